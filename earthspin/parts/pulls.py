"""Everything that turns the axis of a body, made ready for the solver."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import BODIES, PLANETS, Body
from earthspin.constants import DAY
from earthspin.engine.part import part
from earthspin.engine.question import key
from earthspin.parts.sky import Sky
from earthspin.parts.times import Series

if TYPE_CHECKING:
    from earthspin.motion.forces import Forces

#: What moves the axis beside the pull of the perturbers on the bulge.
Effect = Literal[
    "planets", "j3", "j4", "triaxiality", "geodesic", "j2-rate", "second-order", "nonrigid"
]
NONRIGID = "nonrigid"
ALL_BUT_NONRIGID = (
    "planets", "j3", "j4", "triaxiality", "geodesic", "j2-rate", "second-order",
)  # fmt: skip


class Moved(Series):
    """Keys of every question about axes that move under torques."""

    effects: tuple[Effect, ...] = key(ALL_BUT_NONRIGID, doc="effects beside the main one")


@dataclass(frozen=True)
class Pulls:
    """Masses and places of all that may pull, and the limits of the kernel.

    Attributes
    ----------
    sky : Sky
    gm : dict of str to float
        m3 s-2; the question's perturbers first, planets behind them.
    targets : dict of str to int
        NAIF codes.
    near : tuple of str
        The question's perturbers.
    limits : tuple of float
        s from J2000.0 TDB between which all of them can be placed.
    """

    sky: Sky
    gm: dict[str, float]
    targets: dict[str, int]
    near: tuple[str, ...]
    limits: tuple[float, float]
    _seen: dict[tuple[float, float, int], dict[str, NDArray[np.float64]]] = field(
        default_factory=dict, repr=False
    )

    def positions(
        self, names: Sequence[str], times: NDArray[np.float64], keep: bool
    ) -> dict[str, NDArray[np.float64]]:
        """Places of some of them at times in s; kept for runs that ask for the same again."""
        at = (float(times[0]), float(times[-1]), times.size)
        known = self._seen.setdefault(at, {}) if keep else {}
        missing = {name: self.targets[name] for name in names if name not in known}
        if missing:
            known |= self.sky.positions(times / DAY, missing)
        return known


@part
def pulls(sky: Sky, body: Body, perturbers: tuple[Body, ...], effects: tuple[str, ...]) -> Pulls:
    """Masses and places of the perturbers, and of the planets if switched on."""
    masses = {p.name: p.number("gm") for p in perturbers}
    targets = dict(sky.targets)
    if "planets" in effects:
        for name in PLANETS:
            if name not in masses and name != body.name:
                masses[name] = float(BODIES[name].gm)
                targets[name] = sky.ephemeris.code(BODIES[name].naif, name)
    start, end = sky.ephemeris.coverage({*targets.values(), sky.centre})
    return Pulls(sky, masses, targets, tuple(sky.targets), (start * DAY, end * DAY))


def forces_of(body: Body, pulls: Pulls, effects: Sequence[str], keep: bool = False) -> Forces:
    """Forces with some effects switched on and no other evaluated."""
    from earthspin.mass.inertia import inverse_polar_moment
    from earthspin.motion.forces import Figure, Forces

    h, j2 = body.number("dynamical_flattening"), body.number("j2")
    zonal = {n: body.number(f"j{n}") for n in (3, 4) if f"j{n}" in effects}
    per_c = inverse_polar_moment(j2, h)
    figure = Figure(
        h=h,
        spin_rate=2 * math.pi / body.number("spin_period"),
        inverse_polar_moment=per_c,
        radius=body.number("radius"),
        zonal={n: value for n, value in zonal.items() if value},
        j2_trend=body.number("j2_rate") / j2 if "j2-rate" in effects and j2 else 0.0,
        triaxiality=per_c * body.number("triaxiality") if "triaxiality" in effects else 0.0,
        meridian=body.number("meridian"),
    )
    names = tuple(pulls.gm) if "planets" in effects else pulls.near
    pole = body.needed("pole")
    return Forces(
        figure=figure,
        gm={name: pulls.gm[name] for name in names},
        positions=lambda times: pulls.positions(names, times, keep),
        near=pulls.near,
        primary="sun" if "geodesic" in effects and "sun" in names else None,
        mean_pole=None if "second-order" in effects else lambda times: pole.mean(times / DAY),
    )


def start_of(body: Body, pulls: Pulls) -> tuple[NDArray[np.float64], float]:
    """Figure axis to start with, and when (s): J2000.0, or as near as the kernel reaches."""
    epoch = min(max(0.0, pulls.limits[0]), pulls.limits[1])
    return body.needed("pole").true(epoch / DAY), epoch
