"""Nutation predicted from the layers of a body, by interior models of increasing detail (rungs).

Each rung adds one effect to the previous rung. The observed H is used in all, and only the last two
rungs use numbers inferred from nutation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np

from earthspin.constants import COMPUTED, DAY, Constant
from earthspin.interior.equilibrium import Figure, figure
from earthspin.interior.layers import LayeredBody
from earthspin.interior.love import Yielding, elastic, yielding
from earthspin.interior.modes import MODES, Parts, all_fluid, free_modes, transfer
from earthspin.interior.modes import parts_of as interior_parts
from earthspin.interior.named import CORE_NUTATION, K_CMB_OUT_OF_PHASE, K_ICB
from earthspin.interior.ocean_and_anelasticity import anelastic_strain, diurnal_response
from earthspin.numerics.arrays import Array

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
BESIDE = {
    "core-in-rigid-mantle": "a fluid core in a rigid mantle",
    "hydrostatic": "the inner-core rung with the H of hydrostatic equilibrium",
}

#: Effects not included in the last rung, by their size in one term, mas.
LEFT_OUT = {
    "rotation and ellipticity in the compliances": Constant(
        0.43, "mas", None,
        "1 per cent of gamma in the term of 18.6 years; k21 of IERS Conventions (2010), table 6.5, "
        "at O1 is 0.2975, that of this sphere 0.301",
        COMPUTED,
    ),
    "currents of the ocean": Constant(
        0.1, "mas", None, "out-of-phase residual of the 13.66-day term", COMPUTED
    ),
}  # fmt: skip


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
        """Return the model with additional coupling of the fluid core to mantle and inner core."""
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
        for near in (1 / 400, -1.0):
            modes = free_modes(self.parts(np.array(near)))
            nearby = {name: s for name, s in modes.items() if (s.real > -0.5) == (near > 0)}
            for name, s in nearby.items():
                refined_modes[name] = (
                    free_modes(self.parts(np.array(s.real)))[name] if refined else complex(s)
                )
        return {name: refined_modes[name] for name in MODES if name in refined_modes}


@dataclass(frozen=True)
class Setting:
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
    def figure(self) -> Figure:
        """Hydrostatic figure (shape and ellipticities) of the layers of the body."""
        return figure(self.layers, self.spin_rate)

    def softened(self, sigma: Array) -> Yielding:
        """Love numbers of the anelastic body, for diurnal frequencies or for the Chandler wobble.

        One diurnal value is used for all nutations: within the diurnal band the moduli change by a
        thousandth of their change from one second to one day.
        """
        turn = 2 * np.pi / abs(self.spin_rate)
        slow = bool(np.all(np.abs(sigma) < 0.5))
        period = turn / float(np.mean(np.abs(sigma))) if slow else turn
        strain = complex(anelastic_strain(period, self.exponent))
        # retrograde motion: negative frequency, so the complex conjugate
        return _yielding(self.layers, strain if slow else strain.conjugate())


_yielding = lru_cache(maxsize=64)(yielding)


def parts_of(setting: Setting, love: Yielding, e: float | None = None) -> Parts:
    """Ellipticities, moments and compliances that determine the nutation of a layered body.

    The internal figures are hydrostatic, except for the factors of the setting, and the outer
    ellipticity is the observed one.

    Parameters
    ----------
    setting : Setting
    love : Yielding
    e : float, optional
        (C - A)/A of the whole body, the observed value by default.
    """
    whole = setting.e if e is None else e
    parts = interior_parts(setting.layers, setting.spin_rate, love.answers, whole)
    changed = {name: factor * getattr(parts, name) for name, factor in setting.factors.items()}
    if "a3" in changed:  # another excess of density, and the same gravity of the masses outside
        a3 = changed["a3"]
        changed |= {"a1": 1 - a3, "a2": 1 - a3 - a3 * (parts.a1 - parts.a2) / parts.a3}
    return replace(parts, **changed)


def with_ocean(parts: Parts, setting: Setting, love: Yielding, sigma: Array) -> Parts:
    """Add the effect of an ocean, which follows the equipotential and loads the ground.

    A wobble of the body, its core or its inner core changes the height of the equipotential above
    the ground, and thereby the sea level; by reciprocity the same coefficients give the effect of
    the water's weight.
    """
    slow = np.abs(sigma) < 0.5
    added = np.where(slow, setting.ocean, setting.diurnal_ocean * diurnal_response(sigma))
    added = added / love.lift[..., 0] ** 2
    lift = love.lift[..., :, None] * love.lift[..., None, :]
    water = setting.figure.unit * added[..., None, None] * lift
    return replace(parts, answers=parts.answers + water)


def without_core(parts: Parts) -> Parts:
    """Change the parameters of a body so that its fluid and inner core rotate with the mantle."""
    return replace(parts, fluid=0.0, inner=0.0)


def climb(setting: Setting, coupling: bool = False) -> dict[str, Rung]:
    """Build all interior models: those of increasing detail (rungs), and some for comparison.

    Parameters
    ----------
    setting : Setting
    coupling : bool
        Whether to include the rung with the coupling inferred from nutation.
    """
    f, love = setting.figure, elastic(setting.layers)
    firm = parts_of(setting, love)

    def wet(sigma: Array, soft: bool) -> Parts:
        yields = setting.softened(sigma) if soft else love
        return with_ocean(parts_of(setting, yields), setting, yields, sigma)

    anelastic = Rung(lambda sigma: wet(sigma, soft=True))

    e_core = f.e_core * setting.factors.get("e_f", 1.0)
    stiff = replace(firm, answers=np.zeros((3, 3)))
    rungs = {
        "rigid": Rung(lambda sigma: without_core(stiff)),
        "elastic": Rung(lambda sigma: without_core(firm)),
        "fluid-core": Rung(lambda sigma: all_fluid(firm, e_core)),
        "inner-core": Rung(lambda sigma: firm),
        "ocean": Rung(lambda sigma: wet(sigma, soft=False)),
        "anelastic": anelastic,
        "core-ellipticity": at_observed_period(anelastic, setting),
        "core-in-rigid-mantle": Rung(lambda sigma: all_fluid(stiff, e_core)),
        "hydrostatic": Rung(lambda sigma: parts_of(setting, love, f.e)),
    }
    if coupling:
        # The coupling was inferred from the resonance of the inner core nutation, 1 + sigma about
        # a2 e_s - K: another figure of the inner core would have given another K.
        hydrostatic = parts_of(replace(setting, factors={}), love)
        k_icb = setting.k_icb + firm.a2 * firm.e_s - hydrostatic.a2 * hydrostatic.e_s
        rungs["coupling"] = at_observed_period(anelastic.coupled(setting.k_cmb, k_icb), setting)
    return {name: rungs[name] for name in (*RUNGS, *BESIDE) if name in rungs}


def at_observed_period(rung: Rung, setting: Setting) -> Rung:
    """Adjust the core flattening of an interior model to the observed free core nutation period.

    Parameters
    ----------
    rung : Rung
        Model; its core flattening is the first estimate.
    setting : Setting
        Its observed period and spin rate are used.
    """
    wanted = 1 / (setting.core_nutation * DAY * setting.spin_rate / (2 * np.pi)) - 1

    def with_core(e_f: float) -> Rung:
        return Rung(lambda sigma: replace(rung.parts(sigma), e_f=e_f))

    e_f = rung.core_ellipticity
    # each step reduces the error sevenfold, as the mode shifts slightly more than e_f
    for _ in range(8):
        model = with_core(e_f)
        mode = free_modes(model.parts(np.array(-1.0)))["free_core_nutation"].real
        e_f += mode - wanted
    return with_core(e_f)


def quality(mode: complex) -> float:
    """Quality factor of a free mode with complex frequency s, Re s/(2 Im s); it may be infinite."""
    if abs(mode.imag) < 1e-12 * abs(mode):
        return float("inf")
    return abs(mode.real / (2 * mode.imag))
