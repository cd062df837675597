"""Exact gravity field of a homogeneous spheroid at given points."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from earthspin.bodies import EARTH, Body, all_of, proper
from earthspin.engine import Neglected, Question, key, part, public_call, setting
from earthspin.engine.variables import Variables, labels, number
from earthspin.mass.figure import eccentricity_squared
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.labelled_numbers import LabelledNumbers
from earthspin.units import Number, Numbers


class Spheroid(
    Question, word="spheroid", call="spheroid_field", table="spheroid", positional=("position",)
):
    """Exact field of a homogeneous spheroid with a body's mass and figure (source text, I.9).

    Its `gm`, `radius` and `flattening` are used; the flattening may be negative (prolate) or zero
    (sphere).

    Raises
    ------
    EarthspinError
        If the body has no figure, or a position is not finite.

    Examples
    --------
    >>> import earthspin
    >>> field = earthspin.spheroid_field(["7000 km", "0 km", "0 km"])
    >>> print(field.attraction.sel(component="x").round(3).values, "m/s2")
    [-8.148] m/s2
    """

    page, headline = "rotors", "potential"

    body: Body = key(EARTH, doc="body that gives mass and figure of the spheroid")
    position: Annotated[FloatArray, Numbers("m", "7000 km", (None, 3))] = setting(
        doc="coordinates from the centre, z along the axis"
    )
    point_mass: Annotated[float, Number("kg", "1 kg", low=0.0, high=1e60)] = setting(
        "1 kg", doc="mass at each point; its torque on the body is computed"
    )

    def check(self) -> None:
        """Refuse a body without mass, radius or flattening."""
        if not all_of(self.body.gm > 0):
            raise self.error("body", self.body.name, "the mass of a body that spins is not zero")
        self.body.require(("radius", "flattening"))


_VECTOR = ("point", "component")
_FRAME = "principal axes of the spheroid, z along its axis"


class Field(Variables, along=_VECTOR, error="relative_error"):
    """Potential, attraction and torque of a spheroid at given points, with their relative error."""

    position = number(
        "m", "coordinates of the point from the centre", no_error="as it was given", frame=_FRAME
    )
    potential = number(
        "J/kg",
        "gravitational potential",
        along=("point",),
        comment="of a homogeneous spheroid with the mass, radius and flattening of the body",
    )
    attraction = number("m/s2", "acceleration of gravity", frame=_FRAME)
    torque = number("N m", "torque of the point mass on the spheroid", frame=_FRAME)
    relative_error = number(
        "1",
        "bound on the errors of potential, attraction and torque relative to their sizes",
        along=("point",),
    )
    component = labels(default=["x", "y", "z"])


@part(loads=("scipy.special",))
def field(body: Body, position: FloatArray, point_mass: float) -> Field:
    """Compute potential, attraction and torque of a homogeneous spheroid at given points."""
    from earthspin.mass import spheroid

    fields = {name: getattr(body, name) for name in ("gm", "radius", "flattening")}
    numbers = LabelledNumbers.broadcast(**fields, mass=point_mass)
    gm, radius, flattening, mass = numbers.columns(*fields, "mass")
    figure = gm, radius, flattening
    error = spheroid.error_bound(flattening, position / radius[..., np.newaxis])
    return Field(
        position=position,
        potential=numbers.array(spheroid.spheroid_potential(*figure, position), "point"),
        attraction=numbers.array(spheroid.spheroid_attraction(*figure, position), *_VECTOR),
        torque=numbers.array(spheroid.spheroid_torque(*figure, mass, position), *_VECTOR),
        relative_error=numbers.array(error, "point"),
    )


@part
def neglected(body: Body, position: FloatArray) -> Neglected:
    """Neglected effect of non-uniform density: change of the potential if J2 has its true value."""
    if body.labelled or body.j2 is None:
        lacking = f"this {proper(body.name)} has no single J2 to compare with"
        return Neglected(what=f"a density that grows inwards: {lacking}")
    # inside the body the field of its J2 is another
    nearest = max(float(np.min(np.linalg.norm(position, axis=-1))), body.number("radius"))
    # (C - A)/(M a2) of an even density is a fifth of e2
    excess = float(eccentricity_squared(body.number("flattening"))) / 5 - body.number("j2")
    size = body.number("gm") / nearest * (body.number("radius") / nearest) ** 2 * abs(excess)
    what = "largest change of the potential by the body's own J2, at the nearest point"
    return Neglected({"density that grows inwards": size}, "J/kg", what, body.reference)


spheroid_field = public_call(
    Spheroid, answer=field, sections=(neglected,), together=("body", "point_mass"), widest=16384
)
