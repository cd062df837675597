"""Torques, at an instant and averaged over orbits."""

import math

import numpy as np
import pytest
import xarray as xr
from scipy.special import eval_legendre

from earthspin.bodies import MOON, SUN, Body
from earthspin.constants import ARCSEC_PER_YEAR, DAY, JULIAN_YEAR
from earthspin.questions.precession import precession
from earthspin.questions.torque import torque_series
from earthspin.sky.iau_models import ecliptic_pole
from earthspin.sky.poles import spherical
from earthspin.torque.average import TAPERS, Window, best_window, precessing_torque
from earthspin.torque.gravity import torque_from_declination, torque_from_position, zonal_law
from tests.extreme import Distances, holds, refused, relative_error
from tests.reference.sky import BODY, J2, H

NORTH = np.array([0.0, 0.0, 1.0])


def _rate(body: Body = BODY, perturber: Body = SUN) -> xr.Dataset:
    """Precession rate and mean torque of a body under one perturber."""
    return precession(body=body, perturbers=[perturber], source="jplephem")


@holds(bound=0.0)
def test_no_mass() -> Distances:
    """torque and precession rate by a perturber without mass

    Hard because: rates are zero and periods infinite, so every ratio may become 0/0
    Compared with: zero torque, zero rate and infinite period, and no NaN
    """
    rates = _rate(perturber=MOON.replace(gm=0.0))
    yield rates.mean_torque
    yield rates.precession_rate
    yield ~np.isposinf(rates.precession_period)
    none = (SUN.replace(gm=0.0),)
    yield torque_series("2000-01-01", "2000-01-03", "6 h", perturbers=none).torque


@holds(bound=5e-15)
def test_tiny_h() -> Distances:
    """averaged precession with a dynamical flattening of 1e-12

    Hard because: the precession period is 10^14 years
    Compared with: rate proportional to H, relative
    """
    tiny = _rate(BODY.replace(j2=1e-12 / 3, dynamical_flattening=1e-12))
    yield tiny.precession_rate[0] / _rate().precession_rate[0] * H / 1e-12 - 1


@holds(bound=1e-14)
def test_nearly_upright() -> Distances:
    """averaged torque at obliquities of 1e-6 rad and pi - 1e-6 rad

    Hard because: the longitude is almost undefined, because the torque and sin2 nearly vanish
    Compared with: mean precessing torque of a circular orbit, (3/2) GM/b3 cos(obliquity), relative
    """
    phase = 2 * np.pi * np.arange(4000) / 4000
    orbit = 1.5e11 * np.stack([np.cos(phase), np.sin(phase), 0 * phase], axis=1)
    for angle in (1e-6, np.pi - 1e-6):
        axis = np.array([0.0, -math.sin(angle), math.cos(angle)])
        precessing = precessing_torque(torque_from_position(SUN.gm, 1.0, orbit, axis), axis, NORTH)
        closed = 1.5 * SUN.gm / 1.5e11**3 * math.cos(angle)
        yield np.mean(precessing) / closed - 1


@holds(bound=5e-15)
def test_over_the_pole() -> Distances:
    """torque by a perturber above the pole of the body

    Hard because: the right ascension is undefined at a declination of 90 degrees
    Compared with: vector form, which vanishes there, relative to the largest torque at that
        distance
    """
    offset = np.array([0.0, 1e-300, 1e-16, 1e-9])
    r = 4e8 * np.stack([offset, 0 * offset, np.ones(4)], axis=1)
    r = np.concatenate([r, -r])
    one = torque_from_position(1e20, 1e35, r, NORTH)
    other = torque_from_declination(1e20, 1e35, *spherical(r))
    yield (one - other) / (3 * 1e20 * 1e35 / 4e8**3)


@holds(bound=5e-15)
def test_far() -> Distances:
    """torque by a perturber at distances of a million au to 10^90 m

    Hard because: r5 overflows, and the torque falls to 10^-271
    Compared with: torque proportional to 1/b3 at distances of 2^57, 2^203 and 2^299, relative
    """
    place = np.array([[0.6, 0.0, 0.8]])
    near = torque_from_position(1.0, 1.0, place, NORTH)[0, 1]
    for power in (57, 203, 299):
        far = torque_from_position(1.0, 1.0, np.ldexp(place, power), NORTH)[0, 1]
        yield np.ldexp(far, 3 * power) / near - 1


