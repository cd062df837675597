"""Closeness without a hidden allowance: what is not given is zero."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike


def close(found: ArrayLike, expected: ArrayLike, rel: float = 0.0, abs: float = 0.0) -> bool:
    """Whether every number is within abs + rel |expected| of the expected one."""
    return bool(np.allclose(found, expected, rtol=rel, atol=abs))
