"""Stiff and extreme cases of motion with no torque."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from earthspin.checks.case import Cases
from earthspin.checks.default_body import default_body
from earthspin.constants import ARCSEC, JULIAN_YEAR
from earthspin.mass.inertia import ellipticity_from_h
from earthspin.numerics import quaternion
from earthspin.numerics.double_double import DoubleDouble, as_double_double, two_product, two_sum
from earthspin.numerics.elliptic import jacobi, landen_descent
from earthspin.rotor.axisymmetric import SymmetricRotor, speed_and_cone
from earthspin.rotor.constants_of_motion import jacobi_motion
from earthspin.rotor.euler import integrate_rotation
from earthspin.rotor.moments import principal_moments
from earthspin.rotor.triaxial import FreeRotation, free_rotation

FloatArray = NDArray[np.float64]

CASES = Cases("rotor")

EPS = float(np.finfo(float).eps)
UAS = 1e-6 * ARCSEC
BODY = [1.0, 2.0, 2.5]
START = [0.7, -0.4, 0.2]


def _apart(a: FloatArray, b: FloatArray) -> float:
    """Largest difference of two arrays, over the largest size of the second."""
    return float(np.max(np.abs(a - b)) / np.max(np.abs(b)))


def _many_periods(periods: float) -> FreeRotation:
    """A tumbling body at its start and at random times over many periods."""
    span = periods * float(jacobi_motion(BODY, START).period)
    times = np.random.default_rng(5).uniform(0.0, span, 2000)
    return free_rotation(BODY, START, np.concatenate([[0.0], times]))


@CASES.hold(
    "sphere: three equal moments",
    because="every difference of moments is zero, and most formulas divide by one",
    against="a steady turn about the start's own axis, over 10^4 turns",
    bound=5e-15,
)
def _sphere() -> float:
    w, speed = np.array([2.0, 3.0, 6.0]), 7.0
    times = np.arange(0.0, 1e4, 7.0)
    found = free_rotation([2.5, 2.5, 2.5], w, times)
    half = speed * times / 2  # exact
    turn = np.column_stack([np.cos(half), np.sin(half)[:, np.newaxis] * w / speed])
    return max(_apart(found.omega_body, w), _apart(found.attitude, turn))


@CASES.hold(
    "A = B exactly, over 10^4 wobbles",
    because="the elliptic functions degenerate to circular ones",
    against="the axisymmetric closed form (I.6)",
    bound=2e-11,
)
def _axisymmetric() -> float:
    rotor = SymmetricRotor(1.0, 0.3, 1.1, 0.6)
    times = np.linspace(0.0, 1e4 * 2 * np.pi / float(rotor.wobble_rate), 500)
    moments = {"A": 1.0, "B-A": 0.0, "C-A": 0.3}
    found = free_rotation(moments, rotor.omega_body(np.zeros(1))[0], times)
    return _apart(found.omega_body, rotor.omega_body(times))


@CASES.hold(
    "A and B one unit in the last place apart",
    because="which axis is the middle one hangs on the last bit",
    against="the axisymmetric closed form, over 100 wobbles; the bit itself does 1e-13",
    bound=1e-12,
)
def _one_ulp() -> float:
    rotor = SymmetricRotor(1.0, 0.3, 1.1, 0.6)
    times = np.linspace(0.0, 100 * 2 * np.pi / float(rotor.wobble_rate), 500)
    exact, worst = rotor.omega_body(times), 0.0
    for b in (1.0 + EPS, 1.0 - EPS / 2):
        found = free_rotation([1.0, b, 1.3], exact[0], times)
        worst = max(worst, _apart(found.omega_body, exact))
    return worst


@CASES.hold(
    "all three moments one unit in the last place apart",
    because="the wobble takes 10^16 turns, and the polhode is decided by two bits",
    against="omega in space that stays as it was, over 100 turns",
    bound=5e-15,
)
def _nearly_sphere() -> float:
    found = free_rotation([1.0, 1.0 + EPS, 1.0 + 2 * EPS], START, np.linspace(0.0, 800.0, 300))
    return _apart(found.omega_inertial, np.array(START))


@CASES.hold(
    "prolate and turning backwards",
    because="the wobble goes the other way, and so does the spin",
    against="the axisymmetric closed form, C - A of either sign, alpha on either side",
    bound=1e-14,
)
def _prolate() -> float:
    worst = 0.0
    for difference in (-0.9, -1e-9, 0.4):
        for alpha in (0.3, np.pi - 0.3):
            rotor = SymmetricRotor(1.0, difference, 1.0, alpha)
            times = np.linspace(-30.0, 30.0, 61)
            moments = {"A": 1.0, "B-A": 0.0, "C-A": difference}
            found = free_rotation(moments, rotor.omega_body(np.zeros(1))[0], times)
            worst = max(worst, _apart(found.omega_inertial, _seen_from_start(rotor, times)))
    return worst


def _seen_from_start(rotor: SymmetricRotor, times: FloatArray) -> FloatArray:
    """Angular velocity along the body's axes at t = 0."""
    begin = quaternion.conjugate(rotor.attitude(np.zeros(1)))
    return quaternion.rotate(begin, rotor.omega_inertial(times))


