"""On what the resonance of the core rests, in IAU 2000A and in the ladder of nutation.

The response that is fitted to IAU 2000A is changed in one way at a time: what its authors add to a
response left in, its mode held where it was built in, the predicted response of the ladder in the
place of IAU 2000A. And the last rung of the ladder is compared with IAU 2000A: without the coupling
of the inner core, without what is added; by how much the strength of the core's resonance would
have to differ, and what its parts do.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

import earthspin
from earthspin import EARTH
from earthspin.constants import DAY, DAYS_PER_CENTURY, MAS, UAS
from earthspin.engine.plan import plan_parts
from earthspin.interior.named import ANELASTIC_EXPONENT
from earthspin.interior.published import K_CMB
from earthspin.nutation.circles import without_line
from earthspin.nutation.ladder import at_observed_period, quality
from earthspin.nutation.response import CORE_NUTATION_START, Response, fit_response
from earthspin.parts.predicted import Prediction, predict
from earthspin.sky import iau

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

#: The mode that is built into IAU 2000A, as IERS Conventions (2010), table 6.4, have it.
BUILT_IN = complex(*CORE_NUTATION_START)
#: The half year, retrograde.
HALF_YEAR = (0, 0, -2, 2, -2)
#: The terms to which most is added.
ADDED_TO = {
    "prograde year": (0, 1, 0, 0, 0),
    "retrograde year": (0, -1, 0, 0, 0),
    "prograde 18.6 years": (0, 0, 0, 0, -1),
}
#: Rigid terms of REN-2000 (Souchay et al. 1999) as a public VLBI code has them (SGDASS,
#: vtd/include/ren2000_heo.i), with what a century and a half does not part from them, at J2000.0:
#: in phase and out of phase, uas.
REN_2000: dict[tuple[int, ...], complex] = {
    (0, -1, 0, 0, 0): complex(-25235.1, 164.8),
    (0, 1, 0, 0, 0): complex(17060.4, -3865.5),
    (0, 0, -2, 2, -2): complex(-22311.7, 134.3),
}
#: Its dynamical flattening, of which ours is so many times as large.
OVER_REN_2000 = 1.00001225


@dataclass(frozen=True)
class Terms:
    """Circular terms without geodesic nutation.

    Attributes
    ----------
    multiples : ndarray, shape (k, 5)
    frequency : ndarray, shape (k,)
        In space, rad/s.
    rigid, iau : ndarray, shape (k,), complex
        Of torques on a rigid Earth, and of IAU 2000A, rad.
    added : ndarray, shape (k,), complex
        What the authors of IAU 2000A add to a response, rad.
    """

    multiples: NDArray[np.int64]
    frequency: FloatArray
    rigid: ComplexArray
    iau: ComplexArray
    added: ComplexArray

    def place(self, multiple: Sequence[int]) -> int:
        """Where a term stands."""
        return int(np.flatnonzero(np.all(self.multiples == multiple, axis=1))[0])

    def all_but(self, without: Sequence[Sequence[int]]) -> NDArray[np.bool_]:
        """Which terms are left if some are left out."""
        there = np.ones(len(self.frequency), dtype=bool)
        there[[self.place(multiple) for multiple in without]] = False
        return there


@cache
def terms() -> Terms:
    """Those of the comparison with the IAU."""
    planned = plan_parts(earthspin.load_scene("iau"), ["core"])
    values = planned.question.keys()
    for step in planned.parts:
        if "response_apart" not in values:
            there = (*step.needs, *(name for name in step.uses if name in values))
            values[step.name] = step(**{name: values[name] for name in there})
    apart, circles = values["response_apart"], values["pole_analysis"].our_circles
    iau = apart.left + apart.response.transfer(circles.frequency) * apart.rigid
    return Terms(circles.multiples, circles.frequency, apart.rigid, iau, apart.added)


def fitted(real: ComplexArray, without: Sequence[Sequence[int]] = ()) -> Response:
    """Response fitted to amplitudes of all terms but some."""
    known = terms()
    used = known.all_but(without)
    h, spin = EARTH.number("dynamical_flattening"), float(EARTH.spin_rate)
    return fit_response(known.frequency[used], known.rigid[used], real[used], h, spin)


def blind() -> Response:
    """Response fitted to IAU 2000A where most is added left out, and nothing taken away."""
    return fitted(terms().iau, list(ADDED_TO.values()))


def held(mode: complex) -> Response:
    """The same with the mode of the core held."""
    known = terms()
    columns = []
    for strength in np.eye(4, dtype=complex):
        response = replace(blind(), core_nutation=mode, strengths=strength)
        columns.append(response.transfer(known.frequency))
    base = replace(blind(), core_nutation=mode, strengths=np.zeros(4, dtype=complex))
    none = base.transfer(known.frequency)
    design = (np.array(columns).T - none[:, np.newaxis]) * known.rigid[:, np.newaxis]
    left = known.iau - none * known.rigid
    used = known.all_but(list(ADDED_TO.values()))
    strengths = np.linalg.lstsq(design[used], left[used], rcond=None)[0]
    return replace(base, strengths=np.asarray(strengths, dtype=np.complex128))


def beside_ren_2000(multiple: Sequence[int]) -> float:
    """How far our rigid term is from that of REN-2000, uas."""
    known = terms()
    own = 1j * known.rigid[known.place(multiple)] / OVER_REN_2000 / UAS
    return float(abs(own - REN_2000[tuple(multiple)]))


def left_by(response: Response, multiple: Sequence[int]) -> complex:
    """What a response leaves of a term of IAU 2000A, in phase and out of phase, uas."""
    known = terms()
    left = known.iau - response.transfer(known.frequency) * known.rigid
    return complex(1j * left[known.place(multiple)] / UAS)


# --- the last rung -------------------------------------------------------------------------------


@cache
def _models() -> Prediction:
    return predict(EARTH, True, ANELASTIC_EXPONENT.value)


def predicted(rung: str) -> ComplexArray:
    """Terms of a rung of the ladder, rad."""
    return np.asarray(_models().transfer(rung, terms().frequency) * terms().rigid)


def in_time(amplitude: ComplexArray) -> tuple[float, float]:
    """Sizes of dpsi sin(eps) and deps from 1980 to 2020 less a line, of circles, rms, mas."""
    days = np.arange(-20 * 365.25, 20 * 365.25, 5.0)
    eta = amplitude @ np.exp(1j * (terms().multiples @ iau.delaunay_arguments(days)))
    angles = without_line(days / DAYS_PER_CENTURY, np.stack([eta.real, eta.imag], axis=1))
    first, second = np.sqrt(np.mean(angles**2, axis=0)) / MAS
    return float(first), float(second)


def coupled_to_mantle_alone() -> ComplexArray:
    """Terms of the last rung without what couples core and inner core, rad."""
    known, models = terms(), _models()
    alone = models.rungs["anelastic"].coupled(complex(*(k.value for k in K_CMB)), 0.0)
    rung = at_observed_period(alone, models.spin_rate)
    return np.asarray(rung.transfer(known.frequency / models.spin_rate - 1, models.e) * known.rigid)


def core_mode(rung: str) -> complex:
    """Frequency of the core nutation of a rung, turns per turn."""
    return _models().rungs[rung].modes()["free_core_nutation"]


def quality_without_the_sea(rung: str = "coupling") -> float:
    """Quality factor of the core nutation less what the sea alone takes: losses add up."""
    return 1 / (1 / quality(core_mode(rung)) - 1 / quality(core_mode("ocean")))


@dataclass(frozen=True)
class Strength:
    """By how much the strength of the core's resonance in a rung would have to differ.

    Attributes
    ----------
    change : complex
        Over the strength.
    before, after : float
        What the rung leaves of IAU 2000A less what is added to it, in each angle, root sum of
        squares of the terms, mas; as it is, and with that change.
    """

    change: complex
    before: float
    after: float


def strength(rung: str = "coupling") -> Strength:
    """Least squares for one complex number."""
    known, model = terms(), _models().rungs[rung]
    unit = replace(
        blind(), core_nutation=core_mode(rung), strengths=np.array([0, 0, 1.0, 0], complex)
    )
    none = replace(unit, strengths=np.zeros(4, complex))
    column = (unit.transfer(known.frequency) - none.transfer(known.frequency)) * known.rigid
    left = known.iau - known.added - predicted(rung)
    wanted = np.vdot(column, left) / np.vdot(column, column)
    # The strength is the residue: from the response around the mode.
    mode = core_mode(rung)
    near = mode.real + 1e-5 * np.array([-2.0, -1.0, 1.0, 2.0])
    unit_near = np.array([unit.transfer((n + 1) * unit.spin_rate) for n in near])
    none_near = np.array([none.transfer((n + 1) * unit.spin_rate) for n in near])
    resonance = np.stack([unit_near - none_near, none_near * (1 + near)], axis=-1)
    residue = np.linalg.lstsq(resonance, model.transfer(near, _models().e), rcond=None)[0][0]

    def size(values: ComplexArray) -> float:
        return float(np.sqrt(np.sum(abs(values) ** 2) / 2) / MAS)

    return Strength(complex(wanted / residue), size(left), size(left - wanted * column))


def main(arguments: argparse.Namespace) -> int:
    """Print all of it."""
    known, last_rung = terms(), fitted(predicted("coupling"))
    for name, response in {
        "as it is": fitted(known.iau),
        "where most is added left out": blind(),
        "what is added taken away": fitted(known.iau - known.added),
        "the last rung in its place": last_rung,
    }.items():
        print(f"{name}: {response.period / DAY:.2f} d, Q {response.quality:.0f}")
    for name, multiple in {**ADDED_TO, "retrograde half year": HALF_YEAR}.items():
        published = 1j * known.added[known.place(multiple)] / UAS
        print(f"{name}: {left_by(held(BUILT_IN), multiple):.1f} uas with the mode held; "
              f"published {published:.1f}")  # fmt: skip
    print(
        f"Q of the last rung {quality(core_mode('coupling')):.0f}, "
        f"without the sea {quality_without_the_sea():.0f}"
    )
    for name, terms_of in {
        "core-ellipticity": predicted("core-ellipticity"),
        "coupling": predicted("coupling"),
        "coupling to the mantle alone": coupled_to_mantle_alone(),
    }.items():
        as_it_is, less = in_time(terms_of - known.iau), in_time(terms_of - known.iau + known.added)
        print(
            f"{name}: leaves {as_it_is[0]:.2f} / {as_it_is[1]:.2f} mas, "
            f"{less[0]:.2f} / {less[1]:.2f} with what is added taken away"
        )
    print(strength())
    return 0
