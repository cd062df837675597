"""On what the resonance of the core rests, in IAU 2000A and in the ladder of nutation.

The response that is fitted to IAU 2000A is changed in one way at a time: its mode held where it was
built in, one more term left out, the predicted response of the ladder in the place of IAU 2000A.
And the last rung of the ladder is compared with IAU 2000A: by how much the strength of the core's
resonance would have to differ, what is left then, and what its parts do.
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
from earthspin.constants import ARCSEC
from earthspin.engine.plan import plan
from earthspin.interior.named import ANELASTIC_EXPONENT
from earthspin.nutation.ladder import quality
from earthspin.nutation.response import ADDED_TO, CORE_NUTATION_START, Response, fit_response
from earthspin.parts.predicted import Prediction, predict

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

UAS = ARCSEC / 1e6
#: The mode that is built into IAU 2000A, as IERS Conventions (2010), table 6.4, have it.
BUILT_IN = complex(*CORE_NUTATION_START)
#: The half year, retrograde.
HALF_YEAR = (0, 0, -2, 2, -2)


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
    used : ndarray, shape (k,), bool
        Those to which IAU 2000A adds nothing.
    """

    multiples: NDArray[np.int64]
    frequency: FloatArray
    rigid: ComplexArray
    iau: ComplexArray
    used: NDArray[np.bool_]

    def place(self, multiple: Sequence[int]) -> int:
        """Where a term stands."""
        return int(np.flatnonzero(np.all(self.multiples == multiple, axis=1))[0])


@cache
def terms() -> Terms:
    """Those of the comparison with the IAU."""
    planned = plan(earthspin.load_scene("iau"), ["core"])
    values = planned.question.keys()
    for one in planned.parts:
        if "response_apart" not in values:
            there = (*one.needs, *(name for name in one.uses if name in values))
            values[one.name] = one(**{name: values[name] for name in there})
    apart, circles = values["response_apart"], values["pole_analysis"].our_circles
    iau = apart.left + apart.response.transfer(circles.frequency) * apart.rigid
    return Terms(circles.multiples, circles.frequency, apart.rigid, iau, apart.used)


def fitted(real: ComplexArray, without: Sequence[Sequence[int]] = ()) -> Response:
    """Response fitted to amplitudes of all terms that are used, but for some."""
    of = terms()
    used = of.used.copy()
    used[[of.place(multiple) for multiple in without]] = False
    h, spin = EARTH.number("dynamical_flattening"), float(EARTH.spin_rate)
    return fit_response(of.frequency[used], of.rigid[used], real[used], h, spin)


def held(mode: complex) -> Response:
    """Strengths fitted to IAU 2000A with the mode of the core held."""
    of, free = terms(), fitted(terms().iau)
    columns = []
    for strength in np.eye(4, dtype=complex):
        one = replace(free, core_nutation=mode, strengths=strength)
        columns.append(one.transfer(of.frequency))
    base = replace(free, core_nutation=mode, strengths=np.zeros(4, dtype=complex))
    none = base.transfer(of.frequency)
    design = (np.array(columns).T - none[:, np.newaxis]) * of.rigid[:, np.newaxis]
    left = of.iau - none * of.rigid
    strengths = np.linalg.lstsq(design[of.used], left[of.used], rcond=None)[0]
    return replace(base, strengths=np.asarray(strengths, dtype=np.complex128))


def left_by(response: Response, multiple: Sequence[int]) -> complex:
    """What a response leaves of a term of IAU 2000A, in phase and out of phase, uas."""
    of = terms()
    left = of.iau - response.transfer(of.frequency) * of.rigid
    return complex(1j * left[of.place(multiple)] / UAS)


def half_year_tells() -> float:
    """How far the response that is fitted and that with the mode built in are apart there, uas."""
    of = terms()
    here = of.place(HALF_YEAR)
    free, built = (one.transfer(of.frequency)[here] for one in (fitted(of.iau), held(BUILT_IN)))
    return float(abs((free - built) * of.rigid[here]) / UAS)


# --- the last rung -------------------------------------------------------------------------------


@cache
def _models() -> Prediction:
    return predict(EARTH, True, ANELASTIC_EXPONENT.value)


def predicted(rung: str) -> ComplexArray:
    """Terms of a rung of the ladder, rad."""
    return np.asarray(_models().transfer(rung, terms().frequency) * terms().rigid)


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
        What the rung leaves of the terms that are used, in each angle, root sum of squares, mas;
        as it is, and with that change.
    all_before, all_after : float
        The same of all terms.
    """

    change: complex
    before: float
    after: float
    all_before: float
    all_after: float


def strength(rung: str = "coupling") -> Strength:
    """Least squares for one complex number."""
    of, model = terms(), _models().rungs[rung]
    unit = replace(
        fitted(of.iau), core_nutation=core_mode(rung), strengths=np.array([0, 0, 1.0, 0], complex)
    )
    none = replace(unit, strengths=np.zeros(4, complex))
    column = (unit.transfer(of.frequency) - none.transfer(of.frequency)) * of.rigid
    left = of.iau - predicted(rung)
    used = of.used
    wanted = np.vdot(column[used], left[used]) / np.vdot(column[used], column[used])
    # The strength is the residue: from the response around the mode.
    mode = core_mode(rung)
    near = mode.real + 1e-5 * np.array([-2.0, -1.0, 1.0, 2.0])
    unit_near = np.array([unit.transfer((n + 1) * unit.spin_rate) for n in near])
    none_near = np.array([none.transfer((n + 1) * unit.spin_rate) for n in near])
    resonance = np.stack([unit_near - none_near, none_near * (1 + near)], axis=-1)
    residue = np.linalg.lstsq(resonance, model.transfer(near, _models().e), rcond=None)[0][0]
    after = left - wanted * column

    def size(values: ComplexArray) -> float:
        return float(np.sqrt(np.sum(abs(values) ** 2) / 2) / UAS / 1e3)

    return Strength(
        complex(wanted / residue), size(left[used]), size(after[used]), size(left), size(after)
    )


def main(given: argparse.Namespace) -> int:
    """Print all of it."""
    known = fitted(predicted("coupling"))
    print(
        f"Q as fitted {fitted(terms().iau).quality:.0f}, "
        f"without the half year {fitted(terms().iau, [HALF_YEAR]).quality:.0f}; "
        f"of the last rung {quality(core_mode('coupling')):.0f}, fitted {known.quality:.0f}, "
        f"without the sea {quality_without_the_sea():.0f}"
    )
    print(f"the half year tells them apart by {half_year_tells():.1f} uas")
    for name, multiple in {**ADDED_TO, "retrograde half year": HALF_YEAR}.items():
        print(f"{name}: {left_by(held(BUILT_IN), multiple):.1f} uas with the mode held")
    print(strength())
    return 0
