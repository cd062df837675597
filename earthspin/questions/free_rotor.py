"""Motion of a body without torque, and Poinsot's picture of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import numpy as np

from earthspin.choosing.promises import Report
from earthspin.engine.asking import ask
from earthspin.engine.labels import Variable, build, covered_by, without_error
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import Question, key, made_of, setting
from earthspin.errors import Where
from earthspin.parts.reasons import no_accuracy
from earthspin.parts.times import FROM_START, Seconds, instants
from earthspin.units import Duration, FloatArray, Numbers, Plain, Relative, Whole, quantity

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Moments:
    """Principal moments as they were given, so that no digits are lost.

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
    def read(cls, given: object, where: Where) -> Moments:
        """Read three moments, or one and two differences."""
        from earthspin.rotor.moments import KEYS

        if isinstance(given, Moments):
            return given
        table = isinstance(given, Mapping)
        if isinstance(given, Mapping):
            if set(given) != set(KEYS):
                raise where.error(sorted(map(str, given)), f"the keys are {', '.join(KEYS)}")
            values = [quantity(given[name], "kg m2", where.at(name), "8e37 kg m2") for name in KEYS]
        else:
            values = list(Numbers("kg m2", "8.01e37 kg m2", (3,)).read(given, where))
        first, second, third = (float(value) for value in values)
        return cls((first, second, third), table)

    def write(self) -> Plain:
        """Give what was read."""
        from earthspin.rotor.moments import KEYS

        texts = [f"{number!r} kg m2" for number in self.numbers]
        return dict(zip(KEYS, texts, strict=True)) if self.differences else texts

    @property
    def given(self) -> list[float] | dict[str, float]:
        """As the physics takes them."""
        from earthspin.rotor.moments import KEYS

        numbers = list(self.numbers)
        return dict(zip(KEYS, numbers, strict=True)) if self.differences else numbers

    def of_many(self, starts: int) -> FloatArray | dict[str, FloatArray]:
        """Of many bodies, as the physics takes them, with axes of length 1 for their starts."""
        from earthspin.rotor.moments import KEYS

        many = np.broadcast_arrays(*(np.asarray(number) for number in self.numbers))
        laid = [one.reshape(one.shape + (1,) * starts) for one in many]
        if self.differences:
            return dict(zip(KEYS, laid, strict=True))
        return np.stack(laid, axis=-1)


class FreeRotor(
    Question,
    word="free-rotor",
    call="free_rotor",
    table="rotor",
    positional=("moments", "omega", "times"),
):
    """Motion of a body without torque, in closed form (I.4 to I.6).

    Returns
    -------
    Dataset
        Over `time` (s): `omega_body`, `angular_momentum_body`, `omega_inertial` (along
        `component`), `attitude` (unit quaternion along `quaternion`, body to inertial; the
        inertial axes are those of the body at t = 0), `energy`. For one start
        `earthspin.run_tree` adds Poinsot's ellipsoids, polhode and herpolhode.

    Raises
    ------
    EarthspinError
        For moments that no body has, a start without angular momentum, or numbers that are
        not finite.

    Examples
    --------
    >>> import earthspin
    >>> racket = earthspin.free_rotor([1, 2, 2.8], [0.01, 1, 0], [0, 10, 20])
    >>> print(racket.omega_body.sel(component="y").round(2).values)
    [ 1.    0.53 -1.  ]
    """

    views, page = "free_rotor", "rotors"

    exclusive = (("times",), ("duration", "points"))

    moments: Moments = setting(
        doc="principal moments about the x, y, z axes of the body, in any order of size"
    )
    omega: Annotated[FloatArray, Numbers("rad/s", "1 rad/s", (None, 3), optional_row=True)] = (
        setting(doc="angular velocity along the principal axes at t = 0; one start or many")
    )
    times: Seconds | None = setting(None, doc="times from the start")
    duration: Duration = setting("20 s", doc="last time, if times are not given")
    points: Annotated[int, Whole()] = setting(401, doc="number of evenly spaced times")
    accuracy: Relative | None = key(None, doc="largest relative error that is allowed")


_SERIES = ("time", "component")
ROTATION = covered_by(
    "relative_error",
    {
        "omega_body": Variable(_SERIES, "rad/s", "angular velocity along the principal axes"),
        "angular_momentum_body": Variable(
            _SERIES, "kg m2 / s", "angular momentum along the principal axes"
        ),
        "omega_inertial": Variable(
            _SERIES, "rad/s", "angular velocity along inertial axes, those of the body at t = 0"
        ),
        "attitude": Variable(("time", "quaternion"), "1", "unit quaternion, body to inertial"),
        "energy": Variable(("time",), "J", "kinetic energy of rotation"),
        "relative_error": Variable(
            (),
            "1",
            "95 % half-width of each quantity relative to its largest value, for exact inputs",
        ),
    },
)


