"""Open the kernel and find in it the bodies of the scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from earthspin.errors import SceneError
from earthspin.scene.part import Part

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from earthspin.scene.spec import Scene
    from earthspin.sky.ephemeris import Ephemeris


@dataclass(frozen=True)
class Sky:
    """An open kernel, and the codes by which it knows the bodies of a scene.

    Attributes
    ----------
    ephemeris : Ephemeris
    centre : int
        NAIF code of the body that spins.
    targets : dict of str to int
        NAIF code of each perturber.
    span : tuple of float
        First and last day that may be used, from J2000.0 TDB: the scene's span, or all that
        the kernel covers.
    radius : float
        Of the body that spins, m; the largest, where it is an array.
    """

    ephemeris: Ephemeris
    centre: int
    targets: dict[str, int]
    span: tuple[float, float]
    radius: float = 0.0

    def positions(
        self, days: NDArray[np.float64], targets: Mapping[str, int] | None = None
    ) -> dict[str, NDArray[np.float64]]:
        """Positions seen from the body, m, shape (n, 3) each, at days from J2000.0 TDB.

        Parameters
        ----------
        days : ndarray, shape (n,)
        targets : mapping of str to int, optional
            NAIF codes; the perturbers by default.

        Raises
        ------
        UndefinedError
            If one comes into the body: torques on the bulge hold outside alone.
        """
        import numpy as np

        from earthspin.errors import UndefinedError

        targets = self.targets if targets is None else targets
        found = self.ephemeris.positions(targets, self.centre, days)
        for name, place in found.items():
            squares = np.einsum("ti,ti->t", place, place)
            nearest = float(np.sqrt(np.min(squares, initial=np.inf)))
            if nearest <= self.radius:
                raise UndefinedError(
                    f"'{name}' comes to {nearest:.4g} m from the centre of a body with a radius "
                    f"of {self.radius:.4g} m; a torque on the bulge holds outside it alone"
                )
        return found


def open_sky(scene: Scene, given: Mapping[str, Any]) -> Sky:
    """Open the scene's kernel; refuse it if it lacks a body or does not cover the span."""
    from earthspin.sky.ephemeris import open_ephemeris
    from earthspin.units import span_days

    ephemeris = open_ephemeris(scene.ephemeris)
    centre = ephemeris.code(scene.body.naif, scene.body.name)
    targets = {p.name: ephemeris.code(p.naif, p.name) for p in scene.perturbers}
    for name, code in targets.items():
        if code == centre:
            raise SceneError(
                "perturbers", name, "a body does not pull on itself", source=scene.source
            )
    codes = {*targets.values(), centre}
    span = ephemeris.coverage(codes)
    if scene.span is not None:
        asked = span_days(scene.span, scene.source)
        ephemeris.check_times(asked, codes)
        span = float(asked[0]), float(asked[1])
    radius = scene.body.radius
    return Sky(ephemeris, centre, targets, span, 0.0 if radius is None else _largest(radius))


def _largest(radius: Any) -> float:
    """A float, or the largest of an array."""
    return float(radius.max() if hasattr(radius, "max") else radius)


EPHEMERIS = Part(
    name="ephemeris",
    does="open the kernel; check that it holds the bodies and covers the span",
    function="earthspin.scene.parts.kernel:open_sky",
    keys=("ephemeris", "body", "perturbers", "span"),
)
