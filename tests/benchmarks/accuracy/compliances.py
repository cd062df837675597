"""Compliances of a layered Earth: collocation beside step-by-step integrators.

The equations, the initial radius and the conditions at boundaries and surface are the same for all
methods, which differ only in the integration from one radius to another.
"""

from collections.abc import Callable
from functools import partial
from itertools import pairwise
from typing import Any
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

from earthspin.constants import G
from earthspin.interior import love
from earthspin.interior.layers import PREM
from earthspin.numerics.polynomials import carry as collocation
from tests.benchmarks.accuracy.ladder import Ladder, settings
from tests.reference.stepping import integrate
from tests.reference.stored import load

Array = NDArray[Any]
Matrix = Callable[[Array], Array]
#: Function that carries solutions from one radius to another with some setting.
Carry = Callable[[Matrix, float, float, Array, float], Array]

#: Inputs of the stored reference.
INPUTS = {
    "G": G.value,
    "layers": [
        [layer.top, *(list(values) for values in (layer.density, layer.vp, layer.vs))]
        for layer in PREM.layers
    ],
}
#: Change of the reference with other steps and another initial radius.
FLOOR = 4e-15
TOLERANCES = (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-12)
THIN = (0.2, 0.1, 0.05, 0.02, 0.01)


def ladder() -> Ladder:
    """Methods for the compliances of PREM.

    The bound is about twice the error of the inner core's diagonal compliance from starting the
    integration at r = 0.001 R, 4.5e-12.
    """
    true = load("compliances", INPUTS)["answers"]
    own = np.sqrt(abs(np.diagonal(true.hi)))

    def runs(words: str, carry: Carry, values: tuple[float, ...]) -> dict[str, Any]:
        return settings(words, partial(_compliances, carry), values)

    return Ladder(
        title="Compliances of PREM",
        problem="nine compliances of PREM (whole body, fluid core and inner core, each to "
        "potentials in each); the error is the largest, relative to the geometric mean of the two "
        "diagonal compliances",
        reference="Hooke's law and Poisson's equation in the logarithm of the radius, in long "
        "double by extrapolation of order 20, starting at a tenth of the radius at which the "
        "methods start",
        unit="1",
        floor=FLOOR,
        error=lambda answers: np.max(abs((answers - true).hi) / np.outer(own, own)),
        runs={
            "collocation": runs("settled to {}", collocation, (1e-4, 1e-13)),
            "solve_ivp DOP853": runs("rtol {}", partial(_by_scipy, "DOP853"), TOLERANCES),
            "solve_ivp LSODA": runs("rtol {}", partial(_by_scipy, "LSODA"), TOLERANCES),
            "solve_ivp RK45": runs("rtol {}", partial(_by_scipy, "RK45"), TOLERANCES[:4]),
            "homogeneous layers": runs("layers of {} in ln r", _even_layers, THIN),
        },
        bounds={"collocation": 1e-11},
    )


def _compliances(carry: Carry, setting: float) -> tuple[Array, int]:
    """Compliances by one integrator, and the number of radii at which it was evaluated."""
    radii = 0

    def counted(matrix: Matrix, start: float, stop: float, y: Array, /, **_: Any) -> Array:
        def at(r: Array) -> Array:
            nonlocal radii
            radii += r.size
            return matrix(r)

        return carry(at, start, stop, y, setting)

    with patch.object(love, "carry", counted):
        return love.solve_love_numbers(PREM).response, radii


def _by_scipy(name: str, matrix: Matrix, start: float, stop: float, y: Array, rtol: float) -> Array:
    """Integrate the deformation equations, for all columns at once, along the radius by SciPy."""

    def slope(r: float, flat: Array) -> Array:
        return np.asarray(_at(matrix, r) @ flat.reshape(y.shape)).ravel()

    ends = np.array([stop])
    states, _ = integrate(slope, y.ravel(), ends, rtol, name, begin=start, atol=rtol * 1e-6)
    return np.asarray(states[-1].reshape(y.shape))


def _even_layers(matrix: Matrix, start: float, stop: float, y: Array, step: float) -> Array:
    """Integrate through homogeneous layers by matrix exponentials.

    The exponents are r M in the middle of each layer in ln r, times its thickness in ln r.
    """
    for r, after in pairwise(_edges(start, stop, step)):
        middle = np.sqrt(r * after)
        y = expm(np.log(after / r) * middle * _at(matrix, middle)) @ y
    return y


def _edges(start: float, stop: float, step: float) -> Array:
    return np.geomspace(start, stop, int(np.ceil(np.log(stop / start) / step)) + 1)


def _at(matrix: Matrix, r: float) -> Array:
    """Matrix M of the elastic-gravitational equations dy/dr = M y at one radius."""
    return np.asarray(matrix(np.array([r]))[..., 0, :, :])
