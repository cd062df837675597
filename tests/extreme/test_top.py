"""Heavy symmetric top."""

import math
from functools import partial

import numpy as np
from scipy.special import ellipkm1

from earthspin.numerics.arrays import FloatArray
from earthspin.top.azimuth import mean_precession_rate
from earthspin.top.closed_form import heavy_top_motion
from earthspin.top.height import nutation_of, nutation_period, turning_angles
from earthspin.top.patterns import nutation_pattern, sleeping_top, steady_precession
from earthspin.top.start import HeavyTop, axis_start
from tests.extreme import Distances, holds

#: I1 = 2, I3 = 1, m g r = 2: the critical spin is 4 rad/s exactly.
CRITICAL = 4.0


_top = partial(
    HeavyTop, transverse_moment=2.0, axial_moment=1.0, weight_moment=2.0, theta=0.4, spin=10.0
)


def _energy_drift(top: HeavyTop, times: FloatArray) -> FloatArray:
    """Relative change of a top's energy in time, without the constant energy of its spin."""
    motion = heavy_top_motion(top, times)
    p, q, _ = np.moveaxis(motion.omega_body, -1, 0)
    kinetic = top.transverse_moment * (p * p + q * q) / 2
    energy = kinetic + top.weight_moment * np.cos(motion.theta)
    return np.asarray((energy - energy[0]) / (np.max(kinetic) + abs(top.weight_moment)))


@holds(bound=1e-14)
def test_just_below() -> Distances:
    """sleeping top with a spin one unit in the last place below the critical spin

    Hard because: the growth rate is the square root of a difference of 1e-15
    Compared with: sqrt(omega_c (omega_c - omega)/2) I3/I1 and the fall to 2 arccos(omega/omega_c)
    """
    spin = np.nextafter(CRITICAL, 0.0)
    result = sleeping_top(_top(theta=0.0, spin=spin))
    gap = CRITICAL - spin
    growth = math.sqrt(2 * CRITICAL * gap) / 2 / 2
    fall = 2 * math.sqrt(2 * gap / CRITICAL)
    yield result.growth_rate / growth - 1
    yield result.fall_angle / fall - 1


@holds(bound=5e-15)
def test_just_above() -> Distances:
    """sleeping top with a spin one unit in the last place above the critical spin

    Hard because: the top is stable only because of the last bit of the spin
    Compared with: circling rates a/2 and their difference from the exact difference of the spins
    """
    spin = np.nextafter(CRITICAL, 9.0)
    result = sleeping_top(_top(theta=0.0, spin=spin))
    difference = math.sqrt((spin - CRITICAL) * (spin + CRITICAL)) / 2
    yield result.nutation_rate / difference - 1
    yield result.growth_rate
    yield not result.stable


@holds(bound=3e-13)
def test_pushed_above() -> Distances:
    """tilted top with a spin a millionth above the critical spin

    Hard because: two circling rates differ by 1e-3, so the tilt first grows a thousandfold and then
        shrinks
    Compared with: largest tilt theta_0 a/sqrt(a2 - 2 beta) of the linearized motion, relative
    """
    gap = 2.0**-20
    greatest = turning_angles(nutation_of(_top(theta=1e-12, spin=CRITICAL * (1 + gap))))[1]
    # a/sqrt(a2 - 2 beta), with a proportional to the spin and a2 = 2 beta at the critical spin
    yield greatest / (1e-12 * (1 + gap) / math.sqrt(gap * (2 + gap))) - 1


@holds(bound=0.0)
def test_upright() -> Distances:
    """exactly upright top below its critical spin

    Hard because: the position is unstable, and every formula divides by sin(theta)
    Compared with: theta = 0 for a day, bit for bit
    """
    yield heavy_top_motion(_top(theta=0.0, spin=1.0), np.linspace(0.0, 86400.0, 101)).theta


@holds(bound=1e-14)
def test_creeping() -> Distances:
    """top that approaches the upright position without reaching it

    Hard because: k'2 is 2e-16, so the start is within rounding of a motion with infinite period
    Compared with: energy without that of the spin, at 100 times, relative
    """
    # b = a and alpha = beta place the upper turning point exactly at the upward vertical
    spin, beta = 2.0, 2.0
    a = spin / 2
    top = _top(theta=np.pi / 2, spin=spin, phi_rate=a, theta_rate=math.sqrt(beta - a * a))
    yield _energy_drift(top, np.linspace(-40.0, 40.0, 100))


