"""`ds.earthspin`: what an answer knows of itself."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from astropy.coordinates import SkyCoord

import earthspin
from earthspin import EARTH, SceneError, UnitsError, load_scene
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
    xr.testing.assert_identical(answer.dataset.earthspin.section(name), section)


def header(data: xr.Dataset, tmp_path: Path, **choices: Any) -> list[str]:
    return data.earthspin.to_csv(tmp_path / "out.csv", **choices).read_text().split("\n")


def test_units_of_a_table_are_chosen_by_column(tmp_path: Path) -> None:
    """C04 at 2015-01-01: x = 0.030767 arcsec."""
    pole = earthspin.polar_motion(span=("2015-01-01", "2015-02-01"), file="c04")
    lines = header(pole, tmp_path, units={"x": "mas"})
    assert lines[0] == "time,x (mas),x_error (mas),y (arcsec),y_error (arcsec)"
    assert float(lines[1].split(",")[1]) == pytest.approx(30.767, abs=1e-9)
    past = earthspin.long_term("-2 kyr", "0 kyr", "1 kyr")
    kyr = header(past, tmp_path, columns="obliquity", units={"epoch": "kyr"})
    assert kyr[0] == "epoch (kyr),obliquity (deg),obliquity_error (deg)"
    assert [line.split(",")[0] for line in kyr[1:4]] == ["-2.0", "-1.0", "0.0"]
    with pytest.raises(UnitsError, match="units of x = '1 m'"):
        header(pole, tmp_path, units={"x": "m"})
    with pytest.raises(SceneError, match="columns with a unit: x, x_error"):
        header(pole, tmp_path, units={"z": "mas"})


def test_a_unit_that_no_longer_holds_is_not_written(tmp_path: Path) -> None:
    pole = earthspin.polar_motion(span=("2015-01-01", "2015-02-01"), file="c04")
    plain = "time,x,x_error,y,y_error"
    own = "time,x (arcsec),x_error (arcsec),y (arcsec),y_error (arcsec)"
    with xr.set_options(keep_attrs=True):
        for part in (pole, pole.isel(time=slice(9)), pole.isel(time=0).drop_vars("time")):
            assert "arcsec" in header(part, tmp_path)[0]
            assert "arcsec" not in header(part * 1000, tmp_path)[0]
        assert header(pole / 1000, tmp_path)[0] == plain
        assert header(-pole, tmp_path)[0] == own
        assert header(pole - pole.mean("time"), tmp_path)[0] == own
    with xr.set_options(keep_attrs=False):
        assert header(pole * 1000, tmp_path)[0] == plain


def test_angles_that_wind_up_may_be_wrapped(tmp_path: Path) -> None:
    past = earthspin.long_term("-2 Myr", "0 kyr", "100 kyr")
    wound = past.earthspin.to_frame().longitude_of_perihelion
    frame = past.earthspin.to_frame(wrap="longitude_of_perihelion")
    wrapped = frame.longitude_of_perihelion
    assert wound.min() < -30_000
    assert wrapped.between(0, 360).all()
    turns = (wound - wrapped) / 360
    assert np.allclose(turns, turns.round(), rtol=0, atol=1e-9)
    with pytest.raises(SceneError, match="wrap = 'eccentricity': it is no angle"):
        past.earthspin.to_frame(wrap="eccentricity")


def test_a_fit_keeps_its_period_and_quality_factor(tmp_path: Path) -> None:
    fit = earthspin.fit_chandler(earthspin.polar_motion())
    first = header(fit, tmp_path)[0].split(",")
    assert {"chandler_period (d)", "chandler_period_error (d)"} <= {*first}
    assert {f"chandler_quality_factor{end}" for end in ("", "_low", "_high")} <= {*first}
    table = pd.read_csv(tmp_path / "out.csv")
    assert (table["chandler_period (d)"] == float(fit.chandler_period)).all()


def test_a_section_is_written_in_one_step(tmp_path: Path) -> None:
    answer = earthspin.forecast(30)
    lines = header(answer, tmp_path, section="bulletin_a")
    assert "x_minus_bulletin_a (arcsec)" in lines[0].split(",")
    table = pd.read_csv(tmp_path / "out.csv")
    difference = answer.x.values - table["bulletin_a_x (arcsec)"]
    assert np.allclose(table["x_minus_bulletin_a (arcsec)"], difference, rtol=0, atol=1e-15)
