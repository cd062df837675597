"""Attitude and spin of the Moon at any date, from its last tabulated state before that date."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from earthspin.bodies import MOON, Body, librations, planets
from earthspin.bodies.librations import Libration
from earthspin.constants import DAY
from earthspin.errors import EarthspinError
from earthspin.motion import solution
from earthspin.motion.attitude_effects import ATTITUDE_EFFECTS
from earthspin.motion.effects import RIGID
from earthspin.motion.forces import Forces
from earthspin.numerics import rotations
from earthspin.progress import up_to
from earthspin.questions.effects_and_torques import attractors, forces_of
from earthspin.questions.sky import places, sky
from earthspin.sky.sources import SourceName

#: Tolerance of the integrator up to the first date; after five years, the attitude and that of the
#: next year differ by 2e-8 arcsec from those with 1e-13.
_TOLERANCE = 1e-9


def starts_from_librations(body: Body) -> bool:
    """Return True for the Moon with its own figure and spin."""
    return body.known_as == MOON.name and body.is_as_named


@lru_cache(maxsize=64)
def moon_at(day: float, ephemeris: str, source: SourceName) -> Libration | None:
    """State of the Moon on a day from J2000.0 TDB; None outside the table or the kernel.

    It is that of the Moon itself under all known effects, also if a question uses other numbers or
    fewer effects.
    """
    row = librations.last_before(day)
    if row is None or row.day == day:
        return row
    effects, perturbers = (*RIGID, *ATTITUDE_EFFECTS), planets.default_perturbers(MOON)
    try:
        opened = sky(ephemeris, places(MOON, perturbers), source)
        masses = attractors(opened, MOON, perturbers, effects)
        opened.check_times((row.day, day), masses.targets)
        forces = with_core(forces_of(masses, effects), row)
    except EarthspinError:
        return None
    epoch, seconds = row.day * DAY, (day - row.day) * DAY
    body, _ = solution.rigid_bodies(forces, float(MOON.spin_rate), {}, epoch)
    pulls = solution.masses(forces, epoch)
    start = solution.start_of(body, row.attitude, row.omega, pulls)
    integrator = solution.AttitudeIntegrator(body, pulls, start, seconds, tolerance=_TOLERANCE)
    with up_to("librations of the Moon up to the first date", day - row.day) as report:
        series = integrator.at(np.array([seconds]), lambda reached: report(reached / DAY))
    assert body.core is not None
    attitude = series.attitude[0]
    momentum = (body.unit * series.core[0])[:, np.newaxis]
    in_body = rotations.rotated(rotations.conjugate(attitude[:, np.newaxis]), momentum)
    core = rotations.rotated(attitude[:, np.newaxis], in_body / body.core.moments)
    return Libration(day, attitude, series.omega[0], core[:, 0])


def with_core(forces: Forces, state: Libration | None) -> Forces:
    """Set the first angular velocity of a fluid core from a state of the Moon."""
    if state is None or forces.core is None:
        return forces
    return replace(forces, core=replace(forces.core, spin=state.core))
