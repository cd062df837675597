"""Bodies with a place of their own: Skyfield's vector functions, orbits, and what is none."""

import math
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from skyfield.api import EarthSatellite, load, load_file
from skyfield.data import mpc
from skyfield.jpllib import SpiceKernel
from skyfield.vectorlib import VectorFunction

import earthspin
from earthspin import EARTH, MOON, SUN, Body
from earthspin.bodies import BODIES
from earthspin.errors import Where
from earthspin.sky.ephemeris import find_kernel
from earthspin.sky.sources import read_position, trajectory, write_position
from tests.refusals import refused

JUPITER = BODIES["jupiter"]
SPAN = ("2000-01-01", "2000-02-01", "1 d")
SCALE = load.timescale(builtin=True)
SOURCES = pytest.mark.parametrize("source", ["jplephem", "skyfield"])
HERE = Where("position")


@pytest.fixture(scope="module")
def kernel() -> Iterator[SpiceKernel]:
    opened = load_file(str(find_kernel("de421")))
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def orbit() -> VectorFunction:
    """A comet as the Minor Planet Center gives one: about the Sun, NAIF 10."""
    names = [
        *("perihelion_year", "perihelion_month", "perihelion_day", "perihelion_distance_au"),
        *("eccentricity", "argument_of_perihelion_degrees", "inclination_degrees"),
        *("longitude_of_ascending_node_degrees", "designation"),
    ]
    row = pd.Series(dict(zip(names, (2000, 2, 5.0, 0.2, 0.999, 130, 89, 282, "C/X"), strict=True)))
    return mpc.comet_orbit(row, SCALE, 1.32712440041e11)


@dataclass(frozen=True)
class Still:
    """A body that stands somewhere, or is lost."""

    place: tuple[float, ...]
    centre: int = 399
    coverage: tuple[float, float] = (-math.inf, math.inf)

    def positions(self, days: np.ndarray) -> np.ndarray:
        return np.broadcast_to(np.array(self.place), (days.size, len(self.place)))


@dataclass
class Mutable:
    """A place that cannot be hashed."""

    centre: int = 399
    coverage: tuple[float, float] = (-math.inf, math.inf)

    def positions(self, days: np.ndarray) -> np.ndarray:
        return np.zeros((days.size, 3))


def series(*perturbers: object, **more: object) -> object:
    return earthspin.torque_series(*SPAN, perturbers=list(perturbers), **more)  # type: ignore[arg-type]


@SOURCES
def test_segments_and_sums_of_a_kernel(kernel: SpiceKernel, source: str) -> None:
    """The same torques, the same errors: a kernel is what they stand on."""
    plain = series("sun", "moon", "jupiter", source=source)
    own = series(
        kernel["sun"],
        MOON.replace(position=kernel["moon"]),
        JUPITER.replace(position=kernel["jupiter barycenter"]),
        source=source,
    )
    # measured: 1.4e-13 for the Moon, whose way from the barycentre the fast reader cancels
    assert abs(own.torque - plain.torque).max() < 1e-12 * abs(plain.torque).max()
    for name in ("direction_error", "distance_error"):
        assert (own[name] == plain[name]).all()
    assert earthspin.run(own).identical(own)
    assert "de421" in own.attrs["own_positions"]


@SOURCES
def test_a_comet_is_where_skyfield_puts_it(
    kernel: SpiceKernel, orbit: VectorFunction, source: str
) -> None:
    days = np.arange(31.0) - 0.5
    away = (kernel["sun"] + orbit - kernel["earth"]).at(SCALE.tdb_jd(2451545.0, days)).position.m.T
    for position in (orbit, kernel["sun"] + orbit):
        comet = Body(name="comet", gm=1e5, position=position)
        found = series("sun", comet, source=source)
        distance = found.distance.sel(perturber="comet").values
        assert np.allclose(distance[:31], np.linalg.norm(away, axis=1), rtol=1e-13, atol=0)


