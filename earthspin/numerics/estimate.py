"""A number with the contributions to its half-width."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

#: A float, an array, or an array with named dimensions.
Numeric = Any


@dataclass(frozen=True)
class Estimate:
    """A number or array with its errors.

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
        """Total 95 % half-width."""
        return np.hypot(self.method, self.given)
