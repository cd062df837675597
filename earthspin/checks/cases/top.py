"""Stiff and extreme cases of the heavy symmetric top."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipkm1

from earthspin.checks.case import Cases, Distances, hard_because, held_against, refused
from earthspin.rotor.axisymmetric import SymmetricRotor
from earthspin.top.integration import integrate_heavy_top
from earthspin.top.motion import heavy_top_motion
from earthspin.top.patterns import nutation_pattern, pattern_limits
from earthspin.top.start import HeavyTop
from earthspin.top.steady import minimum_spin, sleeping_top, steady_precession
from earthspin.top.turning import mean_precession_rate, nutation_period, turning_angles

FloatArray = NDArray[np.float64]

CASES = Cases("top")

#: I1 = 2, I3 = 1, m g r = 2: the critical spin is 4 rad/s exactly.
CRITICAL = 4.0


def _top(**changes: Any) -> HeavyTop:
    numbers: dict[str, Any] = {
        "transverse_moment": 2.0,
        "axial_moment": 1.0,
        "weight_moment": 2.0,
        "theta": 0.4,
        "spin": 10.0,
    }
    return HeavyTop(**(numbers | changes))


def _energy_drift(top: HeavyTop, times: FloatArray) -> FloatArray:
    """Change of the energy less that of the spin, over the largest of its two parts."""
    motion = heavy_top_motion(top, times)
    p, q, _ = np.moveaxis(motion.omega_body, -1, 0)
    kinetic = top.transverse_moment * (p * p + q * q) / 2
    energy = kinetic + top.weight_moment * np.cos(motion.theta)
    return np.asarray((energy - energy[0]) / (np.max(kinetic) + abs(top.weight_moment)))


@CASES.case("sleeping top exactly at its critical spin")
@hard_because("stable and unstable meet; rounding decides")
@held_against("stable, no growth, no fall, both circling rates equal", bound=0.0)
def _critical() -> Distances:
    found = sleeping_top(_top(theta=0.0, spin=CRITICAL))
    yield not found.stable
    yield found.growth_rate
    yield found.fall_angle
    yield found.rates[1] - found.rates[0]


@CASES.case("sleeping top one unit in the last place below its critical spin")
@hard_because("the growth rate is the root of a difference of 1e-15")
@held_against(
    "sqrt(omega_c (omega_c - omega)/2) I3/I1 and the fall to 2 arccos(omega/omega_c)", bound=1e-14
)
def _just_below() -> Distances:
    spin = np.nextafter(CRITICAL, 0.0)
    found = sleeping_top(_top(theta=0.0, spin=spin))
    gap = CRITICAL - spin
    growth = math.sqrt(2 * CRITICAL * gap) / 2 / 2
    fall = 2 * math.sqrt(2 * gap / CRITICAL)
    yield found.growth_rate / growth - 1
    yield found.fall_angle / fall - 1


@CASES.case("sleeping top one unit in the last place above its critical spin")
@hard_because("it is stable by the last bit alone")
@held_against(
    "circling rates a/2 and their difference from the exact difference of the spins", bound=5e-15
)
def _just_above() -> Distances:
    spin = np.nextafter(CRITICAL, 9.0)
    found = sleeping_top(_top(theta=0.0, spin=spin))
    difference = math.sqrt((spin - CRITICAL) * (spin + CRITICAL)) / 2
    yield found.nutation_rate / difference - 1
    yield found.growth_rate
    yield not found.stable


@CASES.case("pushed top a millionth below its critical spin")
@hard_because("it falls by milliradians after hundreds of seconds of hardly moving")
@held_against(
    "arccos(2 (omega/omega_c)2 - 1), the greatest inclination after the least push", bound=3e-13
)
def _pushed_below() -> Distances:
    gap = 2.0**-20
    greatest = turning_angles(_top(theta=1e-12, spin=CRITICAL * (1 - gap)))[1]
    # cos(greatest) = 2 x^2 - 1 with x = omega/omega_c, so sin(greatest/2) = sqrt(1 - x^2)
    fall = 2 * math.asin(math.sqrt(gap * (2 - gap)))
    yield greatest / fall - 1


@CASES.case("pushed top a millionth above its critical spin")
@hard_because("two rates of circling 1e-3 apart: the push grows a thousandfold, then shrinks")
@held_against("the linear motion: theta_0 a/sqrt(a2 - 2 beta) at most, relative", bound=3e-13)
def _pushed_above() -> Distances:
    gap = 2.0**-20
    greatest = turning_angles(_top(theta=1e-12, spin=CRITICAL * (1 + gap)))[1]
    # a/sqrt(a2 - 2 beta), with a in proportion to the spin and a2 = 2 beta where it is critical
    yield greatest / (1e-12 * (1 + gap) / math.sqrt(gap * (2 + gap))) - 1


@CASES.case("exactly upright top below its critical spin")
@hard_because("unstable, and every formula divides by sin(theta)")
@held_against("theta = 0 for a day, bit for bit", bound=0.0)
def _upright() -> Distances:
    yield heavy_top_motion(_top(theta=0.0, spin=1.0), np.linspace(0.0, 86400.0, 101)).theta


@CASES.case("top that all but stays upright for ever")
@hard_because("k'2 is 2e-16: the start is within rounding of a period without end")
@held_against("energy less that of the spin, at 100 times, relative", bound=1e-14)
def _creeping() -> Distances:
    # b = a and alpha = beta put the upper turning point on the pole itself
    spin, beta = 2.0, 2.0
    a = spin / 2
    top = _top(theta=np.pi / 2, spin=spin, phi_rate=a, theta_rate=math.sqrt(beta - a * a))
    yield _energy_drift(top, np.linspace(-40.0, 40.0, 100))


@CASES.case("weightless top")
@hard_because("the third root of the cubic is infinite")
@held_against("the free rotor's space cone and rate L/I1 (I.6.24)", bound=1e-14)
def _weightless() -> Distances:
    rotor = SymmetricRotor(2.0, -1.0, 3.0, 0.5)
    spin = 3.0 * math.cos(0.5)
    theta, rate = float(rotor.theta), float(rotor.precession_rate)
    top = _top(weight_moment=0.0, theta=theta, spin=spin, phi_rate=rate)
    times = np.linspace(0.0, 300.0, 100)
    motion = heavy_top_motion(top, times)
    yield motion.theta / theta - 1
    yield (motion.phi - rate * times) / (300 * rate)


@CASES.case("weight of 1e-200 of what the spin resists")
@hard_because("squares of the weight vanish, and the cubic seems to have lost a root")
@held_against("the weightless top, after 10^4 turns", bound=1e-14)
def _nearly_weightless() -> Distances:
    times = np.linspace(0.0, 6e3, 50)
    with_weight, without = (
        heavy_top_motion(_top(weight_moment=w, phi_rate=1.0), times) for w in (1e-200, 0.0)
    )
    yield with_weight.attitude - without.attitude


@CASES.case("spin to precession 10^7 to one")
@hard_because("the nutation is 10^-14 of a turn and 10^7 times faster than the precession")
@held_against(
    "the slow steady precession, relative; from rest it differs by (beta/a2)2 = 2e-13", bound=2e-13
)
def _fast_top() -> Distances:
    spin = 10**3.5 * math.sqrt(2.0)  # spin/precession = I3 omega3^2/(m g r) = 10^7
    top = _top(spin=spin, theta=1.0)
    yield mean_precession_rate(top) / steady_precession(top).slow - 1


@CASES.case("spin to nutation 10^7: a fast top after a day")
@hard_because("10^10 turns: phi and psi run to 10^11 rad, and their sum must keep the precession")
@held_against("energy less that of the spin, and vertical angular momentum, relative", bound=1e-14)
def _fast_top_for_a_day() -> Distances:
    top = _top(spin=1e5, theta=1.0)
    times = np.linspace(0.0, 86400.0, 200)
    yield _energy_drift(top, times)
    motion = heavy_top_motion(top, times)
    w, x, y, z = np.moveaxis(motion.attitude, -1, 0)
    up = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=-1)
    vertical = np.sum(up * motion.omega_body * [2.0, 2.0, 1.0], axis=-1)
    yield vertical / vertical[0] - 1


@CASES.case("pendulum a nanoradian from standing on its head")
@hard_because("no spin at all, and k is 1 but for 1e-19")
@held_against("the pendulum's period 4 K/omega by scipy's ellipkm1, relative", bound=1e-14)
def _inverted_pendulum() -> Distances:
    top = _top(spin=0.0, theta=1e-9)
    exact = 4 * float(ellipkm1(math.sin(0.5e-9) ** 2))  # omega = sqrt(m g r/I1) = 1
    # theta goes once to and fro in half a swing across the lower pole
    yield nutation_period(top) / (exact / 2) - 1


@CASES.case("axis that passes exactly over the lower pole")
@hard_because("phi and psi jump by half a turn there; their rates are infinite")
@held_against("attitude by DOP853 on Euler's equations", bound=1e-11)
def _over_the_pole() -> Distances:
    top = _top(spin=3.0, theta=1.2, phi_rate=-1.5 / (1 - math.cos(1.2)))
    times = np.linspace(0.0, 12.0, 80)
    stepped = integrate_heavy_top(top, times).attitude
    yield stepped - heavy_top_motion(top, times).attitude


@CASES.case("axis that misses the upper pole by 1e-12 rad")
@hard_because("phi turns by half a turn within a picosecond")
@held_against("energy along the way, relative", bound=1e-14)
def _grazing() -> Distances:
    exact = 5.0 / (1 + math.cos(0.4))
    top = _top(phi_rate=exact * (1 + 1e-12))
    yield _energy_drift(top, np.linspace(0.0, 30.0, 2001))


@CASES.case("start exactly on a cusp")
@hard_because("between waves and loops; the tip comes to rest")
@held_against(
    "the word 'cusp' at both limits, and 'wave' and 'loop' 1e-12 to either side", bound=0.0
)
def _cusp() -> Distances:
    low, high = pattern_limits(_top()).cusp
    rates = np.array([low, high, high * (1 - 1e-12), high * (1 + 1e-12)])
    yield nutation_pattern(_top(phi_rate=rates)) != ["cusp", "cusp", "wave", "loop"]


@CASES.case("steady precession at the least spin that allows it")
@hard_because("slow and fast precession coincide: a double root, known to half the digits")
@held_against("both rates a/(2 cos(theta)), relative; the root of rounding", bound=1e-7)
def _least_spin() -> Distances:
    theta = 0.9
    spin = float(minimum_spin(_top(theta=theta)))
    found = steady_precession(_top(theta=theta, spin=spin))
    exact = spin / 2 / (2 * math.cos(theta))
    yield found.slow / exact - 1
    yield found.fast / exact - 1


@CASES.case("hanging at exactly pi, and turned upside down")
@hard_because("no float is pi; the axis is described by its other end")
@held_against(
    "theta = pi for a day, and the same motion with weight, spin and axis reversed", bound=1e-14
)
def _hanging() -> Distances:
    yield heavy_top_motion(_top(theta=np.pi), np.linspace(0.0, 86400.0, 11)).theta - np.pi
    times = np.linspace(0.0, 20.0, 50)
    one = heavy_top_motion(_top(theta=2.0, phi_rate=0.3), times).theta
    turned = _top(theta=np.pi - 2.0, phi_rate=0.3, spin=-10.0, weight_moment=-2.0)
    yield one + heavy_top_motion(turned, times).theta - np.pi


@CASES.case("needle and lamina")
@hard_because("I3 of 1e-12 I1, and I3 = 2 I1, the most a body can have")
@held_against("energy over 100 s, relative", bound=1e-14)
def _shapes() -> Distances:
    for axial, spin in ((2e-12, 1e13), (4.0, 3.0)):
        top = _top(axial_moment=axial, spin=spin, theta=1.1)
        yield _energy_drift(top, np.linspace(0.0, 100.0, 500))


@CASES.case("energy over 10^4 nutations")
@hard_because("errors that grow with time would show")
@held_against("the energy at the start, relative", bound=1e-14)
def _energy_kept() -> Distances:
    top = _top(theta=1.3, phi_rate=0.2, spin=6.0)
    span = 1e4 * float(nutation_period(top))
    times = np.random.default_rng(4).uniform(0.0, span, 2000)
    yield _energy_drift(top, np.concatenate([[0.0], times]))


@CASES.case("a spin too slow for steady precession")
@hard_because("the rates are complex: a square root of less than nothing")
@refused("too slow for steady precession")
def _too_slow() -> None:
    steady_precession(_top(theta=0.1, spin=1.0))


@CASES.case("a top leaning by more than pi")
@hard_because("cosines would not notice")
@refused("give an angle from 0 to pi")
def _beyond_pi() -> None:
    _top(theta=3.2)


@CASES.case("a top with I3 above 2 I1")
@hard_because("no such body, yet all formulas give numbers")
@refused("no body has more than twice its transverse moment")
def _impossible() -> None:
    _top(axial_moment=4.0 + 1e-9)


@CASES.case("a top whose weight is not a number")
@hard_because("NaN passes every comparison that is written the wrong way round")
@refused("give a finite number")
def _nan_weight() -> None:
    _top(weight_moment=float("nan"))
