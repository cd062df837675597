"""Principal moments of inertia, stored with their differences in double-double precision.

A torque-free motion depends on the differences of the moments. Computed from rounded moments, they
lose five of sixteen digits for the Earth, so they may be given directly:

    [A, B, C]                                 three numbers, in any order of size
    {"A": ..., "B-A": ..., "C-A": ...}        full precision

A, B and C belong to the x, y and z axes of the body, in any order of size. For a nearly
axisymmetric body, A should be one of the two nearly equal moments.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from earthspin.errors import BodyError
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.double_double import DoubleDouble, as_double_double, stack, two_sum

#: Three numbers, a mapping with the keys of `KEYS`, or a `PrincipalMoments`.
Moments = Any

KEYS = ("A", "B-A", "C-A")
#: Tolerance of C <= A + B for rounding errors, relative to C; a lamina has C = A + B.
_LAMINA = 4 * np.finfo(float).eps


@dataclass(frozen=True, slots=True, eq=False)
class PrincipalMoments:
    """Principal moments of inertia and their differences, as double-double numbers.

    Attributes
    ----------
    moment : DoubleDouble, shape (..., 3)
        A, B, C about the x, y, z axes of the body, kg m2 (or any unit).
    difference : DoubleDouble, shape (..., 3)
        C - B, A - C, B - A: the factors of Euler's equations (I.4.3).
    """

    moment: DoubleDouble
    difference: DoubleDouble

    @property
    def values(self) -> FloatArray:
        """Principal moments of inertia A, B, C as floats, kg m2, shape (..., 3)."""
        return np.asarray(self.moment.hi)

    @property
    def A(self) -> FloatArray:
        """Principal moment of inertia A about the x axis, kg m2."""
        return self.values[..., 0]

    @property
    def B(self) -> FloatArray:
        """Principal moment of inertia B about the y axis, kg m2."""
        return self.values[..., 1]

    @property
    def C(self) -> FloatArray:
        """Principal moment of inertia C about the z axis, kg m2."""
        return self.values[..., 2]

    @property
    def B_A(self) -> FloatArray:
        """Difference B - A of principal moments of inertia, kg m2."""
        return np.asarray(self.difference.hi[..., 2])

    @property
    def C_A(self) -> FloatArray:
        """Difference C - A of principal moments of inertia, kg m2."""
        return np.asarray(-self.difference.hi[..., 1])

    @property
    def C_B(self) -> FloatArray:
        """Difference C - B of principal moments of inertia, kg m2."""
        return np.asarray(self.difference.hi[..., 0])


def principal_moments(given: Moments) -> PrincipalMoments:
    """Read principal moments of inertia; raise an error if no body can have them.

    Parameters
    ----------
    given : sequence of three numbers, mapping, or PrincipalMoments
        A, B, C, as array of shape (..., 3) for many bodies; or ``{"A", "B-A", "C-A"}``,
        whose values broadcast against each other; kg m2.

    Returns
    -------
    PrincipalMoments

    Raises
    ------
    BodyError
        If a moment is not positive, or exceeds the sum of the other two.
    """
    if isinstance(given, PrincipalMoments):
        return given
    moments = _from_differences(given) if isinstance(given, Mapping) else _from_three(given)
    _check(moments)
    return moments


def _from_differences(given: Mapping[str, Any]) -> PrincipalMoments:
    if set(given) != set(KEYS):
        raise BodyError(
            "rotor", "moments", sorted(map(str, given)), f"the keys are {', '.join(KEYS)}"
        )
    parts = [finite(given[key], key, "kg m2") for key in KEYS]
    try:
        a, b_a, c_a = np.broadcast_arrays(*parts)
    except ValueError:
        shapes = [part.shape for part in parts]
        rule = "A, B-A and C-A must have shapes that broadcast together"
        raise BodyError("rotor", "shape of moments", shapes, rule) from None
    zero = np.zeros_like(a)
    first, towards_b, towards_c = (DoubleDouble(x, zero) for x in (a, b_a, c_a))
    return PrincipalMoments(
        stack(first, first + towards_b, first + towards_c),
        stack(towards_c - towards_b, -towards_c, towards_b),
    )


def _from_three(given: Any) -> PrincipalMoments:
    abc = finite(given, "moments", "kg m2")
    if abc.ndim == 0 or abc.shape[-1] != 3:
        raise BodyError("rotor", "shape of moments", abc.shape, "give three numbers, A, B, C")
    a, b, c = np.moveaxis(abc, -1, 0)
    return PrincipalMoments(
        as_double_double(abc),
        stack(*(DoubleDouble(*two_sum(x, -y)) for x, y in ((c, b), (a, c), (b, a)))),
    )


def _check(moments: PrincipalMoments) -> None:
    values = moments.values
    for axis, name in enumerate("ABC"):
        moment = values[..., axis]
        if not np.all(moment > 0):
            raise BodyError(
                "rotor", name, float(np.min(moment)), "a principal moment must be positive"
            )
    for axis, name in enumerate("ABC"):
        moment = values[..., axis]
        # Ij + Ik - Ii, with the original difference Ij - Ii
        room = values[..., axis - 1] + moments.difference.hi[..., axis - 1]
        if np.any(room < -_LAMINA * moment):
            at = np.unravel_index(np.argmin(room / moment), moment.shape)
            others = " + ".join(f"{values[(*at, i)]:.16g}" for i in range(3) if i != axis)
            rule = f"no principal moment may exceed the sum of the other two, here {others}"
            raise BodyError("rotor", name, float(moment[at]), rule)


def finite(given: Any, name: str, unit: str) -> FloatArray:
    """Convert an input to an array of floats; raise an error for infinite or missing values.

    Parameters
    ----------
    given : array_like
    name, unit : str
        Name and unit of the input, for messages.
    """
    try:
        numbers = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        raise BodyError("rotor", name, given, f"give numbers, in {unit}") from None
    bad = numbers[~np.isfinite(numbers)]
    if bad.size:
        raise BodyError("rotor", name, float(bad.flat[0]), f"give finite numbers, in {unit}")
    return numbers
