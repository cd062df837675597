"""Gravity on the surface of a homogeneous, spinning spheroid, from equator to pole."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from earthspin.bodies import EARTH, Body
from earthspin.engine.public_calls import public_call
from earthspin.engine.question import Question, key, part
from earthspin.engine.variables import Neglected, Variables, labels, number
from earthspin.units import FloatArray, Whole


class SurfaceGravity(Question, word="surface-gravity", call="surface_gravity"):
    """Gravity on the surface of a homogeneous, spinning spheroid (I.9).

    Returns
    -------
    Dataset
        Over `latitude` (reduced, deg): `gravity` (m/s2).
    """

    body: Body = key(EARTH, doc="whose mass, figure and spin the spheroid has")
    points: Annotated[int, Whole(low=2)] = key(7, doc="how many latitudes, from equator to pole")


@part
def surface(body: Body, points: int) -> FloatArray:
    """Points on a meridian, m, shape (n, 3)."""
    reduced = np.linspace(0.0, np.pi / 2, points)
    equatorial = body.number("radius")
    polar = equatorial * (1 - body.number("flattening"))
    x, z = equatorial * np.cos(reduced), polar * np.sin(reduced)
    return np.stack([x, np.zeros_like(x), z], axis=-1)


class Gravity(Variables, along=("latitude",)):
    """Gravity by latitude."""

    gravity = number("m/s2", "gravity, attraction and spin together")
    latitude = labels()


@part
def gravity(body: Body, surface: FloatArray) -> Gravity:
    """Attraction less the centrifugal acceleration at each point."""
    from earthspin.mass.spheroid import spheroid_attraction

    figure = body.number("gm"), body.number("radius"), body.number("flattening")
    outward = body.spin_rate**2 * surface * np.array([1.0, 1.0, 0.0])
    felt = np.linalg.norm(spheroid_attraction(*figure, surface) + outward, axis=-1)
    latitude = np.linspace(0.0, 90.0, surface.shape[0])
    return Gravity(gravity=felt, latitude=latitude)


@part
def neglected() -> Neglected:
    """Effect that the uniform density neglects."""
    return Neglected(what="a density that grows inwards")


surface_gravity = public_call(
    SurfaceGravity, answer=gravity, sections=(neglected,), parts=(surface,)
)
