"""Stiff and extreme cases of what pulls on the bulge, at an instant and on average."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.special import eval_legendre

from earthspin.bodies import MOON, SUN, Body
from earthspin.bodies.mean_orbits import MEAN_SUN
from earthspin.checks.case import Cases, Distances, apart, hard_because, held_against, refused
from earthspin.checks.sky import BODY, J2, H
from earthspin.constants import ARCSEC_PER_YEAR, DAY, JULIAN_YEAR, G
from earthspin.parts.averages import mean_rates, mean_torques, torque_samples, window_means
from earthspin.parts.sky import places, sky, stretch
from earthspin.questions.pole import pole
from earthspin.questions.precession import precession, precession_rates
from earthspin.questions.torque import torque_series
from earthspin.sky.equator import direction, spherical
from earthspin.sky.iau import ecliptic_pole
from earthspin.torque.average import TAPERS, Window, best_window, precessing_torque
from earthspin.torque.gravity import torque_from_declination, torque_from_position
from earthspin.torque.harmonics import zonal_torque
from earthspin.torque.quadrupole import quadrupole_torque, tidal_tensor
from earthspin.torque.rates import circular_orbit_torque

FloatArray = NDArray[np.float64]

CASES = Cases("torque")

NORTH = np.array([0.0, 0.0, 1.0])


def _rate(body: Body = BODY, perturber: Body = SUN) -> xr.Dataset:
    """Averaged rates as `precession` gives them, without all that stands beside them."""
    both = body, (perturber,)
    above = sky("de421", places(*both), "jplephem")
    samples = torque_samples(above, stretch(above, None), *both)
    means = mean_torques(window_means(samples, both[1]))
    return precession_rates(mean_rates(means, *both), means, body).dataset()


@lru_cache
def _usual() -> xr.Dataset:
    return _rate()


def _leaning(angle: float) -> Body:
    """The default body with its pole at an angle from the normal of its orbit."""
    normal = ecliptic_pole()
    across = np.cross(normal, NORTH)
    across /= np.linalg.norm(across)
    axis = math.cos(angle) * normal + math.sin(angle) * across
    return BODY.replace(pole=_sky_angles(axis), orbit_pole=_sky_angles(normal))


def _sky_angles(direction: FloatArray) -> tuple[float, float]:
    """Right ascension and declination, rad."""
    ra, dec, _ = spherical(direction[np.newaxis])
    return float(ra[0]), float(dec[0])


def _at_rest(rates: xr.Dataset) -> Iterator[xr.DataArray]:
    """What is left of a torque, a rate, and of a period short of infinity."""
    yield rates.mean_torque
    yield rates.precession_rate
    yield ~np.isposinf(rates.precession_period)


@CASES.case("perturber of no mass")
@hard_because("rates are zero and periods infinite: 0/0 lies in wait at every ratio")
@held_against("no torque, no rate and an infinite period, and nothing that is no number", bound=0.0)
def _no_mass() -> Distances:
    yield from _at_rest(_rate(perturber=MOON.replace(gm=0.0)))
    none = (SUN.replace(gm=0.0),)
    yield torque_series("2000-01-01", "2000-01-03", "6 h", perturbers=none).torque


@CASES.case("perturber of a thousandfold mass")
@hard_because("errors and rates scale alike; nothing may saturate")
@held_against("a thousand times the rate, relative", bound=5e-15)
def _thousandfold() -> Distances:
    many = _rate(perturber=SUN.replace(gm=1e3 * SUN.gm))
    yield many.precession_rate[0] / _usual().precession_rate[0] / 1e3 - 1


@CASES.case("body without a bulge")
@hard_because("H and J2 are zero together; their quotient C/(M a2) is not defined")
@held_against("no torque, no rate, an infinite period", bound=0.0)
def _round() -> Distances:
    yield from _at_rest(_rate(BODY.replace(j2=0.0, dynamical_flattening=0.0)))


@CASES.case("dynamical flattening of 1e-12")
@hard_because("the precession takes 10^14 years")
@held_against("the rate in proportion to H, relative", bound=5e-15)
def _tiny_h() -> Distances:
    tiny = _rate(BODY.replace(j2=1e-12 / 3, dynamical_flattening=1e-12))
    yield tiny.precession_rate[0] / _usual().precession_rate[0] * H / 1e-12 - 1


@CASES.case("prolate body")
@hard_because("H and J2 below zero, where square roots and logarithms would fail")
@held_against("the same rate the other way, bit for bit", bound=0.0)
def _prolate() -> Distances:
    turned = BODY.replace(j2=-J2, dynamical_flattening=-H)
    yield _rate(turned).precession_rate[0] + _usual().precession_rate[0]


@CASES.case("retrograde body")
@hard_because("the spin rate is negative")
@held_against("the same rate the other way, bit for bit", bound=0.0)
def _retrograde() -> Distances:
    turned = BODY.replace(spin_period=-BODY.needed("spin_period"))
    yield _rate(turned).precession_rate[0] + _usual().precession_rate[0]


@CASES.case("obliquity of 90 degrees")
@hard_because("the precessing torque is the small difference of what the two halves of a year do")
@held_against("cos(90 degrees) = 0: the rate over that of an upright axis", bound=2e-6)
def _lying() -> Distances:
    lying, usual = _rate(_leaning(np.pi / 2)), _usual()
    upright = usual.precession_rate[0] / math.cos(math.radians(float(usual.obliquity)))
    yield lying.precession_rate[0] / upright


@CASES.case("obliquity of 1e-6 rad, and of 1e-6 rad less than 180 degrees")
@hard_because("the longitude is all but undefined: both torque and sin2 nearly vanish")
@held_against(
    "mean precessing torque along a circular orbit, (3/2) GM/b3 cos(obliquity), over itself",
    bound=1e-14,
)
def _nearly_upright() -> Distances:
    phase = 2 * np.pi * np.arange(4000) / 4000
    orbit = 1.5e11 * np.stack([np.cos(phase), np.sin(phase), 0 * phase], axis=1)
    for angle in (1e-6, np.pi - 1e-6):
        axis = np.array([0.0, -math.sin(angle), math.cos(angle)])
        precessing = precessing_torque(torque_from_position(SUN.gm, 1.0, orbit, axis), axis, NORTH)
        closed = circular_orbit_torque(SUN.gm, 1.5e11, angle)
        yield np.mean(precessing) / closed - 1


@CASES.case("obliquity of 0")
@hard_because("an axis upright on its orbit has no longitude that could grow")
@refused("stands upright on the orbit")
def _upright() -> None:
    _rate(_leaning(0.0))


@CASES.case("obliquity of 180 degrees")
@hard_because("an axis upside down on its orbit has no longitude either")
@refused("stands upright on the orbit")
def _upside_down() -> None:
    _rate(_leaning(np.pi))


@CASES.case("a spin locked three to two")
@hard_because(
    "the torque on the equator's ellipse does not average out: 1,613 years come out for "
    "Mercury, and look right"
)
@refused("a spin that is locked")
def _locked() -> None:
    year = 2 * math.pi * math.sqrt(1.495978707e11**3 / 1.32712440018e20)
    precession(body=BODY.replace(spin_period=2 / 3 * year), perturbers=["sun"])


@CASES.case("perturber over the pole")
@hard_because("at a declination of 90 degrees the right ascension means nothing")
@held_against(
    "the vector form, which vanishes there, over the largest torque at that distance", bound=5e-15
)
def _over_the_pole() -> Distances:
    offset = np.array([0.0, 1e-300, 1e-16, 1e-9])
    r = 4e8 * np.stack([offset, 0 * offset, np.ones(4)], axis=1)
    r = np.concatenate([r, -r])
    one = torque_from_position(1e20, 1e35, r, NORTH)
    other = torque_from_declination(1e20, 1e35, *spherical(r))
    yield (one - other) / (3 * 1e20 * 1e35 / 4e8**3)


@CASES.case("perturber a million astronomical units away, and at 10^90 m")
@hard_because("r5 overflows, and the torque falls to 10^-271")
@held_against(
    "torque in proportion to 1/b3, distances of 2^57, 2^203 and 2^299, relative", bound=5e-15
)
def _far() -> Distances:
    place = np.array([[0.6, 0.0, 0.8]])
    near = torque_from_position(1.0, 1.0, place, NORTH)[0, 1]
    for power in (57, 203, 299):
        far = torque_from_position(1.0, 1.0, np.ldexp(place, power), NORTH)[0, 1]
        yield np.ldexp(far, 3 * power) / near - 1


@CASES.case("perturber in the very centre")
@hard_because("the distance is zero: 0/0")
@refused("no direction to pull in")
def _in_the_centre() -> None:
    torque_from_position(1e20, 1e35, np.array([[4e8, 0.0, 0.0], [0.0, 0.0, 0.0]]), NORTH)


SWOLLEN = 5e8  # m, beyond the Moon


@CASES.case("perturber inside the body, a series")
@hard_because("the formula goes on inside, and gives a plausible wrong number")
@refused("holds outside it alone")
def _inside_a_series() -> None:
    torque_series(times=["2000-01-01"], body=BODY.replace(radius=SWOLLEN))


@CASES.case("perturber inside the body, an average")
@hard_because("the formula goes on inside, and gives a plausible wrong number")
@refused("holds outside it alone")
def _inside_an_average() -> None:
    _rate(BODY.replace(radius=SWOLLEN), MOON)


@CASES.case("perturber inside the body, the pole")
@hard_because("the formula goes on inside, and gives a plausible wrong number")
@refused("holds outside it alone")
def _inside_the_pole() -> None:
    pole("2000-01-01", "2000-01-11", "1 d", body=BODY.replace(radius=SWOLLEN))


@CASES.case("perturber at no distance, by its declination")
@hard_because("1/b3 is infinite")
@refused("no direction to pull in")
def _no_distance() -> None:
    torque_from_declination(1e20, 1e35, np.zeros(2), np.full(2, 0.3), np.array([4e8, 0.0]))


@CASES.case("three forms of one torque, masses of 1e-30 and 1e40 kg together")
@hard_because("seventy decades are added up in one tensor")
@held_against(
    "declination, position and tide tensor against each other, over the largest", bound=5e-15
)
def _three_forms() -> Distances:
    rng = np.random.default_rng(7)
    r = rng.normal(size=(500, 3)) * 10.0 ** rng.uniform(7, 13, (500, 1))
    for mass in (1e-30, 1e40):
        gm = G.value * mass
        one = torque_from_position(gm, 1.0, r, NORTH)
        other = torque_from_declination(gm, 1.0, *spherical(r))
        tide = quadrupole_torque(tidal_tensor([(gm, r.T)]), np.broadcast_to(NORTH, r.shape).T).T
        size = 3 * gm / np.linalg.norm(r, axis=1) ** 3
        yield np.max(np.abs(other - one), axis=1) / size
        yield np.max(np.abs(tide - one), axis=1) / size


@CASES.case("zonal harmonics of degree 30 with the mass on the surface")
@hard_because("P_30 has coefficients of 10^8 that nearly cancel")
@held_against(
    "n (P_(n-1) - u P_n)/(1 - u2) by scipy's recurrence, over the largest slope", bound=1e-13
)
def _harmonics() -> Distances:
    u = np.linspace(-0.99, 0.99, 41)
    place = np.stack([np.sqrt(1 - u * u), 0 * u, u])
    axis = np.broadcast_to(NORTH[:, np.newaxis], place.shape)
    found = zonal_torque(30, 1.0, 1.0, 1.0, place, axis)[1] / -place[0]
    slope = 30 * (eval_legendre(29, u) - u * eval_legendre(30, u)) / (1 - u * u)
    yield apart(found, slope)


@CASES.case("a window of whole cycles forgets them exactly")
@hard_because("the signal that is removed is a million times what is left")
@held_against(
    "the constant below it, over the size of the signal; sin4 on 3 to 8 cycles", bound=5e-15
)
def _forgets() -> Distances:
    for turns in range(3, 9):
        window = Window(0.0, turns, 6798 * DAY, "sin4")
        times = window.sample_times(6798 * DAY / 4000)
        for harmonic in (1, 2, 7, 400):
            signal = 1e6 * np.cos(2 * np.pi * harmonic * times / window.cycle + 0.4)
            yield (window.mean(times, 1.0 + signal) - 1) / 1e6


@CASES.case("averages at steps that resonate with the month and the node")
@hard_because("a handful of samples, some of them on the very edge of the window")
@held_against("a constant comes out as itself through every taper, relative", bound=2e-13)
def _weights() -> Distances:
    for taper in TAPERS:
        window = Window(1e9, 5, 6798 * DAY, taper)
        for step in (DAY, 27.212 * DAY, window.cycle / 7):
            times = window.sample_times(step)
            yield window.mean(times, np.full(times.size, 7.5)) / 7.5 - 1


@CASES.case("an average over fewer than three cycles")
@hard_because("with two, nothing tells how far the mean is off")
@refused("needs three turns of the slowest cycle")
def _too_short() -> None:
    best_window(0.0, 2.99 * 18.6 * JULIAN_YEAR, 18.6 * JULIAN_YEAR, 0.0)


@CASES.case("an average over a scene's span of 30 years")
@hard_because("the Moon's node turns but once and a half")
@refused("needs three turns of the slowest cycle")
def _short_span() -> None:
    precession(span=("1985-01-01", "2015-01-01"))


@CASES.case("an accuracy that no kernel gives")
@hard_because("the number would look the same")
@refused("was asked for")
def _too_accurate() -> None:
    precession(accuracy=1e-12)


@CASES.case("ten thousand bodies at once", slow=True)
@hard_because("prolate, round, retrograde and slow ones stand in one call")
@held_against("six of them one at a time, bit for bit", bound=0.0)
def _ten_thousand() -> Distances:
    rng = np.random.default_rng(1)
    h = rng.uniform(-0.01, 0.01, 10_000)
    h[1234] = 0.0
    spins = rng.uniform(-3e5, 3e5, 10_000)
    spins += np.copysign(6000.0, spins)  # the equator flies off at periods below 1.41 h
    numbers = {"j2": J2 / H * h, "dynamical_flattening": h, "spin_period": spins}
    many = {name: xr.DataArray(values, dims="body") for name, values in numbers.items()}
    whole = precession(body=BODY.replace(**many))
    for n in (0, 1, 77, 1234, 5000, 9999):
        alone = {name: float(values[n]) for name, values in numbers.items()}
        one = precession(body=BODY.replace(**alone))
        for name in ("precession_rate", "precession_rate_error", "mean_torque"):
            yield whole[name].isel(body=n).values - one[name].values


@CASES.case("axes and directions given at the poles of the sky")
@hard_because("a declination of exactly 90 degrees leaves cosines of 6e-17")
@held_against("unit vectors along the third axis", bound=5e-15)
def _sky_poles() -> Distances:
    yield direction(1.0, math.pi / 2) - NORTH
    yield -direction(1.0, -math.pi / 2) - NORTH


@CASES.case("a Sun on an ellipse next to a parabola")
@hard_because("e is 1 - 1e-9: almost all of the pull comes in a moment at the pericentre")
@held_against("the closed form of the mean over the orbit, relative", bound=1e-14)
def _next_to_a_parabola() -> Distances:
    e, a = 1 - 1e-9, 1e20
    body, normal = _leaning(0.4), ecliptic_pole()
    found = precession(body=body, perturbers=[SUN.replace(orbit={"a": a, "e": e})])
    obliquity = math.acos(float(np.dot(body.needed("pole").vector(), normal)))
    torque = circular_orbit_torque(float(SUN.gm), a, obliquity) * ((1 - e) * (1 + e)) ** -1.5
    spin = float(body.needed("dynamical_flattening") / body.spin_rate)
    yield float(found.precession_rate[0]) * ARCSEC_PER_YEAR / (spin * torque) - 1


@CASES.case("a Moon whose orbit stands upright, its node going round")
@hard_because("the factor 1 - (3/2) sin2(i) is -1/2: the pull turns the axis the other way")
@held_against("minus half of that of the flat orbit, relative", bound=1e-14)
def _upright_orbit() -> Distances:
    flat, upright = (
        precession(
            body=BODY,
            perturbers=[MOON.replace(orbit={"a": 4e8, "i": i, "node_period": "-18 yr"})],
        ).precession_rate[0]
        for i in (0.0, math.pi / 2)
    )
    yield float(upright / flat) + 0.5


@CASES.case("an orbit that leaves its star")
@hard_because("the elements of a hyperbola would go into the formulas of an ellipse")
@refused("elements are those of an ellipse")
def _hyperbola() -> None:
    SUN.replace(orbit={"a": "1 au", "e": 1.2})


@CASES.case("an orbit through the body")
@hard_because("its mean has a closed form, though no such orbit is")
@refused("lies inside")
def _through_the_body() -> None:
    precession(perturbers=[MEAN_SUN, MOON.replace(orbit={"a": "20000 km", "e": 0.7})])


@CASES.case("elements that contradict Kepler's third law")
@hard_because("each of the two gives a rate, a factor of two apart")
@refused("contradict each other")
def _contradiction() -> None:
    precession(perturbers=[MEAN_SUN, MOON.replace(orbit={"a": "384399 km", "period": "40 d"})])
