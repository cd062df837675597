"""Stiff and extreme cases of what pulls on the bulge, at an instant and on average."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.special import eval_legendre

from earthspin.bodies import MOON, SUN, Body
from earthspin.checks.case import Cases
from earthspin.checks.default_body import default_body
from earthspin.constants import DAY, JULIAN_YEAR, G
from earthspin.parts.sky import places, sky, stretch
from earthspin.questions.pole import pole
from earthspin.questions.precession import (
    mean_rates,
    precession,
    precession_rates,
    torque_samples,
)
from earthspin.questions.torque import torque_series
from earthspin.sky.equator import direction, spherical
from earthspin.sky.iau import ecliptic_pole
from earthspin.torque.average import TAPERS, Window, best_window, precessing_push
from earthspin.torque.gravity import torque_from_declination, torque_from_position
from earthspin.torque.harmonics import zonal_torque
from earthspin.torque.quadrupole import quadrupole_torque, tidal_tensor
from earthspin.torque.rates import circular_orbit_push

FloatArray = NDArray[np.float64]

CASES = Cases("torque")

NORTH = np.array([0.0, 0.0, 1.0])
EPS = float(np.finfo(float).eps)


def _body(**changes: Any) -> Body:
    """The body that questions are about, changed."""
    return default_body().replace(**changes)


def _rate(body: Body | None = None, perturber: Body = SUN) -> xr.Dataset:
    """Averaged rates as `precession` gives them, without all that stands beside them."""
    both = body or _body(), (perturber,)
    above = sky("de421", places(*both))
    samples = torque_samples(above, stretch(above, None), *both)
    return precession_rates(mean_rates(samples, *both, None), samples)


@lru_cache
def _usual() -> xr.Dataset:
    return _rate()


def _leaning(angle: float) -> Body:
    """The default body with its pole at an angle from the normal of its orbit."""
    normal = ecliptic_pole()
    across = np.cross(normal, NORTH)
    across /= np.linalg.norm(across)
    axis = math.cos(angle) * normal + math.sin(angle) * across
    (ra, dec), (ra0, dec0) = ((float(x[0]), float(y[0])) for x, y in _angles(axis, normal))
    return _body(pole=(ra, dec), orbit_pole=(ra0, dec0))


def _angles(*vectors: FloatArray) -> list[tuple[FloatArray, FloatArray]]:
    return [spherical(v[np.newaxis])[:2] for v in vectors]


@CASES.hold(
    "perturber of no mass",
    because="rates are zero and periods infinite: 0/0 lies in wait at every ratio",
    against="no torque, no rate and an infinite period, and nothing that is no number",
    bound=0.0,
)
def _no_mass() -> float:
    found = _rate(perturber=MOON.replace(gm=0.0))
    series = torque_series("2000-01-01", "2000-01-03", "6 h", perturbers=(SUN.replace(gm=0.0),))
    still = abs(found.precession_rate) + abs(found.mean_torque)
    period = 0.0 if np.all(np.isposinf(found.precession_period)) else 1.0
    return float(still.sum()) + float(abs(series.torque).sum()) + period


@CASES.hold(
    "perturber of a thousandfold mass",
    because="errors and rates scale alike; nothing may saturate",
    against="a thousand times the rate, relative",
    bound=5e-15,
)
def _thousandfold() -> float:
    many = _rate(perturber=SUN.replace(gm=1e3 * SUN.gm))
    return float(many.precession_rate[0] / _usual().precession_rate[0] / 1e3 - 1)


@CASES.hold(
    "body without a bulge",
    because="H and J2 are zero together; their quotient C/(M a2) is not defined",
    against="no torque, no rate, an infinite period",
    bound=0.0,
)
def _round() -> float:
    found = _rate(_body(j2=0.0, dynamical_flattening=0.0))
    period = 0.0 if np.all(np.isposinf(found.precession_period)) else 1.0
    return float(abs(found.precession_rate).sum() + abs(found.mean_torque).sum()) + period


@CASES.hold(
    "dynamical flattening of 1e-12",
    because="the precession takes 10^14 years",
    against="the rate in proportion to H, relative",
    bound=5e-15,
)
def _tiny_h() -> float:
    body = _body()
    tiny = body.replace(j2=1e-12 / 3, dynamical_flattening=1e-12)
    ratio = float(_rate(tiny).precession_rate[0] / _usual().precession_rate[0])
    return ratio * float(body.needed("dynamical_flattening")) / 1e-12 - 1


@CASES.hold(
    "prolate body",
    because="H and J2 below zero, where square roots and logarithms would fail",
    against="the same rate the other way, bit for bit",
    bound=0.0,
)
def _prolate() -> float:
    body = _body()
    turned = body.replace(
        j2=-float(body.needed("j2")), dynamical_flattening=-body.needed("dynamical_flattening")
    )
    return float(_rate(turned).precession_rate[0] + _usual().precession_rate[0])


@CASES.hold(
    "retrograde body",
    because="the spin rate is negative",
    against="the same rate the other way, bit for bit",
    bound=0.0,
)
def _retrograde() -> float:
    body = _body()
    turned = body.replace(spin_period=-body.needed("spin_period"))
    return float(_rate(turned).precession_rate[0] + _usual().precession_rate[0])


@CASES.hold(
    "obliquity of 90 degrees",
    because="the push is the small difference of what the two halves of a year do",
    against="cos(90 degrees) = 0: the rate over that of an upright axis",
    bound=2e-6,
)
def _lying() -> float:
    lying = float(_rate(_leaning(np.pi / 2)).precession_rate[0])
    usual = _usual()
    upright = float(usual.precession_rate[0]) / math.cos(math.radians(float(usual.obliquity)))
    return lying / upright


@CASES.hold(
    "obliquity of 1e-6 rad, and of 1e-6 rad less than 180 degrees",
    because="the longitude is all but undefined: both torque and sin2 nearly vanish",
    against="mean push along a circular orbit, (3/2) GM/b3 cos(obliquity), over itself",
    bound=1e-14,
)
def _nearly_upright() -> float:
    phase = 2 * np.pi * np.arange(4000) / 4000
    orbit = 1.5e11 * np.stack([np.cos(phase), np.sin(phase), 0 * phase], axis=1)
    worst = 0.0
    for angle in (1e-6, np.pi - 1e-6):
        axis = np.array([0.0, -math.sin(angle), math.cos(angle)])
        push = precessing_push(torque_from_position(SUN.gm, 1.0, orbit, axis), axis, NORTH)
        closed = circular_orbit_push(SUN.gm, 1.5e11, angle)
        worst = max(worst, abs(float(np.mean(push)) / closed - 1))
    return worst


@CASES.refuse(
    "obliquity of 0",
    because="an axis upright on its orbit has no longitude that could grow",
    saying="stands upright on the orbit",
)
def _upright() -> None:
    _rate(_leaning(0.0))


@CASES.refuse(
    "obliquity of 180 degrees",
    because="an axis upside down on its orbit has no longitude either",
    saying="stands upright on the orbit",
)
def _upside_down() -> None:
    _rate(_leaning(np.pi))


@CASES.refuse(
    "a spin locked three to two",
    because="the torque on the equator's ellipse does not average out: 1,613 years come out for "
    "Mercury, and look right",
    saying="a spin that is locked",
)
def _locked() -> None:
    year = 2 * math.pi * math.sqrt(1.495978707e11**3 / 1.32712440018e20)
    precession(body=_body(spin_period=2 / 3 * year), perturbers=["sun"])


@CASES.hold(
    "perturber over the pole",
    because="at a declination of 90 degrees the right ascension means nothing",
    against="the vector form, which vanishes there, over the largest torque at that distance",
    bound=5e-15,
)
def _over_the_pole() -> float:
    offset = np.array([0.0, 1e-300, 1e-16, 1e-9])
    r = 4e8 * np.stack([offset, 0 * offset, np.ones(4)], axis=1)
    r = np.concatenate([r, -r])
    one = torque_from_position(1e20, 1e35, r, NORTH)
    other = torque_from_declination(1e20, 1e35, *spherical(r))
    return float(np.max(np.abs(one - other)) / (3 * 1e20 * 1e35 / 4e8**3))


@CASES.hold(
    "perturber a million astronomical units away, and at 10^90 m",
    because="r5 overflows, and the torque falls to 10^-271",
    against="torque in proportion to 1/b3, distances of 2^57, 2^203 and 2^299, relative",
    bound=5e-15,
)
def _far() -> float:
    place = np.array([[0.6, 0.0, 0.8]])
    near = torque_from_position(1.0, 1.0, place, NORTH)[0, 1]
    powers = (57, 203, 299)
    far = [torque_from_position(1.0, 1.0, np.ldexp(place, k), NORTH)[0, 1] for k in powers]
    scaled = [np.ldexp(t, 3 * k) / near for t, k in zip(far, powers, strict=True)]
    return float(np.max(np.abs(np.array(scaled) - 1)))


@CASES.refuse(
    "perturber in the very centre",
    because="the distance is zero: 0/0",
    saying="no direction to pull in",
)
def _in_the_centre() -> None:
    torque_from_position(1e20, 1e35, np.array([[4e8, 0.0, 0.0], [0.0, 0.0, 0.0]]), NORTH)


SWOLLEN = 5e8  # m, beyond the Moon


@CASES.refuse(
    "perturber inside the body, a series",
    because="the formula goes on inside, and gives a plausible wrong number",
    saying="holds outside it alone",
)
def _inside_a_series() -> None:
    torque_series(times=["2000-01-01"], body=_body(radius=SWOLLEN))


@CASES.refuse(
    "perturber inside the body, an average",
    because="the formula goes on inside, and gives a plausible wrong number",
    saying="holds outside it alone",
)
def _inside_an_average() -> None:
    _rate(_body(radius=SWOLLEN), MOON)


@CASES.refuse(
    "perturber inside the body, the pole",
    because="the formula goes on inside, and gives a plausible wrong number",
    saying="holds outside it alone",
)
def _inside_the_pole() -> None:
    pole("2000-01-01", "2000-01-11", "1 d", body=_body(radius=SWOLLEN))


@CASES.refuse(
    "perturber at no distance, by its declination",
    because="1/b3 is infinite",
    saying="no direction to pull in",
)
def _no_distance() -> None:
    torque_from_declination(1e20, 1e35, np.zeros(2), np.full(2, 0.3), np.array([4e8, 0.0]))


@CASES.hold(
    "three forms of one torque, masses of 1e-30 and 1e40 kg together",
    because="seventy decades are added up in one tensor",
    against="declination, position and tide tensor against each other, over the largest",
    bound=5e-15,
)
def _three_forms() -> float:
    rng = np.random.default_rng(7)
    r = rng.normal(size=(500, 3)) * 10.0 ** rng.uniform(7, 13, (500, 1))
    worst = 0.0
    for mass in (1e-30, 1e40):
        gm = G.value * mass
        one = torque_from_position(gm, 1.0, r, NORTH)
        other = torque_from_declination(gm, 1.0, *spherical(r))
        tide = quadrupole_torque(tidal_tensor([(gm, r.T)]), np.broadcast_to(NORTH, r.shape).T).T
        size = 3 * gm / np.linalg.norm(r, axis=1) ** 3
        for a in (other, tide):
            worst = max(worst, float(np.max(np.max(np.abs(a - one), axis=1) / size)))
    return worst


@CASES.hold(
    "zonal harmonics of degree 30 with the mass on the surface",
    because="P_30 has coefficients of 10^8 that nearly cancel",
    against="n (P_(n-1) - u P_n)/(1 - u2) by scipy's recurrence, over the largest slope",
    bound=1e-13,
)
def _harmonics() -> float:
    u = np.linspace(-0.99, 0.99, 41)
    place = np.stack([np.sqrt(1 - u * u), 0 * u, u])
    axis = np.broadcast_to(NORTH[:, np.newaxis], place.shape)
    found = zonal_torque(30, 1.0, 1.0, 1.0, place, axis)[1] / -place[0]
    slope = 30 * (eval_legendre(29, u) - u * eval_legendre(30, u)) / (1 - u * u)
    return float(np.max(np.abs(found - slope)) / np.max(np.abs(slope)))


@CASES.hold(
    "a window of whole cycles forgets them exactly",
    because="the signal that is removed is a million times what is left",
    against="the constant below it, over the size of the signal; sin4 on 3 to 8 cycles",
    bound=5e-15,
)
def _forgets() -> float:
    worst = 0.0
    for turns in range(3, 9):
        window = Window(0.0, turns, 6798 * DAY, "sin4")
        times = window.sample_times(6798 * DAY / 4000)
        for harmonic in (1, 2, 7, 400):
            signal = 1e6 * np.cos(2 * np.pi * harmonic * times / window.cycle + 0.4)
            worst = max(worst, abs(float(window.mean(times, 1.0 + signal)) - 1) / 1e6)
    return worst


@CASES.hold(
    "averages at steps that resonate with the month and the node",
    because="a handful of samples, some of them on the very edge of the window",
    against="a constant comes out as itself through every taper, relative",
    bound=2e-13,
)
def _weights() -> float:
    worst = 0.0
    for taper in TAPERS:
        window = Window(1e9, 5, 6798 * DAY, taper)
        for step in (DAY, 27.212 * DAY, window.cycle / 7):
            times = window.sample_times(step)
            worst = max(worst, abs(float(window.mean(times, np.full(times.size, 7.5))) / 7.5 - 1))
    return worst


@CASES.refuse(
    "an average over fewer than three cycles",
    because="with two, nothing tells how far the mean is off",
    saying="needs three turns of the slowest cycle",
)
def _too_short() -> None:
    best_window(0.0, 2.99 * 18.6 * JULIAN_YEAR, 18.6 * JULIAN_YEAR, 0.0)


@CASES.refuse(
    "an average over a scene's span of 30 years",
    because="the Moon's node turns but once and a half",
    saying="needs three turns of the slowest cycle",
)
def _short_span() -> None:
    precession(span=("1985-01-01", "2015-01-01"))


@CASES.refuse(
    "an accuracy that no kernel gives",
    because="the number would look the same",
    saying="was asked for",
)
def _too_accurate() -> None:
    precession(accuracy=1e-12)


@CASES.hold(
    "ten thousand bodies at once",
    because="prolate, round, retrograde and slow ones stand in one call",
    against="six of them one at a time, bit for bit",
    bound=0.0,
    slow=True,
)
def _ten_thousand() -> float:
    rng = np.random.default_rng(1)
    h = rng.uniform(-0.01, 0.01, 10_000)
    h[1234] = 0.0
    spins = rng.uniform(-3e5, 3e5, 10_000)
    body = _body()
    factor = float(body.needed("j2")) / float(body.needed("dynamical_flattening"))
    many = body.replace(
        j2=xr.DataArray(factor * h, dims="body"),
        dynamical_flattening=xr.DataArray(h, dims="body"),
        spin_period=xr.DataArray(spins, dims="body"),
    )
    whole, worst = precession(body=many), 0.0
    for n in (0, 1, 77, 1234, 5000, 9999):
        one = precession(
            body=body.replace(
                j2=float(factor * h[n]),
                dynamical_flattening=float(h[n]),
                spin_period=float(spins[n]),
            )
        )
        for name in ("precession_rate", "precession_rate_error", "mean_torque"):
            off = abs(whole[name].isel(body=n).values - one[name].values)
            worst = max(worst, float(np.max(off)))
    return worst


@CASES.hold(
    "axes and directions given at the poles of the sky",
    because="a declination of exactly 90 degrees leaves cosines of 6e-17",
    against="unit vectors along the third axis",
    bound=5e-15,
)
def _sky_poles() -> float:
    found = np.array([direction(1.0, math.pi / 2), -direction(1.0, -math.pi / 2)])
    return float(np.max(np.abs(found - NORTH)))
