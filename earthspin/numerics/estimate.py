"""A number with the shares of its half-width."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

#: A float, an array, or an array with named dimensions.
Numeric = Any


@dataclass(frozen=True)
class Estimate:
    """A number, or an array of numbers, with what it may be off by.

    Attributes
    ----------
    value : float
    method, given : float
        95 % half-widths from averaging and sampling, and from the given numbers.
    """

    value: Numeric
    method: Numeric
    given: Numeric

    @property
    def error(self) -> Numeric:
        """95 % half-width from both."""
        return np.hypot(self.method, self.given)
