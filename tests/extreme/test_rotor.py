"""Torque-free rotation."""

import math
from fractions import Fraction

import numpy as np
import pytest

from earthspin.constants import JULIAN_YEAR, UAS
from earthspin.mass.figure import ellipticity_from_h
from earthspin.numerics import quaternion
from earthspin.numerics.arrays import FloatArray
from earthspin.rotor.axisymmetric import SymmetricRotor
from earthspin.rotor.euler import integrate_rotation
from earthspin.rotor.triaxial import FreeRotation, free_rotation, jacobi_motion
from tests.extreme import Distances, holds, relative_error
from tests.reference.sky import BODY, J2, SPIN, H

EPS = float(np.finfo(float).eps)
MOMENTS = [1.0, 2.0, 2.5]
START = [0.7, -0.4, 0.2]


def _as_triaxial(rotor: SymmetricRotor, times: FloatArray) -> FreeRotation:
    """Rotation of an axisymmetric rotor with A = 1, computed by the triaxial closed form."""
    moments = {"A": 1.0, "B-A": 0.0, "C-A": float(rotor.difference)}
    return free_rotation(moments, rotor.omega_body(np.zeros(1))[0], times)


@holds(bound=2e-11)
def test_axisymmetric() -> Distances:
    """free rotor with A = B exactly, over 10^4 wobble periods

    Hard because: the elliptic functions degenerate to circular functions
    Compared with: axisymmetric closed form (I.6)
    """
    rotor = SymmetricRotor(1.0, 0.3, 1.1, 0.6)
    times = np.linspace(0.0, 1e4 * 2 * np.pi / float(rotor.wobble_rate), 500)
    yield relative_error(_as_triaxial(rotor, times).omega_body, rotor.omega_body(times))


@holds(bound=1e-12)
def test_one_ulp() -> Distances:
    """free rotor whose A and B differ by one unit in the last place

    Hard because: the last bit decides which axis is the intermediate one
    Compared with: axisymmetric closed form over 100 wobble periods; the bit itself changes it by
        1e-13
    """
    rotor = SymmetricRotor(1.0, 0.3, 1.1, 0.6)
    times = np.linspace(0.0, 100 * 2 * np.pi / float(rotor.wobble_rate), 500)
    exact = rotor.omega_body(times)
    for b in (1.0 + EPS, 1.0 - EPS / 2):
        result = free_rotation([1.0, b, 1.3], exact[0], times)
        yield relative_error(result.omega_body, exact)


@holds(bound=5e-15)
def test_nearly_sphere() -> Distances:
    """free rotor whose three moments differ by one unit in the last place

    Hard because: a wobble period lasts 10^16 rotations, and two bits decide the polhode
    Compared with: constant angular velocity in space over 100 rotations
    """
    result = free_rotation([1.0, 1.0 + EPS, 1.0 + 2 * EPS], START, np.linspace(0.0, 800.0, 300))
    yield relative_error(result.omega_inertial, START)


@holds(bound=1e-14)
def test_prolate() -> Distances:
    """prolate and retrograde free rotors

    Hard because: the wobble or the spin has the opposite sense
    Compared with: axisymmetric closed form, with both signs of C - A and alpha on both sides of 90
        degrees
    """
    times = np.linspace(-30.0, 30.0, 61)
    for difference in (-0.9, -1e-9, 0.4):
        for alpha in (0.3, np.pi - 0.3):
            rotor = SymmetricRotor(1.0, difference, 1.0, alpha)
            result = _as_triaxial(rotor, times)
            start = quaternion.conjugate(rotor.attitude(np.zeros(1)))  # the axes at t = 0
            expected = quaternion.rotate(start, rotor.omega_inertial(times))
            yield relative_error(result.omega_inertial, expected)


@holds(bound=5e-15)
def test_leaf() -> Distances:
    """precession of a thin plate with I3 = 2 I1 exactly

    Hard because: it is the limiting case of possible bodies (Feynman's plate)
    Compared with: precession at twice the spin rate in the limit of a small cone, relative
    """
    rotor = SymmetricRotor(1.0, 1.0, 3.0, 1e-9)
    yield rotor.precession_rate / (2 * rotor.speed) - 1


@holds(bound=1e-14)
def test_near_separatrix() -> Distances:
    """period of a free rotor one unit in the last place from the separatrix

    Hard because: k' is 1e-8 and follows from the difference of two nearly equal numbers
    Compared with: period 4 ln(4/k')/lambda with k' in exact fractions, relative
    """
    for w3 in (np.nextafter(1.0, 2.0), np.nextafter(1.0, 0.0)):
        i1, i2, i3 = (Fraction(x) for x in (3, 4, 6))
        x1, x3 = i1 * 2**2, i3 * Fraction(float(w3)) ** 2
        if (i3 - i2) * x3 < (i2 - i1) * x1:  # the polhode encloses the axis of least moment
            i1, i3, x1, x3 = i3, i1, x3, x1
        r, s = (i3 - i2) / (i3 - i1), (i2 - i1) / (i3 - i1)
        k = math.sqrt((r * x3 - s * x1) / (r * x3))
        rate = abs(i3 - i1) * math.sqrt(r * x3 / (i1 * i2 * i3))
        exact = 4 * math.log(4 / k) / rate
        result = float(jacobi_motion([3.0, 4.0, 6.0], [2.0, 0.0, float(w3)]).period)
        yield result / exact - 1


@pytest.mark.slow
@holds(bound=5e-9)
def test_racket() -> Distances:
    """free rotor (tennis racket) over five flips about its intermediate axis

    Hard because: a perturbation of 1e-3 grows a thousandfold before each flip, and errors grow
        equally
    Compared with: Euler's equations and the attitude integrated by DOP853 with tolerance 1e-13
    """
    start = np.array([1e-3, 1.0, 1e-3])
    period = float(jacobi_motion(MOMENTS, start).period)
    times = np.linspace(0.0, 2.5 * period, 200)
    stepped = integrate_rotation(MOMENTS, start, times)
    yield relative_error(stepped.attitude, free_rotation(MOMENTS, start, times).attitude)


@holds(bound=7e-8, unit="uas")
def test_polhode() -> Distances:
    """polhode of the Earth over 60 years

    Hard because: the cone of 0.2 arcsec is traversed 72 times in 22,000 rotations, and A and B
        differ by 7e-6
    Compared with: angular velocity at the start after every complete period
    """
    # Moments in units of A from J2 = (C - (A + B)/2)/(M a2), H and (B - A)/(M a2); C/(M a2) = J2/H
    b_a = float(BODY.triaxiality)
    a, c_a = J2 / H - J2 - b_a / 2, J2 + b_a / 2
    moments = {"A": 1.0, "B-A": b_a / a, "C-A": c_a / a}
    start = np.array([1e-6, 0.0, 1.0]) * SPIN
    period = float(jacobi_motion(moments, start).period)
    rounds = np.arange(0, int(60 * JULIAN_YEAR / period) + 1)
    result = free_rotation(moments, start, rounds * period).omega_body
    yield (result - start) / SPIN / UAS


@holds(bound=5e-15)
def test_tiny_cones() -> Distances:
    """free rotor whose body cone has a half-angle of one microarcsecond

    Hard because: the body cone is 5e-12 rad and the space cone 300 times smaller, too small for
        cosines
    Compared with: small-angle form e alpha/(1 + e) of the space cone, relative
    """
    e = ellipticity_from_h(0.00327)
    rotor = SymmetricRotor(1.0, e, 7.3e-5, UAS)
    yield rotor.space_cone / (e * UAS / (1 + e)) - 1