@CASES.hold(
    "leaf: I3 = 2 I1 exactly",
    because="the last body that can be; Feynman's plate",
    against="precession at twice the spin as the cone closes, relative",
    bound=5e-15,
)
def _leaf() -> float:
    rotor = SymmetricRotor(1.0, 1.0, 3.0, 1e-9)
    return float(rotor.precession_rate / (2 * rotor.speed) - 1)


@CASES.hold(
    "exactly on the separatrix",
    because="the period is infinite; elliptic functions become hyperbolic ones",
    against="(G/I1) sech, (G/I2) tanh, (G/I3) sech, moments 3, 4, 6",
    bound=5e-15,
)
def _separatrix() -> float:
    i1, i2, i3 = body = np.array([3.0, 4.0, 6.0])
    start = np.array([2.0, 0.0, 1.0])  # I1 (I2 - I1) w1^2 = I3 (I3 - I2) w3^2 in whole numbers
    times = np.linspace(-20.0, 20.0, 81)
    g = float(np.sqrt(np.sum((body * start) ** 2)))
    rate = g / i2 * math.sqrt((i2 - i1) * (i3 - i2) / (i1 * i3))
    sech = 1 / np.cosh(rate * times)
    exact = np.stack([2.0 * sech, -g / i2 * np.tanh(rate * times), sech], axis=-1)
    found = free_rotation(body, start, times).omega_body
    return min(_apart(found, exact), _apart(found, exact * [1.0, -1.0, 1.0]))


@CASES.hold(
    "one unit in the last place off the separatrix",
    because="k' is 1e-8 and must come from the difference of two nearly equal numbers",
    against="the period 4 ln(4/k')/lambda, k' in exact fractions, relative",
    bound=1e-14,
)
def _near_separatrix() -> float:
    worst = 0.0
    for w3 in (np.nextafter(1.0, 2.0), np.nextafter(1.0, 0.0)):
        i1, i2, i3 = (Fraction(x) for x in (3, 4, 6))
        x1, x3 = i1 * 2**2, i3 * Fraction(float(w3)) ** 2
        if (i3 - i2) * x3 < (i2 - i1) * x1:  # it circles the axis of the other end
            i1, i3, x1, x3 = i3, i1, x3, x1
        r, s = (i3 - i2) / (i3 - i1), (i2 - i1) / (i3 - i1)
        k = math.sqrt((r * x3 - s * x1) / (r * x3))
        rate = abs(i3 - i1) * math.sqrt(r * x3 / (i1 * i2 * i3))
        exact = 4 * math.log(4 / k) / rate
        found = float(jacobi_motion([3.0, 4.0, 6.0], [2.0, 0.0, float(w3)]).period)
        worst = max(worst, abs(found / exact - 1))
    return worst


@CASES.hold(
    "spin exactly about the middle axis",
    because="unstable: the least rounding would make it tumble",
    against="omega that stays, bit for bit, for 10^6 turns",
    bound=0.0,
)
def _middle_axis() -> float:
    found = free_rotation(BODY, [0.0, 1.5, 0.0], np.linspace(0.0, 6e6, 1001))
    return float(np.max(np.abs(found.omega_body - [0.0, 1.5, 0.0])))


@CASES.hold(
    "tennis racket through five flips",
    because="a push of 1e-3 grows a thousandfold before each flip, and errors with it",
    against="Euler's equations and the attitude by DOP853, 1e-13",
    bound=1e-8,
    slow=True,
)
def _racket() -> float:
    start = np.array([1e-3, 1.0, 1e-3])
    period = float(jacobi_motion(BODY, start).period)
    times = np.linspace(0.0, 2.5 * period, 200)
    stepped = integrate_rotation(BODY, start, times)
    return _apart(stepped.attitude, free_rotation(BODY, start, times).attitude)


@CASES.hold(
    "energy over 10^4 periods",
    because="errors that grow with time would show",
    against="the energy at the start, relative",
    bound=1e-14,
)
def _energy() -> float:
    energy = _many_periods(1e4).energy
    return float(np.max(np.abs(energy / energy[0] - 1)))


@CASES.hold(
    "size of the angular momentum over 10^4 periods",
    because="errors that grow with time would show",
    against="|L| at the start, relative",
    bound=1e-14,
)
def _momentum() -> float:
    size = np.linalg.norm(_many_periods(1e4).angular_momentum_body, axis=-1)
    return float(np.max(np.abs(size / size[0] - 1)))


