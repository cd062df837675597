"""Nutation predicted from the layers of a body, by interior models of increasing detail (rungs).

Each rung adds one effect to the previous rung. The observed H is used in all, and only the last two
rungs use numbers inferred from nutation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any

import numpy as np

from earthspin.constants import COMPUTED, DAY, Constant
from earthspin.interior.equilibrium import HydrostaticFigure, figure
from earthspin.interior.layers import LayeredBody
from earthspin.interior.love import DegreeTwoLoveNumbers, elastic, solve_love_numbers
from earthspin.interior.modes import MODES, Parts, all_fluid, free_modes, mode_period, transfer
from earthspin.interior.modes import parts_of as interior_parts
from earthspin.interior.named import CORE_NUTATION, EXPONENT_RANGE, K_CMB_OUT_OF_PHASE, K_ICB
from earthspin.interior.ocean_and_anelasticity import diurnal_response, shear_modulus_change
from earthspin.numerics.arrays import Array, ComplexArray, FloatArray
from earthspin.numerics.varied_inputs import half_width, normal_medians, one_at_a_time

# --- the rungs ------------------------------------------------------------------------------------

#: Effect added by each rung, in order.
RUNGS = {
    "rigid": "a rigid body",
    "elastic": "an elastic mantle; no core",
    "fluid-core": "a fluid core of hydrostatic figure, with the inner core treated as fluid",
    "inner-core": "a solid inner core, coupled by fluid pressure and gravity",
    "ocean": "an ocean with diurnal tides from altimetry",
    "anelastic": "an anelastic mantle, softer and dissipative at diurnal periods",
    "core-ellipticity": "the core flattening for which the free core nutation has its observed "
    "period",
    "coupling": "coupling at both boundaries of the fluid core, inferred from nutation",
}
#: Additional models for comparison with the rungs.
COMPARISONS = {
    "core-in-rigid-mantle": "a fluid core in a rigid mantle",
    "hydrostatic": "the inner-core rung with the H of hydrostatic equilibrium",
}

_GAMMA = (
    "1 per cent of gamma in the term of 18.6 years; k21 of IERS Conventions (2010), table 6.5, at "
    "O1 is 0.2975, that of this sphere 0.301"
)
_RESIDUAL = "out-of-phase residual of the 13.66-day term"
#: Effects not included in the last rung, by their size in one term, mas.
LEFT_OUT = {
    "rotation and ellipticity in the compliances": Constant(0.43, "mas", None, _GAMMA, COMPUTED),
    "currents of the ocean": Constant(0.1, "mas", None, _RESIDUAL, COMPUTED),
}


@dataclass(frozen=True)
class Rung:
    """One model of the interior in the ladder, a list of models of increasing detail.

    Attributes
    ----------
    parts : callable
        Parameters of the system at body-fixed frequencies (cycles per rotation, an array).
    """

    parts: Callable[[Array], Parts]

    @property
    def core_ellipticity(self) -> float:
        """Dynamical ellipticity (C_f - A_f)/A_f of the fluid core; 0 without a core."""
        parts = self.parts(np.array(-1.0))
        return float(parts.e_f) if parts.count > 1 else 0.0

    def coupled(self, k_cmb: complex, k_icb: complex) -> Rung:
        """Return this model with additional coupling of the fluid core to mantle and inner core."""
        return replace(
            self, parts=lambda sigma: replace(self.parts(sigma), k_cmb=k_cmb, k_icb=k_icb)
        )

    def transfer(self, sigma: Array, rigid_e: float) -> Array:
        """Nutation amplitude relative to that of a rigid body, at body-fixed frequencies."""
        sigma = np.asarray(sigma, dtype=float)
        return transfer(self.parts(sigma), sigma, rigid_e)

    def modes(self, refined: bool = True) -> dict[str, complex]:
        """Body-fixed frequencies of the free modes, cycles per rotation; Im > 0 for decaying ones.

        Parameters
        ----------
        refined : bool
            Whether the body's parameters are evaluated at the period of each mode; otherwise at
            periods of 400 rotations and of one rotation.
        """
        refined_modes: dict[str, complex] = {}
        for sigma_start in (1 / 400, -1.0):
            modes = free_modes(self.parts(np.array(sigma_start)))
            group = {name: s for name, s in modes.items() if (s.real > -0.5) == (sigma_start > 0)}
            for name, s in group.items():
                refined_modes[name] = (
                    free_modes(self.parts(np.array(s.real)))[name] if refined else complex(s)
                )
        return {name: refined_modes[name] for name in MODES if name in refined_modes}


@dataclass(frozen=True)
class InteriorInputs:
    """Inputs that all models of a body's interior share: layers, ellipticity, spin and ocean.

    Attributes
    ----------
    layers : LayeredBody
    e : float
        Observed (C - A)/A, also used for the rigid body.
    spin_rate : float
        rad/s.
    ocean : float
        Contribution of the ocean to the Love number at long periods; 0 without an ocean.
    exponent : float
        Exponent of the period in the mantle's quality factor.
    diurnal_ocean : float
        Factor of the published response of the ocean at diurnal periods.
    core_nutation : float
        Observed period of the free core nutation in space, d.
    k_cmb, k_icb : complex
        Coupling constants of the core's boundaries, inferred from nutation.
    factors : mapping of str to float
        Factors of fields of `Parts` by which an interior differs from the layers.
    """

    layers: LayeredBody
    e: float
    spin_rate: float
    ocean: float = 0.0
    exponent: float = 0.0
    diurnal_ocean: float = 1.0
    core_nutation: float = CORE_NUTATION.value
    k_cmb: complex = 1j * K_CMB_OUT_OF_PHASE.value
    k_icb: complex = complex(*(part.value for part in K_ICB))
    factors: Mapping[str, float] = field(default_factory=dict)

    @property
    def figure(self) -> HydrostaticFigure:
        """Hydrostatic figure (shape and ellipticities) of the layers of the body."""
        return figure(self.layers, self.spin_rate)

    def softened(self, sigma: Array) -> DegreeTwoLoveNumbers:
        """Love numbers of the anelastic body, for diurnal frequencies or for the Chandler wobble.

        One diurnal value is used for all nutations: within the diurnal band the moduli change by a
        thousandth of their change from one second to one day.
        """
        rotation_period = 2 * np.pi / abs(self.spin_rate)
        is_wobble = bool(np.all(np.abs(sigma) < 0.5))
        period = rotation_period / float(np.mean(np.abs(sigma))) if is_wobble else rotation_period
        mu_change = complex(shear_modulus_change(period, self.exponent))
        # retrograde motion: negative frequency, so the complex conjugate
        return _love_numbers(self.layers, mu_change if is_wobble else mu_change.conjugate())


_love_numbers = lru_cache(maxsize=64)(solve_love_numbers)


def parts_of(setting: InteriorInputs, love: DegreeTwoLoveNumbers, e: float | None = None) -> Parts:
    """Ellipticities, moments and compliances that determine the nutation of a layered body.

    The internal figures are hydrostatic, except for the factors of the setting, and the outer
    ellipticity is the observed one.

    Parameters
    ----------
    setting : InteriorInputs
    love : DegreeTwoLoveNumbers
    e : float, optional
        (C - A)/A of the whole body, the observed value by default.
    """
    whole_e = setting.e if e is None else e
    parts = interior_parts(setting.layers, setting.spin_rate, love.response, whole_e)
    scaled = {name: factor * getattr(parts, name) for name, factor in setting.factors.items()}
    if "a3" in scaled:  # another excess of density, and the same gravity of the masses outside
        a3 = scaled["a3"]
        scaled |= {"a1": 1 - a3, "a2": 1 - a3 - a3 * (parts.a1 - parts.a2) / parts.a3}
    return replace(parts, **scaled)


def with_ocean(
    parts: Parts, setting: InteriorInputs, love: DegreeTwoLoveNumbers, sigma: Array
) -> Parts:
    """Add the effect of an ocean, which follows the equipotential and loads the ground.

    A wobble of the body, its core or its inner core changes the height of the equipotential above
    the ground, and thereby the sea level; by reciprocity the same coefficients give the effect of
    the water's weight.
    """
    is_slow = np.abs(sigma) < 0.5
    ocean_k2 = np.where(is_slow, setting.ocean, setting.diurnal_ocean * diurnal_response(sigma))
    ocean_k2 = ocean_k2 / love.tilt_factor[..., 0] ** 2
    tilt_product = love.tilt_factor[..., :, None] * love.tilt_factor[..., None, :]
    ocean_inertia = setting.figure.tidal_inertia * ocean_k2[..., None, None] * tilt_product
    return replace(parts, inertia=parts.inertia + ocean_inertia)


def without_core(parts: Parts) -> Parts:
    """Change the parameters of a body so that its fluid and inner core rotate with the mantle."""
    return replace(parts, fluid=0.0, inner=0.0)


def rungs_of(setting: InteriorInputs, coupling: bool = False) -> dict[str, Rung]:
    """Build all interior models: those of increasing detail (rungs), and some for comparison.

    Parameters
    ----------
    setting : InteriorInputs
    coupling : bool
        Whether to include the rung with the coupling inferred from nutation.
    """
    hydrostatic, elastic_love = setting.figure, elastic(setting.layers)
    elastic_parts = parts_of(setting, elastic_love)

    def with_ocean_parts(sigma: Array, is_anelastic: bool) -> Parts:
        love_numbers = setting.softened(sigma) if is_anelastic else elastic_love
        return with_ocean(parts_of(setting, love_numbers), setting, love_numbers, sigma)

    anelastic = Rung(lambda sigma: with_ocean_parts(sigma, is_anelastic=True))

    e_core = hydrostatic.e_core * setting.factors.get("e_f", 1.0)
    rigid_parts = replace(elastic_parts, inertia=np.zeros((3, 3)))
    rungs = {
        "rigid": Rung(lambda sigma: without_core(rigid_parts)),
        "elastic": Rung(lambda sigma: without_core(elastic_parts)),
        "fluid-core": Rung(lambda sigma: all_fluid(elastic_parts, e_core)),
        "inner-core": Rung(lambda sigma: elastic_parts),
        "ocean": Rung(lambda sigma: with_ocean_parts(sigma, is_anelastic=False)),
        "anelastic": anelastic,
        "core-ellipticity": at_observed_period(anelastic, setting),
        "core-in-rigid-mantle": Rung(lambda sigma: all_fluid(rigid_parts, e_core)),
        "hydrostatic": Rung(lambda sigma: parts_of(setting, elastic_love, hydrostatic.e)),
    }
    if coupling:
        # The coupling was inferred from the resonance of the inner core nutation, 1 + sigma about
        # a2 e_s - K: another figure of the inner core would have given another K.
        balanced = parts_of(replace(setting, factors={}), elastic_love)
        k_icb = setting.k_icb + elastic_parts.a2 * elastic_parts.e_s - balanced.a2 * balanced.e_s
        rungs["coupling"] = at_observed_period(anelastic.coupled(setting.k_cmb, k_icb), setting)
    return {name: rungs[name] for name in (*RUNGS, *COMPARISONS) if name in rungs}


def at_observed_period(rung: Rung, setting: InteriorInputs) -> Rung:
    """Adjust the core flattening of an interior model to the observed free core nutation period.

    Parameters
    ----------
    rung : Rung
        Model; its core flattening is the first estimate.
    setting : InteriorInputs
        Its observed period and spin rate are used.
    """
    observed = 1 / (setting.core_nutation * DAY * setting.spin_rate / (2 * np.pi)) - 1

    def with_core(e_f: float) -> Rung:
        return Rung(lambda sigma: replace(rung.parts(sigma), e_f=e_f))

    e_f = rung.core_ellipticity
    # each step reduces the error sevenfold, as the mode shifts slightly more than e_f
    for _ in range(8):
        model = with_core(e_f)
        mode = free_modes(model.parts(np.array(-1.0)))["free_core_nutation"].real
        e_f += mode - observed
    return with_core(e_f)


def quality(mode: complex) -> float:
    """Quality factor |Re s/(2 Im s)| of a free mode with complex frequency s; may be infinite."""
    if abs(mode.imag) < 1e-12 * abs(mode):
        return float("inf")
    return abs(mode.real / (2 * mode.imag))


# --- errors by random draws of all inputs together ------------------------------------------------
# Each quantity is interpolated by a parabola in each input (`earthspin.numerics.varied_inputs`).

#: Number of draws, and their seed.
DRAWS, SEED = 4000, 1
#: Nodes of the parabola in the anelastic exponent.
_EXPONENTS = np.linspace(*EXPONENT_RANGE, 3)

#: Relative uncertain inputs, and the field of `Parts` that each scales.
_FACTORS = {
    "k2": "inertia",
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
    setting: InteriorInputs, uncertainty: Mapping[str, float], deviations: Mapping[str, float]
) -> InteriorInputs:
    """Change inputs of the models by given multiples of their standard uncertainties.

    Parameters
    ----------
    setting : InteriorInputs
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
            field = _NUMBERS[name]
            numbers[field] = getattr(setting, field) * (1 + uncertainty[name] * z)
        elif name == "exponent":
            numbers[name] = z
        elif name.startswith("k_icb"):
            coupling += _PUBLISHED[name] * z
        else:
            numbers[name] = getattr(setting, name) + _PUBLISHED[name] * z
    return replace(setting, factors=factors, k_icb=coupling, **numbers)