@SOURCES
def test_a_satellite_of_the_earth(source: str) -> None:
    """Seen from the Earth it needs no kernel: no leg that would cancel."""
    satellite = EarthSatellite(
        "1 25544U 98067A   14020.93268519  .00009878  00000-0  18200-3 0  5082",
        "2 25544  51.6498 109.4756 0003572  55.9686 274.8005 15.49815350868473",
        "ISS",
        SCALE,
    )
    body = Body(name="iss", gm=1e-5, position=satellite)
    t = SCALE.tdb_jd(2456678.5, np.arange(5) / 24)
    found = earthspin.torque_series(times=t, perturbers=body, source=source)
    # measured: 6e-14, the rounding of its time; by way of the barycentre it would be 5e-12
    assert np.allclose(found.distance[:, 0], satellite.at(t).distance().m, rtol=3e-13, atol=0)


@SOURCES
def test_the_body_that_spins_may_have_a_place_of_its_own(kernel: SpiceKernel, source: str) -> None:
    plain = series("sun", "moon", source=source)
    for body in (kernel["earth"], EARTH.replace(position=kernel["earth"])):
        own = series("sun", "moon", body=body, source=source)
        off = abs(own.torque - plain.torque).max() / abs(plain.torque).max()
        assert off < 1e-12  # measured: 1.7e-13


def test_no_error_is_claimed_where_none_was_measured(orbit: VectorFunction) -> None:
    comet = Body(name="comet", gm=1e5, position=orbit)
    found = series("sun", comet)
    for name in ("direction_error", "distance_error", "torque_magnitude_error"):
        assert np.isnan(found[name].sel(perturber="comet")).all()
        assert np.isfinite(found[name].sel(perturber="sun")).all()
        assert "not measured" in found[name].attrs["no_error"]
    rates = earthspin.precession(perturbers=[SUN, comet], span=("1950-01-01", "2050-01-01"))
    for name in ("precession_rate_error", "precession_period_error", "mean_torque_error"):
        assert np.isfinite(rates[name]).values.tolist() == [True, False, False]
    assert np.isnan(earthspin.pole(*SPAN, perturbers=[SUN, comet]).direction_error).all()
    with pytest.raises(earthspin.SceneError, match="error of its positions"):
        earthspin.compare_iau(perturbers=[SUN, MOON, comet])


def test_a_moon_of_ones_own_leaves_the_sections_without_errors(kernel: SpiceKernel) -> None:
    class Mine(VectorFunction):  # type: ignore[misc]
        center, target = 0, 301

        def _at(self, t: object) -> tuple[np.ndarray, np.ndarray, None, None]:
            place = kernel["moon"].at(t)
            return place.position.au, place.velocity.au_per_d, None, None

    scene = earthspin.load_scene("precession").replace(perturbers=[SUN, Mine()])
    tree = earthspin.run_tree(scene, ["standstills", "seasons", "iau_2006"])
    plain = earthspin.precession()
    assert np.allclose(tree.precession_rate, plain.precession_rate, rtol=1e-12, atol=0)
    for path in ("standstills/standstill_declination_error", "iau_2006/closure_error"):
        assert np.isnan(tree[path]).all()
        assert "for moon" in tree[path].attrs["no_error"]


def test_positions_from_a_kernel_have_its_error(kernel: SpiceKernel) -> None:
    moon = MOON.replace(position=kernel["moon"])
    # DE421 and DE440 differ by 7.2 mas, and the pole is known to 1 mas (one standard deviation)
    expected = math.hypot(7.2e-3, 1.96e-3)
    found = float(series("sun", moon).direction_error.max())
    assert found == pytest.approx(expected, rel=1e-5, abs=0)
    nameless = Body(name="it", gm=MOON.gm, position=kernel["moon"])
    rates = earthspin.precession(perturbers=[SUN, nameless])
    assert np.isfinite(rates.precession_rate_error).all()


def test_a_live_object_is_not_run_again_silently(orbit: VectorFunction) -> None:
    found = series("sun", Body(name="comet", gm=1e5, position=orbit))
    with pytest.raises(earthspin.SceneError, match="C/X"):
        earthspin.run(found)


