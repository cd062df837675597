"""Motion of a body without torque, and Poinsot's construction."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from earthspin._lazy import xr
from earthspin.engine import Neglected, Question, part, public_call, setting
from earthspin.engine.variables import labels, number, variable_of
from earthspin.errors import Where
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.time_axes import TimesFromStart, TimesOfMotion, instants
from earthspin.rotor.euler import KEYS, axis_stability
from earthspin.units import Numbers, Plain, quantity


@dataclass(frozen=True)
class RotorMoments:
    """Kind of input: three principal moments of inertia, or A, B - A and C - A, in kg m2.

    Attributes
    ----------
    numbers : tuple of float
        A, B, C, or A, B - A, C - A, kg m2.
    differences : bool
        Which of the two.
    """

    numbers: tuple[float, float, float]
    differences: bool = False

    words = 'three values like "8.01e37 kg m2", or a table of "A", "B-A" and "C-A"'
    hint = "Values | Mapping[str, Value]"
    unit, example = "kg m2", "8.01e37 kg m2"

    @classmethod
    def read(cls, value: object, where: Where) -> RotorMoments:
        """Check principal moments of inertia, given as three moments or by "A", "B-A" and "C-A"."""
        if isinstance(value, RotorMoments):
            return value
        table = isinstance(value, Mapping)
        if isinstance(value, Mapping):
            if set(value) != set(KEYS):
                raise where.error(sorted(map(str, value)), f"the keys are {', '.join(KEYS)}")
            values = [quantity(value[name], "kg m2", where.at(name), "8e37 kg m2") for name in KEYS]
        else:
            values = list(Numbers("kg m2", "8.01e37 kg m2", (3,)).read(value, where))
        first, second, third = (float(value) for value in values)
        return cls((first, second, third), table)

    def write(self) -> Plain:
        """Text stored in scene (input) files: the moments of inertia with their unit."""
        texts = [f"{number!r} kg m2" for number in self.numbers]
        return dict(zip(KEYS, texts, strict=True)) if self.differences else texts

    @property
    def values(self) -> list[float] | dict[str, float]:
        """Return the three moments of inertia as a list, or A, B - A and C - A as a mapping."""
        numbers = list(self.numbers)
        return dict(zip(KEYS, numbers, strict=True)) if self.differences else numbers

    def of_many(self, starts: int) -> FloatArray | dict[str, FloatArray]:
        """Return the moments of inertia as arrays that broadcast with arrays of initial states.

        The argument `starts` is the number of these axes, one for each axis of initial states.
        """
        many = np.broadcast_arrays(*(np.asarray(number) for number in self.numbers))
        columns = [moment.reshape(moment.shape + (1,) * starts) for moment in many]
        if self.differences:
            return dict(zip(KEYS, columns, strict=True))
        return np.stack(columns, axis=-1)


class StartOfRotor(Question):
    """Moments and initial rotation of a free rotor, the keys before the times of its motion."""

    moments: RotorMoments = setting(
        doc="principal moments about the x, y, z axes of the body, in any order of size"
    )
    omega: Annotated[FloatArray, Numbers("rad/s", "1 rad/s", (None, 3), optional_row=True)] = (
        setting(doc="angular velocity along the principal axes at t = 0; one start or many")
    )


class FreeRotor(
    TimesOfMotion,
    StartOfRotor,
    word="free-rotor",
    call="free_rotor",
    table="rotor",
    positional=("moments", "omega", "times"),
):
    """Motion of a rigid body without torque, in closed form (source text, I.4 to I.6).

    The label `time` is in seconds. The inertial axes are those of the body at t = 0.

    Raises
    ------
    EarthspinError
        If the moments are impossible, the angular momentum is zero, or a number is not finite.

    Examples
    --------
    >>> import earthspin
    >>> racket = earthspin.free_rotor([1, 2, 2.8], [0.01, 1, 0], [0, 10, 20])
    >>> print(racket.omega_body.sel(component="y").round(2).values)
    [ 1.    0.53 -1.  ]
    """

    page, headline = "rotors", "attitude"


_SERIES = ("time", "component")


class RotorMotion(TimesFromStart, along=_SERIES, error="relative_error"):
    """Angular velocity, angular momentum, attitude and energy of a free body in time."""

    omega_body = number("rad/s", "angular velocity along the principal axes")
    angular_momentum_body = number("kg m2 / s", "angular momentum along the principal axes")
    omega_inertial = number(
        "rad/s", "angular velocity along inertial axes, those of the body at t = 0"
    )
    attitude = number("1", "unit quaternion, body to inertial", along=("time", "quaternion"))
    energy = number("J", "kinetic energy of rotation", along=("time",), short="kinetic energy")
    relative_error = number(
        "1",
        "bound on the error of each quantity relative to its largest value, for exact inputs; it "
        "grows with time beyond 1e15 rad",
        along=(),
    )
    quaternion = labels(default=["w", "x", "y", "z"])


@part(loads=("scipy.special",))
def free_rotation(moments: RotorMoments, omega: FloatArray, instants: FloatArray) -> RotorMotion:
    """Compute angular velocity, angular momentum, attitude and energy of a free rotor in time."""
    from earthspin.rotor import triaxial

    many = {dim for number in (omega, *moments.numbers) for dim in getattr(number, "dims", ())[:1]}
    starts = ("start",) * (np.ndim(omega) - 1 - hasattr(omega, "dims"))
    values = moments.of_many(len(starts)) if many else moments.values
    motion = triaxial.free_rotation(values, np.asarray(omega), instants)

    def lay(values: FloatArray, *dims: str) -> xr.DataArray:
        return xr.DataArray(variable_of((*many, *starts, "time", *dims), values))

    return RotorMotion(
        omega_body=lay(motion.omega_body, "component"),
        angular_momentum_body=lay(motion.angular_momentum_body, "component"),
        omega_inertial=lay(motion.omega_inertial, "component"),
        attitude=lay(motion.attitude, "quaternion"),
        energy=lay(motion.energy),
        # one bound for all starts
        relative_error=xr.DataArray(motion.error.max(-1) if starts else motion.error, dims=[*many]),
        time=motion.times,
    )


def several_starts(omega: FloatArray) -> str | None:
    """Return the reason (text) to omit Poinsot's construction for several motions, else None."""
    return None if omega.ndim == 1 else "there are several starts"


