"""Attitude of a body at the first date of its rotation, with errors and where it comes from.

The Earth starts with its angle from UT1, the Moon with the librations of DE421, and other bodies
with their pole and prime meridian.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from earthspin.bodies import EARTH, MOON, Body, in_a_sentence, librations
from earthspin.bodies.librations import Libration
from earthspin.constants import ARCSEC, DAY, NORMAL_95
from earthspin.motion import solution
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.effects_and_torques import x_axis_angle, x_axis_longitude
from earthspin.questions.moon_start import moon_at, starts_from_librations
from earthspin.questions.sky import start_error
from earthspin.sky.sources import SourceName
from earthspin.sky.ut1 import earth_rotation

#: First word about an x axis that no longitude can be counted from.
ARBITRARY = "arbitrary"


@dataclass(frozen=True, kw_only=True)
class FirstState:
    """Attitude and angular velocity of a body at the first date, with 95 % half-widths.

    Attributes
    ----------
    attitude : ndarray, shape (4,)
        Quaternion from the body's axes to the ICRF.
    omega : ndarray, shape (3,)
        Angular velocity along the body's axes, rad/s.
    source : str
        Source of the attitude, for a start from UT1 or from librations.
    turn_error : float
        Half-width of the attitude, which stays so in time, rad.
    rotation_error : ndarray, shape (3,)
        Half-width whose effect is integrated: rotation vector along the body's axes, rad.
    spin_error : float
        Relative half-width of the angular velocity, whose effect is integrated.
    libration : Libration or None
        State of the Moon that was used.
    """

    attitude: FloatArray
    omega: FloatArray
    source: str = ""
    turn_error: float = 0.0
    rotation_error: FloatArray = field(default_factory=lambda: np.zeros(3))
    spin_error: float = 0.0
    libration: Libration | None = None

    @property
    def turn_errors(self) -> tuple[float, float, float]:
        """Half-widths by `earthspin.motion.solution.KINDS`: rad, rad/s, and C times rad/s."""
        spin = 0.0 if self.libration is None else float(np.linalg.norm(self.omega))
        return self.turn_error, self.turn_error * spin, self.turn_error * spin


def first_state(
    body: Body,
    day: float,
    attitude: FloatArray | None,
    omega: FloatArray | None,
    ephemeris: str,
    source: SourceName,
) -> FirstState:
    """Attitude and angular velocity on a day from J2000.0 TDB; given ones are exact."""
    spin_rate = float(body.spin_rate)
    uniform = np.array([0.0, 0.0, spin_rate]) if omega is None else omega
    if attitude is not None:
        return FirstState(attitude=attitude, omega=uniform)
    if omega is None and starts_from_librations(body):
        libration = moon_at(day, ephemeris, source)
        if libration is not None:
            return FirstState(
                attitude=libration.attitude,
                omega=libration.omega,
                source=librations.SOURCE.source,
                turn_error=librations.HALF_WIDTH,
                libration=libration,
            )
    pole = body.needed("pole").true(day)
    if turns_as_observed(body):
        angle, turn_error, words = earth_rotation(day)
        return FirstState(
            attitude=solution.upright(pole, angle + x_axis_longitude(body)),
            omega=uniform,
            source=words,
            turn_error=turn_error,
        )
    rotation_error, spin_error = _start_errors(body, day)
    if omega is None:
        uniform[2] += _node_speed(body, day)
    return FirstState(
        attitude=solution.upright(pole, x_axis_angle(body, day, spin_rate)),
        omega=uniform,
        rotation_error=rotation_error,
        spin_error=spin_error if omega is None else 0.0,
    )


def turns_as_observed(body: Body) -> bool:
    """Return True for the Earth with its own spin, whose angle about the axis follows from UT1."""
    return body.needed("pole").of_the_iau and body.spin_period == EARTH.spin_period


def _start_errors(body: Body, day: float) -> tuple[FloatArray, float]:
    """95 % half-widths of the first attitude, as a rotation vector in the body, and of the spin.

    The angle about the axis is uncertain by that of the prime meridian at J2000.0 and by that of
    the spin period since then.

    Returns
    -------
    rotation : ndarray, shape (3,)
        rad.
    spin : float
        Relative half-width.
    """
    if body.needed("pole").of_the_iau:
        return np.zeros(3), 0.0
    spin = NORMAL_95 * body.relative_uncertainty.get("spin_period", 0.0)
    meridian = NORMAL_95 * (body.prime_meridian_uncertainty or 0.0)
    meridian += spin * abs(float(body.spin_rate) * day * DAY)
    return np.array([start_error(body) or 0.0, 0.0, min(meridian, np.pi)]), spin


def _node_speed(body: Body, day: float) -> float:
    """Speed along the equator of its node, from which W is counted, without nutation, rad/s."""
    if body.prime_meridian is None:
        return 0.0
    pole = body.needed("pole").without_nutation()
    before, now, after = (pole.true(day + shift) for shift in (-1.0, 0.0, 1.0))
    x, y, z = now
    dx, dy, _ = (after - before) / (2 * DAY)
    return float(z * (x * dy - y * dx) / (x * x + y * y))


# --- notes ----------------------------------------------------------------------------------------


def start_note(body: Body, first: FirstState) -> dict[str, str]:
    """Attribute of a result which states where the attitude at the first date comes from."""
    half = first.turn_error / ARCSEC
    if first.libration is not None:
        return {"start": f"librations of {first.source}, within {half:.2g} arcsec (95 %)"}
    if first.source:
        words = (
            f"pole of the IAU and {first.source}, within {half:.2g} arcsec about the axis (95 %)"
        )
        return {"start": words}
    if body.needed("pole").of_the_iau:
        return {}
    if body.prime_meridian is None:
        meridian = "its first angle about the axis is arbitrary"
    elif body.prime_meridian_uncertainty is None:
        meridian = "that of its prime meridian is not known"
    else:
        angle = np.degrees(NORMAL_95 * body.prime_meridian_uncertainty)
        meridian = f"that of its prime meridian is {angle:.2g} deg"
    name, pole = in_a_sentence(body.name), start_error(body)
    size = "is not known" if pole is None else f"is {pole / ARCSEC:.2g} arcsec (95 % half-width)"
    return {
        "start": f"the uncertainty of the pole of {name} at J2000.0 {size}, {meridian}; the errors "
        "contain those that are known"
    }


def x_axis_note(body: Body, start_attitude: FloatArray | None) -> str:
    """Text that states where the x axis of the body points."""
    if start_attitude is not None:
        return "as in start_attitude"
    if body.prime_meridian is None and not body.needed("pole").of_the_iau:
        return f"{ARBITRARY}: the prime meridian of {in_a_sentence(body.name)} is not known"
    if not body.number("triaxiality"):
        return "prime meridian"
    if body.known_as == MOON.name:
        return "principal axis of least moment; the mean-Earth axes of maps differ by 103.85 arcsec"
    longitude = np.degrees(x_axis_longitude(body))
    return f"principal axis of least moment, at {longitude:.2f} deg of east longitude"
