"""Stiff and extreme cases of how mass is spread."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

import numpy as np

from earthspin.checks.case import Distances, holds, refused, relative_error
from earthspin.constants import G
from earthspin.mass.figure import layered_moments, spheroid_mass, spheroid_moments
from earthspin.mass.legendre import orthonormal_functions
from earthspin.mass.maccullagh import maccullagh_potential, maccullagh_torque
from earthspin.mass.multipoles import (
    exterior_multipoles,
    inverse_distance,
    inverse_distance_bound,
)
from earthspin.mass.principal_axes import principal_axes
from earthspin.mass.rings import (
    dumbbell_torque,
    ring_positions,
    ring_torque,
    torque_on_masses,
)
from earthspin.mass.spheroid import (
    attraction_integrals,
    confocal_squares,
    error_bound,
    spheroid_attraction,
    spheroid_potential,
    spheroid_torque,
)
from earthspin.mass.tensor import check_inertia_tensor, inertia_tensor
from earthspin.mass.zonal import spheroid_zonals

EPS = float(np.finfo(float).eps)
#: From a needle to a disc.
FLATTENINGS = np.array([-1e6, -1e3, -1.0, -1e-12, 0.0, 1e-12, 1e-3, 0.5, 1 - 1e-6, 1 - 1e-12])


@holds(bound=0.0)
def _equal_moments() -> Distances:
    """three moments equal to the last bit

    Hard because: no axis is told from another: eigenvectors would be anything
    Held against: shape 'sphere', and the axes that the tensor came in
    """
    found = principal_axes(8e37 * np.eye(3))
    yield found.shape != "sphere"
    yield ~np.array(found.free)
    yield found.axes - np.eye(3)


@holds(bound=0.0)
def _one_ulp() -> Distances:
    """moments that differ by one unit in the last place

    Hard because: C - A is as small as a float can tell, and taken from eigenvalues
    Held against: that unit itself, over the moment
    """
    found = principal_axes(np.diag([1.0, 1.0, 1.0 + EPS]))
    yield found.c_minus_a - EPS


@holds(bound=5e-15)
def _turned_cube() -> Distances:
    """degenerate principal axes of a turned cube

    Hard because: a cube's moments agree, but rounding of the turned tensor sets them apart
    Held against: sum of m (y2 + z2) about every axis, and shape 'sphere'
    """
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    found = principal_axes(inertia_tensor(np.ones(8), corners @ turn.T))
    yield found.moments / 16 - 1
    yield found.shape != "sphere"


@holds(bound=1e-14)
def _line() -> Distances:
    """masses on a straight line

    Hard because: one moment is zero, and rounding may take it below
    Held against: sum of m s2 about the two axes across, zero along
    """
    direction = np.array([1.0, -2.0, 2.0]) / 3
    places, masses = np.array([-3.0, 0.5, 1.0, 7.0]), np.array([1.0, 2.0, 3.0, 4.0])
    found = principal_axes(inertia_tensor(masses, places[:, np.newaxis] * direction))
    across = float(np.sum(masses * places**2))
    yield relative_error(found.moments, [0.0, across, across])


@holds(bound=5e-15)
def _flat() -> Distances:
    """flat body: C = A + B exactly

    Hard because: the triangle inequality of the moments is met with equality
    Held against: A + B - C = 0, over C
    """
    places = np.random.default_rng(5).normal(size=(40, 3)) * [1.0, 0.3, 0.0]
    a, b, c = principal_axes(inertia_tensor(np.ones(40), places)).moments
    yield (a + b - c) / c


@refused("none may exceed the sum of the other two")
def _triangle() -> None:
    """triangle inequality violated

    Hard because: no body has C above A + B, yet every formula would give numbers
    """
    check_inertia_tensor(np.diag([1.0, 1.0, 2.0 + 1e-9]))


@holds(bound=5e-15)
def _scales() -> Distances:
    """masses of 1e-30 kg and of 1e40 kg

    Hard because: products of seventy decades apart pass through one formula
    Held against: moments in proportion to the mass
    """
    small, large = (spheroid_moments(m, 1.0, 0.1) for m in (1e-30, 1e40))
    body = np.array([[1.0, 2.0, 3.0], [-2.0, 0.0, 1.0], [0.5, -1.0, 2.0]])
    tensors = [inertia_tensor(np.full(3, m), body) / m for m in (1e-30, 1e40)]
    yield large.polar / small.polar / 1e70 - 1
    yield (tensors[0] - tensors[1]) / 20


@holds(bound=1e-11)
def _nearly_round() -> Distances:
    """flattening 1e-12: torque against the quadrupole

    Hard because: A3 - A1 is 1e-12 of either integral; their difference keeps four digits
    Held against: 3 G m (C - A) z (r x k)/r5, exact to first order in the flattening at any distance
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
def _poisson() -> Distances:
    """spheroids from needle to disc: Poisson's equation inside

    Hard because: semi-axes of one to a million, both ways; textbook arctangents lose all digits
    Held against: 2 A1 + A3 = 2/(a2 c), for ten flattenings from -1e6 to 1 - 1e-12
    """
    inside = attraction_integrals(1.0, FLATTENINGS, np.zeros((FLATTENINGS.size, 3)))
    yield (2 * inside.a1 + inside.a3) * (1 - FLATTENINGS) / 2 - 1


