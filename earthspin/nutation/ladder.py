"""The nutation of a body predicted from its layers, rung by rung.

Each rung adds one thing to the rung before; the one number of precession, H, is as observed
throughout, and nothing is fitted to nutation before the rung that says so.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import COMPUTED, DAY, NORMAL_95, Constant
from earthspin.interior.anelastic import anelastic_strain
from earthspin.interior.diurnal_ocean import diurnal_response
from earthspin.interior.equilibrium import Figure, figure
from earthspin.interior.layers import LayeredBody
from earthspin.interior.love import Yielding, elastic, yielding
from earthspin.interior.modes import MODES, Parts, all_fluid, free_modes, transfer
from earthspin.interior.modes import parts_of as interior_parts
from earthspin.interior.published import CORE_NUTATION, K_CMB, K_ICB

Array = NDArray[Any]

#: What each rung adds, in the order in which it is added.
RUNGS = {
    "rigid": "a rigid body",
    "elastic": "a mantle that yields; no core",
    "fluid-core": "a fluid core of hydrostatic figure, the inner core counted with it",
    "inner-core": "a solid inner core, tilted and turned by the fluid and by gravity",
    "ocean": "an ocean that follows the tides of a day, as altimetry has them",
    "anelastic": "a mantle softer at a day than for seismic waves, and that loses energy",
    "core-ellipticity": "one observed number: the flattening of the core at which its nutation "
    "has the observed period",
    "coupling": "coupling at both boundaries of the fluid core; inferred from nutation itself",
}
#: Models beside the ladder, from which one learns what the rungs are for.
BESIDE = {
    "core-in-rigid-mantle": "a fluid core in a mantle that does not yield",
    "hydrostatic": "the inner-core rung, H too of a body in hydrostatic equilibrium",
}
#: Rungs that take a number from the observed nutations.
INFERRED = ("core-ellipticity", "coupling")

#: What the last rung leaves out, by what it does to one term, mas.
LEFT_OUT = {
    "rotation and ellipticity in the answers": Constant(
        0.43, "mas", None,
        "1 per cent of gamma in the term of 18.6 years; k21 of IERS Conventions (2010), table 6.5, "
        "at O1 is 0.2975, that of this sphere 0.301",
        COMPUTED,
    ),
    "currents of the ocean": Constant(
        0.1, "mas", None, "what remains in the term of 13.66 days, out of phase", COMPUTED
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Rung:
    """One model of the inside.

    Attributes
    ----------
    parts : callable
        Of frequencies in the body (turns per turn, an array), what the system stands on there.
    observed_core : bool
        Whether the flattening of the core is that of its observed nutation.
    """

    parts: Callable[[Array], Parts]
    observed_core: bool = False

    @property
    def core_ellipticity(self) -> float:
        """(C_f - A_f)/A_f of the fluid core; 0 without a core."""
        parts = self.parts(np.array(-1.0))
        return float(parts.e_f) if parts.count > 1 else 0.0

    def coupled(self, k_cmb: complex, k_icb: complex) -> Rung:
        """The model with its fluid core coupled to mantle and inner core beside their figures."""
        return replace(
            self, parts=lambda sigma: replace(self.parts(sigma), k_cmb=k_cmb, k_icb=k_icb)
        )

    def transfer(self, sigma: Array, rigid_e: float) -> Array:
        """Nutation over that of a rigid body at frequencies in the body."""
        sigma = np.asarray(sigma, dtype=float)
        return transfer(self.parts(sigma), sigma, rigid_e)

    def modes(self, refined: bool = True) -> dict[str, complex]:
        """Frequencies of the free modes in the body, turns per turn; Im > 0 decays.

        Parameters
        ----------
        refined : bool
            Whether the body is taken as it is at each mode's own period; else at 400 turns and at
            one.
        """
        found: dict[str, complex] = {}
        for near in (1 / 400, -1.0):
            modes = free_modes(self.parts(np.array(near)))
            own = {name: s for name, s in modes.items() if (s.real > -0.5) == (near > 0)}
            for name, s in own.items():
                found[name] = (
                    free_modes(self.parts(np.array(s.real)))[name] if refined else complex(s)
                )
        return {name: found[name] for name in MODES if name in found}

    def uncertain(self, relative: Mapping[str, float]) -> list[tuple[Rung, Rung]]:
        """The model with each uncertain input larger and smaller by a 95 % half-width.

        Parameters
        ----------
        relative : mapping
            One standard deviation over value, of `k2` (all answers are scaled with it),
            `core_fraction` and `core_ellipticity`; the last is not used where it is observed.
        """
        shares = {name: NORMAL_95 * relative.get(name, 0.0) for name in _INPUTS}
        if self.observed_core:
            shares["core_ellipticity"] = NORMAL_95 * CORE_NUTATION.relative_uncertainty
        return [
            (self._scaled(field, share), self._scaled(field, -share))
            for field, share in zip(_INPUTS.values(), shares.values(), strict=True)
        ]

    def _scaled(self, field: str, share: float) -> Rung:
        def parts(sigma: Array) -> Parts:
            own = self.parts(sigma)
            return replace(own, **{field: (1 + share) * getattr(own, field)})

        return replace(self, parts=parts)

    def mode_half_widths(self, relative: Mapping[str, float]) -> dict[str, float]:
        """95 % half-widths of the frequencies of the free modes, by name; real parts."""
        own = self.modes(refined=False)
        varied = [[rung.modes(refined=False) for rung in pair] for pair in self.uncertain(relative)]
        found = {}
        for name in own:
            # an observed core nutation is as sure as its observation, whatever else is changed
            of = varied[-1:] if self.observed_core and name == "free_core_nutation" else varied
            changes = [(up[name] - down[name]).real for up, down in of]
            found[name] = float(np.linalg.norm(changes) / 2)
        return found

    def transfer_half_width(
        self, sigma: Array, rigid_e: float, relative: Mapping[str, float]
    ) -> Array:
        """95 % half-width of T at frequencies in the body."""
        pairs = [[rung.transfer(sigma, rigid_e) for rung in p] for p in self.uncertain(relative)]
        squares = np.sum([np.abs(up - down) ** 2 for up, down in pairs], axis=0)
        return np.asarray(np.sqrt(squares) / 2)


#: Inputs with an uncertainty, and the field of the system that each scales.
_INPUTS = {"k2": "answers", "core_fraction": "fluid", "core_ellipticity": "e_f"}


@dataclass(frozen=True)
class Setting:
    """What all rungs share.

    Attributes
    ----------
    layers : LayeredBody
    e : float
        Observed (C - A)/A, of the rigid body too.
    spin_rate : float
        rad/s.
    ocean : float
        Love number that the ocean adds at long periods; 0 for a body without one.
    exponent : float
        Of the period, in the mantle's loss.
    """

    layers: LayeredBody
    e: float
    spin_rate: float
    ocean: float = 0.0
    exponent: float = 0.0

    @property
    def figure(self) -> Figure:
        """Of hydrostatic equilibrium."""
        return figure(self.layers, self.spin_rate)

    def softened(self, sigma: Array) -> Yielding:
        """Love numbers at frequencies in the body, of a day or of the slow wobble.

        All nutations are taken at a day: over the band of the tides the moduli change by a
        thousandth of what they do from a second to a day.
        """
        turn = 2 * np.pi / abs(self.spin_rate)
        slow = bool(np.all(np.abs(sigma) < 0.5))
        period = turn / float(np.mean(np.abs(sigma))) if slow else turn
        strain = complex(anelastic_strain(period, self.exponent))
        # The loss of a turn against the body's own is that of a negative frequency.
        return _yielding(self.layers, strain if slow else strain.conjugate())


@lru_cache(maxsize=64)
def _yielding(layers: LayeredBody, strain: complex) -> Yielding:
    return yielding(layers, strain)


def parts_of(setting: Setting, love: Yielding, e: float | None = None) -> Parts:
    """All parts of the body, with its hydrostatic figure inside and its observed one outside.

    Parameters
    ----------
    setting : Setting
    love : Yielding
    e : float, optional
        (C - A)/A of the whole, the observed one by default.
    """
    whole = setting.e if e is None else e
    return interior_parts(setting.layers, setting.spin_rate, love.answers, whole)


def with_ocean(parts: Parts, setting: Setting, love: Yielding, sigma: Array) -> Parts:
    """Add an ocean: it follows the level surface above the ground, and the ground its weight.

    Whatever lifts the one above the other, a wobble of the body, of its core, of its inner core,
    lifts the sea in the same way, and by reciprocity its weight answers in the same way.
    """
    slow = np.abs(sigma) < 0.5
    added = np.where(slow, setting.ocean, diurnal_response(sigma)) / love.lift[..., 0] ** 2
    lift = love.lift[..., :, None] * love.lift[..., None, :]
    water = setting.figure.unit * added[..., None, None] * lift
    return replace(parts, answers=parts.answers + water)


def without_core(parts: Parts) -> Parts:
    """The same mantle over nothing that turns by itself."""
    return replace(parts, fluid=0.0, inner=0.0)


def climb(setting: Setting, coupling: bool = False) -> dict[str, Rung]:
    """All rungs, and the models beside the ladder.

    Parameters
    ----------
    setting : Setting
    coupling : bool
        Whether the rung is there that takes the coupling of the core from nutation.
    """
    f, love = setting.figure, elastic(setting.layers)
    firm = parts_of(setting, love)

    def wet(sigma: Array, soft: bool) -> Parts:
        yields = setting.softened(sigma) if soft else love
        return with_ocean(parts_of(setting, yields), setting, yields, sigma)

    anelastic = Rung(lambda sigma: wet(sigma, soft=True))

    stiff = replace(firm, answers=np.zeros((3, 3)))
    found = {
        "rigid": Rung(lambda sigma: without_core(stiff)),
        "elastic": Rung(lambda sigma: without_core(firm)),
        "fluid-core": Rung(lambda sigma: all_fluid(firm, f.e_core)),
        "inner-core": Rung(lambda sigma: firm),
        "ocean": Rung(lambda sigma: wet(sigma, soft=False)),
        "anelastic": anelastic,
        "core-ellipticity": at_observed_period(anelastic, setting.spin_rate),
        "core-in-rigid-mantle": Rung(lambda sigma: all_fluid(stiff, f.e_core)),
        "hydrostatic": Rung(lambda sigma: parts_of(setting, love, f.e)),
    }
    if coupling:
        coupled = anelastic.coupled(*(complex(k[0].value, k[1].value) for k in (K_CMB, K_ICB)))
        found["coupling"] = at_observed_period(coupled, setting.spin_rate)
    return {name: found[name] for name in (*RUNGS, *BESIDE) if name in found}


def at_observed_period(rung: Rung, spin_rate: float) -> Rung:
    """A rung with the core as flat as its observed nutation asks for.

    Parameters
    ----------
    rung : Rung
        Its own flattening of the core is where the search begins.
    spin_rate : float
        rad/s.
    """
    wanted = 1 / (CORE_NUTATION.value * DAY * spin_rate / (2 * np.pi)) - 1

    def with_core(e_f: float) -> Rung:
        return Rung(lambda sigma: replace(rung.parts(sigma), e_f=e_f), observed_core=True)

    e_f = rung.core_ellipticity
    for _ in range(8):  # each step leaves a seventh: the mode moves a little more than e_f does
        found = with_core(e_f)
        mode = free_modes(found.parts(np.array(-1.0)))["free_core_nutation"].real
        e_f += mode - wanted
    return with_core(e_f)


def quality(mode: complex) -> float:
    """Quality factor of a free mode, Re s/(2 Im s); infinite where nothing is lost."""
    if abs(mode.imag) < 1e-12 * abs(mode):
        return float("inf")
    return abs(mode.real / (2 * mode.imag))