@CASES.hold(
    "direction of the angular momentum over 10^4 periods",
    because="attitude and spin must err together, or not at all",
    against="L in space at the start, over |L|",
    bound=1e-14,
)
def _direction() -> float:
    found = _many_periods(1e4)
    space = quaternion.rotate(found.attitude, found.angular_momentum_body)
    return _apart(space, space[0])


@CASES.hold(
    "unit quaternion over 10^4 periods",
    because="no step ever brings its length back",
    against="1",
    bound=1e-14,
)
def _unit() -> float:
    return float(np.max(np.abs(np.sum(_many_periods(1e4).attitude ** 2, axis=-1) - 1)))


@CASES.hold(
    "60 years of a planet's polhode",
    because="72 rounds of a cone of 0.2 arcsec, A and B 7e-6 apart, after 22,000 turns",
    against="omega at the start after every whole round",
    unit="uas",
    bound=7e-8,
)
def _polhode() -> float:
    moments, spin = _moments_and_spin()
    start = np.array([1e-6, 0.0, 1.0]) * spin
    period = float(jacobi_motion(moments, start).period)
    rounds = np.arange(0, int(60 * JULIAN_YEAR / period) + 1)
    found = free_rotation(moments, start, rounds * period).omega_body
    return float(np.max(np.abs(found - start)) / spin / UAS)


def _moments_and_spin() -> tuple[dict[str, float], float]:
    """Moments in units of A, and spin, of the body that questions are about."""
    body = default_body()
    h, j2 = float(body.needed("dynamical_flattening")), float(body.needed("j2"))
    polar = j2 / h  # C/(M a2)
    equatorial = polar - j2 - float(body.triaxiality) / 2
    b_a, c_a = float(body.triaxiality), j2 + float(body.triaxiality) / 2
    moments = {"A": 1.0, "B-A": b_a / equatorial, "C-A": c_a / equatorial}
    return moments, float(body.spin_rate)


@CASES.hold(
    "cones of one microarcsecond",
    because="the body cone is 5e-12 rad, the space cone 300 times less; cosines see neither",
    against="the small-angle form e alpha/(1 + e) of the space cone, relative",
    bound=5e-15,
)
def _tiny_cones() -> float:
    e = ellipticity_from_h(0.00327)
    rotor = SymmetricRotor(1.0, e, 7.3e-5, UAS)
    return float(rotor.space_cone / (e * UAS / (1 + e)) - 1)


@CASES.hold(
    "a tumbling body of 1e-30 kg m2, and one of 1e40 that turns once in 10^6 years",
    because="squares of moments and spins leave the range of floats",
    against="the same body in units of one, digit for digit up to the scale's rounding",
    bound=5e-15,
)
def _scales() -> float:
    times = np.array([0.3, 4.0, 50.0])
    plain = free_rotation(BODY, START, times)
    worst = 0.0
    for size, speed in ((-100, 0), (132, -45), (300, 250), (-300, -250)):
        moments, start = np.ldexp(BODY, size), np.ldexp(START, speed)
        found = free_rotation(moments, start, np.ldexp(times, -speed))
        worst = max(worst, _apart(np.ldexp(found.omega_body, -speed), plain.omega_body))
        worst = max(worst, _apart(found.attitude, plain.attitude))
    return worst


@CASES.hold(
    "there and back in time",
    because="the phase is reduced by half periods of either sign",
    against="the start, from the state at t with the spin reversed",
    bound=6e-14,
)
def _there_and_back() -> float:
    there = free_rotation(BODY, START, [1234.5])
    back = free_rotation(BODY, -there.omega_body[0], [1234.5])
    turn = quaternion.multiply(there.attitude[0], back.attitude[0])
    home = np.abs(turn) - np.array([1.0, 0.0, 0.0, 0.0])
    return max(_apart(-back.omega_body[0], np.array(START)), float(np.max(np.abs(home))))


@CASES.hold(
    "elliptic functions as k tends to 1",
    because="1 - k2 is 1e-300: k itself is the float 1",
    against="tanh and sech, over what the last place of u does to them, and K = ln(4/k')",
    bound=5e-15,
)
def _modulus_one() -> float:
    descent = landen_descent(as_double_double(np.array([1e-150])))
    u = np.array([[-30.0, -1.0, 0.0, 0.5, 7.0, 300.0]])
    (sn, cn, dn), _ = jacobi(u, descent)
    sech = 1 / np.cosh(u)
    quarter = float(descent.quarter_period.hi[0]) / math.log(4e150)
    told = 1 + np.abs(u)
    off = [np.abs(sn - np.tanh(u)), np.abs(cn / sech - 1) / told, np.abs(dn / sech - 1) / told]
    return max(float(np.max(off)), abs(quarter - 1))