def inputs_of(uncertainty: Mapping[str, float]) -> list[str]:
    """Names of the uncertain inputs, in the order of the random samples."""
    relative = [name for name in (*_FACTORS, *_NUMBERS) if uncertainty.get(name, 0.0)]
    return [*relative, *_PUBLISHED, "exponent"]


def draw(uncertainty: Mapping[str, float]) -> dict[str, FloatArray]:
    """Draw random model inputs: deviations in standard uncertainties, or values of the exponent.

    Each input takes equally probable values in random order (a Latin hypercube), so that a half-
    width due to a single input has no sampling error.
    """
    names = inputs_of(uncertainty)
    order = np.tile(np.arange(DRAWS), (len(names), 1))
    strata = np.random.default_rng(SEED).permuted(order, axis=1)
    low, high = EXPONENT_RANGE
    exponent = low + (high - low) * ((strata[-1] + 0.5) / DRAWS)
    return dict(zip(names, [*normal_medians(strata[:-1], DRAWS), exponent], strict=True))


@dataclass(frozen=True)
class Spread:
    """Interior models, each with one input changed, and weights to combine their changes.

    Attributes
    ----------
    setting : InteriorInputs
        Nominal inputs.
    rungs : dict of str to Rung
        Nominal models.
    nodes : list of (InteriorInputs, dict of str to Rung)
        Inputs with one of them changed, and their models.
    weights : ndarray, shape (nodes, draws)
        Weights of the changes at the nodes in the change of each draw.
    """

    setting: InteriorInputs
    rungs: dict[str, Rung]
    nodes: list[tuple[InteriorInputs, dict[str, Rung]]]
    weights: FloatArray

    def transfer_changes(self, name: str, frequency: FloatArray) -> ComplexArray:
        """Change of a model's transfer function for each changed input, shape (nodes, frequencies).

        The frequencies are in space, in rad/s.
        """
        sigma = frequency / self.setting.spin_rate - 1
        nominal = self.rungs[name].transfer(sigma, self.setting.e)
        return np.array(
            [rungs[name].transfer(sigma, setting.e) - nominal for setting, rungs in self.nodes]
        )

    def transfer_half_width(self, name: str, frequency: FloatArray) -> FloatArray:
        """95 % half-width of a model's transfer function at frequencies in space, rad/s."""
        return half_width(self._drawn(self.transfer_changes(name, frequency)))

    def period_half_widths(self, name: str) -> dict[str, float]:
        """95 % half-widths of the periods of a model's free modes, s."""
        nominal = self.rungs[name].modes(refined=False)
        varied = [rungs[name].modes(refined=False) for _, rungs in self.nodes]
        half_widths = {}
        for mode, s in nominal.items():
            drawn = s + self._drawn(np.array([modes[mode] - s for modes in varied]))
            period = mode_period(mode, drawn, self.setting.spin_rate)
            middle = mode_period(mode, s, self.setting.spin_rate)
            half_widths[mode] = float(half_width(period - middle))
        return half_widths

    def rms_half_width(
        self,
        name: str,
        frequency: FloatArray,
        circles: FloatArray,
        products: FloatArray,
        residual: ComplexArray,
    ) -> float:
        """95 % half-width of the rms residual, rad; the larger value of the two nutation angles.

        Parameters
        ----------
        name : str
            Model.
        frequency : ndarray, shape (k,)
            Frequencies of the circular terms in space, rad/s.
        circles : ndarray, shape (2 k, t)
            Real parts of the rigid circular terms at t days, then imaginary parts, without linear
            trends, rad.
        products : ndarray, shape (2 k, 2 k)
            Sums over the days of the products of two rows of `circles`, rad2.
        residual : ndarray, shape (t,), complex
            Nominal residual, without a linear trend, rad.
        """
        change = self.transfer_changes(name, frequency)
        shifts_of_angles = (
            np.hstack([change.real, -change.imag]),
            np.hstack([change.imag, change.real]),
        )
        half_widths = []
        for angle, shift in zip((residual.real, residual.imag), shifts_of_angles, strict=True):
            nominal = np.sum(angle * angle)
            linear = np.einsum("ni,i->n", shift, np.einsum("it,t->i", circles, angle))
            square = np.einsum("ni,mi->nm", np.einsum("ni,ij->nj", shift, products), shift)
            by_node = 2 * linear[:, np.newaxis] + np.einsum("nm,md->nd", square, self.weights)
            squares = nominal + np.sum(self.weights * by_node, axis=0)
            rms_change = np.sqrt(np.maximum(squares, 0.0)) - np.sqrt(nominal)
            half_widths.append(float(half_width(rms_change / np.sqrt(angle.size))))
        return max(half_widths)

    def _drawn(self, changes: Array) -> Array:
        """Interpolate the changes of the models to all random samples, shape (samples, ...)."""
        return np.asarray(np.einsum("nd,n...->d...", self.weights, changes))


def spread_of(
    setting: InteriorInputs, rungs: dict[str, Rung], uncertainty: Mapping[str, float]
) -> Spread:
    """Compute interior models, each with one input changed, and weights for random inputs.

    Parameters
    ----------
    setting : InteriorInputs
    rungs : dict of str to Rung
        The nominal models, as `rungs_of` gives them.
    uncertainty : mapping of str to float
        Relative standard uncertainties of the numbers of the interior.
    """
    nodes, weights = [], []
    centre = {"exponent": setting.exponent}
    for name, node, weight in one_at_a_time(draw(uncertainty), {"exponent": _EXPONENTS}, centre):
        varied = changed(setting, uncertainty, {name: node})
        nodes.append((varied, rungs_of(varied, "coupling" in rungs)))
        weights.append(weight)
    return Spread(setting, rungs, nodes, np.array(weights))
