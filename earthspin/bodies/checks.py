"""Check that the properties of a body are valid, consistent and physically possible."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any, ClassVar, Self

import numpy as np

from earthspin.constants import SPEED_OF_LIGHT, G
from earthspin.errors import BodyError, UndefinedError, Where, nearest
from earthspin.numerics.arrays import Numeric
from earthspin.units import Plain

# --- element-wise tests of numbers and labelled arrays --------------------------------------------


#: Names of numbers, each with a condition on it and the text of the message.
Rules = tuple[tuple[str, Callable[[Any], Any], str], ...]

#: Largest relative difference between two values that count as the same body's.
SAME_BODY = 0.01


def all_of(condition: Any) -> bool:
    """Return True if a bool is true, or if all elements of a boolean array are true."""
    return bool(condition.all()) if hasattr(condition, "all") else bool(condition)


def is_finite(value: Numeric) -> Numeric:
    """Test element-wise whether a real number is neither infinite nor NaN."""
    return (value == value) & (abs(value) != math.inf)


def are_close(value: Numeric | None, other: Numeric | None) -> Numeric:
    """Test element-wise if two values agree within `SAME_BODY` (relative), or if both are None."""
    if value is None or other is None:
        return value is other
    return abs(value - other) <= SAME_BODY * abs(other)


def is_close(value: Numeric | None, other: Numeric | None) -> bool:
    """Test whether all elements of two values agree to within the tolerance `SAME_BODY`."""
    return all_of(are_close(value, other))


def is_same(value: object, other: object) -> bool:
    """Test whether two values are identical, including the coordinate labels of arrays."""
    if hasattr(value, "identical"):
        return type(value) is type(other) and bool(value.identical(other))
    if isinstance(value, tuple) and isinstance(other, tuple):
        return len(value) == len(other) and all(map(is_same, value, other))
    return not hasattr(other, "identical") and value == other


class Record:
    """Base class of records whose numbers may be labelled arrays."""

    words: ClassVar[str]
    #: Converters of the fields.
    KINDS: ClassVar[dict[str, Any]]
    #: Fields that must be given.
    REQUIRED: ClassVar[tuple[str, ...]] = ()
    #: Conditions on single numbers, with the text of the message.
    RULES: ClassVar[Rules] = ()
    #: Values that are not written to scene files.
    UNWRITTEN: ClassVar[tuple[Any, ...]] = (None, "")

    @classmethod
    def read(cls, value: object, where: Where) -> Self:
        """Read a record, or a table of its numbers.

        Raises
        ------
        SceneError, UnitsError
            If a key is unknown or missing, or a number is impossible.
        """
        return value if isinstance(value, cls) else cls(**cls.checked(value, where, whole=True))

    @classmethod
    def checked(cls, table: object, where: Where, *, whole: bool = False) -> dict[str, Any]:
        """Convert the numbers of a table to SI units, and refuse impossible ones.

        With `whole`, the required fields must be among them.

        Raises
        ------
        SceneError, UnitsError
            Names the field.
        """
        if not isinstance(table, Mapping):
            raise where.error(table, f"give {cls.words}")
        where.refuse_unknown(table, cls.KINDS)
        for name in cls.REQUIRED if whole else ():
            if name not in table:
                raise where.at(name).error(None, f"give {cls.words}")
        read = {}
        for name, value in table.items():
            if value is not None or getattr(cls, name, 0) is not None:  # None is no default
                read[name] = cls.KINDS[name].read(value, where.at(name))
            if isinstance(read.get(name), np.ndarray):
                problem = "give one number, or a DataArray with named dimensions"
                raise where.at(name).error(value, problem)
        for name, holds, allowed in cls.RULES:
            if name in read and not all_of(holds(read[name])):
                raise where.at(name).error(table[name], allowed)
        return read

    def write(self) -> Plain:
        """Return a table of all numbers that are set, for scene files."""
        values = {name: getattr(self, name) for name in self.KINDS}
        return {
            name: self.KINDS[name].write(value)
            for name, value in values.items()
            if not any(is_same(value, nothing) for nothing in self.UNWRITTEN)
        }

    def __eq__(self, other: object) -> bool:
        """Return True if all fields are identical, including the labels of arrays."""
        if type(self) is not type(other):
            return NotImplemented
        return all(is_same(value, vars(other)[name]) for name, value in vars(self).items())

    def __hash__(self) -> int:
        return hash(type(self))


# --- checks of a new body -------------------------------------------------------------------------
# Fields are passed by name; an impossible value is refused with the name of its field.

#: Values of a body by field.
Fields = Mapping[str, Any]

#: Plausibility bounds: above the mass and the age of the observable universe, m3 s-2 and s.
LARGEST_GM, LONGEST_DAY = 1e60, 1e30

#: Usual mean densities, from loose planets to small stars, kg m-3.
USUAL_DENSITIES = 30.0, 1e5
#: Densities that no body has: above those of white dwarfs and below those of neutron stars; and
#: below 1, but for giant stars, whose GM is larger than `LEAST_STAR`, m3 s-2.
NO_STAR, LEAST_STAR = (1e11, 1e16), 1e18
#: Largest GM of a star, of 500 solar masses, m3 s-2. Black holes are larger, and of any density.
LARGEST_STAR = 6.6e22

#: Bound on the mean moment of a nearly round body: that of a hollow sphere, and 1 %; and bound on
#: the J2 and the triaxiality of such a body.
HOLLOW_SPHERE, NEARLY_ROUND = 1.01 * 2 / 3, 0.05

_THIN_DISC = "C cannot exceed A + B, so H = (C - A)/C is at most 0.5 (the thin disc)"
#: Conditions on single numbers, in the order of the checks, with the text of the message.
RULES_OF_BODIES: Rules = (
    ("gm", lambda gm: gm >= 0, "a mass must be zero or more"),
    ("gm", lambda gm: gm <= LARGEST_GM, f"give at most {LARGEST_GM:g} m3 s-2"),
    ("cycle", lambda t: t > 0, "a cycle must be greater than zero"),
    ("orbital_period", lambda t: t > 0, "a period must be greater than zero"),
    ("radius", lambda a: a > 0, "a radius must be greater than zero"),
    ("spin_period", lambda p: p != 0, "a period must not be zero"),
    ("spin_period", lambda p: abs(p) <= LONGEST_DAY, f"give at most {LONGEST_DAY:g} s"),
    ("flattening", lambda f: f < 1, "a flattening must be less than 1"),
    ("dynamical_flattening", lambda h: h <= 0.5, _THIN_DISC),
    ("triaxiality", lambda t: t >= 0, "(B - A)/(M a2) must be zero or more"),
    ("pole_uncertainty", lambda u: u >= 0, "an uncertainty must be zero or more"),
    ("prime_meridian_uncertainty", lambda u: u >= 0, "an uncertainty must be zero or more"),
    ("core_moment", lambda m: (m >= 0) & (m < 0.9), "C of the core over C is 0 to less than 0.9"),
    ("slow_swing", lambda swing: swing >= 0, "a variation must be zero or more"),
)


def check_numbers(body: Fields, numbers: Iterable[str]) -> None:
    """Raise an error if a number is out of range, or J2, H and triaxiality contradict each other.

    Parameters
    ----------
    body : mapping
    numbers : iterable of str
        Fields that are numbers.

    Raises
    ------
    BodyError
        If no body can have these numbers.
    """
    name = body["name"]
    gm, radius = body["gm"], body["radius"]
    if radius is not None:
        with_size = gm * radius * radius
        if not all_of(is_finite(with_size) & ((with_size > 0) | (gm == 0))):
            raise BodyError(name, "radius", radius, "M a2 is out of a float's range")
        _check_density(name, gm, radius)
        for satellite in body["satellites"]:
            if not all_of(radius < satellite.a):
                allowed = "its orbit lies inside the body; if this is in km, write the unit"
                raise BodyError(name, f"satellites.{satellite.name}.a", satellite.a, allowed)
    for field, u in body["relative_uncertainty"].items():
        if field not in numbers:
            raise BodyError(name, "relative_uncertainty", field, nearest(field, numbers))
        if not 0 <= u < math.inf:
            entry = f"relative_uncertainty[{field!r}]"
            raise BodyError(name, entry, u, "it must be finite, and zero or more")
    j2, h = body["j2"], body["dynamical_flattening"]
    if j2 is not None and h is not None:
        _check_polar_moment(name, j2, h, body["triaxiality"])


def _check_density(name: str, gm: Numeric, radius: Numeric) -> None:
    """Refuse an impossible mean density that indicates a radius or GM in km units instead of SI."""
    density = gm / (4 / 3 * math.pi * G.value) / radius / radius / radius
    not_dense = (density <= NO_STAR[0]) | (density >= NO_STAR[1]) | (gm >= LARGEST_STAR)
    not_thin = (density >= 1) | (gm >= LEAST_STAR)
    for field, value, unit, right, factor in (
        ("radius", radius, "km", not_dense, 1e-9),
        ("gm", gm, "km3/s2", not_thin, 1e9),
    ):
        meant = density * factor
        if not all_of(right | (meant <= USUAL_DENSITIES[0]) | (meant >= USUAL_DENSITIES[1])):
            allowed = f"no body has this density; if it is in {unit}, write this unit behind it"
            raise BodyError(name, field, value, allowed)


def _check_polar_moment(name: str, j2: Numeric, h: Numeric, triaxiality: Numeric) -> None:
    """Check that J2 and H give C/(M a2) between 0 and 1, and that B - A does not exceed C.

    With H = 0 the polar moment does not follow from J2 and is not checked.
    """
    if not all_of((j2 * h > 0) | (h == 0)):
        allowed = f"it must have the sign of dynamical_flattening = {h!r}, and must not be 0"
        raise BodyError(name, "j2", j2, allowed)
    if not all_of((abs(j2) <= abs(h)) | (h == 0)):
        allowed = f"C = (j2/H) M a2 cannot exceed M a2, so j2 is at most H = {h!r}"
        raise BodyError(name, "j2", j2, allowed)
    if not all_of((triaxiality * abs(h) <= abs(j2)) | (h == 0)):
        raise BodyError(name, "triaxiality", triaxiality, "B - A cannot exceed C")
    # (A + B + C)/3 = 2/3 M <r2>, and no mass of a nearly round body is far outside its radius
    solid = abs(j2) - 2 / 3 * j2 * abs(h) <= HOLLOW_SPHERE * abs(h)
    if not all_of(solid | (abs(j2) >= NEARLY_ROUND) | (triaxiality >= NEARLY_ROUND) | (h == 0)):
        allowed = "C = (j2/H) M a2 exceeds 2/3 M a2 of a hollow sphere; increase H or reduce j2"
        raise BodyError(name, "dynamical_flattening", h, allowed)


def check_labels(name: str, numbers: Fields) -> None:
    """Check that arrays that share a dimension have the same length and labels along it."""
    by_dimension: dict[str, tuple[str, Any]] = {}
    for field, array in numbers.items():
        for dim in getattr(array, "dims", ()):
            other_field, other_array = by_dimension.setdefault(dim, (field, array))
            same = other_array.sizes[dim] == array.sizes[dim] and (
                not (dim in other_array.coords and dim in array.coords)
                or all_of(other_array.coords[dim].values == array.coords[dim].values)
            )
            if not same:
                differ = f"they differ from those of {other_field}"
                raise BodyError(name, field, f"labels along '{dim}'", differ)
        for label in getattr(array, "coords", ()):
            kind = array.coords[label].dtype.kind
            text = kind == "O" and all(
                isinstance(element, str) for element in array.coords[label].values.ravel()
            )
            if kind not in "fiubUM" and not text:
                allowed = "give numbers, dates or words"
                raise BodyError(name, field, f"labels '{label}'", allowed)


# --- limits that questions apply ------------------------------------------------------------------
# A body itself may be extreme. Each question applies the limits that its formulas need.

#: Upper bound on the tensile strength of any material, Pa: a small rock or a flywheel may spin
#: faster than gravity alone allows, up to this tension.
STRONGEST = 1e10
#: Largest precession per radian of the orbit or of the spin, rad.
FASTEST = 0.01
#: Bound on the relative error of a first-order average, divided by the sum of the two ratios of
#: precession rate to orbital and spin rate. Measured values are 0.3 to 1.8, against the rotation
#: under the Sun's torque, at two obliquities and ratios up to 0.05.
SECOND_ORDER_BOUND = 2.0


def largest(value: Numeric) -> float:
    """Return the largest element of an array, or a plain number unchanged."""
    return float(value.max() if hasattr(value, "max") else value)


def extent(body: Any) -> float:
    """Radius of a body, or its Schwarzschild radius if that is larger, m.

    Parameters
    ----------
    body : Body
        Its radius, or its Schwarzschild radius 2 GM/c2 if that is larger, is returned.
    """
    radius = 0.0 if body.radius is None else largest(body.radius)
    return max(radius, 2 * largest(body.gm) / SPEED_OF_LIGHT.value**2)


def overlap(distance: float, reach: float, name: str, centre: str) -> str | None:
    """Return an error message (text) if two bodies overlap at a given distance, else None.

    Parameters
    ----------
    distance : float
        Between their centres, m.
    reach : float
        Sum of their extents, m.
    name, centre : str
        Names of the two bodies, for the message.
    """
    if distance > reach:
        return None
    return (
        f"at a distance of {distance:.4g} m {name} lies inside {centre}: their radii, or 2 GM/c2 "
        f"if that is larger, add up to {reach:.4g} m"
    )


def refuse_break_up(body: Any) -> None:
    """Raise an error if neither gravity nor material strength can hold a spinning body together.

    Parameters
    ----------
    body : Body
        Body to check. Nothing is checked without a radius, a rotation period or a positive mass.

    Raises
    ------
    BodyError
    """
    if body.radius is None or body.spin_period is None or not all_of(body.gm > 0):
        return
    period = abs(body.spin_period)
    by_gravity = 2 * math.pi * body.radius * (body.radius / body.gm) ** 0.5
    # from density * (equatorial speed)^2 = STRONGEST
    by_strength = (3 * math.pi / (G.value * STRONGEST) * body.gm / body.radius) ** 0.5
    if all_of((period >= by_gravity) | (period >= by_strength)):
        return
    shortest = float(period.min()) if hasattr(period, "dims") else float(period)
    hours = largest(by_gravity) / 3600
    allowed = f"it would break up: gravity holds it together at {hours:.3g} h or more"
    raise BodyError(body.name, "spin_period", f"{shortest:g} s", allowed)


def refuse_fast_axis(by_orbit: Numeric, by_spin: Numeric) -> None:
    """Raise an error if a spin axis precesses too fast for averaging over orbits and rotations.

    Parameters
    ----------
    by_orbit : float or array
        Precession rate of the axis or of the orbit, divided by the mean motion and summed over the
        perturbers.
    by_spin : float or array
        The same precession rate divided by the rate of the spin.

    Raises
    ------
    UndefinedError
    """
    if all_of((by_orbit <= FASTEST) & (by_spin <= FASTEST)):
        return
    orbits, spin = largest(by_orbit), largest(by_spin)
    word, share = ("orbit", orbits) if orbits > spin else ("rotation", spin)
    raise UndefinedError(
        f"an average over orbits needs a slow precession: this axis makes {share:.2g} turns per "
        f"{word}, and at most {FASTEST:g} is allowed; use the question rotation for the full motion"
    )