@part(gives=ROTATION)
def free_rotation(moments: Moments, omega: FloatArray, instants: FloatArray) -> xr.Dataset:
    """Angular velocity, attitude and energy of a free rotor, in closed form."""
    import xarray as xr

    from earthspin.rotor.triaxial import CLOSED_FORM_ERROR
    from earthspin.rotor.triaxial import free_rotation as rotate

    many = {dim for of in (omega, *moments.numbers) for dim in getattr(of, "dims", ())[:1]}
    starts = ("start",) * (np.ndim(omega) - 1 - hasattr(omega, "dims"))
    given = moments.of_many(len(starts)) if many else moments.given
    motion = rotate(given, np.asarray(omega), instants)

    def laid(values: FloatArray, *dims: str) -> xr.DataArray:
        return xr.DataArray(values, dims=(*many, *starts, "time", *dims))

    return build(
        ROTATION,
        {
            "omega_body": laid(motion.omega_body, "component"),
            "angular_momentum_body": laid(motion.angular_momentum_body, "component"),
            "omega_inertial": laid(motion.omega_inertial, "component"),
            "attitude": laid(motion.attitude, "quaternion"),
            "energy": laid(motion.energy),
            "relative_error": CLOSED_FORM_ERROR,
        },
        coords={
            "time": ("time", motion.times, FROM_START),
            "component": ["x", "y", "z"],
            "quaternion": ["w", "x", "y", "z"],
        },
    )


def several_starts(omega: FloatArray) -> str | None:
    """Leave Poinsot's picture out where there are several starts."""
    return None if omega.ndim == 1 else "there are several starts"


POINSOT = without_error(
    "same closed form as the rotation, so its relative_error holds",
    {
        "inertia_ellipsoid": Variable(
            ("component",), "rad/s", "semi-axes of the inertia ellipsoid"
        ),
        "momentum_ellipsoid": Variable(
            ("component",), "rad/s", "semi-axes of the ellipsoid of constant angular momentum"
        ),
        "polhode": Variable(
            ("polhode_point", "component"), "rad/s", "path of the angular velocity in the body"
        ),
        "polhode_period": Variable((), "s", "period of the polhode"),
        "invariable_plane_distance": Variable(
            (), "rad/s", "distance of the invariable plane from the centre, 2T/L"
        ),
        "herpolhode": Variable(
            ("time", "in_plane"), "rad/s", "path of the angular velocity in the invariable plane"
        ),
        "herpolhode_radius": Variable(
            ("bound",), "rad/s", "radii between which the herpolhode runs"
        ),
        "growth_rate": Variable(
            ("component",), "1/s", "growth rate of a small tilt away from each axis; 0 if stable"
        ),
    },
)
#: Given where the polhode has a period: not on the separatrix, nor where omega stands still.
ADVANCE = {
    "herpolhode_advance": Variable(
        (),
        "rad",
        "advance of the herpolhode in one period of the polhode",
        no_error="same closed form as the rotation, so its relative_error holds",
    )
}


@part(gives=POINSOT, unless=several_starts)
def poinsot(moments: Moments, omega: FloatArray, instants: FloatArray) -> xr.Dataset:
    """Ellipsoids, polhode and herpolhode of a free rotor."""
    from earthspin.rotor import poinsot as p
    from earthspin.rotor.euler import axis_stability

    given, start = moments.given, omega.tolist()
    path = p.polhode(given, start)
    stability = axis_stability(given, sum(w * w for w in start) ** 0.5)
    returns = {}
    if bool(np.isfinite(path.period)):
        returns["herpolhode_advance"] = p.herpolhode_advance(given, start)
    return build(
        POINSOT | (ADVANCE if returns else {}),
        {
            "inertia_ellipsoid": p.inertia_ellipsoid(given, start),
            "momentum_ellipsoid": p.momentum_ellipsoid(given, start),
            "polhode": path.omega,
            "polhode_period": path.period,
            "invariable_plane_distance": p.invariable_plane_distance(given, start),
            "herpolhode": p.herpolhode(given, start, instants),
            "herpolhode_radius": p.herpolhode_radii(given, start),
            **returns,
            "growth_rate": stability.growth_rate,
        },
        coords={
            "time": ("time", instants, FROM_START),
            "component": ["x", "y", "z"],
            "in_plane": ["x", "y"],
            "bound": ["inner", "outer"],
        },
    )


class RotationAccuracy(Report, units="1", error_of="relative, of angular velocity and attitude"):
    """Accuracy of the rotation: asked, estimated, and the method."""


@part(unless=no_accuracy)
def rotation_accuracy(free_rotation: xr.Dataset, accuracy: float | None) -> RotationAccuracy:
    """Accuracy of the rotation: asked, estimated, and the method."""
    size, bound = free_rotation.attitude.size // 4, float(free_rotation.relative_error)
    return RotationAccuracy.closed_form(accuracy, bound, "Jacobi's closed form", size)


@part
def neglected() -> Neglected:
    """What a rigid body without torque leaves out."""
    return Neglected(what="nothing: the question is about a rigid body without torque")


made_of(
    FreeRotor,
    answer=(free_rotation, rotation_accuracy),
    sections={"poinsot": poinsot, "neglected": neglected},
    parts=(instants,),
    together=("moments", "omega"),
    widest=4096,
)

free_rotor = ask(FreeRotor)
