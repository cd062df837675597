"""Numbers of the page on models, times and frames, and of the first hour that was tried."""

from __future__ import annotations

import erfa
import numpy as np
from astropy.time import Time
from scipy.spatial.transform import Rotation

import earthspin
from earthspin.constants import ARCSEC, DAY, J2000_JD, JULIAN_YEAR
from earthspin.motion.effects import EFFECTS, RIGID
from tests.docs.numbers.answers import at_j2000_with_response, from_the_iau, value
from tests.docs.numbers.sentence import Part, Sentence, Told

FRAMES, TESTING = "docs/frames.md", "docs/testing.md"


def rigid_from_the_iau() -> list[float]:
    """Largest distance, mas, and the share of dates beyond 60 mas, %."""
    distance, _ = from_the_iau(*RIGID)
    return [float(distance.max()), 60.0, 100 * float(np.mean(distance > 60))]


def triaxial_share() -> float:
    """What B - A adds to the torque, over the largest torque, %."""
    year = earthspin.torque_series("2026-01-01", "2027-01-01", "6 h")
    more = float(year.attrs["neglected"].split()[1])
    return 100 * more / float(year.torque_magnitude.max())


def apart_of_tt() -> float:
    """Largest TDB - TT, ms."""
    return float(1e3 * np.abs(erfa.dtdb(J2000_JD, np.arange(0.0, 9000.0, 5.0), 0, 0, 0, 0)).max())


def precession_of_tt() -> float:
    """What the axis precesses in the largest TDB - TT, arcsec."""
    rate = value("precession", "/", "precession_rate", perturber="total") / JULIAN_YEAR
    return rate * apart_of_tt() / 1e3


def zero_hours_utc() -> float:
    """Length from 0h TDB to 0h UTC, s, to the millisecond of TT."""
    midnight = Time("2026-01-01", scale="utc")
    return round(float((midnight.tt.jd2 - midnight.jd2) * DAY), 3)


def frame_bias() -> float:
    return float(Rotation.from_matrix(erfa.bp06(J2000_JD, 0.0)[0]).magnitude() / ARCSEC)


MEASURED = [
    Sentence(FRAMES, "what $B - A$ adds is {} %", triaxial_share),
    Sentence(
        FRAMES,
        "up to {} mas from the pole of IAU 2006/2000A between 1950 and 2050, above {} mas at {} %",
        rigid_from_the_iau,
    ),
    Sentence(
        FRAMES,
        "| {} mas from IAU 2006/2000A between 1950 and 2050, {} mas at J2000.0",
        lambda: [float(from_the_iau(*EFFECTS)[0].max()), at_j2000_with_response()],
    ),
    Sentence(FRAMES, "is 0h TDB, {} s before 0h UTC", zero_hours_utc),
    Sentence(FRAMES, "they differ by {} ms at most", apart_of_tt, bound=True),
    Sentence(
        FRAMES,
        "which is ${}$ arcsec of precession",
        precession_of_tt,
    ),
    Sentence(FRAMES, "by the frame\nbias, {} arcsec", frame_bias, 0.005),
    Sentence(FRAMES, "a Julian year of {} d,", lambda: JULIAN_YEAR / DAY),
    Sentence(FRAMES, "a day {} s.", lambda: DAY),
    Sentence(
        FRAMES,
        "ecliptic of J2000.0, about {} arcsec",
        lambda: float(erfa.obl06(J2000_JD, 0) / ARCSEC),
    ),
]

TOLD = [
    Told("docs/coverage.md", "half-width of a {} % interval", "what an error is, by definition"),
    Told(FRAMES, "the {term}`Chandler wobble` to {} %", "the error that the last rung claims"),
    Told(FRAMES, "towards {}° west", "the axes of the IERS, by definition"),
    Told(FRAMES, "half-widths of {} %", "what an error is, by definition"),
    Part(TESTING, "## The pages", "run times of the first hour, tried once"),
]
