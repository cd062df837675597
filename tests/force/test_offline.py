"""Nothing is ever fetched, also when the tables of leap seconds and of UT1 have aged."""

import pytest

from tests.processes import printed

#: Each starts a process.
pytestmark = pytest.mark.slow

#: A process without a network, whose clock is ten years on for those who look after tables.
WITHOUT_NETWORK = """
import datetime, socket, warnings

def refuse(*_, **__):
    raise AssertionError("somebody asks for the network")

for name in ("socket", "create_connection", "getaddrinfo"):
    setattr(socket, name, refuse if name != "socket" else type("No", (), {"__init__": refuse}))

warnings.simplefilter("error")
import numpy as np
import earthspin
from astropy.time import Time
from astropy.utils import iers

iers.LeapSeconds._today = staticmethod(lambda: Time("2036-01-01", scale="tai", format="iso"))
iers.IERS_Auto.time_now = property(lambda self: Time(64693.0, format="mjd", scale="tai"))
now = Time.now
Time.now = classmethod(lambda cls: cls("2036-01-01", scale="utc"))

def ask(*times, scale):
    with warnings.catch_warnings():
        if times[0] > "2040":  # of the reader's own dates: that their year is dubious
            warnings.simplefilter("ignore")
        dates = Time(list(times), scale=scale)
    return earthspin.torque_series(times=dates).time.values
"""


def without_network(program: str) -> str:
    return printed(WITHOUT_NETWORK + program)


def test_old_tables_do_where_they_reach_and_settings_stay() -> None:
    """32.184 s and 32 leap seconds, TDB - TT of -0.1 ms; UT1 - UTC was 0.355 s (IERS C04)."""
    program = """
iers.conf.auto_max_age = 17
for scale, tdb in (("utc", "2000-01-01T00:01:04.184"), ("ut1", "2000-01-01T00:01:03.829")):
    (found,) = ask("2000-01-01", scale=scale)
    assert abs(found - np.datetime64(tdb)) < np.timedelta64(1, "ms"), found
assert iers.conf.auto_max_age == 17 and iers.conf.auto_download
"""
    without_network(program)


def test_a_date_beyond_the_tables_is_refused_in_one_line() -> None:
    program = """
for scale in ("utc", "ut1"):
    try:
        print(ask("2045-01-01", scale=scale))
    except earthspin.SceneError as error:
        print(error)
"""
    lines = without_network(program).splitlines()
    assert len(lines) == 2
    for line, scale in zip(lines, ("utc", "ut1"), strict=True):
        assert f"{scale.upper()} is not known at this date; give TDB, or install a newer" in line


def test_scenes_ask_for_no_network() -> None:
    program = """
for scene in ("precession", "torque", "wobble", "polar-motion", "pole", "iau"):
    earthspin.run(scene)
earthspin.torque_series("2000-01-01T00:00Z", "2000-01-02T00:00Z", "6 h")
"""
    without_network(program)
