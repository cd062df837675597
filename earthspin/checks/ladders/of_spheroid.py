"""Compare error and run time of methods for attraction and torque of a homogeneous spheroid.

Methods: exact form, series and sums.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.polynomial import legendre

from tests.reference.sky import unit_vectors
from tests.reference.stored import load
from earthspin.checks.work_precision import FloatArray, Ladder, Method, Setting
from earthspin.mass.maccullagh import maccullagh_torque
from earthspin.mass.spheroid import spheroid_attraction, spheroid_torque
from earthspin.mass.zonal import spheroid_zonals
from earthspin.numerics.double_double import DoubleDouble

Field = Callable[[Any], tuple[Any, Any]]

FLATTENING = 1 / 298.25
#: Distances in equatorial radii; 60 is the distance of the Moon, 2.35e4 that of the Sun.
DISTANCES = (1.05, 1.5, 4.0, 60.0, 1e4, 2.35e4)
LATITUDES = (-70.0, -30.0, 10.0, 45.0, 80.0)

ROUNDING = 1e-28


def points() -> FloatArray:
    """Points at which attraction and torque are compared, in equatorial radii, shape (n, 3).

    They are ordered by distance. Directions are rounded to 2^-30, so that they are the same on
    every machine.
    """
    azimuth = np.arange(0.3, len(LATITUDES))
    direction = unit_vectors(azimuth, np.radians(LATITUDES))
    direction = np.round(direction * 2.0**30) / 2.0**30
    return np.concatenate([distance * direction for distance in DISTANCES])


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for attraction and torque of a spheroid."""
    positions = points()
    true = load("spheroid", {"flattening": FLATTENING, "points": positions.tolist()})
    degrees = (2, 6, 20) if quick else tuple(range(2, 22, 2))
    cells = (4, 8) if quick else (4, 8, 12, 16, 20)

    def setting(words: str, field: Field, where: Any = positions) -> Setting:
        return Setting(words, lambda: (field(where), len(where)))

    textbook = [
        setting("float64", _arctangents),
        setting("long double", _arctangents, positions.astype(np.longdouble)),
    ]
    return Ladder(
        quantity="spheroid",
        unit="1",
        problem=f"attraction and torque of a homogeneous spheroid of flattening 1/298.25 at "
        f"{len(positions)} points from 1.05 to 23,500 equatorial radii; the error is the largest "
        "of both, relative to their sizes",
        subject="attraction and torque of a spheroid at any distance",
        reference="the textbook formula (MacMillan) with 80 digits, stored with 32",
        reference_error=ROUNDING,
        methods=[
            Method("exact", [setting("", _exact)], 1e-14),
            Method(
                "zonal series", [setting(f"to degree {n}", partial(_series, n)) for n in degrees]
            ),
            Method("MacCullagh", [setting("", _maccullagh)]),
            Method("textbook formula", textbook),
            Method("sum over the body", [setting(f"{n}³ cells", partial(_sum, n)) for n in cells]),
        ],
        useful=0.1,
        error=lambda field: _error(field, true),
    )


def _error(result: Any, true: dict[str, DoubleDouble]) -> float:
    """Largest relative error of attraction and torque over all points."""
    return max(float(np.max(relative_errors(result, true)[name])) for name in true)


def relative_errors(result: Any, true: dict[str, DoubleDouble]) -> dict[str, FloatArray]:
    """Relative errors of attraction and torque at each point."""
    errors = {}
    for values, (name, exact) in zip(result, true.items(), strict=True):
        error = np.linalg.norm((np.asarray(values) - exact).hi, axis=1)
        errors[name] = np.asarray(error / np.linalg.norm(exact.hi, axis=1), dtype=np.float64)
    return errors


def _exact(r: FloatArray) -> tuple[Any, Any]:
    attraction = spheroid_attraction(1.0, 1.0, FLATTENING, r)
    return attraction, spheroid_torque(1.0, 1.0, FLATTENING, 1.0, r)