@holds(bound=5e-15)
def _needle() -> Distances:
    """needle: potential at its centre

    Hard because: c is a million a, and the integral runs over twelve decades
    Held against: -(3/2) G M arcosh(c/a)/sqrt(c2 - a2)
    """
    ratio = 1 + 1e6
    found = spheroid_potential(1.0, 1.0, -1e6, np.zeros(3))
    yield found / (-1.5 * math.acosh(ratio) / math.sqrt(ratio**2 - 1)) - 1


@holds(bound=1.0)
def _rim() -> Distances:
    """beside the rim of a disc, from a tenth of a radius to 1e-8 of it

    Hard because: the confocal coordinate magnifies the rounding of the place near the focal ring
    Held against: that coordinate from the same floats with 50 digits, over what is claimed
    """
    rng = np.random.default_rng(4)
    for distance in 10.0 ** np.arange(-8, 0):
        f = 1 - 1e-3 * float(distance)
        ring, turn = math.sqrt(-math.expm1(2 * math.log1p(-f))), rng.uniform(0, np.pi / 2)
        place = np.array([ring + distance * np.cos(turn), 0.0, distance * np.sin(turn)])
        with localcontext(prec=50):
            c2, x2, z2 = ((Decimal(float(v))) ** 2 for v in (1 - f, place[0], place[2]))
            half = (x2 + z2 - 1 - c2) / 2
            exact = float(half + (half * half + x2 * c2 + z2 - c2).sqrt() + c2)
        _, along = confocal_squares(f, place)
        yield (along / exact - 1) / error_bound(f, place)


@holds(bound=5e-15)
def _disc() -> Distances:
    """disc: potential at its centre

    Hard because: c is 1e-12 of a, next to where the spheroid has no volume
    Held against: -(3/2) G M arccos(c/a)/sqrt(a2 - c2)
    """
    f = 1 - 1e-12
    ratio = 1 - f
    found = spheroid_potential(1.0, 1.0, f, np.zeros(3))
    yield found / (-1.5 * math.acos(ratio) / math.sqrt((1 - ratio) * (1 + ratio))) - 1


@holds(bound=5e-15)
def _far_field() -> Distances:
    """field from the surface to a million radii

    Hard because: potential and quadrupole fall by six and by eighteen decades
    Held against: the zonal series of a homogeneous spheroid, J2 to J20
    """
    f, theta = 1 / 298.25, np.radians(33.0)
    distance = np.geomspace(1.0 + 1e-12, 1e6, 40)
    r = distance[:, np.newaxis] * np.array([np.sin(theta), 0.0, np.cos(theta)])
    found = spheroid_potential(1.0, 1.0, f, r)
    zonals = spheroid_zonals(f, 20)
    degrees = np.arange(21)
    powers = distance[:, np.newaxis] ** -(degrees + 1.0)
    legendre = np.array([np.polynomial.Legendre.basis(n)(np.cos(theta)) for n in degrees])
    series = np.sum(zonals * powers * legendre, axis=1)
    yield found / series - 1


@holds(bound=1e-14)
def _across_surface() -> Distances:
    """field across the surface

    Hard because: inside and outside are different formulas
    Held against: the same attraction one unit in the last place below and above, over its size
    """
    for f in (-0.5, 0.0, 1e-9, 0.3, 0.7):
        theta = np.linspace(0.0, np.pi, 13)
        edge = np.stack([np.sin(theta), 0 * theta, (1 - f) * np.cos(theta)], axis=-1)
        inner, outer = (spheroid_attraction(1.0, 1.0, f, edge * (1 + s * EPS)) for s in (-2, 2))
        yield relative_error(inner, outer)


@holds(bound=0.0)
def _centre() -> Distances:
    """at the centre and on the axis

    Hard because: directions vanish there: 0/0 in spherical coordinates
    Held against: no attraction at the centre, no torque on the axis or in the equator
    """
    yield spheroid_attraction(4e14, 6.4e6, 0.01, np.zeros(3))
    places = np.array([[0.0, 0.0, 3e7], [0.0, 0.0, -1e3], [3e7, -2e7, 0.0], [0.0, 0.0, 0.0]])
    yield spheroid_torque(4e14, 6.4e6, 0.01, 7e22, places)


