"""Figure (J2, H, ...) of a body from moments, point masses, a density grid, a mesh or layers."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

from earthspin import errors
from earthspin.bodies.checks import all_of
from earthspin.bodies.kinds import Layers
from earthspin.constants import Constant, G
from earthspin.errors import BodyError, SeriesError, Where, checked, nearest
from earthspin.interior.equilibrium import equilibrium, figure
from earthspin.numerics.arrays import FloatArray, Numeric
from earthspin.units import in_order, is_masked, quantity

if TYPE_CHECKING:
    from earthspin.mass.shape import Shape

# --- J2, H and triaxiality from moments of inertia ------------------------------------------------


def flattening_of(j2: Constant, moment: Constant) -> Constant:
    """Dynamical flattening H = J2/(C/(M R2)), with its propagated uncertainty."""
    h = j2.value / moment.value
    # The source of Venus's J2 gives none; that of its moment, 7 %, is far larger.
    u = math.hypot(*(n.relative_uncertainty for n in (j2, moment) if n.uncertainty is not None))
    source = f"J2 over C/(M R2): {j2.source}; {moment.source}"
    return Constant(h, "", h * u, source, f"{j2.read_in}; {moment.read_in}")


def moments_of(j2: float, h: float, triaxiality: float) -> FloatArray:
    """Principal moments of inertia from J2, H and triaxiality, divided by M a2, shape (3,).

    The order is A <= B <= C, with C about the spin axis.

    Parameters
    ----------
    j2, h, triaxiality : float
        J2 = (C - (A + B)/2)/(M a2); H = (C - (A + B)/2)/C, not zero; (B - A)/(M a2).
    """
    polar = j2 / h
    equatorial, half = polar - j2, triaxiality / 2
    return np.array([equatorial - half, equatorial + half, polar])


def figure_of(
    name: str, moments: tuple[Numeric, Numeric, Numeric], scale: Numeric
) -> dict[str, Numeric]:
    """J2, H and triaxiality from three principal moments of inertia, as a dict by field of `Body`.

    Parameters
    ----------
    name : str
        Name of the body, for messages.
    moments : three floats or labelled arrays
        Principal moments, kg m2, the polar one last.
    scale : float or labelled array
        M a2, kg m2.

    Raises
    ------
    BodyError
        If no body can have such moments.
    """
    try:
        small, middle, polar = moments
    except (TypeError, ValueError):
        raise BodyError(name, "moments", moments, "give three, the polar one last") from None
    if not all_of((small > 0) & (middle > 0) & (polar > 0)):
        raise BodyError(name, "moments", moments, "each moment must be greater than zero")
    if not all_of(abs(small - middle) <= polar):
        raise BodyError(name, "moments", moments, "no moment may exceed the sum of the other two")
    difference = polar - (small + middle) / 2
    return {
        "j2": difference / scale,
        "dynamical_flattening": difference / polar,
        "triaxiality": abs(middle - small) / scale,
    }


# --- bodies from their mass distribution ----------------------------------------------------------


def _numbers_of(shape: Shape) -> dict[str, Any]:
    """GM, radius, J2 to J4, H and triaxiality of a `Shape`, as a dict by field of `Body`."""
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


def _single(value: Any, unit: str, name: str, example: str) -> float:
    """Convert one nonzero number to SI units; refuse zero and arrays."""
    number = quantity(value, unit, Where(name), example)
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
    where = Where("vertices")
    return scale * quantity(in_order(mesh[0], where), "", where, "0.5"), np.asarray(mesh[1])


def _read(file: Path) -> Any:
    """Read a mesh from a file and merge coincident vertices, which some formats repeat."""
    try:
        import trimesh
    except ImportError:
        raise errors.MissingExtraError("trimesh", "mesh", "a mesh from a file") from None
    kind = file.suffix.lstrip(".").lower()
    formats = sorted(trimesh.exchange.load.mesh_formats())
    if kind not in formats:
        raise SeriesError(file, f"'.{kind}' is not a mesh format", nearest(kind, formats))
    if problem := errors.no_plain_file(file) or (not file.exists() and "there is no such file"):
        raise SeriesError(file, problem)
    try:
        mesh = trimesh.load_mesh(file, process=True)
    except Exception as error:  # readers raise errors of many types
        raise SeriesError(file, f"it cannot be read: {errors.one_line(error)}") from None
    if not np.size(getattr(mesh, "vertices", ())):
        raise SeriesError(file, "it contains no mesh")
    return mesh


class FromMass:
    """Constructors of a body from point masses, a density, a mesh or layers.

    Each accepts the body's other fields as `Body.replace` does.
    """

    def __init__(self, **fields: Any) -> None:
        """Make a body from its fields as keyword arguments; the class `Body` implements this."""

    def replace(self, **changes: Any) -> Self:
        """Return a copy of the body with some fields changed; the class `Body` implements this."""
        raise NotImplementedError

    @classmethod
    @checked
    def from_masses(
        cls,
        masses: Any,
        positions: Any,
        *,
        name: str = "point masses",
        radius: Any = None,
        **fields: Any,
    ) -> Self:
        """Make a body from point masses; it spins about its axis of greatest inertia.

        Parameters
        ----------
        masses : array_like or Quantity, shape (k,)
            kg.
        positions : array_like or Quantity, shape (k, 3)
            m, along any axes.
        name : str
        radius : float, str or Quantity, optional
            Reference radius of J2, J3 and J4. Default: the distance of the farthest mass from the
            centre of mass.
        **fields
            More fields of `Body`, such as ``spin_period="5 h"``, as `replace` takes them.

        Raises
        ------
        BodyError, UndefinedError
            If a mass is not positive, the shapes do not match, or all masses are at one point.

        Examples
        --------
        >>> import earthspin
        >>> dumbbell = earthspin.Body.from_masses([1e12, 1e12], [[-500, 0, 0], [500, 0, 0]])
        >>> print(dumbbell.moments.round(3))
        [0.e+00 5.e+17 5.e+17]
        """
        from earthspin.mass.shape import Shape

        where = Where("positions")
        shape = Shape.of_masses(
            quantity(masses, "kg", Where("masses"), "1e12 kg"),
            quantity(in_order(positions, where), "m", where, "500 m"),
            _optional(radius, "m", "radius", "1 km"),
        )
        return cls(name=name, **_numbers_of(shape)).replace(**fields)

    @classmethod
    @checked
    def from_density(
        cls,
        density: Any,
        x: Any,
        y: Any,
        z: Any,
        *,
        name: str = "grid",
        radius: Any = None,
        **fields: Any,
    ) -> Self:
        """Make a body from a density on a grid, constant in each cell; the moments are then exact.

        Parameters
        ----------
        density : array_like or Quantity, shape (nx, ny, nz)
            kg m-3; zero in empty cells.
        x, y, z : array_like or Quantity
            Edges of the cells in increasing order, one more than there are cells, m.
        name, radius, **fields
            As for `from_masses`; the default radius is that of the farthest corner of a cell.

        Raises
        ------
        BodyError, UndefinedError
            If a density is negative, all are zero, or the edges do not increase or match the cells.

        Examples
        --------
        >>> import earthspin
        >>> brick = earthspin.Body.from_density([[[2000.0]]], [0, 3], [0, 2], [0, 1])
        >>> print(brick.moments.round(6))
        [ 5000. 10000. 13000.]
        """
        from earthspin.mass.shape import Shape

        x, y, z = (
            quantity(edge, "m", Where(axis), "1 km")
            for axis, edge in zip("xyz", (x, y, z), strict=True)
        )
        rho = quantity(density, "kg/m3", Where("density"), "2000 kg/m3")
        shape = Shape.of_density(rho, x, y, z, _optional(radius, "m", "radius", "1 km"))
        return cls(name=name, **_numbers_of(shape)).replace(**fields)

    @classmethod
    @checked
    def from_mesh(
        cls,
        mesh: Any,
        *,
        density: Any = None,
        mass: Any = None,
        unit: str = "m",
        name: str = "mesh",
        radius: Any = None,
        **fields: Any,
    ) -> Self:
        """Make a homogeneous body from a closed mesh of triangles; exact for flat faces.

        Parameters
        ----------
        mesh : path, Trimesh, or (vertices, faces)
            Mesh, or a file in a format that trimesh reads, such as OBJ, PLY, STL, OFF. The corners
            of each triangle are counter-clockwise as seen from outside.
        density, mass : float, str or Quantity
            Exactly one of the two.
        unit : str
            Unit of the vertices; most file formats do not store it.
        name, radius, **fields
            As for `from_masses`.

        Raises
        ------
        BodyError
            If the mesh is open or inside out, or not exactly one of density and mass is given.
        SeriesError
            If the file cannot be read.
        MissingExtraError
            If a file is given and the extra `mesh` is not installed.

        Examples
        --------
        >>> import earthspin
        >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
        >>> rock = earthspin.Body.from_mesh((corners, faces), density="3 g/cm3", unit="km")
        >>> print(f"{rock.mass:.6e} kg")
        5.000000e+11 kg
        """
        from earthspin.mass.shape import Shape

        shape = Shape.of_mesh(
            *_mesh(mesh, unit),
            density=_optional(density, "kg/m3", "density", "2000 kg/m3"),
            mass=_optional(mass, "kg", "mass", "1e12 kg"),
            radius=_optional(radius, "m", "radius", "1 km"),
        )
        return cls(name=name, **_numbers_of(shape)).replace(**fields)

    @classmethod
    @checked
    def from_layers(
        cls, layers: Any, *, spin_period: Any, name: str = "layers", **fields: Any
    ) -> Self:
        """Make a body in hydrostatic equilibrium from layers, to first order in the flattening.

        The layers are also stored as the body's `interior`.

        Parameters
        ----------
        layers : LayeredBody, str or mapping
            Layers, the name of an interior with layers, such as ``"prem"``, or a table of layers or
            samples.
        spin_period : float, str or Quantity
            Rotation period, which determines the flattening.
        name, **fields
            As for `from_masses`.

        Raises
        ------
        SceneError
            If there is no such interior, it has no layers, or the table is invalid.

        Examples
        --------
        >>> import earthspin
        >>> slow = earthspin.Body.from_layers("prem", spin_period="48 h")
        >>> print(f"1/{1 / slow.flattening:.0f}")
        1/1206
        """
        layers = Layers().read(layers, Where("layers"))
        spin = 2 * math.pi / _single(spin_period, "s", "spin_period", "23.93 h")
        gm, mean, k = G.value * layers.mass, layers.radius, equilibrium(layers).k
        ellipticity = figure(layers, spin).e
        # the surface is an equipotential: f = (k + 1) q/2
        pull = spin**2 * mean**3 / gm
        flattening = (k + 1) * pull / 2
        equatorial = mean * (1 + flattening / 3)
        body = cls(
            name=name,
            gm=gm,
            radius=equatorial,
            j2=k * pull / 3 * (mean / equatorial) ** 2,
            dynamical_flattening=ellipticity / (1 + ellipticity),
            flattening=flattening,
            spin_period=2 * math.pi / spin,
            interior=layers,
            reference=f"hydrostatic equilibrium of {layers.reference}",
        )
        return body.replace(**fields)
