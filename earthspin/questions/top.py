"""Motion of the heavy symmetric top."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Annotated

import numpy as np

from earthspin.engine import Neglected, Variables, labels, number, part, public_call, setting, words
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.labelled_numbers import LabelledNumbers
from earthspin.questions.time_axes import TimesFromStart, TimesOfMotion, instants
from earthspin.top.start import HeavyTop
from earthspin.units import Number

if TYPE_CHECKING:
    from earthspin.top.closed_form import HeavyTopMotion

#: Points of the effective potential, ends included.
POTENTIAL_POINTS = 361

#: Keys that define the top and its initial motion.
_START_KEYS = tuple(field.name for field in fields(HeavyTop))

Moment = Annotated[float, Number("kg m2", "2e-4 kg m2")]
Angle = Annotated[float, Number("rad", "30 deg")]
Rate = Annotated[float, Number("rad/s", "200 rad/s")]


class Top(TimesOfMotion, word="top", call="heavy_top", table="top", positional=("times",)):
    """Motion of a heavy symmetric top, by elliptic functions (source text, I.7).

    The label `time` is in seconds.

    Raises
    ------
    EarthspinError
        If the moments are impossible, or an initial value is out of range.

    Examples
    --------
    >>> import earthspin
    >>> top = earthspin.heavy_top(
    ...     [0, 1, 2],
    ...     transverse_moment=1,
    ...     axial_moment=1.2,
    ...     weight_moment=1.5,
    ...     theta="40 deg",
    ...     spin=3,
    ... )
    >>> print(top.pattern.values)
    cusp
    """

    page, headline = "rotors", "theta"

    transverse_moment: Moment = setting(
        doc="I1, about any line through the pivot perpendicular to the axis"
    )
    axial_moment: Moment = setting(doc="I3, about the axis; at most 2 I1 in any body")
    weight_moment: Annotated[float, Number("N m", "0.04 N m")] = setting(
        doc="m g r, weight times the distance from the pivot to the centre of mass"
    )
    theta: Angle = setting(doc="angle from the vertical to the axis at t = 0")
    spin: Rate = setting(doc="omega3, angular velocity along the axis")
    phi_rate: Rate = setting("0 rad/s", doc="rate of phi at t = 0")
    theta_rate: Rate = setting("0 rad/s", doc="rate of theta at t = 0")
    phi: Angle = setting("0 deg", doc="azimuth of the axis about the vertical at t = 0")
    psi: Angle = setting("0 deg", doc="rotation angle of the body about its axis at t = 0")

    def check(self) -> None:
        """Refuse a top whose moments or initial motion are impossible."""
        HeavyTop(**{name: getattr(self, name) for name in _START_KEYS})


@part
def inputs(
    transverse_moment: float,
    axial_moment: float,
    weight_moment: float,
    theta: float,
    spin: float,
    phi_rate: float,
    theta_rate: float,
    phi: float,
    psi: float,
) -> LabelledNumbers:
    """Broadcast the moments and initial values of one or more tops to arrays of one shape."""
    moments = (transverse_moment, axial_moment, weight_moment)
    start = (theta, spin, phi_rate, theta_rate, phi, psi)
    return LabelledNumbers.broadcast(**dict(zip(_START_KEYS, (*moments, *start), strict=True)))


@part
def heavy_top_start(inputs: LabelledNumbers) -> HeavyTop:
    """Build one or more tops with their initial motions; refuse impossible values."""
    return HeavyTop(**inputs.values)


@part(loads=("scipy.special",))
def motion(heavy_top_start: HeavyTop, instants: FloatArray) -> HeavyTopMotion:
    """Compute the Euler angles of the top, the shape of its path, and its turning angles."""
    from earthspin.top.closed_form import heavy_top_motion

    return heavy_top_motion(heavy_top_start, instants)


#: Instants at which the error is computed.
ERROR_POINTS = 64


class TopMotion(TimesFromStart, error="relative_error"):
    """Motion of a top in time: Euler angles, attitude, angular velocity and shape of the path."""

    theta = number("rad", "angle from the vertical to the axis")
    phi = number("rad", "azimuth of the axis about the vertical")
    psi = number("rad", "rotation angle of the body about its axis")
    attitude = number("1", "unit quaternion, body to inertial", along=("time", "quaternion"))
    omega_body = number(
        "rad/s", "angular velocity along the principal axes", along=("time", "component")
    )
    pattern = words("wave, cusp, loop, steady or sleeping", along=())
    stability = words("stable, critical or unstable: the top in the vertical position", along=())
    stability_margin = number(
        "1", "(spin / critical spin)^2 - 1 there; infinite if it cannot fall", along=(),
        no_error="a closed form of the numbers as given, exact to rounding",
    )  # fmt: skip
    nutation_period = number(
        "s",
        "period of the nutation, the oscillation of theta",
        along=(),
        short="period of nutation",
    )
    mean_precession_rate = number("rad/s", "mean rate of phi", along=(), short="mean precession")
    relative_error = number(
        "1",
        "bound on the error of theta relative to itself, of the others relative to their largest "
        "values, from rounding of the initial values and of the closed form",
        along=(),
    )
    quaternion = labels(default=["w", "x", "y", "z"])


@part
def euler_angles(
    motion: HeavyTopMotion, heavy_top_start: HeavyTop, inputs: LabelledNumbers, instants: FloatArray
) -> TopMotion:
    """Return the motion of the top in time: Euler angles, attitude and angular velocity."""
    from earthspin.top.closed_form import error_bound
    from earthspin.top.patterns import stability_margin, stability_of
    from earthspin.top.start import axis_start

    labelled, top = inputs.array, heavy_top_start
    margin = stability_margin(axis_start(top)).reshape(top.shape)
    # the error grows with time: the last instants and some before show it
    sample = instants[np.unique(np.linspace(0, instants.size - 1, ERROR_POINTS).astype(int))]
    return TopMotion(
        theta=labelled(motion.theta, "time"),
        phi=labelled(motion.phi, "time"),
        psi=labelled(motion.psi, "time"),
        attitude=labelled(motion.attitude, "time", "quaternion"),
        omega_body=labelled(motion.omega_body, "time", "component"),
        pattern=labelled(motion.pattern),
        stability=labelled(stability_of(margin)),
        stability_margin=labelled(margin),
        nutation_period=labelled(motion.nutation_period),
        mean_precession_rate=labelled(motion.precession_rate),
        relative_error=labelled(error_bound(heavy_top_start, sample)),
        time=instants,
    )


class Turning(
    Variables,
    along=("turning",),
    no_error="same closed form as the motion, so its relative_error holds",
):
    """Smallest and largest inclination theta of the top's axis, the limits of the nutation."""

    turning_angle = number("rad", "smallest and largest theta")
    turning = labels(default=["upper", "lower"])