@holds(bound=5e-15)
def _mass_inside() -> Distances:
    """a mass inside the spheroid

    Hard because: no expansion in the distance holds there
    Held against: torque in proportion to z x: A3 - A1 is constant inside, over itself
    """
    r = np.array([[1e-9, 0.0, 1e-9], [0.1, 0.0, 0.2], [0.6, 0.0, 0.4]])
    twist = spheroid_torque(1.0, 1.0, 0.2, 1.0, r)[:, 1] / (r[:, 0] * r[:, 2])
    yield twist / twist[0] - 1


@refused("holds outside it")
def _maccullagh_centre() -> None:
    """a distant mass in the middle of the body

    Hard because: r = 0 divides by zero in the formula for a distant mass
    """
    maccullagh_torque(1e20, np.diag([1.0, 1.0, 2.0]), np.zeros(3))


@holds(bound=5e-15)
def _far_multipoles() -> Distances:
    """multipole moments a billion radii away

    Hard because: the terms fall by nine decades each, to 1e-100 and below
    Held against: MacCullagh's potential, relative
    """
    rng = np.random.default_rng(11)
    masses, places = rng.uniform(1, 2, 30), rng.normal(size=(30, 3))
    places -= np.sum(masses[:, np.newaxis] * places, axis=0) / np.sum(masses)
    far = 1e9 * np.array([0.6, -0.48, 0.64])
    series = exterior_multipoles(masses, places, 12).potential(far)
    closed = maccullagh_potential(np.sum(masses), inertia_tensor(masses, places), far)
    yield series / closed - 1


@holds(bound=1.0)
def _hardly_converging() -> Distances:
    """series of 1/R to degree 300 where it hardly converges

    Hard because: both points are within 10 per cent of one distance: 300 terms of like size
    Held against: 1/R itself, over the bound that the series claims and rounding
    """
    one, other = np.array([1.0, 0.2, -0.3]), 0.9 * np.array([0.3, 1.0, 0.2])
    exact = 1 / np.linalg.norm(one - other)
    found = float(inverse_distance(one, other, 300))
    claimed = float(inverse_distance_bound(one, other, 300))
    yield (found - exact) / (claimed + 20 * EPS * exact)


@holds(bound=5e-12)
def _legendre() -> Distances:
    """Legendre functions of degree 1000 beside the pole

    Hard because: the recurrence runs a thousand steps where neighbours nearly cancel
    Held against: P_n(1) = 1 and P_n(-1) = (-1)^n
    """
    top = orthonormal_functions(1000, np.array([1.0, -1.0]))[-1] / math.sqrt(1000.5)
    yield top - 1


@holds(bound=5e-12)
def _dumbbell() -> Distances:
    """a dumbbell and a mass a million radii away

    Hard because: the pulls on both ends agree to six digits; their difference is the torque
    Held against: -6 GM m r2/b3 sin cos (I.8.2), relative; the next order is 1e-12
    """
    angle = 0.7
    ends = ring_positions(2, 1.0, angle)
    found = torque_on_masses(1e20, [1e6, 0.0, 0.0], np.full(2, 5.0), ends)[2]
    yield found / dumbbell_torque(1e20, 1e6, 5.0, 1.0, angle) - 1


@holds(bound=1e-11)
def _ring() -> Distances:
    """a ring of six whose dumbbells cancel

    Hard because: three torques of size one add up to 1e-8
    Held against: closed form of degree six, over one dumbbell's torque
    """
    angle, distance = 0.2, 100.0
    places = ring_positions(6, 1.0, angle)
    found = torque_on_masses(1e6, [distance, 0.0, 0.0], np.ones(6), places)[2]
    closed = ring_torque(1e6, distance, 1.0, 1.0, 6, angle)
    yield (found - closed) / dumbbell_torque(1e6, distance, 1.0, 1.0, angle)


@holds(bound=5e-15)
def _layers() -> Distances:
    """a body of many layers that are all alike

    Hard because: mass and moments become sums of vanishing differences
    Held against: the whole homogeneous spheroid
    """
    radii = np.linspace(0.001, 1.0, 1000) * 6.4e6
    mass, moments = layered_moments(radii, np.full(1000, 5500.0), np.full(1000, 1e-9))
    whole = float(spheroid_mass(5500.0, 6.4e6, 1e-9))
    bulge = float(spheroid_moments(whole, 6.4e6, 1e-9).difference)
    yield mass / whole - 1
    yield moments.difference / bulge - 1
