"""`ds.earthspin`: what an answer knows of itself."""

import numpy as np
import pytest
import xarray as xr
from astropy.coordinates import SkyCoord

import earthspin
from earthspin import EARTH, SceneError, load_scene
from earthspin.engine.run import Run
from earthspin.questions.precession import Precession
from earthspin.questions.wobble import Wobble
from tests import shipped
from tests.processes import printed


def test_the_scene_is_the_question(precession_result: xr.Dataset) -> None:
    scene = precession_result.earthspin.scene
    assert isinstance(scene, Precession)
    assert scene.body.dynamical_flattening == EARTH.dynamical_flattening
    assert [one.name for one in scene.perturbers] == ["sun", "moon"]
    assert scene.title == "Precession of the equinoxes"


def test_the_plan_is_a_table_with_its_seconds() -> None:
    run = Run(load_scene("wobble", {"wobble.ocean": "global"}))
    run.answer()
    plan = run.plan()
    rows = {row.part: row for row in plan.rows}
    assert rows["wobble-rungs"].status == "ran"
    assert rows["wobble-rungs"].seconds is not None
    assert rows["wobble-rungs"].seconds > 0
    assert rows["sensitivity"].seconds is None
    assert len(plan.to_frame()) == len(Wobble.graph.parts)


def test_an_answer_without_labels_is_one_row() -> None:
    from earthspin.engine.accessor import Answer

    plain = xr.Dataset({"x": ((), 2.0), "x_error": ((), 0.1), "word": ((), "yes")})
    frame = Answer(plain).to_frame()
    assert frame.to_dict("records") == [{"x": 2.0, "x_error": 0.1, "word": "yes"}]


def test_vectors_become_coordinates_of_astropy() -> None:
    """The mean pole of IAU 2006, of which right ascension and declination come from ERFA."""
    import erfa

    past = earthspin.long_term("-1000-01-01", "0 kyr", "1 kyr")
    pole = past.earthspin.to_skycoord("pole")
    assert pole.shape == past.epoch.shape
    expected = erfa.pmat06(2451545.0, past.epoch.values * 365.25)[:, 2]
    there = SkyCoord(*expected.T, representation_type="cartesian", frame="icrs")
    # 0.3 arcsec measured at -3 kyr, where IAU 2006 itself ends
    assert pole.separation(there).arcsec.max() < 1.0
    path = earthspin.pole("2000-01-01T12:00", "2000-01-21T12:00", "10 d")
    start = path.earthspin.to_skycoord()[0]
    across = np.hypot(path.X.values[0], path.Y.values[0])
    assert start.dec.rad == pytest.approx(np.arctan2(path.Z.values[0], across), abs=1e-15)


@pytest.mark.parametrize("name", ["obliquity", "nonsense", "", np.array([1.0, 2.0]), ["pole"]])
def test_what_is_no_vector_is_named(name: object) -> None:
    past = earthspin.long_term("-10 kyr", "0 kyr", "5 kyr")
    with pytest.raises(SceneError, match="pole, ecliptic_pole"):
        past.earthspin.to_skycoord(name)


def test_vectors_along_other_axes_are_refused() -> None:
    year = earthspin.torque_series("2000-01-01", "2000-01-03", "1 d")
    with pytest.raises(SceneError, match="no vector in the GCRS"):
        year.earthspin.to_skycoord("torque")


def test_methods_that_other_packages_register_are_listed_and_load_nothing_before_a_call() -> None:
    program = (
        "import sys, earthspin, xarray\n"
        "answer = earthspin.love_numbers()\n"
        "assert {'plot', 'to_iers_table'} <= set(dir(answer.earthspin))\n"
        "assert not hasattr(answer.earthspin, 'print')\n"
        "assert not {'matplotlib', 'earthspin.views.rendering'} & set(sys.modules)\n"
        "figures = answer.earthspin.plot()\n"
        "assert 'matplotlib' in sys.modules\n"
        "print(len(figures), answer.earthspin.plot.__doc__.split('.')[0])"
    )
    assert printed(program).strip() == "1 Draw the standard figures of a result"


@pytest.mark.parametrize(
    ("scene", "name", "dims"),
    [("precession", "standstills", "standstill"), ("long-term", "budget", "epoch")],
)
def test_a_section_has_the_labels_of_its_own_dimensions(scene: str, name: str, dims: str) -> None:
    answer = shipped.tree(scene).earthspin
    section = answer.section(name)
    assert {*section.coords} >= {dims}
    own = shipped.tree(scene)[name].to_dataset(inherit=False)
    assert section.sizes == own.sizes
    assert len(section.to_dataframe()) == np.prod([*own.sizes.values()])
    with pytest.raises(SceneError, match=f"did you mean '{name}'.*neglected"):
        answer.section(f"{name}x")
    with pytest.raises(SceneError, match="run_tree"):
        answer.dataset.earthspin.section(name)
