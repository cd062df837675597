"""Compare error and run time of methods for the compliances of a layered Earth.

Methods: collocation and step-by-step integrators.

The equations, the initial radius and the conditions at boundaries and surface are the same for all
methods, which differ only in the integration from one radius to another.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

from tests.reference.stepping import integrate
from tests.reference.stored import load
from earthspin.checks.work_precision import Ladder, Method, Result, method
from earthspin.constants import G
from earthspin.interior.love import Carry, yielding
from earthspin.interior.prem import PREM
from earthspin.numerics.collocation import carry as by_collocation
from earthspin.numerics.double_double import DoubleDouble

Array = NDArray[Any]
Matrix = Callable[[Array], Array]

#: Inputs of the stored reference.
INPUTS = {
    "G": G.value,
    "layers": [
        [layer.top, *(list(values) for values in (layer.density, layer.vp, layer.vs))]
        for layer in PREM.layers
    ],
}
#: Change of the reference with other steps and another initial radius.
REFERENCE_ERROR = 4e-15
#: Bound for every method: about twice the error of the inner core's diagonal compliance from
#: starting the integration at r = 0.001 R, 4.5e-12.
BOUND = 1e-11


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for the compliances of PREM."""
    true = load("compliances", INPUTS)["answers"]
    fine = (1e-4, 1e-7) if quick else (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-12)
    coarse = (1e-3, 1e-5) if quick else (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
    settled = (1e-4, 1e-13)
    thin = (0.1, 0.05) if quick else (0.2, 0.1, 0.05, 0.02, 0.01)

    def row(name: str, words: str, carry: Callable[..., Array], *rest: Any) -> Method:
        return method(name, words, partial(_run, carry), *rest)

    return Ladder(
        quantity="compliances",
        unit="1",
        problem="nine compliances of PREM (whole body, fluid core and inner core, each to "
        "potentials in each); the error is the largest, relative to the geometric mean of the two "
        "diagonal compliances",
        subject="the compliances of PREM",
        reference="Hooke's law and Poisson's equation in the logarithm of the radius, in long "
        "double by extrapolation of order 20, starting at a tenth of the radius at which the "
        "methods start",
        reference_error=REFERENCE_ERROR,
        methods=[
            row("collocation at Gauss's nodes", "settled to {}", by_collocation, settled, BOUND),
            row("solve_ivp DOP853", "rtol {}", partial(_by_scipy, "DOP853"), fine),
            row("solve_ivp LSODA", "rtol {}", partial(_by_scipy, "LSODA"), fine),
            row("solve_ivp RK45", "rtol {}", partial(_by_scipy, "RK45"), coarse),
            row("RK4", "steps of {} in ln r", _runge_kutta, thin),
            row(
                "homogeneous layers, matrix exponentials",
                "layers of {} in ln r",
                _even_layers,
                thin,
            ),
        ],
        useful=0.01,
        error=partial(scaled_error, true),
    )


def scaled_error(true: DoubleDouble, result: Array) -> float:
    """Largest error of an element of the compliance matrix, scaled by its diagonal elements.

    The error of element (i, j) is divided by the geometric mean of elements (i, i) and (j, j).
    """
    own = np.sqrt(abs(np.diagonal(true.hi)))
    return float(np.max(abs((result - true).hi) / np.outer(own, own)))


def _run(carry: Callable[..., Array], setting: float) -> Result:
    """Compliances of PREM by one integrator, and the number of radii at which it was evaluated."""
    radii = 0

    def counted(
        matrix: Matrix, start: float, stop: float, y: Array, /, *, together: bool = False
    ) -> Array:
        def at(r: Array) -> Array:
            nonlocal radii
            radii += r.size
            return matrix(r)

        # Every method integrates each solution separately, so `together` is ignored.
        return carry(at, start, stop, y, setting)

    integration: Carry = counted
    return yielding(PREM, 0.0, integration).answers, radii


def _by_scipy(name: str, matrix: Matrix, start: float, stop: float, y: Array, rtol: float) -> Array:
    """Integrate the deformation equations, for all columns at once, along the radius by SciPy."""

    def slope(r: float, flat: Array) -> Array:
        return np.asarray(_at(matrix, r) @ flat.reshape(y.shape)).ravel()

    ends = np.array([stop])
    states, _ = integrate(slope, y.ravel(), ends, rtol, name, begin=start, atol=rtol * 1e-6)
    return np.asarray(states[-1].reshape(y.shape))


def _runge_kutta(matrix: Matrix, start: float, stop: float, y: Array, step: float) -> Array:
    """Integrate the deformation equations along the radius by the Runge-Kutta method (RK4).

    The steps grow with the radius: they are equal in its logarithm.
    """
    edges = _edges(start, stop, step)
    for r, after in pairwise(edges):
        h = after - r
        first, middle, last = (_at(matrix, at) for at in (r, r + h / 2, after))
        k1 = first @ y
        k2 = middle @ (y + h / 2 * k1)
        k3 = middle @ (y + h / 2 * k2)
        k4 = last @ (y + h * k3)
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return y


def _even_layers(matrix: Matrix, start: float, stop: float, y: Array, step: float) -> Array:
    """Integrate the deformation equations through homogeneous layers by matrix exponentials.

    The exponents are r M in the middle of each layer in ln r, times its thickness in ln r.
    """
    edges = _edges(start, stop, step)
    for r, after in pairwise(edges):
        middle = np.sqrt(r * after)
        y = expm(np.log(after / r) * middle * _at(matrix, middle)) @ y
    return y


def _edges(start: float, stop: float, step: float) -> Array:
    return np.geomspace(start, stop, int(np.ceil(np.log(stop / start) / step)) + 1)


def _at(matrix: Matrix, r: float) -> Array:
    """Matrix M of the elastic-gravitational equations dy/dr = M y at one radius."""
    return np.asarray(matrix(np.array([r]))[..., 0, :, :])
