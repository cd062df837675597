"""Closeness without a hidden allowance: what is not given is zero."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike


def close(found: ArrayLike, expected: ArrayLike, rel: Any = 0.0, abs: Any = 0.0) -> bool:
    """Whether every number is within abs + rel |expected| of the expected one."""
    return bool(np.allclose(found, expected, rtol=rel, atol=abs))
