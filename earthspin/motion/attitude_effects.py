"""Effects that depend on the full attitude of a body, one section for each effect.

Only the question `rotation` includes them. On a body that rotates fast relative to its perturbers,
harmonics of order m > 0 average out, and tides and core are part of the response of its interior.
The model is that of DE421 for the Moon; the equations are written out in Folkner et al. 2014, IPN
Progress Report 42-196.
"""

from __future__ import annotations

from collections import ChainMap
from dataclasses import replace

import numpy as np

from earthspin.motion.effects import EFFECTS, BodyNumbers, Effect, register
from earthspin.motion.equations import BodyLaw, LiquidCore
from earthspin.motion.forces import BodyTorque, Forces, Places
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.polynomials import Windows
from earthspin.torque.gravity import cross, dot
from earthspin.torque.harmonics import HarmonicsTorque

#: Effects that depend on the full attitude, by name.
ATTITUDE_EFFECTS: dict[str, Effect] = {}
#: Effects on the axes, and those that depend on the full attitude.
ALL_EFFECTS = ChainMap(ATTITUDE_EFFECTS, EFFECTS)


def _in_body(matrix: FloatArray, position: FloatArray) -> FloatArray:
    """Transform positions (3, w, n) from sky axes to those of a body, or of some in one window."""
    return np.asarray(np.einsum("ji...,j...->i...", matrix, position))


# --- harmonics of the field -----------------------------------------------------------------------
# Torque of the primary mass on the Stokes coefficients of degree 3 and higher.


def harmonics_torque(forces: Forces, windows: Windows, places: Places) -> BodyLaw:
    """Return a function for the torque of the primary mass on C_nm and S_nm, per C."""
    figure, field = forces.figure, forces.figure.harmonics
    assert field is not None
    scale = forces.gm[forces.primary] * figure.inverse_polar_moment / figure.radius**3
    position = places[forces.primary] / figure.radius
    return lambda matrix, spin: scale * field.at(_in_body(matrix, position))


def _set_harmonics(forces: Forces, body: BodyNumbers) -> Forces:
    if not forces.primary:
        return forces
    figure = replace(forces.figure, harmonics=HarmonicsTorque(body.harmonics))
    return replace(forces, figure=figure, body_torques=(*forces.body_torques, harmonics_torque))


HARMONICS = register(ATTITUDE_EFFECTS, Effect("harmonics", _set_harmonics, "harmonics"))


# --- tides on the body ----------------------------------------------------------------------------
# Changes of the products of inertia by the tide of the primary mass and by the spin, at an earlier
# time, with the Love number k2 and the mean spin n:
#
#     dI = (k2 a5/G) { -GM/r5 (r r - r2/3) + [w w - (1/3)(w2 - n2)]/3 - (n2/3) z z }
#
# The attitude at the earlier time is that of a steady rotation with the present angular velocity,
# and the position follows from two terms of Taylor's series, as the delay is short.


def tidal_inertia(k2: float, delay: float, gm: float, mean_spin: float) -> BodyTorque:
    """Return the effect of tides and spin on the products of inertia of a body, per C."""

    def over(forces: Forces, windows: Windows, places: Places) -> BodyLaw:
        name, figure = forces.primary, forces.figure
        velocity = windows.derivative(places[name])
        earlier = places[name] - delay * (velocity - 0.5 * delay * windows.derivative(velocity))
        scale = k2 * figure.radius**3 * figure.inverse_polar_moment / gm

        def law(matrix: FloatArray, spin: FloatArray) -> FloatArray:
            position = _turned(spin * delay, _in_body(matrix, earlier))
            r2 = dot(position, position)
            tide = -forces.gm[name] / (r2 * r2 * np.sqrt(r2))
            change = tide * _products(position) + _products(spin) / 3
            change[:3] -= (tide * r2 + (dot(spin, spin) - mean_spin**2) / 3) / 3
            change[2] -= mean_spin**2 / 3
            return np.asarray(scale * change)

        return law

    return over


def _turned(rotation: FloatArray, vector: FloatArray) -> FloatArray:
    """Rotate vectors (3, ...) by small rotation vectors (3, ...), to third order in the angle."""
    first = cross(rotation, vector)
    second = cross(rotation, first)
    return np.asarray(vector + first + second / 2 + cross(rotation, second) / 6)


def _products(v: FloatArray) -> FloatArray:
    """Products xx, yy, zz, xy, xz, yz of the components of vectors, shape (6, ...)."""
    x, y, z = v
    return np.stack([x * x, y * y, z * z, x * y, x * z, y * z])


def _add_tides(forces: Forces, body: BodyNumbers) -> Forces:
    k2 = body.number("k2")
    if not k2 or not forces.primary:
        return forces
    mean_spin = 2 * np.pi / body.number("spin_period")
    inertia = tidal_inertia(k2, body.number("tidal_delay"), body.number("gm"), mean_spin)
    return replace(forces, inertia_changes=(*forces.inertia_changes, inertia))


TIDES = register(ATTITUDE_EFFECTS, Effect("tides", _add_tides, "k2", ("tidal_delay",)))


# --- fluid core -----------------------------------------------------------------------------------
# A core of uniform vorticity. By default it starts about the mean normal of the orbit, which the
# mantle circles too fast for the core to follow.


def _add_core(forces: Forces, body: BodyNumbers) -> Forces:
    moment = body.number("core_moment")
    if not moment:
        return forces
    core = LiquidCore(
        moment=moment,
        flattening=body.number("core_flattening"),
        friction=body.number("core_friction"),
        spin=None
        if body.orbit_pole is None
        else forces.figure.spin_rate * body.orbit_pole.vector(),
    )
    return replace(forces, core=core)


FLUID_CORE = register(
    ATTITUDE_EFFECTS,
    Effect("fluid-core", _add_core, "core_moment", ("core_flattening", "core_friction")),
)


# --- flattening of the perturber ------------------------------------------------------------------
# Torque of the J2 of the primary mass on the moments of inertia, with its pole p and u = r/r:
#
#     (15/2) GM J2 a2/r5 {(1 - 7 (u.p)2) u x I u + 2 (u.p)(u x I p + p x I u) - (2/5) p x I p}


def flattening_torque(forces: Forces, windows: Windows, places: Places) -> BodyLaw:
    """Return a function for the torque of the flattening of the primary mass, per C."""
    figure, (j2_a2, pole) = forces.figure, forces.primary_bulge
    half = figure.triaxiality / 2
    moments = np.array([1 - figure.h - half, 1 - figure.h + half, 1.0]).reshape(3, 1, 1)
    away = places[forces.primary]
    distance = np.sqrt(dot(away, away))
    size = 7.5 * forces.gm[forces.primary] * j2_a2 / distance**5

    def law(matrix: FloatArray, spin: FloatArray) -> FloatArray:
        u, p = _in_body(matrix, away / distance), _in_body(matrix, pole.reshape(3, 1, 1))
        up = dot(u, p)
        mixed = cross(u, moments * p) + cross(p, moments * u)
        total = (1 - 7 * up * up) * cross(u, moments * u) + 2 * up * mixed
        return np.asarray(size * (total - 0.4 * cross(p, moments * p)))

    return law


def _add_flattening(forces: Forces, body: BodyNumbers) -> Forces:
    if not forces.primary_bulge[0]:
        return forces
    return replace(forces, body_torques=(*forces.body_torques, flattening_torque))


FLATTENED_PERTURBER = register(ATTITUDE_EFFECTS, Effect("flattened-perturber", _add_flattening))
