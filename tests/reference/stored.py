"""Stored reference values with 32 digits.

Each number is an unevaluated sum of two floats, so that errors in the last digit of a float can be
measured. `python -m tests.reference` computes the files again.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.double_double import DoubleDouble

FOLDER = Path(__file__).parent / "values"


def load(name: str, inputs: Mapping[str, Any]) -> dict[str, DoubleDouble]:
    """Read stored reference values; raise an error if they were computed for other inputs.

    Parameters
    ----------
    name : str
    inputs : mapping
        Plain numbers and lists on which the values depend.

    Raises
    ------
    UndefinedError
        If the reference was computed for other inputs.
    """
    stored = json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8"))
    if stored["inputs"] != json.loads(json.dumps(inputs)):
        raise UndefinedError(
            f"the stored reference '{name}' was computed for other inputs; compute it again with "
            "python -m tests.reference"
        )
    return {
        key: DoubleDouble(np.array(pair["hi"]), np.array(pair["lo"]))
        for key, pair in stored["values"].items()
    }


def attitude_error(values: FloatArray, true: DoubleDouble) -> float:
    """Largest angle between computed and true attitudes, as unit quaternions, rad.

    Parameters
    ----------
    values : ndarray, shape (n, 4)
        Computed attitudes; q and -q are the same attitude.
    true : DoubleDouble, shape (n, 4)
        Reference.
    """
    sign = np.where(np.sum(values * true.hi, axis=1) < 0, -1.0, 1.0)[:, np.newaxis]
    return float(2 * np.max(np.linalg.norm((sign * values - true).hi, axis=1)))


def rotation_error(
    values: tuple[FloatArray, FloatArray], omega: DoubleDouble, attitude: DoubleDouble
) -> float:
    """Larger of two errors: relative error of angular velocity, and attitude error in rad.

    Parameters
    ----------
    values : pair of ndarray, shapes (n, 3) and (n, 4)
        Computed angular velocity along the body's axes (rad/s), and unit quaternions.
    omega, attitude : DoubleDouble
        Reference of angular velocity and attitude.
    """
    error = np.linalg.norm((values[0] - omega).hi, axis=1) / np.linalg.norm(omega.hi, axis=1)
    return max(float(np.max(error)), attitude_error(values[1], attitude))