@holds(bound=1e-14)
def test_nearly_weightless() -> Distances:
    """top with a weight of 1e-200 of its gyroscopic resistance

    Hard because: squares of the weight underflow, so the cubic seems to lose a root
    Compared with: weightless top after 10^4 rotations
    """
    times = np.linspace(0.0, 6e3, 50)
    with_weight, without = (
        heavy_top_motion(_top(weight_moment=w, phi_rate=1.0), times) for w in (1e-200, 0.0)
    )
    yield with_weight.attitude - without.attitude


@holds(bound=2e-13)
def test_fast_top() -> Distances:
    """top that spins 10^7 times faster than it precesses

    Hard because: the nutation has an amplitude of 10^-14 revolutions and is 10^7 times faster than
        the precession
    Compared with: slow steady precession, relative; a start from rest differs by (beta/a2)2 = 2e-13
    """
    spin = 10**3.5 * math.sqrt(2.0)  # spin/precession = I3 omega3^2/(m g r) = 10^7
    top = _top(spin=spin, theta=1.0)
    yield mean_precession_rate(top, nutation_of(top)) / steady_precession(top).slow - 1


@holds(bound=1e-14)
def test_fast_top_for_a_day() -> Distances:
    """top that spins fast, after a day with 10^10 rotations

    Hard because: phi and psi grow to 10^11 rad, and their sum must keep the precession
    Compared with: energy without that of the spin, and vertical angular momentum, relative
    """
    top = _top(spin=1e5, theta=1.0)
    times = np.linspace(0.0, 86400.0, 200)
    yield _energy_drift(top, times)
    motion = heavy_top_motion(top, times)
    w, x, y, z = np.moveaxis(motion.attitude, -1, 0)
    up = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=-1)
    vertical = np.sum(up * motion.omega_body * [2.0, 2.0, 1.0], axis=-1)
    yield vertical / vertical[0] - 1


@holds(bound=1e-14)
def test_inverted_pendulum() -> Distances:
    """top without spin (pendulum) that starts 1e-9 rad from its upright position

    Hard because: the spin is zero, and k differs from 1 by 1e-19
    Compared with: period 4 K/omega of the pendulum by scipy's ellipkm1, relative
    """
    top = _top(spin=0.0, theta=1e-9)
    exact = 4 * float(ellipkm1(math.sin(0.5e-9) ** 2))  # omega = sqrt(m g r/I1) = 1
    # theta completes a cycle in half a swing through the lowest point
    yield nutation_period(nutation_of(top)) / (exact / 2) - 1


@holds(bound=1e-14)
def test_grazing() -> Distances:
    """top whose axis passes the upward vertical at a distance of 1e-12 rad

    Hard because: phi changes by half a revolution within a picosecond
    Compared with: energy at 2001 times, relative
    """
    exact = 5.0 / (1 + math.cos(0.4))
    top = _top(phi_rate=exact * (1 + 1e-12))
    yield _energy_drift(top, np.linspace(0.0, 30.0, 2001))


@holds(bound=0.0)
def test_cusp() -> Distances:
    """top that starts exactly at a cusp

    Hard because: the start is on the border between waves and loops, where the tip comes to rest
    Compared with: pattern 'cusp' at both limits, and 'wave' and 'loop' at relative distances of
        1e-12
    """
    high = 2 * 2.0 / 10.0  # 2 m g r/(I3 omega3)
    rates = np.array([0.0, high, high * (1 - 1e-12), high * (1 + 1e-12)])
    yield nutation_pattern(axis_start(_top(phi_rate=rates))) != ["cusp", "cusp", "wave", "loop"]


@holds(bound=1e-14)
def test_hanging() -> Distances:
    """top that hangs exactly downward, and a top described upside down

    Hard because: no float equals pi, and the inverted top is described by the opposite end of its
        axis
    Compared with: theta = pi for a day, and the same motion with weight, spin and axis reversed
    """
    yield heavy_top_motion(_top(theta=np.pi), np.linspace(0.0, 86400.0, 11)).theta - np.pi
    times = np.linspace(0.0, 20.0, 50)
    theta = heavy_top_motion(_top(theta=2.0, phi_rate=0.3), times).theta
    inverted = _top(theta=np.pi - 2.0, phi_rate=0.3, spin=-10.0, weight_moment=-2.0)
    yield theta + heavy_top_motion(inverted, times).theta - np.pi


@holds(bound=1e-14)
def test_shapes() -> Distances:
    """energy of needle-shaped and disc-shaped tops

    Hard because: I3 is 1e-12 I1 for the needle, and the largest possible value 2 I1 for the disc
    Compared with: energy over 100 s, relative
    """
    for axial, spin in ((2e-12, 1e13), (4.0, 3.0)):
        top = _top(axial_moment=axial, spin=spin, theta=1.1)
        yield _energy_drift(top, np.linspace(0.0, 100.0, 500))
