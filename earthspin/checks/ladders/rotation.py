"""What the ladders of the free rotor and of the top share: a closed form against integrators."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.checks.stored import load, rotation_error
from earthspin.checks.work_precision import Ladder, Method, settings

FloatArray = NDArray[np.float64]
#: Angular velocity along the body's axes and attitude, and how often slopes were evaluated.
Rotation = tuple[tuple[FloatArray, FloatArray], int]
#: From times (s) and a relative tolerance.
Solver = Callable[[FloatArray, float], Rotation]

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
    closed_form: tuple[Callable[[FloatArray], Rotation], float],
    integrator: tuple[str, Solver],
    by_hand: Mapping[str, tuple[Solver, Sequence[float]]],
) -> Ladder:
    """Make the ladder of a rotation whose angular velocity and attitude are stored.

    Parameters
    ----------
    quantity : str
    inputs : mapping
        Numbers that the stored reference was made for.
    quick : bool
    periods, detail : str
        Name of the periods that are counted, and the rest of the problem's description.
    reference : str
        Source of the true values.
    closed_form : tuple
        Rotation at times (s), and the bound on its error.
    integrator : tuple
        Name and run of the integrator of this package, by DOP853.
    by_hand : mapping
        Runs of other methods by name, with their tolerances.
    """
    true = load(quantity, inputs)
    wanted = slice(0, TIMES // 2 if quick else TIMES)
    t = true["times"].hi[wanted]
    omega, attitude = true["omega"][wanted], true["attitude"][wanted]
    span = f"{FEW_PERIODS if quick else PERIODS:g} {periods}"
    (closed, bound), (name, integrated) = closed_form, integrator
    stepped = settings("DOP853, rtol {}", partial(integrated, t), FEW_FINE if quick else FINE)
    return Ladder(
        quantity=quantity,
        unit="1",
        problem=f"{span}{detail}, at {t.size} times; the error is the largest of the angular "
        "velocity, relative to its size, and of the attitude, in rad",
        subject=span,
        reference=f"{reference} with 80 digits, kept to 32",
        reference_error=ROUNDING,
        methods=[
            Method("closed form", settings("", partial(closed, t)), bound),
            Method(name, stepped, 1e-3 if quick else 1e-9),
            *(
                Method(other, settings("rtol {}", partial(run, t), tolerances))
                for other, (run, tolerances) in by_hand.items()
            ),
        ],
        useful=0.1,
        error=lambda rotation: rotation_error(rotation, omega, attitude),
    )
