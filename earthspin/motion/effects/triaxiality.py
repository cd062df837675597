"""Inequality of the equatorial moments A and B, which causes semidiurnal motion of the axes."""

from __future__ import annotations

from dataclasses import replace

from earthspin.motion.effects.effect import Effect, Numbers
from earthspin.motion.forces import Forces


def _switch_on(forces: Forces, body: Numbers) -> Forces:
    figure = forces.figure
    over_c = figure.inverse_polar_moment * body.number("triaxiality")
    return replace(forces, figure=replace(figure, triaxiality=over_c))


TRIAXIALITY = Effect("triaxiality", _switch_on, coefficient="triaxiality")