SWOLLEN = 5e8  # m, beyond the Moon


@refused("valid only outside")
def test_inside_a_series() -> None:
    """refusal of a torque series with a perturber inside the body

    Hard because: the formula gives a plausible wrong number inside the body
    """
    torque_series(times=["2000-01-01"], body=BODY.replace(radius=SWOLLEN))


@holds(bound=1e-13)
def test_harmonics() -> Distances:
    """torque on a zonal harmonic of degree 30 by a mass on the surface

    Hard because: P_30 has coefficients of 10^8 that nearly cancel
    Compared with: n (P_(n-1) - u P_n)/(1 - u2) by scipy's recurrence, relative to the largest slope
    """
    u = np.linspace(-0.99, 0.99, 41)
    place = np.stack([np.sqrt(1 - u * u), 0 * u, u])
    axis = np.broadcast_to(NORTH[:, np.newaxis], place.shape)
    result = zonal_law({30: 1.0}, 1.0, 1.0, place)(axis)[1] / -place[0]
    slope = 30 * (eval_legendre(29, u) - u * eval_legendre(30, u)) / (1 - u * u)
    yield relative_error(result, slope)


@holds(bound=2e-13)
def test_weights() -> Distances:
    """weighted mean with sampling steps in resonance with the month and the Moon's node

    Hard because: there are few samples, and some of them are exactly at the edge of the window
    Compared with: mean of a constant with every taper, relative
    """
    for taper in TAPERS:
        window = Window(1e9, 5, 6798 * DAY, taper)
        for step in (DAY, 27.212 * DAY, window.cycle / 7):
            times = window.sample_times(step)
            yield window.mean(times, np.full(times.size, 7.5)) / 7.5 - 1


@refused("needs three turns of the slowest cycle")
def test_too_short() -> None:
    """refusal of an average over fewer than three of the slowest cycles

    Hard because: two cycles do not show how large the error of the mean is
    """
    best_window(0.0, 2.99 * 18.6 * JULIAN_YEAR, 18.6 * JULIAN_YEAR)


@pytest.mark.slow
@holds(bound=0.0)
def test_ten_thousand() -> Distances:
    """averaged precession rates of ten thousand bodies in one call

    Hard because: prolate, spherical, retrograde and slowly rotating bodies are in the same arrays
    Compared with: six of the bodies computed alone, bit for bit
    """
    rng = np.random.default_rng(1)
    h = rng.uniform(-0.01, 0.01, 10_000)
    h[1234] = 0.0
    spins = rng.uniform(-3e5, 3e5, 10_000)
    spins += np.copysign(6000.0, spins)  # periods below 1.41 h exceed the break-up spin
    numbers = {"j2": J2 / H * h, "dynamical_flattening": h, "spin_period": spins}
    many = {name: xr.DataArray(values, dims="body") for name, values in numbers.items()}
    whole = precession(body=BODY.replace(**many))
    for n in (0, 1, 77, 1234, 5000, 9999):
        alone = {name: float(values[n]) for name, values in numbers.items()}
        one = precession(body=BODY.replace(**alone))
        for name in ("precession_rate", "precession_rate_error", "mean_torque"):
            yield whole[name].isel(body=n).values - one[name].values


@holds(bound=1e-14)
def test_next_to_a_parabola() -> Distances:
    """averaged torque of the Sun on a nearly parabolic ellipse

    Hard because: e is 1 - 1e-9, so almost the whole torque acts near the pericentre
    Compared with: closed form of the mean over the orbit, relative
    """
    e, a, obliquity = 1 - 1e-9, 1e20, 0.4
    (ra,), (dec,), _ = spherical(ecliptic_pole()[np.newaxis])
    body = BODY.replace(pole=(ra, dec - obliquity), orbit_pole=(ra, dec))
    result = precession(body=body, perturbers=[SUN.replace(orbit={"a": a, "e": e})])
    torque = 1.5 * float(SUN.gm) / a**3 * math.cos(obliquity) * ((1 - e) * (1 + e)) ** -1.5
    spin = float(body.needed("dynamical_flattening") / body.spin_rate)
    yield float(result.precession_rate[0]) * ARCSEC_PER_YEAR / (spin * torque) - 1
