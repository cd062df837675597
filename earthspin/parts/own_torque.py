"""A torque of one's own: a function that is given in Python."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from earthspin.errors import EarthspinError, UndefinedError, Where, one_line
from earthspin.units import FloatArray, Plain, real_numbers

#: Word for what a scene cannot hold.
_LIVE = "live"


@dataclass(frozen=True)
class OwnTorque:
    """A torque of one's own.

    Attributes
    ----------
    law : callable
        ``torque(t, q, omega)`` of times from the start (s), shape (n,), attitudes (n, 4) and
        angular velocities along the body's axes (rad/s), shape (n, 3), to N m along the body's
        axes, shape (n, 3).
    """

    law: Callable[[FloatArray, FloatArray, FloatArray], ArrayLike]

    words = "a function torque(t, q, omega) -> N m, in Python"
    hint = "Callable[[np.ndarray, np.ndarray, np.ndarray], ArrayLike]"

    @classmethod
    def read(cls, value: object, where: Where) -> OwnTorque:
        """Take a function; whether it gives a torque shows when it is called."""
        if isinstance(value, OwnTorque):
            return value
        if isinstance(value, Mapping) and _LIVE in value:
            raise where.error(
                value[_LIVE], "it was a function, which no scene can hold; give it again in Python"
            )
        if not callable(value):
            raise where.error(value, f"give {cls.words}")
        return cls(value)

    def write(self) -> Plain:
        """Say which function it was."""
        name = getattr(self.law, "__qualname__", None) or repr(self.law)
        return {_LIVE: re.sub(r" at 0x[0-9a-fA-F]+", "", str(name))}

    def over(
        self, polar_moment: float
    ) -> Callable[[FloatArray, FloatArray, FloatArray], FloatArray]:
        """Torque divided by C, checked whenever it is called.

        Parameters
        ----------
        polar_moment : float
            C, kg m2.

        Raises
        ------
        UndefinedError
            If it fails, or gives something else than a finite torque for each time.
        """

        def torque(times: FloatArray, q: FloatArray, omega: FloatArray) -> FloatArray:
            try:
                returned: Any = self.law(times, q, omega)
                if hasattr(returned, "to_value"):  # a Quantity
                    returned = returned.to_value("N m")
                values = np.broadcast_to(real_numbers(returned), omega.shape)
            except EarthspinError:
                raise
            except Exception as error:  # whatever somebody's function meets
                words = one_line(error) or type(error).__name__
                raise UndefinedError(
                    f"the torque of your own cannot be used at {times.size} times: {words}; it "
                    f"takes arrays of shapes ({times.size},), ({times.size}, 4) and "
                    f"({times.size}, 3) and gives N m of the last shape"
                ) from None
            finite = np.isfinite(values).all(axis=1)
            if not finite.all():
                raise UndefinedError(
                    "the torque of your own is not finite "
                    f"{float(times[~finite][0]):.6g} s from the "
                    "start; give N m for each time"
                )
            return np.asarray(values / polar_moment)

        return torque
