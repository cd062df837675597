"""What the ladders of the free rotor and of the top share: a closed form against integrators."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.checks.stored import load, rotation_error
from earthspin.checks.work_precision import Ladder, Method

FloatArray = NDArray[np.float64]
#: Angular velocity along the body's axes and attitude, and how often slopes were evaluated.
Rotation = tuple[tuple[FloatArray, FloatArray], int]

#: Periods that are followed. Half of the stored times lie within the first few.
PERIODS, FEW_PERIODS = 100.0, 5.0
TIMES = 40
#: Of a reference that is kept to 32 digits.
ROUNDING = 1e-28
#: Relative tolerances of solvers of high order, for all settings and for a quick run.
FINE, FEW_FINE = (1e-4, 1e-6, 1e-8, 1e-10, 1e-13), (1e-4, 1e-8)


def ladder_of_rotation(
    quantity: str,
    inputs: Mapping[str, Any],
    quick: bool,
    *,
    periods: str,
    detail: str,
    reference: str,
    methods: Callable[[FloatArray, bool], Sequence[Method]],
) -> Ladder:
    """Make the ladder of a rotation whose angular velocity and attitude are stored.

    Parameters
    ----------
    quantity : str
    inputs : mapping
        What the stored reference hangs on.
    quick : bool
    periods, detail : str
        What there are so many of, and what else there is to say of it.
    reference : str
        Where the true values come from.
    methods : callable
        From times (s) and `quick`.
    """
    true = load(quantity, inputs)
    wanted = slice(0, TIMES // 2 if quick else TIMES)
    t = true["times"].hi[wanted]
    omega, attitude = true["omega"][wanted], true["attitude"][wanted]
    span = f"{FEW_PERIODS if quick else PERIODS:g} {periods}"
    return Ladder(
        quantity=quantity,
        unit="1",
        problem=f"{span}{detail}, at {t.size} times; the error is the largest of the angular "
        "velocity, relative to its size, and of the attitude, in rad",
        subject=span,
        reference=f"{reference} with 80 digits, kept to 32",
        reference_error=ROUNDING,
        methods=methods(t, quick),
        useful=0.1,
        error=lambda found: rotation_error(found, omega, attitude),
    )
