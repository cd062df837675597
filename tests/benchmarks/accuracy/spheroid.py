"""Attraction and torque of a homogeneous spheroid: exact form, series and sums."""

from typing import Any

import numpy as np
from numpy.polynomial import legendre

from earthspin.mass.figure import maccullagh_torque
from earthspin.mass.spheroid import spheroid_attraction, spheroid_torque
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.double_double import DoubleDouble
from tests.benchmarks.accuracy.ladder import Ladder, settings
from tests.mass.spheroid_reference import spheroid_zonals
from tests.reference.sky import unit_vectors
from tests.reference.stored import load

#: Attraction and torque.
Field = tuple[Any, Any]

FLATTENING = 1 / 298.25
#: Distances in equatorial radii; 60 is the distance of the Moon, 2.35e4 that of the Sun.
DISTANCES = (1.05, 1.5, 4.0, 60.0, 1e4, 2.35e4)
LATITUDES = (-70.0, -30.0, 10.0, 45.0, 80.0)


def points() -> FloatArray:
    """Points at which attraction and torque are compared, in equatorial radii, shape (n, 3).

    They are ordered by distance. Directions are rounded to 2^-30, so that they are the same on
    every machine.
    """
    direction = unit_vectors(np.arange(0.3, len(LATITUDES)), np.radians(LATITUDES))
    direction = np.round(direction * 2.0**30) / 2.0**30
    return np.concatenate([distance * direction for distance in DISTANCES])


def inputs() -> dict[str, Any]:
    """Inputs of the stored reference."""
    return {"flattening": FLATTENING, "points": points().tolist()}


def ladder() -> Ladder:
    """Methods for attraction and torque of a spheroid."""
    r, true = points(), load("spheroid", inputs())
    return Ladder(
        title="Attraction and torque of a spheroid",
        problem=f"attraction and torque of a homogeneous spheroid of flattening 1/298.25 at "
        f"{len(r)} points from 1.05 to 23,500 equatorial radii; the error is the largest of both, "
        "relative to their sizes",
        reference="the textbook formula (MacMillan) with 80 digits, stored with 32",
        unit="1",
        floor=1e-28,
        error=lambda field: max(np.max(error) for error in errors(field, true).values()),
        runs={
            "exact": {"": lambda: (_exact(r), len(r))},
            "zonal series": settings(
                "to degree {}", lambda n: (_series(n, r), len(r)), range(2, 22, 2)
            ),
            "MacCullagh": {"": lambda: (_maccullagh(r), len(r))},
            "textbook formula": {
                "float64": lambda: (arctangents(r), len(r)),
                "long double": lambda: (arctangents(r.astype(np.longdouble)), len(r)),
            },
            "sum over the body": settings(
                "{}³ cells", lambda n: (_sum(n, r), len(r)), (4, 8, 12, 16, 20)
            ),
        },
        bounds={"exact": 1e-14},
    )


def errors(field: Field, true: dict[str, DoubleDouble]) -> dict[str, FloatArray]:
    """Relative errors of attraction and torque at each point."""
    return {
        name: np.asarray(
            np.linalg.norm((np.asarray(values) - exact).hi, axis=1)
            / np.linalg.norm(exact.hi, axis=1),
            dtype=np.float64,
        )
        for values, (name, exact) in zip(field, true.items(), strict=True)
    }


def _exact(r: FloatArray) -> Field:
    attraction = spheroid_attraction(1.0, 1.0, FLATTENING, r)
    return attraction, spheroid_torque(1.0, 1.0, FLATTENING, 1.0, r)


def _torque(push: Any, r: Any) -> Any:
    """Torque on the spheroid: `push` times the cross product of position r and the z axis."""
    return np.stack([push * r[:, 1], -push * r[:, 0], np.zeros_like(push)], axis=-1)


def _series(n_max: int, r: FloatArray) -> Field:
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


def _maccullagh(r: FloatArray) -> Field:
    """Attraction and torque by MacCullagh's formula, with C - A only (I.9.31, I.9.32)."""
    bulge = (1 - (1 - FLATTENING) ** 2) / 5
    square = np.sum(r * r, axis=1)
    distance = np.sqrt(square)
    pull = 1 + 1.5 * bulge / square * (1 - 5 * r[:, 2] ** 2 / square)
    attraction = -(pull / distance**3)[:, np.newaxis] * r
    attraction[:, 2] -= 3 * bulge * r[:, 2] / distance**5
    return attraction, maccullagh_torque(1.0, np.diag([0.0, 0.0, bulge]), r)


def arctangents(r: Any) -> Field:
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


def _sum(cells: int, r: FloatArray) -> Field:
    """Attraction and torque by numerical integration over the volume of the spheroid."""
    node, weight = legendre.leggauss(cells)
    size, size_weight = (1 + node) / 2, weight / 2
    longitude = 2 * np.pi * (np.arange(2 * cells) + 0.5) / (2 * cells)
    s, u, phi = np.meshgrid(size, node, longitude, indexing="ij")
    mass = 3 * s**2 * size_weight[:, np.newaxis, np.newaxis] * weight[:, np.newaxis]
    mass = (mass / (4 * cells)).ravel()  # the total is 1
    across = s * np.sqrt(1 - u * u)
    body = [across * np.cos(phi), across * np.sin(phi), s * u * (1 - FLATTENING)]
    body = np.stack(body, axis=-1).reshape(-1, 3)
    attraction, torque = np.empty_like(r), np.empty_like(r)
    for number, point in enumerate(r):
        separation = body - point
        pull = mass / np.sum(separation * separation, axis=1) ** 1.5
        attraction[number] = pull @ separation
        torque[number] = np.cross(pull @ body, point)
    return attraction, torque
