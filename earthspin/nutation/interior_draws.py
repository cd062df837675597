"""Errors of nutation models from their uncertain inputs, by random draws of all inputs together.

The models are not computed for every draw: each quantity is interpolated by a parabola in each
input, and the changes by the inputs are added. A half-width is the change that 95 % of the draws
do not exceed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from earthspin.constants import DAYS_PER_CENTURY
from earthspin.interior.modes import mode_period
from earthspin.interior.named import CORE_NUTATION, EXPONENT_RANGE, K_CMB_OUT_OF_PHASE, K_ICB
from earthspin.numerics.arrays import Array, ComplexArray, FloatArray
from earthspin.numerics.polynomials import lagrange
from earthspin.nutation.ladder import Rung, Setting, climb

#: Number of draws, and their seed.
DRAWS, SEED = 4000, 1
#: Nodes of the parabola of a normal input in standard deviations: those of Gauss's rule of three
#: points, by which mean and variance of a parabola are exact.
_NODES = np.array([-np.sqrt(3.0), 0.0, np.sqrt(3.0)])
#: Nodes of the parabola in the anelastic exponent.
_EXPONENTS = np.linspace(*EXPONENT_RANGE, 3)

#: Relative uncertain inputs, and the field of `Parts` that each scales.
_FACTORS = {
    "k2": "answers",
    "core_fraction": "fluid",
    "core_ellipticity": "e_f",
    "inner_core_fraction": "inner",
    "inner_core_ellipticity": "e_s",
    "inner_core_excess": "a3",
}
#: Relative uncertain inputs that are numbers of the setting.
_NUMBERS = {"ellipticity": "e", "ocean": "ocean", "diurnal_ocean": "diurnal_ocean"}
#: Inputs that are published with their uncertainty, in these units.
_PUBLISHED = {
    "core_nutation": CORE_NUTATION.uncertainty or 0.0,
    "k_cmb": 1j * (K_CMB_OUT_OF_PHASE.uncertainty or 0.0),
    "k_icb_in_phase": K_ICB[0].uncertainty or 0.0,
    "k_icb_out_of_phase": 1j * (K_ICB[1].uncertainty or 0.0),
}


def changed(
    setting: Setting, uncertainty: Mapping[str, float], deviations: Mapping[str, float]
) -> Setting:
    """Change inputs of the models by given multiples of their standard uncertainties.

    Parameters
    ----------
    setting : Setting
    uncertainty : mapping of str to float
        Relative standard uncertainties of the numbers of the interior.
    deviations : mapping of str to float
        Deviations from the nominal values in standard uncertainties, by the names of `inputs_of`;
        for the anelastic exponent its value.
    """
    numbers: dict[str, Any] = {}
    factors = dict(setting.factors)
    coupling = setting.k_icb
    for name, z in deviations.items():
        if name in _FACTORS:
            factors[_FACTORS[name]] = 1 + uncertainty[name] * z
        elif name in _NUMBERS:
            own = _NUMBERS[name]
            numbers[own] = getattr(setting, own) * (1 + uncertainty[name] * z)
        elif name == "exponent":
            numbers[name] = z
        elif name.startswith("k_icb"):
            coupling += _PUBLISHED[name] * z
        else:
            numbers[name] = getattr(setting, name) + _PUBLISHED[name] * z
    return replace(setting, factors=factors, k_icb=coupling, **numbers)


def inputs_of(uncertainty: Mapping[str, float]) -> list[str]:
    """Names of the uncertain inputs, in the order in which they are drawn."""
    relative = [name for name in (*_FACTORS, *_NUMBERS) if uncertainty.get(name, 0.0)]
    return [*relative, *_PUBLISHED, "exponent"]


def draw(
    uncertainty: Mapping[str, float], draws: int = DRAWS, seed: int = SEED
) -> dict[str, FloatArray]:
    """Draw deviations of all uncertain inputs, in the units of `changed`, shape (draws,) each.

    Each input takes equally probable values in random order (a Latin hypercube), so that a half-
    width due to a single input has no sampling error.
    """
    from scipy.special import ndtri

    generator = np.random.default_rng(seed)
    names = inputs_of(uncertainty)
    below = (generator.permuted(np.tile(np.arange(draws), (len(names), 1)), axis=1) + 0.5) / draws
    low, high = EXPONENT_RANGE
    return dict(zip(names, [*ndtri(below[:-1]), low + (high - low) * below[-1]], strict=True))


@dataclass(frozen=True)
class Spread:
    """Models of the interior with one input changed each, and the weights that combine them.

    Attributes
    ----------
    setting : Setting
        Nominal inputs.
    rungs : dict of str to Rung
        Nominal models.
    nodes : list of (Setting, dict of str to Rung)
        Inputs with one of them changed, and their models.
    weights : ndarray, shape (nodes, draws)
        Weights of the changes at the nodes in the change of each draw.
    """

    setting: Setting
    rungs: dict[str, Rung]
    nodes: list[tuple[Setting, dict[str, Rung]]]
    weights: FloatArray

    def transfer_changes(self, name: str, frequency: FloatArray) -> ComplexArray:
        """Change of a model's transfer function at each node, shape (nodes, frequencies).

        The frequencies are in space, in rad/s.
        """
        sigma = frequency / self.setting.spin_rate - 1
        nominal = self.rungs[name].transfer(sigma, self.setting.e)
        return np.array(
            [rungs[name].transfer(sigma, setting.e) - nominal for setting, rungs in self.nodes]
        )

    def transfer_half_width(self, name: str, frequency: FloatArray) -> FloatArray:
        """95 % half-width of a model's transfer function at frequencies in space, rad/s."""
        return _half_width(self._drawn(self.transfer_changes(name, frequency)))

    def period_half_widths(self, name: str) -> dict[str, float]:
        """95 % half-widths of the periods of a model's free modes, s."""
        nominal = self.rungs[name].modes(refined=False)
        varied = [rungs[name].modes(refined=False) for _, rungs in self.nodes]
        half_widths = {}
        for mode, s in nominal.items():
            drawn = s + self._drawn(np.array([modes[mode] - s for modes in varied]))
            period = mode_period(mode, drawn, self.setting.spin_rate)
            middle = mode_period(mode, s, self.setting.spin_rate)
            half_widths[mode] = float(_half_width(period - middle))
        return half_widths

    def rms_half_width(
        self,
        name: str,
        frequency: FloatArray,
        circles: ComplexArray,
        residual: ComplexArray,
        days: FloatArray,
    ) -> float:
        """95 % half-width of the root mean square of a residual, the larger of both angles, rad.

        Parameters
        ----------
        name : str
            Model.
        frequency : ndarray, shape (k,)
            Frequencies of the circular terms in space, rad/s.
        circles : ndarray, shape (k, t), complex
            Rigid circular terms at the days, rad.
        residual : ndarray, shape (t,), complex
            Nominal residual, without a linear trend, rad.
        days : ndarray, shape (t,)
        """
        from earthspin.nutation.circles import without_line

        shifts = np.einsum("nk,kt->tn", self.transfer_changes(name, frequency), circles)
        shifts = without_line(days / DAYS_PER_CENTURY, np.hstack([shifts.real, shifts.imag]))
        factors = np.vstack([np.ones(self.weights.shape[1]), self.weights])
        half_widths = []
        for angle, shift in zip(
            (residual.real, residual.imag), np.split(shifts, 2, axis=1), strict=True
        ):
            series = np.column_stack([angle, shift])
            products = np.einsum("ti,tj->ij", series, series) / len(days)
            squares = np.einsum("id,ij,jd->d", factors, products, factors, optimize=True)
            change = np.sqrt(np.maximum(squares, 0.0)) - np.sqrt(products[0, 0])
            half_widths.append(float(_half_width(change)))
        return max(half_widths)

    def _drawn(self, changes: Array) -> Array:
        """Changes of all draws from those at the nodes, shape (draws, ...)."""
        return np.asarray(np.einsum("nd,n...->d...", self.weights, changes))


def _half_width(changes: Array) -> FloatArray:
    """Change that 95 % of the draws do not exceed, along the first axis."""
    return np.asarray(np.quantile(np.abs(changes), 0.95, axis=0))


def spread_of(setting: Setting, rungs: dict[str, Rung], uncertainty: Mapping[str, float]) -> Spread:
    """Compute the models at the nodes of all uncertain inputs, and draw the inputs.

    Parameters
    ----------
    setting : Setting
    rungs : dict of str to Rung
        The nominal models, as `climb` gives them.
    uncertainty : mapping of str to float
        Relative standard uncertainties of the numbers of the interior.
    """
    nodes, weights = [], []
    for name, values in draw(uncertainty).items():
        places, nominal = (_EXPONENTS, setting.exponent) if name == "exponent" else (_NODES, 0.0)
        basis = lagrange(places, values) - lagrange(places, np.array([nominal]))
        for place, weight in zip(places, basis, strict=True):
            if place != nominal:
                varied = changed(setting, uncertainty, {name: float(place)})
                nodes.append((varied, climb(varied, "coupling" in rungs)))
                weights.append(weight)
    return Spread(setting, rungs, nodes, np.array(weights))