@part
def turning(motion: HeavyTopMotion) -> Turning:
    """Return the smallest and largest inclination theta between which the top's axis nutates."""
    return Turning(turning_angle=motion.turning_angle)


class Potential(
    Variables,
    along=("inclination",),
    no_error="two terms of one formula, with rounding errors only",
):
    """Effective potential of a heavy top, as a function of the inclination of its axis."""

    effective_potential = number(
        "rad2 / s2", "effective potential V, where alpha = theta'^2 + V is constant"
    )
    inclination = labels("angle from the vertical", "deg")


@part
def potential(heavy_top_start: HeavyTop) -> Potential:
    """Compute the effective potential of a heavy top as a function of inclination."""
    from earthspin.top.height import effective_potential

    inclination = np.linspace(0.0, np.pi, POTENTIAL_POINTS)[1:-1]
    return Potential(
        effective_potential=effective_potential(heavy_top_start, inclination),
        inclination=np.degrees(inclination),
    )


@part
def neglected() -> Neglected:
    """Report that no effect is neglected, as the problem is a rigid top without friction."""
    return Neglected(what="nothing: the question is about a rigid top without friction")


heavy_top = public_call(
    Top,
    answer=euler_angles,
    sections=(turning, potential, neglected),
    parts=(instants, inputs, heavy_top_start, motion),
    together=_START_KEYS,
    widest=4096,
)
