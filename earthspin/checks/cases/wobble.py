"""Stiff and extreme cases of the free wobble and of what excites it."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from earthspin.checks.case import (
    Cases,
    Distances,
    apart,
    hard_because,
    held_against,
    refused,
    without_folder,
)
from earthspin.constants import UAS
from earthspin.questions.polar_motion import (
    excitation,
    fit_chandler,
    polar_motion,
    polar_motion_from,
)
from earthspin.questions.wobble import wobble_ladder
from earthspin.rotor.axisymmetric import free_wobble_period
from earthspin.sky.eop import c04_path, read_polar_motion
from earthspin.wobble import resonance
from earthspin.wobble.ladder import turns_rigid, turns_triaxial

CASES = Cases("wobble")

PERIOD = 433.0
DAYS = 64 * 365 + 16


@lru_cache
def _observed() -> xr.Dataset:
    return polar_motion()


def _round_trip(
    quality_factor: float, step: float = 1.0, size: int = DAYS
) -> Iterator[NDArray[np.complex128]]:
    """From a white excitation of 30 mas to the pole and back, and to the pole again, mas."""
    s = resonance.chandler_frequency(PERIOD, quality_factor)
    both = 30 * np.random.default_rng(1).standard_normal((2, size))
    chi = both[0] + 1j * both[1]
    p = resonance.polar_motion_from(chi, step, s, 100 - 40j)
    again = resonance.excitation(p, step, s)
    yield again - chi
    yield resonance.polar_motion_from(again, step, s, p[0]) - p


@CASES.case("64 years of excitation, there and back")
@hard_because("the excitation is a difference of nearly equal poles, 1/70 of their size")
@held_against("the excitation that drove the pole, and that pole", bound=1e-11, unit="mas")
def _there_and_back() -> Distances:
    yield from _round_trip(100.0)


@CASES.case("64 years as observed, there and back")
@hard_because("labelled data, dates rounded to microseconds, units changed on the way")
@held_against("the observed pole", bound=5e-11, unit="mas")
def _observed_round_trip() -> Distances:
    seen = _observed()
    back = polar_motion_from(excitation(seen))
    for name in ("x", "y"):
        yield (back[name].values - seen[name].values) * 1e3


@CASES.case("no loss at all: an infinite quality factor")
@hard_because("nothing forgets the start, so that errors stay for ever")
@held_against(
    "the excitation that drove the pole, and that pole, over 64 years", bound=2e-11, unit="mas"
)
def _no_loss() -> Distances:
    yield from _round_trip(np.inf)


@CASES.case("quality factor of one half")
@hard_because("the wobble dies within a period; its start decays to 1e-60")
@held_against(
    "the excitation that drove the pole, and that pole, over 64 years", bound=1e-11, unit="mas"
)
def _all_loss() -> Distances:
    yield from _round_trip(0.5)


@CASES.case("step of exactly one free period")
@hard_because(
    "the pole comes back to where it was, but for the loss: 3 per cent tell what drove it"
)
@held_against(
    "the excitation that drove the pole, and that pole, over 400 steps", bound=5e-12, unit="mas"
)
def _resonant_step() -> Distances:
    yield from _round_trip(100.0, step=PERIOD, size=400)


@CASES.case("step of exactly one free period without loss")
@hard_because("whatever drove it leaves no trace: 0/0, which rounding turns into numbers")
@refused("leaves no trace")
def _resonant_step_without_loss() -> None:
    s = resonance.chandler_frequency(PERIOD, np.inf)
    resonance.excitation(np.array([1.0, 2.0, 3.0], dtype=complex), PERIOD, s)


@CASES.case("steps of a second")
@hard_because("the pole moves by 1e-7 of itself from one to the next")
@held_against(
    "the excitation that drove the pole; rounding of the pole times 6e6", bound=1e-6, unit="mas"
)
def _tiny_steps() -> Distances:
    yield from _round_trip(100.0, step=1 / 86400, size=5000)


@CASES.case("a free wobble without excitation")
@hard_because("the result is nothing but what cancels")
@held_against("zero, for a wobble of 150 mas over 64 years", bound=1e-9, unit="mas")
def _free() -> Distances:
    s = resonance.chandler_frequency(PERIOD, 100.0)
    p = 150 * np.exp(1j * s * np.arange(float(DAYS)))
    yield resonance.excitation(p, 1.0, s)


@CASES.case("quality factor of zero")
@hard_because("all is lost at once: the frequency is infinite")
@refused("greater than zero")
def _zero_quality() -> None:
    resonance.chandler_frequency(PERIOD, 0.0)


@CASES.case("a free period that is not a number")
@hard_because("NaN passes every comparison that is written the wrong way round")
@refused("greater than zero")
def _nan_period() -> None:
    resonance.chandler_frequency(float("nan"), 100.0)


@CASES.case("a gap of twenty days in the observed pole")
@hard_because("what is bridged over it would pass for data")
@refused("a gap of 21.0 d")
def _gap() -> None:
    lines = c04_path().read_text(encoding="ascii", errors="replace").splitlines(keepends=True)
    rows = [n for n, line in enumerate(lines) if line[:1].isdigit() or line[:5].strip().isdigit()]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "gap"
        cut = set(rows[5000:5020])
        file.write_text("".join(line for n, line in enumerate(lines) if n not in cut))
        with without_folder(file):
            read_polar_motion(file)


@CASES.case("excitation over steps that are not even")
@hard_because("each step has its own response; one for all would be wrong by per cents")
@refused("even")
def _uneven() -> None:
    excitation(_observed().isel(time=[0, 1, 2, 4, 5]))


@CASES.case("the free wobble from two years of data")
@hard_because("the beat with the annual wobble takes six years; some number would come out")
@refused("too short to separate")
def _too_short() -> None:
    fit_chandler(_observed().isel(time=slice(0, 730)))


@CASES.case("the free wobble of a sphere")
@hard_because("(C - A)/A is zero: a division by it")
@held_against("an infinite period, and no number anywhere that is not one", bound=0.0)
def _sphere() -> Distances:
    yield free_wobble_period(0.0, 86164.0) != np.inf
    yield turns_rigid(0.0) != np.inf


@CASES.case("prolate and oblate wobble alike")
@hard_because("the wobble goes the other way; periods count without sign")
@held_against("A/(C - A) turns, relative, down to H of 1e-15", bound=5e-15)
def _prolate() -> Distances:
    h = np.array([0.3, 3e-3, 1e-9, 1e-15])
    for sign in (1, -1):
        yield turns_rigid(sign * h) * h / (1 - sign * h) - 1


@CASES.case("a wobble about the middle axis")
@hard_because("the square of its period is below zero")
@refused("middle one of the three principal axes")
def _middle() -> None:
    turns_triaxial(1e-6, 3e-7, 1e-5)


@CASES.case("a ladder with an exponent of loss of 2")
@hard_because("the formula would give a wobble that gains energy, or numbers without meaning")
@refused("exponent")
def _exponent() -> None:
    wobble_ladder(anelastic_exponent=2.0)


@CASES.case("a wobble of one microarcsecond")
@hard_because("the least that is ever told, on a pole given in arcseconds")
@held_against("excitation in proportion, and back, over its size", bound=2e-14)
def _microarcsecond() -> Distances:
    s = resonance.chandler_frequency(PERIOD, 100.0)
    chi = UAS * np.exp(0.3j * np.arange(2000.0))
    p = resonance.polar_motion_from(chi, 1.0, s)
    yield apart(resonance.excitation(p, 1.0, s), chi)
