"""Stiff and extreme cases of the heavy symmetric top."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipkm1

from earthspin.checks.case import Cases
from earthspin.rotor.axisymmetric import SymmetricRotor
from earthspin.top.integration import integrate_heavy_top
from earthspin.top.motion import HeavyTopMotion, heavy_top_motion
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


def _energy_drift(top: HeavyTop, motion: HeavyTopMotion) -> float:
    """Largest change of the energy less that of the spin, over the largest of its two parts."""
    p, q, _ = np.moveaxis(motion.omega_body, -1, 0)
    kinetic = top.transverse_moment * (p * p + q * q) / 2
    energy = kinetic + top.weight_moment * np.cos(motion.theta)
    return float(np.max(np.abs(energy - energy[0])) / (np.max(kinetic) + abs(top.weight_moment)))


@CASES.hold(
    "sleeping top exactly at its critical spin",
    because="stable and unstable meet; rounding decides",
    against="stable, no growth, no fall, both circling rates equal",
    bound=0.0,
)
def _critical() -> float:
    found = sleeping_top(_top(theta=0.0, spin=CRITICAL))
    apart = abs(float(found.rates[1] - found.rates[0]))
    return float(found.growth_rate + found.fall_angle) + apart + (not found.stable)


@CASES.hold(
    "sleeping top one unit in the last place below its critical spin",
    because="the growth rate is the root of a difference of 1e-15",
    against="sqrt(omega_c (omega_c - omega)/2) I3/I1 and the fall to 2 arccos(omega/omega_c)",
    bound=1e-14,
)
def _just_below() -> float:
    spin = np.nextafter(CRITICAL, 0.0)
    found = sleeping_top(_top(theta=0.0, spin=spin))
    gap = CRITICAL - spin
    growth = math.sqrt(2 * CRITICAL * gap) / 2 / 2
    fall = 2 * math.sqrt(2 * gap / CRITICAL)
    return max(abs(float(found.growth_rate) / growth - 1), abs(float(found.fall_angle) / fall - 1))


@CASES.hold(
    "sleeping top one unit in the last place above its critical spin",
    because="it is stable by the last bit alone",
    against="circling rates a/2 and their difference from the exact difference of the spins",
    bound=5e-15,
)
def _just_above() -> float:
    spin = np.nextafter(CRITICAL, 9.0)
    found = sleeping_top(_top(theta=0.0, spin=spin))
    apart = math.sqrt((spin - CRITICAL) * (spin + CRITICAL)) / 2
    off = abs(float(found.nutation_rate) / apart - 1)
    return off + float(found.growth_rate) + (not found.stable)


@CASES.hold(
    "pushed top a millionth below its critical spin",
    because="it falls by milliradians after hundreds of seconds of hardly moving",
    against="arccos(2 (omega/omega_c)2 - 1), the greatest inclination after the least push",
    bound=3e-13,
)
def _pushed_below() -> float:
    gap = 2.0**-20
    greatest = float(turning_angles(_top(theta=1e-12, spin=CRITICAL * (1 - gap)))[1])
    # cos(greatest) = 2 x^2 - 1 with x = omega/omega_c, so sin(greatest/2) = sqrt(1 - x^2)
    fall = 2 * math.asin(math.sqrt(gap * (2 - gap)))
    return greatest / fall - 1


@CASES.hold(
    "pushed top a millionth above its critical spin",
    because="two rates of circling 1e-3 apart: the push grows a thousandfold, then shrinks",
    against="the linear motion: theta_0 a/sqrt(a2 - 2 beta) at most, relative",
    bound=3e-13,
)
def _pushed_above() -> float:
    gap = 2.0**-20
    greatest = float(turning_angles(_top(theta=1e-12, spin=CRITICAL * (1 + gap)))[1])
    # a/sqrt(a2 - 2 beta), with a in proportion to the spin and a2 = 2 beta where it is critical
    return greatest / (1e-12 * (1 + gap) / math.sqrt(gap * (2 + gap))) - 1


@CASES.hold(
    "exactly upright top below its critical spin",
    because="unstable, and every formula divides by sin(theta)",
    against="theta = 0 for a day, bit for bit",
    bound=0.0,
)
def _upright() -> float:
    motion = heavy_top_motion(_top(theta=0.0, spin=1.0), np.linspace(0.0, 86400.0, 101))
    return float(np.max(np.abs(motion.theta)))


@CASES.hold(
    "top that all but stays upright for ever",
    because="k'2 is 2e-16: the start is within rounding of a period without end",
    against="energy less that of the spin, at 100 times, relative",
    bound=1e-14,
)
def _creeping() -> float:
    # b = a and alpha = beta put the upper turning point on the pole itself
    theta, spin = np.pi / 2, 2.0
    a, beta = spin / 2, 2.0
    top = _top(theta=theta, spin=spin, phi_rate=a, theta_rate=math.sqrt(beta - a * a))
    motion = heavy_top_motion(top, np.linspace(-40.0, 40.0, 100))
    return _energy_drift(top, motion)


@CASES.hold(
    "weightless top",
    because="the third root of the cubic is infinite",
    against="the free rotor's space cone and rate L/I1 (I.6.24)",
    bound=1e-14,
)
def _weightless() -> float:
    rotor = SymmetricRotor(2.0, -1.0, 3.0, 0.5)
    spin = 3.0 * math.cos(0.5)
    theta, rate = float(rotor.theta), float(rotor.precession_rate)
    top = _top(weight_moment=0.0, theta=theta, spin=spin, phi_rate=rate)
    motion = heavy_top_motion(top, np.linspace(0.0, 300.0, 100))
    turned = np.abs(motion.phi - rate * np.linspace(0.0, 300.0, 100)) / (300 * rate)
    return float(max(np.max(np.abs(motion.theta / theta - 1)), np.max(turned)))


@CASES.hold(
    "weight of 1e-200 of what the spin resists",
    because="squares of the weight vanish, and the cubic seems to have lost a root",
    against="the weightless top, after 10^4 turns",
    bound=1e-14,
)
def _nearly_weightless() -> float:
    times = np.linspace(0.0, 6e3, 50)
    with_weight, without = (
        heavy_top_motion(_top(weight_moment=w, phi_rate=1.0), times) for w in (1e-200, 0.0)
    )
    return float(np.max(np.abs(with_weight.attitude - without.attitude)))


@CASES.hold(
    "spin to precession 10^7 to one",
    because="the nutation is 10^-14 of a turn and 10^7 times faster than the precession",
    against="the slow steady precession, relative; from rest it differs by (beta/a2)2 = 2e-13",
    bound=2e-13,
)
def _fast_top() -> float:
    spin = 10**3.5 * math.sqrt(2.0)  # spin/precession = I3 omega3^2/(m g r) = 10^7
    top = _top(spin=spin, theta=1.0)
    mean = float(mean_precession_rate(top))
    return mean / float(steady_precession(top).slow) - 1


@CASES.hold(
    "spin to nutation 10^7: a fast top after a day",
    because="10^10 turns: phi and psi run to 10^11 rad, and their sum must keep the precession",
    against="energy less that of the spin, and vertical angular momentum, relative",
    bound=1e-14,
)
def _fast_top_for_a_day() -> float:
    top = _top(spin=1e5, theta=1.0)
    motion = heavy_top_motion(top, np.linspace(0.0, 86400.0, 200))
    w, x, y, z = np.moveaxis(motion.attitude, -1, 0)
    up = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=-1)
    vertical = np.sum(up * motion.omega_body * [2.0, 2.0, 1.0], axis=-1)
    return max(_energy_drift(top, motion), float(np.max(np.abs(vertical / vertical[0] - 1))))


@CASES.hold(
    "pendulum a nanoradian from standing on its head",
    because="no spin at all, and k is 1 but for 1e-19",
    against="the pendulum's period 4 K/omega by scipy's ellipkm1, relative",
    bound=1e-14,
)
def _inverted_pendulum() -> float:
    top = _top(spin=0.0, theta=1e-9)
    exact = 4 * float(ellipkm1(math.sin(0.5e-9) ** 2))  # omega = sqrt(m g r/I1) = 1
    # theta goes once to and fro in half a swing across the lower pole
    return float(nutation_period(top)) / (exact / 2) - 1


@CASES.hold(
    "axis that passes exactly over the lower pole",
    because="phi and psi jump by half a turn there; their rates are infinite",
    against="attitude by DOP853 on Euler's equations",
    bound=1e-11,
)
def _over_the_pole() -> float:
    top = _top(spin=3.0, theta=1.2, phi_rate=-1.5 / (1 - math.cos(1.2)))
    times = np.linspace(0.0, 12.0, 80)
    stepped = integrate_heavy_top(top, times).attitude
    return float(np.max(np.abs(stepped - heavy_top_motion(top, times).attitude)))


@CASES.hold(
    "axis that misses the upper pole by 1e-12 rad",
    because="phi turns by half a turn within a picosecond",
    against="energy along the way, relative",
    bound=1e-14,
)
def _grazing() -> float:
    exact = 5.0 / (1 + math.cos(0.4))
    top = _top(phi_rate=exact * (1 + 1e-12))
    motion = heavy_top_motion(top, np.linspace(0.0, 30.0, 2001))
    return _energy_drift(top, motion)


@CASES.hold(
    "start exactly on a cusp",
    because="between waves and loops; the tip comes to rest",
    against="the word 'cusp' at both limits, and 'wave' and 'loop' 1e-12 to either side",
    bound=0.0,
)
def _cusp() -> float:
    low, high = pattern_limits(_top()).cusp
    rates = np.array([low, high, high * (1 - 1e-12), high * (1 + 1e-12)])
    found = nutation_pattern(_top(phi_rate=rates))
    return float(np.sum(found != ["cusp", "cusp", "wave", "loop"]))


@CASES.hold(
    "steady precession at the least spin that allows it",
    because="slow and fast precession coincide: a double root, known to half the digits",
    against="both rates a/(2 cos(theta)), relative; the root of rounding",
    bound=1e-7,
)
def _least_spin() -> float:
    theta = 0.9
    spin = float(minimum_spin(_top(theta=theta)))
    found = steady_precession(_top(theta=theta, spin=spin))
    exact = spin / 2 / (2 * math.cos(theta))
    return float(max(abs(found.slow / exact - 1), abs(found.fast / exact - 1)))


@CASES.hold(
    "hanging at exactly pi, and turned upside down",
    because="no float is pi; the axis is described by its other end",
    against="theta = pi for a day, and the same motion with weight, spin and axis reversed",
    bound=1e-14,
)
def _hanging() -> float:
    still = heavy_top_motion(_top(theta=np.pi), np.linspace(0.0, 86400.0, 11)).theta
    times = np.linspace(0.0, 20.0, 50)
    one = heavy_top_motion(_top(theta=2.0, phi_rate=0.3), times).theta
    other = heavy_top_motion(
        _top(theta=np.pi - 2.0, phi_rate=0.3, spin=-10.0, weight_moment=-2.0), times
    ).theta
    return float(max(np.max(np.abs(still - np.pi)), np.max(np.abs(one + other - np.pi))))


@CASES.hold(
    "needle and lamina",
    because="I3 of 1e-12 I1, and I3 = 2 I1, the most a body can have",
    against="energy over 100 s, relative",
    bound=1e-14,
)
def _shapes() -> float:
    worst = 0.0
    for axial, spin in ((2e-12, 1e13), (4.0, 3.0)):
        top = _top(axial_moment=axial, spin=spin, theta=1.1)
        motion = heavy_top_motion(top, np.linspace(0.0, 100.0, 500))
        worst = max(worst, _energy_drift(top, motion))
    return worst


@CASES.hold(
    "energy over 10^4 nutations",
    because="errors that grow with time would show",
    against="the energy at the start, relative",
    bound=1e-14,
)
def _energy_kept() -> float:
    top = _top(theta=1.3, phi_rate=0.2, spin=6.0)
    span = 1e4 * float(nutation_period(top))
    times = np.random.default_rng(4).uniform(0.0, span, 2000)
    return _energy_drift(top, heavy_top_motion(top, np.concatenate([[0.0], times])))


@CASES.refuse(
    "a spin too slow for steady precession",
    because="the rates are complex: a square root of less than nothing",
    saying="too slow for steady precession",
)
def _too_slow() -> None:
    steady_precession(_top(theta=0.1, spin=1.0))


@CASES.refuse(
    "a top leaning by more than pi",
    because="cosines would not notice",
    saying="give an angle from 0 to pi",
)
def _beyond_pi() -> None:
    _top(theta=3.2)


@CASES.refuse(
    "a top with I3 above 2 I1",
    because="no such body, yet all formulas give numbers",
    saying="no body has more than twice its transverse moment",
)
def _impossible() -> None:
    _top(axial_moment=4.0 + 1e-9)


@CASES.refuse(
    "a top whose weight is not a number",
    because="NaN passes every comparison that is written the wrong way round",
    saying="give a finite number",
)
def _nan_weight() -> None:
    _top(weight_moment=float("nan"))
