"""Accuracy of the closed form.

Errors are against the textbook's form at eighty digits: of each component of omega
relative to its own largest value in the motion, and of the elements of the attitude matrix.
"""

from typing import Any

import mpmath as mp
import numpy as np

from earthspin.rotor.triaxial import free_rotation
from tests.rotor.families import Case
from tests.rotor.textbook import DIGITS, Textbook

#: Times in periods: within a few, and after ten thousand. Next to the sphere, where a period
#: lasts 10^15 turns, the late time is 10^15 rad of turning.
FRACTIONS = (-0.83, 0.31, 3.17)
LATE = 9999.37
MOST_TURNING = 1e15


def errors(case: Case) -> tuple[float, float]:
    """Largest error within a few periods, and after ten thousand."""
    with mp.workdps(DIGITS):
        book = Textbook(*case)
        late = (3 if book.separatrix else LATE) * float(book.period)
        late = min(late, MOST_TURNING / float(np.linalg.norm(case.omega)))
        times = np.array([*(part * float(book.period) for part in FRACTIONS), late])
        found = free_rotation(*case, times)
        off = [
            max(
                *(
                    float(abs(w - exact) / size)
                    for w, exact, size in zip(omega, state.omega, state.amplitude, strict=True)
                ),
                *(
                    float(abs(element - state.attitude[i, j]))
                    for (i, j), element in np.ndenumerate(matrix(q))
                ),
            )
            for omega, q, state in zip(
                found.omega_body, found.attitude, map(book.at, times), strict=True
            )
        ]
    return max(off[:-1]), off[-1]


def matrix(q: Any) -> Any:
    """Rotation matrix of a unit quaternion."""
    w, x, y, z = map(float, q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
