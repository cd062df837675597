"""What every function of this package asks of its input: one clear line when it is not so."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from earthspin.errors import BodyError, UndefinedError

FloatArray = NDArray[np.float64]


def positive(body: str, field: str, value: ArrayLike) -> FloatArray:
    """Return finite numbers above zero as an array, or say which one is not."""
    values = np.asarray(value, dtype=float)
    wrong = ~(np.isfinite(values) & (values > 0))
    if np.any(wrong):
        raise BodyError(body, field, first(values, wrong), "it must be finite and above zero")
    return values


def vectors(name: str, value: ArrayLike) -> FloatArray:
    """Return finite vectors as an array whose last axis is x, y, z."""
    values = np.asarray(value, dtype=float)
    if values.ndim == 0 or values.shape[-1] != 3:
        raise UndefinedError(
            f"{name} has the shape {values.shape}; its last axis must hold x, y and z"
        )
    wrong = ~np.isfinite(values)
    if np.any(wrong):
        raise UndefinedError(f"{name} holds {first(values, wrong)}; give finite numbers of metres")
    return values


def degree(name: str, value: Any) -> int:
    """Return a whole number that is not negative."""
    if not isinstance(value, int | np.integer) or value < 0:
        raise UndefinedError(f"{name} = {value!r} is not possible; give a whole number from 0 on")
    return int(value)


def first(values: FloatArray, wrong: NDArray[np.bool_]) -> float:
    """First of the values that are wrong."""
    return float(values[wrong].flat[0])
