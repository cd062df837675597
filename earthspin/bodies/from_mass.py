"""Constructors of bodies from a mass distribution."""

from __future__ import annotations

from typing import Any, Self

from earthspin.bodies.shapes import of_density, of_layers, of_masses, of_mesh


class FromMass:
    """Constructors of a body from point masses, a density, a mesh or layers.

    Each accepts the body's other fields as `Body.replace` does.
    """

    def __init__(self, **fields: Any) -> None:
        """Accept the fields of a body as keyword arguments; `Body` implements this."""

    def replace(self, **changes: Any) -> Self:
        """Return a copy with some fields changed; `Body` implements this."""
        raise NotImplementedError

    @classmethod
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
        return cls(name=name, **of_masses(masses, positions, radius)).replace(**fields)

    @classmethod
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
        """Make a body from a density that is constant in each cell of a grid; exact for such cells.

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
        return cls(name=name, **of_density(density, (x, y, z), radius)).replace(**fields)

    @classmethod
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
        return cls(name=name, **of_mesh(mesh, unit, density, mass, radius)).replace(**fields)

    @classmethod
    def from_layers(
        cls, layers: Any, *, spin_period: Any, name: str = "layers", **fields: Any
    ) -> Self:
        """Make a body from layers in hydrostatic equilibrium, to first order in its flattening.

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
        return cls(name=name, **of_layers(layers, spin_period)).replace(**fields)
