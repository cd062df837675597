"""Types of arrays and numbers, and a class for numbers with 95 % half-widths."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
BoolArray = NDArray[np.bool_]
#: A float, an array, or an array with named dimensions.
Numeric = Any


@dataclass(frozen=True)
class Estimate:
    """A number or array, with 95 % half-widths due to the method and due to the inputs.

    Attributes
    ----------
    value : float
    method, given : float
        95 % half-widths from averaging and sampling, and from uncertainties of the inputs.
    """

    value: Numeric
    method: Numeric
    given: Numeric

    @property
    def error(self) -> Numeric:
        """Total 95 % half-width, from method and inputs together."""
        return np.hypot(self.method, self.given)
