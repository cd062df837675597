"""Functions shared by the method comparisons of free rotor, heavy top and tumbling moon."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

from tests.reference.stored import rotation_error
from earthspin.checks.work_precision import FloatArray, Ladder, Method, Result, method
from earthspin.numerics.double_double import DoubleDouble

#: Number of periods in a full and in a quick run, which uses the first half of the stored times.
PERIODS, FEW_PERIODS = 100.0, 5.0
TIMES = 40
#: Rounding error of a reference with 32 digits.
ROUNDING = 1e-28
#: Relative tolerances of solvers of high order, and a bound on the error with the last one.
FINE, BOUND = (1e-4, 1e-6, 1e-8, 1e-10, 1e-13), 1e-9
FEW_FINE, FEW_BOUND = (1e-4, 1e-8), 1e-3


def ladder_of_rotation(
    quantity: str,
    true: Mapping[str, DoubleDouble],
    t: FloatArray,
    methods: Sequence[Method],
    *,
    span: str,
    detail: str,
    reference: str,
    reference_error: float = ROUNDING,
) -> Ladder:
    """Make the `Ladder` of a rotation with stored reference angular velocity and attitude.

    Parameters
    ----------
    quantity : str
    true : mapping
        The stored reference.
    t : ndarray
        Times of the reference, or the first of them, s.
    methods : sequence of Method
    span, detail : str
        Description of the motion, and the rest of the problem's description.
    reference : str
        Source of the true values.
    reference_error : float
    """
    omega, attitude = true["omega"][: t.size], true["attitude"][: t.size]
    return Ladder(
        quantity=quantity,
        unit="1",
        problem=f"{span}{detail}, at {t.size} times; the error is the largest of the angular "
        "velocity, relative to its size, and of the attitude, in rad",
        subject=span,
        reference=reference,
        reference_error=reference_error,
        methods=methods,
        useful=0.1,
        error=lambda rotation: rotation_error(rotation, omega, attitude),
    )


def periods(
    true: Mapping[str, DoubleDouble], quick: bool
) -> tuple[FloatArray, str, tuple[float, ...], float]:
    """Choose the times, and the tolerances of integrators, for a full or quick comparison.

    Returns
    -------
    times : ndarray
        Times, s.
    count : str
        Number of periods as text.
    tolerances : tuple of float
        Tolerances of high-order integrators.
    bound : float
        Bound on the error with the last tolerance.
    """
    if quick:
        return true["times"].hi[: TIMES // 2], f"{FEW_PERIODS:g}", FEW_FINE, FEW_BOUND
    return true["times"].hi, f"{PERIODS:g}", FINE, BOUND


def scipy_methods(
    words: str,
    run: Callable[[str, FloatArray, float], Result],
    t: FloatArray,
    tolerances: Mapping[str, Sequence[float]],
) -> list[Method]:
    """Make a `Method` for each SciPy integrator with its relative tolerances.

    Parameters
    ----------
    words : str
        Label with braces for the name of the integrator.
    run : callable
        Function of the name, times and a relative tolerance.
    t : ndarray
        Times, s.
    tolerances : mapping
        Relative tolerances by name of the integrator.
    """
    return [
        method(words.format(name), "rtol {}", partial(run, name, t), steps)
        for name, steps in tolerances.items()
    ]
