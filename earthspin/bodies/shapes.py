"""Compute the fields of a body from point masses, a density on a grid, a mesh or layers."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies.layered import Layers
from earthspin.constants import G
from earthspin.errors import (
    BodyError,
    MissingExtraError,
    SeriesError,
    Where,
    nearest,
    no_plain_file,
    one_line,
)
from earthspin.interior.equilibrium import equilibrium, figure
from earthspin.interior.layers import LayeredBody
from earthspin.numerics.arrays import FloatArray
from earthspin.units import is_masked, quantity

if TYPE_CHECKING:
    from earthspin.mass.shape import Shape

#: Numbers of a body by field, SI.
Fields = dict[str, Any]


def of_masses(masses: Any, positions: Any, radius: Any) -> Fields:
    """Compute mass and figure of a body that consists of point masses (kg) at positions (m)."""
    from earthspin.mass.shape import Shape

    return _of(
        Shape.of_masses(
            _si(masses, "kg", "masses", "1e12 kg"),
            _si(positions, "m", "positions", "500 m"),
            _optional(radius, "m", "radius", "1 km"),
        )
    )


def of_density(density: Any, edges: tuple[Any, Any, Any], radius: Any) -> Fields:
    """Compute mass and figure of a body from densities (kg m-3) of grid cells with edges (m)."""
    from earthspin.mass.shape import Shape

    x, y, z = (_si(edge, "m", axis, "1 km") for axis, edge in zip("xyz", edges, strict=True))
    rho = _si(density, "kg/m3", "density", "2000 kg/m3")
    return _of(Shape.of_density(rho, x, y, z, _optional(radius, "m", "radius", "1 km")))


def of_mesh(mesh: Any, unit: str, density: Any, mass: Any, radius: Any) -> Fields:
    """Compute mass and figure of a homogeneous body bounded by triangles in the given unit."""
    from earthspin.mass.shape import Shape

    return _of(
        Shape.of_mesh(
            *_mesh(mesh, unit),
            density=_optional(density, "kg/m3", "density", "2000 kg/m3"),
            mass=_optional(mass, "kg", "mass", "1e12 kg"),
            radius=_optional(radius, "m", "radius", "1 km"),
        )
    )


def _of(shape: Shape) -> Fields:
    return {
        "gm": G.value * shape.mass,
        "radius": shape.radius,
        "j2": shape.j2,
        "dynamical_flattening": shape.dynamical_flattening,
        "triaxiality": shape.triaxiality,
        "j3": shape.j3,
        "j4": shape.j4,
        "reference": "from where its mass lies",
    }


def _si(value: Any, unit: str, name: str, example: str) -> Any:
    """Convert plain numbers, Quantities, or text with units to numbers in SI units."""
    return quantity(value, unit, Where(name), example)


def _single(value: Any, unit: str, name: str, example: str) -> float:
    """Convert one nonzero number to SI units; refuse zero and arrays."""
    number = _si(value, unit, name, example)
    if not isinstance(number, float) or number == 0:
        raise Where(name).error(value, f"give one number other than zero, like '{example}'")
    return number


def _optional(value: Any, unit: str, name: str, example: str) -> float | None:
    """Convert one nonzero number to SI; return None unchanged."""
    return None if value is None else _single(value, unit, name, example)


def _mesh(mesh: Any, unit: str) -> tuple[FloatArray, NDArray[np.int64]]:
    """Return vertices (m) and faces of a mesh from a file, a Trimesh, or a pair of arrays.

    Raises
    ------
    SeriesError
        If the file cannot be read, or contains no mesh.
    BodyError
        If `mesh` has another type.
    MissingExtraError
        If trimesh, which reads files, is not installed.
    """
    if not isinstance(unit, str):
        raise Where("unit").error(unit, "give a unit of length, like 'km'")
    scale = float(quantity(f"1 {unit}", "m", Where("unit"), "1 km"))
    if isinstance(mesh, (str, os.PathLike)):
        mesh = _read(Path(mesh))
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        mesh = mesh.vertices, mesh.faces
    if not isinstance(mesh, tuple) or len(mesh) != 2:
        raise BodyError("mesh", "mesh", mesh, "give a file, a Trimesh, or (vertices, faces)")
    if is_masked(mesh[1]):
        raise BodyError("mesh", "faces", "a masked value", "give numbers that are all known")
    return scale * quantity(mesh[0], "", Where("vertices"), "0.5"), np.asarray(mesh[1])


def _read(file: Path) -> Any:
    """Read a mesh from a file and merge coincident vertices, which some formats repeat."""
    try:
        import trimesh
    except ImportError:
        raise MissingExtraError("trimesh", "mesh", "a mesh from a file") from None
    kind = file.suffix.lstrip(".").lower()
    formats = sorted(trimesh.exchange.load.mesh_formats())
    if kind not in formats:
        raise SeriesError(file, f"'.{kind}' is not a mesh format", nearest(kind, formats))
    if problem := no_plain_file(file) or (not file.exists() and "there is no such file"):
        raise SeriesError(file, problem)
    try:
        mesh = trimesh.load_mesh(file, process=True)
    except Exception as error:  # readers raise errors of many types
        raise SeriesError(file, f"it cannot be read: {one_line(error)}") from None
    if not np.size(getattr(mesh, "vertices", ())):
        raise SeriesError(file, "it contains no mesh")
    return mesh


def of_layers(layers: LayeredBody | str | Mapping[str, Any], spin_period: Any) -> Fields:
    """Compute mass and figure of layers in hydrostatic equilibrium, to first order in flattening.

    Parameters
    ----------
    layers : LayeredBody, str or mapping
        Layers, the name of an interior with layers, or a table of layers or samples.
    spin_period : float, str or Quantity
        Rotation period, s.

    Raises
    ------
    SceneError
        If there is no such interior, or it has no layers.
    """
    layers = Layers().read(layers, Where("layers"))
    spin = 2 * math.pi / _single(spin_period, "s", "spin_period", "23.93 h")
    gm, mean, k = G.value * layers.mass, layers.radius, equilibrium(layers).k
    ellipticity = figure(layers, spin).e
    # the surface is an equipotential: f = (k + 1) q/2
    pull = spin**2 * mean**3 / gm
    flattening = (k + 1) * pull / 2
    radius = mean * (1 + flattening / 3)
    return {
        "gm": gm,
        "radius": radius,
        "j2": k * pull / 3 * (mean / radius) ** 2,
        "dynamical_flattening": ellipticity / (1 + ellipticity),
        "flattening": flattening,
        "spin_period": 2 * math.pi / spin,
        "interior": layers,
        "reference": f"hydrostatic equilibrium of {layers.reference}",
    }
