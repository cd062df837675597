"""Torques defined by the user's Python functions of time, attitude and angular velocity."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import EarthspinError, UndefinedError, Where, one_line
from earthspin.numerics.arrays import FloatArray
from earthspin.units import Plain, real_numbers

#: Key in a scene for a function, which a scene cannot hold.
_FUNCTION = "live"


@dataclass(frozen=True)
class CustomTorque:
    """Torque on a body that the user defines by a Python function.

    Attributes
    ----------
    law : callable
        ``torque(t, q, omega)`` that takes times from the start (s), shape (n,), attitudes, shape
        (n, 4), and angular velocities along the body's axes (rad/s), shape (n, 3), and returns the
        torque along the body's axes (N m), shape (n, 3).
    """

    law: Callable[[FloatArray, FloatArray, FloatArray], ArrayLike]

    words = "a function torque(t, q, omega) -> N m, in Python"
    hint = "Callable[[np.ndarray, np.ndarray, np.ndarray], ArrayLike]"

    @classmethod
    def read(cls, value: object, where: Where) -> CustomTorque:
        """Accept a Python function as the torque; its results are checked whenever it is called."""
        if isinstance(value, CustomTorque):
            return value
        if isinstance(value, Mapping) and _FUNCTION in value:
            raise where.error(
                value[_FUNCTION],
                "it was a function, which no scene can hold; give it again in Python",
            )
        if not callable(value):
            raise where.error(value, f"give {cls.words}")
        return cls(value)

    def write(self) -> Plain:
        """Form stored in scene files: the name of the function; its code is not stored."""
        name = getattr(self.law, "__qualname__", None) or repr(self.law)
        return {_FUNCTION: re.sub(r" at 0x[0-9a-fA-F]+", "", str(name))}

    def over(
        self, polar_moment: float
    ) -> Callable[[FloatArray, FloatArray, FloatArray], FloatArray]:
        """Wrap the user's function: divide its torque by the polar moment, and check every result.

        Parameters
        ----------
        polar_moment : float
            C, kg m2.

        Raises
        ------
        UndefinedError
            If the function fails, or does not return a finite torque for each time.
        """

        def torque(times: FloatArray, q: FloatArray, omega: FloatArray) -> FloatArray:
            try:
                returned: Any = self.law(times, q, omega)
                if hasattr(returned, "to_value"):  # a Quantity
                    returned = returned.to_value("N m")
                values = np.broadcast_to(real_numbers(returned), omega.shape)
            except EarthspinError:
                raise
            except Exception as error:  # any error of the user's function
                reason = one_line(error) or type(error).__name__
                raise UndefinedError(
                    f"the custom torque failed for {times.size} times: {reason}; it must take "
                    f"arrays of shapes ({times.size},), ({times.size}, 4) and ({times.size}, 3) "
                    "and return N m with the last shape"
                ) from None
            finite = np.isfinite(values).all(axis=1)
            if not finite.all():
                raise UndefinedError(
                    f"the custom torque is not finite {float(times[~finite][0]):.6g} s from the "
                    "start; return a finite torque for each time"
                )
            return np.asarray(values / polar_moment)

        return torque
