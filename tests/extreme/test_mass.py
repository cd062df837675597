"""Mass distributions and their gravity fields."""

import math

import numpy as np

from earthspin.constants import G
from earthspin.mass.figure import maccullagh_potential, spheroid_moments
from earthspin.mass.multipoles import (
    exterior_multipoles,
    inverse_distance,
    inverse_distance_bound,
    orthonormal_functions,
)
from earthspin.mass.spheroid import spheroid_attraction, spheroid_potential, spheroid_torque
from earthspin.mass.tensor import inertia_tensor, principal_axes
from tests.extreme import Distances, holds
from tests.mass.spheroid_reference import spheroid_zonals

EPS = float(np.finfo(float).eps)


@holds(bound=0.0)
def test_one_ulp() -> Distances:
    """principal moments of inertia that differ by one unit in the last place

    Hard because: C - A is the smallest possible difference and comes from eigenvalues
    Compared with: one unit in the last place, relative to the moment
    """
    result = principal_axes(np.diag([1.0, 1.0, 1.0 + EPS]))
    yield result.c_minus_a - EPS


@holds(bound=5e-15)
def test_flat() -> Distances:
    """principal moments of a flat body with C = A + B exactly

    Hard because: the triangle inequality of the moments holds with equality
    Compared with: A + B - C = 0, relative to C
    """
    places = np.random.default_rng(5).normal(size=(40, 3)) * [1.0, 0.3, 0.0]
    a, b, c = principal_axes(inertia_tensor(np.ones(40), places)).moments
    yield (a + b - c) / c


@holds(bound=5e-15)
def test_scales() -> Distances:
    """moments of inertia of bodies of 1e-30 kg and 1e40 kg

    Hard because: one formula has to cover seventy orders of magnitude
    Compared with: moments proportional to the mass
    """
    small, large = (spheroid_moments(m, 1.0, 0.1) for m in (1e-30, 1e40))
    body = np.array([[1.0, 2.0, 3.0], [-2.0, 0.0, 1.0], [0.5, -1.0, 2.0]])
    tensors = [inertia_tensor(np.full(3, m), body) / m for m in (1e-30, 1e40)]
    yield large.polar / small.polar / 1e70 - 1
    yield (tensors[0] - tensors[1]) / 20


@holds(bound=1e-11)
def test_nearly_round() -> Distances:
    """torque on a spheroid with a flattening of 1e-12

    Hard because: A3 - A1 is 1e-12 of either integral, so their difference keeps only four digits
    Compared with: quadrupole torque 3 G m (C - A) z (r x k)/r5, exact to first order in the
        flattening
    """
    f, mass, radius = 1e-12, 6e24, 6.4e6
    bulge = float(spheroid_moments(mass, radius, f).difference)
    for distance in (1.0 + 1e-9, 2.0, 60.0, 2.3e4):
        r = distance * radius * np.array([0.6, 0.0, 0.8])
        exact = spheroid_torque(G.value * mass, radius, f, 2e30, r)
        size = np.sqrt(np.sum(r * r))
        limit = 3 * G.value * 2e30 * bulge * r[2] / size**5 * np.array([r[1], -r[0], 0.0])
        yield exact / limit[1] - limit / limit[1]


@holds(bound=5e-15)
def test_far_field() -> Distances:
    """gravitational potential of a spheroid from its surface to a million radii

    Hard because: the potential falls by 6 orders of magnitude, and its quadrupole part by 18
    Compared with: zonal series of a homogeneous spheroid, J2 to J20
    """
    f, theta = 1 / 298.25, np.radians(33.0)
    distance = np.geomspace(1.0 + 1e-12, 1e6, 40)
    r = distance[:, np.newaxis] * np.array([np.sin(theta), 0.0, np.cos(theta)])
    result = spheroid_potential(1.0, 1.0, f, r)
    zonals = spheroid_zonals(f, 20)
    degrees = np.arange(21)
    powers = distance[:, np.newaxis] ** -(degrees + 1.0)
    legendre = np.array([np.polynomial.Legendre.basis(n)(np.cos(theta)) for n in degrees])
    series = np.sum(zonals * powers * legendre, axis=1)
    yield result / series - 1


@holds(bound=0.0)
def test_centre() -> Distances:
    """attraction of a spheroid at its centre, and torque on its axis and in its equator

    Hard because: directions are undefined there: 0/0 in spherical coordinates
    Compared with: zero attraction at the centre, zero torque on the axis and in the equator
    """
    yield spheroid_attraction(4e14, 6.4e6, 0.01, np.zeros(3))
    places = np.array([[0.0, 0.0, 3e7], [0.0, 0.0, -1e3], [3e7, -2e7, 0.0], [0.0, 0.0, 0.0]])
    yield spheroid_torque(4e14, 6.4e6, 0.01, 7e22, places)


@holds(bound=5e-15)
def test_mass_inside() -> Distances:
    """torque on a spheroid by a point mass inside it

    Hard because: no series in the inverse distance converges there
    Compared with: torque proportional to z x, because A3 - A1 is constant inside, relative
    """
    r = np.array([[1e-9, 0.0, 1e-9], [0.1, 0.0, 0.2], [0.6, 0.0, 0.4]])
    twist = spheroid_torque(1.0, 1.0, 0.2, 1.0, r)[:, 1] / (r[:, 0] * r[:, 2])
    yield twist / twist[0] - 1


@holds(bound=5e-15)
def test_far_multipoles() -> Distances:
    """gravitational potential by multipoles at a distance of a billion radii

    Hard because: each degree is nine orders of magnitude smaller, down to 1e-100 and below
    Compared with: MacCullagh's potential, relative
    """
    rng = np.random.default_rng(11)
    masses, places = rng.uniform(1, 2, 30), rng.normal(size=(30, 3))
    places -= np.sum(masses[:, np.newaxis] * places, axis=0) / np.sum(masses)
    far = 1e9 * np.array([0.6, -0.48, 0.64])
    series = exterior_multipoles(masses, places, 12).potential(far)
    closed = maccullagh_potential(np.sum(masses), inertia_tensor(masses, places), far)
    yield series / closed - 1


@holds(bound=1.0)
def test_hardly_converging() -> Distances:
    """expansion of an inverse distance to degree 300 where it converges slowly

    Hard because: the distances of the two points differ by 10 per cent, so 300 terms have similar
        sizes
    Compared with: 1/R itself, relative to the claimed error bound of the series plus rounding
    """
    one, other = np.array([1.0, 0.2, -0.3]), 0.9 * np.array([0.3, 1.0, 0.2])
    exact = 1 / np.linalg.norm(one - other)
    result = float(inverse_distance(one, other, 300))
    claimed = float(inverse_distance_bound(one, other, 300))
    yield (result - exact) / (claimed + 20 * EPS * exact)


@holds(bound=5e-12)
def test_legendre() -> Distances:
    """values of Legendre functions of degree 1000 at the poles

    Hard because: the recurrence takes a thousand steps in which neighbouring terms nearly cancel
    Compared with: P_n(1) = 1 and P_n(-1) = (-1)^n
    """
    top = orthonormal_functions(1000, np.array([1.0, -1.0]))[-1] / math.sqrt(1000.5)
    yield top - 1