@pytest.mark.parametrize("pair", [("sun", "earth"), ("earth", "mars"), (301, 399), (3, 0)])
def test_what_is_written_gives_the_same_bits(kernel: SpiceKernel, pair: tuple[object, ...]) -> None:
    """Sums and reversed segments among them."""
    one, other = pair
    function = kernel[one] if other == 0 else kernel[one] - kernel[other]
    again = read_position(write_position(function), HERE)
    t = SCALE.tdb_jd(2451545.0, np.linspace(-9000.0, 9000.0, 7))
    assert (again.center, again.target) == (function.center, function.target)
    assert np.array_equal(again.at(t).position.au, function.at(t).position.au)
    assert trajectory(again).coverage == trajectory(function).coverage


def test_a_kernel_that_has_changed(kernel: SpiceKernel, tmp_path: Path) -> None:
    copy = tmp_path / "mine.bsp"
    shutil.copy(find_kernel("de421"), copy)
    opened = load_file(str(copy))
    found = series("sun", JUPITER.replace(position=opened["jupiter barycenter"]))
    opened.close()
    assert earthspin.run(found).identical(found)
    with copy.open("ab") as file:
        file.write(b"\0" * 1024)
    with pytest.raises(earthspin.KernelError, match="SHA-256 is another"):
        earthspin.run(found)
    copy.unlink()
    with pytest.raises(earthspin.KernelError, match="no such file"):
        earthspin.run(found)


test_what_is_no_place = refused(
    (3, "give a vector function"),
    ("moon", "give a vector function"),
    ({"kernel": "de421", "centre": 0, "target": 77}, "the kernel has 0 to 1"),
    ({"kernel": "de421", "center": 0, "target": 5}, "did you mean 'centre'"),
    ({"kernel": "de421", "centre": 0}, "name a segment like"),
    (
        [
            {"kernel": "de421", "centre": 0, "target": 3},
            {"kernel": "de421", "centre": 0, "target": 5},
        ],
        "each segment must start where the previous",
    ),
    call=lambda position: SUN.replace(position=position),
    kind=earthspin.SceneError,
)


def test_what_cannot_be_used(kernel: SpiceKernel, orbit: VectorFunction) -> None:
    with pytest.raises(earthspin.SceneError, match="its mass is not known"):
        series(orbit)
    with pytest.raises(earthspin.SceneError, match="the position of one body"):
        series("sun", ephemeris=kernel["sun"])
    with pytest.raises(earthspin.SceneError, match="NAIF"):
        SUN.replace(position=-orbit)
    with pytest.raises(earthspin.SceneError, match="dataclass"):
        SUN.replace(position=Mutable())


@SOURCES
def test_places_that_are_none(source: str) -> None:
    for place, words in (
        ((np.nan, 0.0, 0.0), "no finite position on 2000-01-01T00:00:00 TDB"),
        ((1e11, 0.0), r"one body has shape \(32, 3\)"),
        ((1.0, 0.0, 0.0), "lies inside"),
    ):
        with pytest.raises(earthspin.UndefinedError, match=words):
            series(Body(name="it", gm=1.0, position=Still(place)), source=source)


@SOURCES
def test_times_outside_a_trajectory(source: str) -> None:
    short = Body(name="it", gm=1.0, position=Still((1e11, 0.0, 0.0), coverage=(0.0, 3.0)))
    with pytest.raises(earthspin.CoverageError, match=r"de421 with Still.*2000-01-01T12:00:00 to"):
        series(short, source=source)


def test_nothing_that_limits_a_span() -> None:
    here = EARTH.replace(position=Still((1e11, 0.0, 0.0), centre=0))
    there = SUN.replace(position=Still((0.0, 1.0, 0.0), centre=0))
    with pytest.raises(earthspin.SceneError, match="give a span"):
        earthspin.precession(body=here, perturbers=there)


def test_a_failing_vector_function(kernel: SpiceKernel) -> None:
    class Broken(VectorFunction):  # type: ignore[misc]
        center, target = 399, 1

        def _at(self, t: object) -> None:
            raise ZeroDivisionError("it broke")

    with pytest.raises(earthspin.UndefinedError, match="it broke"):
        series(Body(name="it", gm=1.0, position=Broken()))