def _torque(push: Any, r: Any) -> Any:
    """Torque on the spheroid: `push` times the cross product of position r and the z axis."""
    return np.stack([push * r[:, 1], -push * r[:, 0], np.zeros_like(push)], axis=-1)


def _series(n_max: int, r: FloatArray) -> tuple[Any, Any]:
    """Attraction and torque of a spheroid by its series of zonal harmonics to degree `n_max`."""
    zonals = spheroid_zonals(FLATTENING, n_max)
    distance = np.linalg.norm(r, axis=1)
    u = r[:, 2] / distance
    radial, along = np.zeros_like(u), np.zeros_like(u)
    for n in range(0, n_max + 1, 2):
        unit = np.eye(n + 1)[n]
        power = zonals[n] / distance ** (n + 2)
        radial += (n + 1) * power * legendre.legval(u, unit)
        along -= power * legendre.legval(u, legendre.legder(unit))
    # g = radial r/|r| + along (k - u r/|r|)
    attraction = ((radial - along * u) / distance)[:, np.newaxis] * r
    attraction[:, 2] += along
    return attraction, _torque(-along, r)


def _maccullagh(r: FloatArray) -> tuple[Any, Any]:
    """Attraction and torque by MacCullagh's formula, with C - A only (I.9.31, I.9.32)."""
    bulge = (1 - (1 - FLATTENING) ** 2) / 5
    square = np.sum(r * r, axis=1)
    distance = np.sqrt(square)
    pull = 1 + 1.5 * bulge / square * (1 - 5 * r[:, 2] ** 2 / square)
    attraction = -(pull / distance**3)[:, np.newaxis] * r
    attraction[:, 2] -= 3 * bulge * r[:, 2] / distance**5
    return attraction, maccullagh_torque(1.0, np.diag([0.0, 0.0, bulge]), r)


def _arctangents(r: Any) -> tuple[Any, Any]:
    """Attraction and torque of a spheroid by the formula with arctangents (MacMillan 1930)."""
    one = r.dtype.type(1)
    c = one - r.dtype.type(FLATTENING)
    e2 = one - c * c
    across, along = r[:, 0] ** 2 + r[:, 1] ** 2, r[:, 2] ** 2
    half = (across + along - one - c * c) / 2
    root = half + np.sqrt(half * half - (c * c - across * c * c - along))
    u, t, e = one + root, c * c + root, np.sqrt(e2)
    i0 = 2 / e * np.arctan(e / np.sqrt(t))
    a1 = (i0 / 2 - np.sqrt(t) / u) / e2
    a3 = (2 / np.sqrt(t) - i0) / e2
    attraction = -1.5 * np.stack([a1, a1, a3], axis=-1) * r
    return attraction, _torque(1.5 * (a3 - a1) * r[:, 2], r)


def _sum(cells: int, r: FloatArray) -> tuple[Any, Any]:
    """Attraction and torque by numerical integration over the volume of the spheroid."""
    node, weight = np.polynomial.legendre.leggauss(cells)
    size, size_weight = (1 + node) / 2, weight / 2
    longitude = 2 * np.pi * (np.arange(2 * cells) + 0.5) / (2 * cells)
    s, u, phi = np.meshgrid(size, node, longitude, indexing="ij")
    mass = 3 * s**2 * size_weight[:, np.newaxis, np.newaxis] * weight[:, np.newaxis]
    mass = (mass / (4 * cells)).ravel()  # the total is 1
    across = s * np.sqrt(1 - u * u)
    body = np.stack(
        [across * np.cos(phi), across * np.sin(phi), s * u * (1 - FLATTENING)], axis=-1
    ).reshape(-1, 3)
    attraction, torque = np.empty_like(r), np.empty_like(r)
    for number, point in enumerate(r):
        separation = body - point
        pull = mass / np.sum(separation * separation, axis=1) ** 1.5
        attraction[number] = pull @ separation
        torque[number] = np.cross(pull @ body, point)
    return attraction, torque
