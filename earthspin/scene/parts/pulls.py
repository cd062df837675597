"""Everything that turns the axis of a scene's body, made ready for the solver."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from earthspin.scene.part import Part

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from earthspin.bodies import Body
    from earthspin.motion.forces import Forces
    from earthspin.scene.parts.kernel import Sky
    from earthspin.scene.spec import Scene


@dataclass(frozen=True)
class Pulls:
    """Masses and places of all that may pull, and the limits of the kernel.

    Attributes
    ----------
    sky : Sky
    gm : dict of str to float
        m3 s-2; the scene's perturbers first, planets behind them.
    targets : dict of str to int
        NAIF codes.
    near : tuple of str
        The scene's perturbers.
    limits : tuple of float
        s from J2000.0 TDB between which all of them can be placed.
    """

    sky: Sky
    gm: dict[str, float]
    targets: dict[str, int]
    near: tuple[str, ...]
    limits: tuple[float, float]
    _seen: dict[Any, Any] = field(default_factory=dict, repr=False)

    def positions(self, names: Sequence[str], times: NDArray[np.float64], keep: bool) -> Any:
        """Places of some of them at times in s; kept for runs that ask for the same again."""
        from earthspin.constants import DAY

        key = (float(times[0]), float(times[-1]), times.size)
        known = self._seen.setdefault(key, {}) if keep else {}
        missing = {name: self.targets[name] for name in names if name not in known}
        if missing:
            known |= self.sky.positions(times / DAY, missing)
        return known


def find_pulls(scene: Scene, given: Mapping[str, Any]) -> Pulls:
    """Look up the perturbers, and the planets if they are switched on."""
    from earthspin.bodies import BODIES, PLANETS
    from earthspin.constants import DAY

    sky = given["ephemeris"]
    masses = {p.name: _number(p, "gm") for p in scene.perturbers}
    targets = dict(sky.targets)
    if "planets" in (scene.effects or ()):
        for name in PLANETS:
            if name not in masses and name != scene.body.name:
                masses[name] = float(BODIES[name].gm)
                targets[name] = sky.ephemeris.code(BODIES[name].naif, name)
    start, end = sky.ephemeris.coverage({*targets.values(), sky.centre})
    return Pulls(sky, masses, targets, tuple(sky.targets), (start * DAY, end * DAY))


def forces_of(scene: Scene, pulls: Pulls, effects: Sequence[str], keep: bool = False) -> Forces:
    """Forces with some effects switched on and no other evaluated."""
    from earthspin.constants import DAY
    from earthspin.mass.inertia import inverse_polar_moment
    from earthspin.motion.forces import Figure, Forces
    from earthspin.sky.equator import mean_pole

    body = scene.body
    h, j2 = _number(body, "dynamical_flattening"), _number(body, "j2")
    zonal = {n: _number(body, f"j{n}") for n in (3, 4) if f"j{n}" in effects}
    per_c = inverse_polar_moment(j2, h)
    figure = Figure(
        h=h,
        spin_rate=2 * math.pi / _number(body, "spin_period"),
        inverse_polar_moment=per_c,
        radius=_number(body, "radius"),
        zonal={n: value for n, value in zonal.items() if value},
        j2_trend=_number(body, "j2_rate") / j2 if "j2-rate" in effects and j2 else 0.0,
        triaxiality=per_c * _number(body, "triaxiality") if "triaxiality" in effects else 0.0,
        meridian=float(body.meridian),
    )
    names = tuple(pulls.gm) if "planets" in effects else pulls.near
    pole = body.needed("pole")
    return Forces(
        figure=figure,
        gm={name: pulls.gm[name] for name in names},
        positions=lambda times: pulls.positions(names, times, keep),
        near=pulls.near,
        primary="sun" if "geodesic" in effects and "sun" in names else None,
        mean_pole=None if "second-order" in effects else lambda times: mean_pole(pole, times / DAY),
    )


def start_of(scene: Scene, pulls: Pulls) -> tuple[NDArray[np.float64], float]:
    """Figure axis to start with, and when (s): J2000.0, or as near as the kernel reaches."""
    from earthspin.constants import DAY
    from earthspin.sky.equator import pole_at

    epoch = min(max(0.0, pulls.limits[0]), pulls.limits[1])
    return pole_at(scene.body.needed("pole"), epoch / DAY), epoch


def _number(body: Body, name: str) -> float:
    """A field as one float: the motion of many bodies at once is not computed."""
    from earthspin.errors import BodyError

    value = body.needed(name)
    try:
        return float(value)
    except (TypeError, ValueError):
        raise BodyError(
            body.name, name, "an array", "the path of the pole takes one body at a time"
        ) from None


PULLS = Part(
    name="pulls",
    does="masses and places of the perturbers, and of the planets if switched on",
    function="earthspin.scene.parts.pulls:find_pulls",
    needs=("ephemeris",),
    keys=("body", "perturbers", "effects", "ephemeris", "span"),
)
