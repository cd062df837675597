"""Results beside observations, and the sizes of what is neglected."""

import math
from pathlib import Path

import pytest

import earthspin
from data_tools.worlds import PUBLISHED, left_out, locked, worlds
from earthspin import MARS, MOON
from earthspin.bodies.earth_moon_sun import MOON_OBLIQUITY
from earthspin.bodies.moons import TITAN_OBLIQUITY
from earthspin.questions.cassini_states import CassiniStates
from earthspin.questions.precession import Precession
from earthspin.views.rendering import tables_for
from earthspin.views.report import write_wobble_report
from tests.reference import lunar_state


def sizes(tree) -> dict[str, float]:  # type: ignore[no-untyped-def]
    """Sizes of what an answer leaves out, by effect, in the unit of the section."""
    section = tree["neglected"].to_dataset()
    return dict(zip(section.effect.values.tolist(), section.neglected_effect.values, strict=True))


def test_the_moon_on_its_real_orbit_measures_what_the_state_leaves_out() -> None:
    """Another method: the energy of the figure averaged over the orbit of DE421."""
    of = lunar_state.sky()
    plain, sun, node = (
        lunar_state.obliquity(of, with_sun=s, from_node=n)
        for s, n in ((False, False), (True, False), (False, True))
    )
    tree = earthspin.run_tree(CassiniStates(body=MOON), ["neglected"])
    own = float(tree.obliquity[0])
    told = sizes(tree)
    assert plain - own == pytest.approx(told["the Sun in the orbit"], rel=0, abs=1e-4)
    assert sun - plain == pytest.approx(told["pull of the Sun"], rel=0, abs=1e-4)
    assert node - plain == pytest.approx(told["spin counted from the node"], rel=0, abs=1e-4)
    # all of them on, and the tilt to the ecliptic is what is observed, 1.543 deg: 0.0023 measured
    full = lunar_state.obliquity(of, with_sun=True, from_node=True)
    assert full - math.degrees(lunar_state.ORBIT.i) == pytest.approx(1.543, rel=0, abs=0.004)


@pytest.mark.parametrize(
    ("name", "observed"), [("moon", MOON_OBLIQUITY.value), ("titan", TITAN_OBLIQUITY.value)]
)
def test_what_is_observed_lies_inside_what_is_printed(name: str, observed: float) -> None:
    (row,) = (row for row in locked() if row.name == name)
    assert abs(row.obliquity - observed) > 2 * row.error
    assert abs(row.obliquity - observed) <= row.error + row.left_out


def test_an_orbit_of_ones_own_has_no_sizes() -> None:
    orbit = {"period": "27.3 d", "e": 0.05, "i": "5 deg", "node_period": "-6798 d"}
    tree = earthspin.run_tree(CassiniStates(body=MOON, orbit=orbit), ["neglected"])
    assert sizes(tree) == {}
    heavier = earthspin.run_tree(CassiniStates(body=MOON.replace(j2=3e-4)), ["neglected"])
    assert sizes(heavier) == {}


def test_a_table_of_states_gives_the_size_that_is_larger_than_its_errors() -> None:
    tree = earthspin.run_tree(CassiniStates(body=MOON), ["neglected"])
    (effect, largest), *_ = sizes(tree).items()
    error = float(tree.obliquity_error[0])
    assert abs(largest) > error
    table, *_ = tables_for(tree.to_dataset())
    assert table.rows[0][1] == f"{float(tree.obliquity[0]):.5f}({error * 1e5:.0f})"
    assert f"Left out: {effect}: {largest:.3g} deg" in table.note


def test_the_computed_wobble_is_one_number_in_table_report_and_readme(tmp_path: Path) -> None:
    tree = earthspin.run_tree("wobble", ["observed", "neglected"])
    top = tree.to_dataset().isel(rung=-1)
    one = f"{float(top.period_solar):.1f}({float(top.period_solar_error):.1f})"
    ladder, *_ = tables_for(tree)
    assert ladder.rows[-1][1] == one
    assert f"Left out: {tree.attrs['neglected']}" in ladder.note
    _, (page, *_) = write_wobble_report(tmp_path, figures=False)
    text = page.read_text()
    assert text.count(one) == 2 == text.count(f"{float(top.period_solar):.1f}(")
    readme = Path("README.md").read_text()
    assert one in readme
    assert one.replace("(", " ± ").replace(")", " days") in readme


def test_rates_of_worlds_beside_observed_ones() -> None:
    rows = {row.name: row for row in worlds()}
    for name, row in rows.items():
        if row.refused or math.isnan(row.left_out):
            continue
        known = PUBLISHED[name].number.uncertainty or 0.0
        allowed = math.hypot(row.error + row.left_out, 1.96 * known)
        assert abs(row.rate - row.published) <= allowed, name
    assert math.isnan(rows["venus"].left_out)
    # the observed rate of Mars includes geodesic precession; ours does not
    told = sizes(earthspin.run_tree(Precession(body="mars"), ["neglected"]))
    assert rows["mars"].rate + told["geodesic"] == pytest.approx(7.6083, rel=0, abs=0.0041)
    other = earthspin.run_tree(Precession(body=MARS.replace(j2=1e-3)), ["neglected"])
    assert "geodesic" not in sizes(other)
    assert math.isnan(left_out(other))


def test_nodes_of_satellites_are_no_error_of_the_mean_rate() -> None:
    """Of what is neglected for Saturn, only C counts; the nodes are zero in the mean."""
    tree = earthspin.run_tree(Precession(body="saturn"), ["neglected"])
    assert max(sizes(tree).values()) > 0.25
    assert left_out(tree) == pytest.approx(0.07, rel=1e-12, abs=0)
