"""Numbers and labelled arrays with names, broadcast to common dimensions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from earthspin._lazy import xr
from earthspin.engine.variables import variable_of


@dataclass(frozen=True)
class LabelledNumbers:
    """Numbers and arrays with names, broadcast to common dimensions.

    Attributes
    ----------
    values : mapping of str to float or ndarray
        Numbers, all with the dimensions `dims`.
    dims : tuple of str
        Common dimensions; empty if all are plain numbers.
    labels : mapping
        Coordinates along the dimensions.
    """

    values: Mapping[str, Any]
    dims: tuple[str, ...] = ()
    labels: Mapping[Any, Any] = field(default_factory=dict)

    @classmethod
    def broadcast(cls, **numbers: Any) -> Self:
        """Broadcast named numbers and labelled arrays to common dimensions."""
        arrays = {name: value for name, value in numbers.items() if hasattr(value, "dims")}
        if not arrays:
            return cls(numbers)
        joint = dict(zip(arrays, xr.broadcast(*arrays.values()), strict=True))
        first = next(iter(joint.values()))
        values = {
            name: np.broadcast_to(joint[name].values if name in joint else value, first.shape)
            for name, value in numbers.items()
        }
        return cls(values, tuple(map(str, first.dims)), first.coords)

    def columns(self, *names: str) -> tuple[Any, ...]:
        """Return the numbers with the given names; arrays get a new last axis of length 1."""
        index = (..., np.newaxis) if self.dims else ...
        return tuple(np.asarray(self.values[name])[index] for name in names)

    def array(self, values: NDArray[Any], *dims: str) -> xr.DataArray:
        """Build a DataArray of the values, with the common dimensions followed by `dims`."""
        if values.ndim < len(self.dims) + len(dims):
            shape = np.shape(next(iter(self.values.values())))
            values = np.broadcast_to(values, (*shape, *values.shape))
        return xr.DataArray(variable_of((*self.dims, *dims), values), self.labels)

    def pair(
        self, value: NDArray[Any], error: NDArray[Any], *dims: str
    ) -> tuple[xr.DataArray, xr.DataArray]:
        """Build two DataArrays: one of a quantity, and one of its half-width."""
        return self.array(value, *dims), self.array(error, *dims)
