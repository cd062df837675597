"""Broadcast numbers and labelled arrays to common dimensions, for plain NumPy functions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class SideBySide:
    """Numbers and arrays with names, broadcast to common dimensions.

    Attributes
    ----------
    numbers : mapping of str to float or ndarray
        Numbers, all with the dimensions `dims`.
    dims : tuple of str
        Common dimensions; empty if all are plain numbers.
    labels : mapping
        Coordinates along the dimensions.
    """

    numbers: Mapping[str, Any]
    dims: tuple[str, ...] = ()
    labels: Mapping[Any, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, **values: Any) -> Self:
        """Broadcast named numbers and labelled arrays to common dimensions."""
        arrays = {name: value for name, value in values.items() if hasattr(value, "dims")}
        if not arrays:
            return cls(values)
        import xarray as xr

        joint = dict(zip(arrays, xr.broadcast(*arrays.values()), strict=True))
        first = next(iter(joint.values()))
        numbers = {
            name: np.broadcast_to(joint[name].values if name in joint else value, first.shape)
            for name, value in values.items()
        }
        return cls(numbers, tuple(map(str, first.dims)), first.coords)

    def columns(self, *names: str) -> tuple[Any, ...]:
        """Return the numbers with the given names; arrays get a new last axis of length 1."""
        index = (..., np.newaxis) if self.dims else ...
        return tuple(np.asarray(self.numbers[name])[index] for name in names)

    def lay(self, values: NDArray[Any], *dims: str) -> xr.DataArray:
        """Build a DataArray of the values, with the common dimensions followed by `dims`."""
        import xarray as xr

        if values.ndim < len(self.dims) + len(dims):
            many = np.shape(next(iter(self.numbers.values())))
            values = np.broadcast_to(values, (*many, *values.shape))
        return xr.DataArray(values, self.labels, (*self.dims, *dims))

    def lay_pair(
        self, value: NDArray[Any], error: NDArray[Any], *dims: str
    ) -> tuple[xr.DataArray, xr.DataArray]:
        """Build two DataArrays: one of a quantity, and one of its half-width."""
        return self.lay(value, *dims), self.lay(error, *dims)
