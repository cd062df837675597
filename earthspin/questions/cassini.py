"""Cassini states: where an axis keeps in step with an orbit that precesses."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import numpy as np

from earthspin.bodies import BODIES, MOON, SUN, Body, in_a_sentence
from earthspin.bodies.limits import refuse_break_up, refuse_fast_axis
from earthspin.bodies.orbit import Orbit, OrbitTable
from earthspin.constants import NORMAL_95
from earthspin.engine.asking import ask
from earthspin.engine.labels import Variable, build, with_error, without_error
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import Question, key, made_of
from earthspin.errors import SceneError, nearest
from earthspin.parts.elements import refuse_overlap, size_and_motion

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.torque.cassini import Precessing


class CassiniStates(
    Question, word="cassini-states", call="cassini_states", positional=("body", "orbit")
):
    """Cassini states of a body: axes that stay in one plane with the orbit's normal and its pole.

    The orbit's node turns evenly on its plane. The spin may be locked to the orbit, like that of
    the Moon (one turn in each) and of Mercury (three in two), or free.

    Returns
    -------
    Dataset
        Over `state` (1 to 4, or 2 and 3, after Peale 1969): `obliquity` to the body's own orbit,
        `tilt`, the angle to the pole that the orbit's normal goes round (deg), each with its error,
        and whether the state is `stable`.

    Raises
    ------
    EarthspinError
        If the body has no figure, or the orbit's node does not turn.

    Examples
    --------
    >>> import earthspin
    >>> print(earthspin.cassini_states("moon").obliquity.round(2).values, "deg")
    [  6.73 175.68] deg
    """

    views, page = "cassini_states", "frames"

    body: Body = key(MOON, doc="body whose axis it is")
    orbit: Annotated[Orbit | None, OrbitTable()] = key(
        None,
        doc="its orbit, with a period of the node; if not given, the body's own, or the mean one "
        "of a moon and of Mercury",
    )

    def check(self) -> None:
        """One body with a figure and a spin, and an orbit."""
        self.body.require(("j2", "dynamical_flattening", "spin_period"))
        if self.body.labelled:
            raise self.error("body", self.body.name, "give single numbers here, no labelled arrays")
        refuse_break_up(self.body)
        if orbit_of(self.body, self.orbit) is None:
            raise self.error(
                "orbit",
                None,
                "give the elements of its orbit, like {period = '27.32 d', i = '5.1 deg', "
                "node_period = '-6793 d'}",
            )


@dataclass(frozen=True)
class Locking:
    """How a spin goes with its orbit.

    Attributes
    ----------
    motion : float
        Mean motion, rad/s, of an orbit outside both bodies.
    turns : float
        Turns in each orbit.
    locked : bool
        Whether that is a multiple of a half.
    """

    motion: float
    turns: float
    locked: bool


def orbit_of(body: Body, orbit: Orbit | None) -> Orbit | None:
    """The orbit that is given, the body's, or the mean one that is known."""
    from earthspin.bodies.mean_orbits import PRECESSING_ORBITS

    return orbit or body.orbit or PRECESSING_ORBITS.get(body.name)


@part
def own_orbit(body: Body, orbit: Orbit | None) -> Orbit:
    """The orbit that is given, the body's, or the mean one that is known."""
    found = orbit_of(body, orbit)
    assert found is not None  # `check` has seen to it
    return found


@part
def locking(body: Body, own_orbit: Orbit) -> Locking:
    """Mean motion, and turns of the body in each orbit."""
    from earthspin.bodies.mean_orbits import PRECESSING_ORBITS
    from earthspin.torque.cassini import is_locked

    about = own_orbit.about or SUN.name
    if about not in BODIES or about == body.name:
        others = [name for name in BODIES if name != body.name]
        raise SceneError("orbit.about", about, nearest(about, others))
    placed = body.replace(orbit=own_orbit)
    a, motion = size_and_motion(placed, BODIES[about])
    known = PRECESSING_ORBITS.get(body.name)
    like = f", like about = '{known.about}'" if known is not None and known.about else ""
    advice = "" if own_orbit.about else f"; name what it orbits{like}"
    refuse_overlap(placed, BODIES[about], a, advice)
    return Locking(motion, body.spin_rate / motion, is_locked(body.spin_rate, motion))