class Poinsot(
    TimesFromStart,
    along=("component",),
    no_error="same closed form as the rotation, so its relative_error holds",
):
    """Ellipsoids, polhode and herpolhode of Poinsot's construction, for one free body."""

    inertia_ellipsoid = number("rad/s", "semi-axes of the inertia ellipsoid")
    momentum_ellipsoid = number("rad/s", "semi-axes of the ellipsoid of constant angular momentum")
    polhode = number(
        "rad/s", "path of the angular velocity in the body", along=("polhode_point", "component")
    )
    polhode_period = number("s", "period of the polhode", along=(), short="period of the polhode")
    invariable_plane_distance = number(
        "rad/s",
        "distance of the invariable plane from the centre, 2T/L",
        along=(),
        short="distance of the invariable plane",
    )
    herpolhode = number(
        "rad/s", "path of the angular velocity in the invariable plane", along=("time", "in_plane")
    )
    herpolhode_radius = number("rad/s", "radii of the bounds of the herpolhode", along=("bound",))
    growth_rate = number("1/s", "growth rate of a small tilt away from each axis; 0 if stable")
    #: Only where the polhode has a period: not on the separatrix, nor where omega stands still.
    herpolhode_advance = number(
        "rad", "advance of the herpolhode in one period of the polhode", along=(), default=None
    )
    in_plane = labels(default=["x", "y"])
    bound = labels(default=["inner", "outer"])


@part(unless=several_starts)
def poinsot(moments: RotorMoments, omega: FloatArray, instants: FloatArray) -> Poinsot:
    """Compute ellipsoids, polhode and herpolhode of Poinsot's construction for a free rotor."""
    from earthspin.rotor import poinsot as construction

    motion = moments.values, omega.tolist()
    path = construction.polhode(*motion)
    is_periodic = bool(np.isfinite(path.period))
    speed = sum(w * w for w in omega.tolist()) ** 0.5
    return Poinsot(
        inertia_ellipsoid=construction.inertia_ellipsoid(*motion),
        momentum_ellipsoid=construction.momentum_ellipsoid(*motion),
        polhode=path.omega,
        polhode_period=path.period,
        invariable_plane_distance=construction.invariable_plane_distance(*motion),
        herpolhode=construction.herpolhode(*motion, instants),
        herpolhode_radius=construction.herpolhode_radii(*motion),
        growth_rate=axis_stability(moments.values, speed).growth_rate,
        herpolhode_advance=construction.herpolhode_advance(*motion) if is_periodic else None,
        time=instants,
    )


@part
def neglected() -> Neglected:
    """Report that no effect is neglected, as the problem is a rigid body without torque."""
    return Neglected(what="nothing: the question is about a rigid body without torque")


free_rotor = public_call(
    FreeRotor,
    answer=free_rotation,
    sections=(poinsot, neglected),
    parts=(instants,),
    together=("moments", "omega"),
    widest=4096,
)
