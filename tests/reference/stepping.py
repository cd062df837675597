"""Step-by-step integration with SciPy, and the time derivative of an attitude quaternion."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import FloatArray


def integrate(
    slope: Callable[[float, FloatArray], ArrayLike],
    start: ArrayLike,
    times: FloatArray,
    rtol: float,
    method: str = "DOP853",
    *,
    begin: float = 0.0,
    atol: ArrayLike | None = None,
    max_step: float = np.inf,
) -> tuple[FloatArray, int]:
    """Integrate a differential equation with SciPy and return the states at given times.

    Parameters
    ----------
    slope : callable
        Rate of the state as a function of time and state.
    start : array_like
        State at `begin`.
    times : ndarray, shape (n,)
        Times in the order of integration.
    rtol, method, atol, max_step
        Arguments of `solve_ivp`. By default the absolute tolerance equals the relative one, for
        states of order 1.
    begin : float
        Time of the initial state.

    Returns
    -------
    states : ndarray, shape (n, k)
    evaluations : int
        Number of evaluations of the slope.

    Raises
    ------
    UndefinedError
        If the integration does not reach the last time.
    """
    solution = solve_ivp(
        slope, (begin, times[-1]), start, method, t_eval=times, rtol=rtol,
        atol=rtol if atol is None else atol, max_step=max_step,
    )  # fmt: skip
    if not solution.success:
        raise UndefinedError(f"the integration stopped: {solution.message}")
    return solution.y.T, int(solution.nfev)


def quaternion_rate(quaternion: Iterable[Any], omega: Iterable[Any]) -> list[Any]:
    """Time derivative (1/2) q omega of an attitude quaternion q, scalar component first.

    Parameters
    ----------
    quaternion : four numbers
        Rotation from the axes of the body to those of the sky.
    omega : three numbers
        Angular velocity along the axes of the body.
    """
    (w, x, y, z), (p, q, r) = quaternion, omega
    return [
        (-x * p - y * q - z * r) / 2,
        (w * p + y * r - z * q) / 2,
        (w * q + z * p - x * r) / 2,
        (w * r + x * q - y * p) / 2,
    ]