def precessing(body: Body, orbit: Orbit, locking: Locking) -> Precessing:
    """What the kernel needs of a body and its orbit."""
    from earthspin.torque.cassini import Precessing, strengths

    axial, locked = strengths(
        locking.motion,
        body.spin_rate,
        body.number("j2"),
        body.number("triaxiality") / 4,
        body.number("j2") / body.number("dynamical_flattening"),
        orbit.e,
    )
    node = 0.0 if orbit.node_period is None else -2 * math.pi / orbit.node_period
    return Precessing(axial, locked if locking.locked else 0.0, orbit.i, node)


NUMBERED = {"units": "1", "long_name": "number of the state after Peale (1969)"}
STATES = {
    **with_error(
        "obliquity", Variable(("state",), "deg", "angle from the normal of the orbit to the axis")
    ),
    **with_error(
        "tilt", Variable(("state",), "deg", "angle from the pole of the orbit's plane to the axis")
    ),
    **without_error(
        "it is so or not",
        {
            "towards_pole": Variable(
                ("state",), "1", "whether the axis leans from the normal towards that pole"
            ),
            "stable": Variable(("state",), "1", "whether an axis beside it stays"),
        },
    ),
}


@part(gives=STATES)
def states(body: Body, own_orbit: Orbit, locking: Locking) -> xr.Dataset:
    """Every state, its error, and whether it is stable."""
    from earthspin.torque.cassini import cassini_states as solve

    axis = precessing(body, own_orbit, locking)
    # a locked body turns with its orbit: there the torque of each orbit is the same at any rate
    own = 0.0 if locking.locked else 1.5 * abs(axis.axial)
    rate = max(own, abs(axis.node_rate))
    refuse_fast_axis(rate / locking.motion, rate / abs(body.spin_rate))
    found = solve(axis)
    squares = np.zeros_like(found.obliquity)
    for name, share in body.relative_uncertainty.items():
        if name not in ("j2", "dynamical_flattening", "triaxiality"):
            continue
        # as it is, not made to fit: `Body.replace` would move H with J2
        more = {name: body.number(name) * (1 + NORMAL_95 * share)}
        if name == "j2":
            more["dynamical_flattening"] = body.number("dynamical_flattening")
        moved = solve(precessing(body.replace(**more), own_orbit, locking))
        if moved.number.size == found.number.size:
            squares += (moved.obliquity - found.obliquity) ** 2
    error = np.degrees(np.sqrt(squares))
    tilt = np.abs(found.obliquity - own_orbit.i)
    result = build(
        STATES,
        {
            "obliquity": np.abs(found.obliquity),
            "obliquity_error": np.radians(error),
            "tilt": np.minimum(tilt, 2 * np.pi - tilt),
            "tilt_error": np.radians(error),
            "towards_pole": found.obliquity > 0,
            "stable": found.stable,
        },
        coords={"state": ("state", found.number, dict(NUMBERED))},
    )
    result["tilt"].attrs["inclination"] = math.degrees(own_orbit.i)
    if own_orbit.reference:
        result["tilt"].attrs["references"] = own_orbit.reference
    locked = "locked" if locking.locked else "free"
    result["obliquity"].attrs["spin"] = f"{locked}, {locking.turns:.6g} turns in each orbit"
    return result


@part
def neglected(body: Body, own_orbit: Orbit) -> Neglected:
    """Sizes of what averages over spin, orbit and pericentre leave out, where they are known."""
    from earthspin.bodies.mean_orbits import LEFT_OUT_OF_STATES, PRECESSING_ORBITS

    sizes = LEFT_OUT_OF_STATES.get(body.name, {})
    if sizes and body.is_as_named and own_orbit == PRECESSING_ORBITS.get(body.name):
        return Neglected.cited(sizes, "change of the obliquity in the upright state")
    return Neglected(
        what="libration, pulls beside that of the primary, a core that does not follow, and terms "
        f"that turn with the pericentre: not measured for {in_a_sentence(body.name)}"
    )


made_of(
    CassiniStates,
    answer=states,
    sections={"neglected": neglected},
    parts=(own_orbit, locking),
)

cassini_states = ask(CassiniStates)