@CASES.hold(
    "double-double sums and products",
    because="the separatrix and late phases hang on what rounding takes away",
    against="exact fractions: nothing may be lost of a sum or a product of two floats",
    bound=0.0,
)
def _exact_pairs() -> float:
    rng = np.random.default_rng(2)
    a, b = rng.normal(size=200) * 10.0 ** rng.integers(-30, 30, 200), rng.normal(size=200)
    lost = Fraction(0)
    for x, y, *pairs in zip(a, b, *two_sum(a, b), *two_product(a, b), strict=True):
        sum_hi, sum_lo, product_hi, product_lo = (Fraction(p) for p in pairs)
        lost = max(lost, abs(Fraction(x) + Fraction(y) - sum_hi - sum_lo))
        lost = max(lost, abs(Fraction(x) * Fraction(y) - product_hi - product_lo))
    return float(lost)


@CASES.hold(
    "double-double division and root",
    because="32 digits must come out of operations that have 16",
    against="exact fractions: (1/3) times 3 and the root of 2 squared, relative",
    bound=2e-31,
)
def _quotients() -> float:
    third = as_double_double(1.0) / as_double_double(3.0)
    root = as_double_double(np.array(2.0)).sqrt()
    return max(float(abs(3 * _exact(third) - 1)), float(abs(_exact(root) ** 2 / 2 - 1)))


def _exact(number: DoubleDouble) -> Fraction:
    return Fraction(float(number.hi)) + Fraction(float(number.lo))


@CASES.hold(
    "quaternion after 10^5 products",
    because="each product rounds, and nothing brings the length back",
    against="the turn by 10^5 times the angle",
    bound=2e-11,
    slow=True,
)
def _products() -> float:
    step = 2 * np.pi * 12345.25 / 1e5
    one = quaternion.turn_about_z(np.array(step / 2))
    turn = np.array([1.0, 0.0, 0.0, 0.0])
    for _ in range(100_000):
        turn = quaternion.multiply(one, turn)
    exact = float(Fraction(step / 2) * 100_000)
    return float(np.hypot(turn[0] - math.cos(exact), turn[3] - math.sin(exact)))


@CASES.hold(
    "ten thousand rotors at once",
    because="tumbling, separatrix, sphere and leaf stand in one array",
    against="fifty of them by themselves; only the last bit may differ",
    bound=5e-15,
)
def _batch() -> float:
    rng = np.random.default_rng(8)
    moments = rng.uniform(0.51, 1.0, (10_000, 3))
    starts = rng.normal(size=(10_000, 3))
    moments[:4] = [[3.0, 4.0, 6.0], [1.0, 1.0, 1.0], [1.0, 1.0, 2.0], [1.0, 1.0, 1.0 + EPS]]
    starts[0] = [2.0, 0.0, 1.0]
    times = np.array([0.0, 3.0, 1e4])
    whole = free_rotation(moments, starts, times)
    worst = 0.0
    for n in [*range(10), *range(10, 10_000, 250)]:
        alone = free_rotation(moments[n], starts[n], times)
        worst = max(worst, float(np.max(np.abs(alone.omega_body - whole.omega_body[n]))))
        worst = max(worst, float(np.max(np.abs(alone.attitude - whole.attitude[n]))))
    return worst


@CASES.refuse(
    "a rotor whose energy no float can hold",
    because="squares overflow, and the energy of a turning body comes out infinite, or zero",
    saying="a float cannot hold",
)
def _overflow() -> None:
    free_rotation(np.multiply(BODY, 1e200), np.multiply(START, 1e80), [0.0])


@CASES.refuse(
    "a rotor at rest",
    because="no angular momentum: there is no axis to follow",
    saying="no angular momentum",
)
def _at_rest() -> None:
    free_rotation(BODY, [0.0, 0.0, 0.0], [1.0])


@CASES.refuse(
    "C one part in 10^9 above A + B",
    because="no such body; the closed form would not notice",
    saying="exceeds the sum of the other two",
)
def _triangle() -> None:
    principal_moments([1.0, 1.0, 2.0 + 2e-9])


@CASES.refuse(
    "a sphere's cone from energy and angular momentum",
    because="0/0: every angle has the same T and L",
    saying="do not tell alpha",
)
def _sphere_cone() -> None:
    speed_and_cone(1.0, 0.0, 0.5, 1.0)


@CASES.refuse(
    "a start that is not a number",
    because="NaN passes every comparison that is written the wrong way round",
    saying="give finite numbers",
)
def _nan_start() -> None:
    free_rotation(BODY, [0.1, float("nan"), 0.0], [1.0])


@CASES.refuse(
    "an infinite time",
    because="its phase is no number",
    saying="give finite numbers",
)
def _infinite_time() -> None:
    free_rotation(BODY, START, [float("inf")])
