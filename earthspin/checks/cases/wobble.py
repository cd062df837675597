"""Stiff and extreme cases of the free wobble and of what excites it."""

from __future__ import annotations

import tempfile
from functools import lru_cache
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from earthspin.checks.case import Cases, without_folder
from earthspin.constants import ARCSEC
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

Complex = NDArray[np.complex128]

CASES = Cases("wobble")

PERIOD = 433.0
DAYS = 64 * 365 + 16


@lru_cache
def _observed() -> xr.Dataset:
    return polar_motion()


def _driven(s: complex, step: float = 1.0, size: int = DAYS) -> tuple[Complex, Complex]:
    """White excitation of 30 mas, and the pole that it drives."""
    both = 30 * np.random.default_rng(1).standard_normal((2, size))
    chi = both[0] + 1j * both[1]
    return chi, resonance.polar_motion_from(chi, step, s, 100 - 40j)


def _round_trip(quality_factor: float, step: float = 1.0, size: int = DAYS) -> float:
    """From an excitation to the pole and back, and from that to the pole again, mas."""
    s = resonance.chandler_frequency(PERIOD, quality_factor)
    chi, p = _driven(s, step, size)
    again = resonance.excitation(p, step, s)
    back = resonance.polar_motion_from(again, step, s, p[0])
    return max(float(np.max(abs(again - chi))), float(np.max(abs(back - p))))


@CASES.hold(
    "64 years of excitation, there and back",
    because="the excitation is a difference of nearly equal poles, 1/70 of their size",
    against="the excitation that drove the pole, and that pole",
    unit="mas",
    bound=1e-11,
)
def _there_and_back() -> float:
    return _round_trip(100.0)


@CASES.hold(
    "64 years as observed, there and back",
    because="labelled data, dates rounded to microseconds, units changed on the way",
    against="the observed pole",
    unit="mas",
    bound=5e-11,
)
def _observed_round_trip() -> float:
    seen = _observed()
    back = polar_motion_from(excitation(seen))
    off = max(float(abs(back[n].values - seen[n].values).max()) for n in ("x", "y"))
    return off * 1e3


@CASES.hold(
    "no loss at all: an infinite quality factor",
    because="nothing forgets the start, so that errors stay for ever",
    against="the excitation that drove the pole, and that pole, over 64 years",
    unit="mas",
    bound=2e-11,
)
def _no_loss() -> float:
    return _round_trip(np.inf)


@CASES.hold(
    "quality factor of one half",
    because="the wobble dies within a period; its start decays to 1e-60",
    against="the excitation that drove the pole, and that pole, over 64 years",
    unit="mas",
    bound=1e-11,
)
def _all_loss() -> float:
    return _round_trip(0.5)


@CASES.hold(
    "step of exactly one free period",
    because="the pole comes back to where it was, but for the loss: 3 per cent tell what drove it",
    against="the excitation that drove the pole, and that pole, over 400 steps",
    unit="mas",
    bound=5e-12,
)
def _resonant_step() -> float:
    return _round_trip(100.0, step=PERIOD, size=400)


@CASES.refuse(
    "step of exactly one free period without loss",
    because="whatever drove it leaves no trace: 0/0, which rounding turns into numbers",
    saying="leaves no trace",
)
def _resonant_step_without_loss() -> None:
    s = resonance.chandler_frequency(PERIOD, np.inf)
    resonance.excitation(np.array([1.0, 2.0, 3.0], dtype=complex), PERIOD, s)


@CASES.hold(
    "steps of a second",
    because="the pole moves by 1e-7 of itself from one to the next",
    against="the excitation that drove the pole; rounding of the pole times 6e6",
    unit="mas",
    bound=1e-6,
)
def _tiny_steps() -> float:
    return _round_trip(100.0, step=1 / 86400, size=5000)


@CASES.hold(
    "a free wobble without excitation",
    because="the result is nothing but what cancels",
    against="zero, for a wobble of 150 mas over 64 years",
    unit="mas",
    bound=1e-9,
)
def _free() -> float:
    s = resonance.chandler_frequency(PERIOD, 100.0)
    p = 150 * np.exp(1j * s * np.arange(float(DAYS)))
    return float(np.max(abs(resonance.excitation(p, 1.0, s))))


@CASES.refuse(
    "quality factor of zero",
    because="all is lost at once: the frequency is infinite",
    saying="greater than zero",
)
def _zero_quality() -> None:
    resonance.chandler_frequency(PERIOD, 0.0)


@CASES.refuse(
    "a free period that is not a number",
    because="NaN passes every comparison that is written the wrong way round",
    saying="greater than zero",
)
def _nan_period() -> None:
    resonance.chandler_frequency(float("nan"), 100.0)


@CASES.refuse(
    "a gap of twenty days in the observed pole",
    because="what is bridged over it would pass for data",
    saying="a gap of 21.0 d",
)
def _gap() -> None:
    lines = c04_path().read_text(encoding="ascii", errors="replace").splitlines(keepends=True)
    rows = [n for n, line in enumerate(lines) if line[:1].isdigit() or line[:5].strip().isdigit()]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "gap"
        cut = set(rows[5000:5020])
        file.write_text("".join(line for n, line in enumerate(lines) if n not in cut))
        with without_folder(file):
            read_polar_motion(file)


@CASES.refuse(
    "excitation over steps that are not even",
    because="each step has its own response; one for all would be wrong by per cents",
    saying="even",
)
def _uneven() -> None:
    seen = _observed()
    excitation(seen.isel(time=[0, 1, 2, 4, 5]))


@CASES.refuse(
    "the free wobble from two years of data",
    because="the beat with the annual wobble takes six years; some number would come out",
    saying="too short to separate",
)
def _too_short() -> None:
    seen = _observed()
    fit_chandler(seen.isel(time=slice(0, 730)))


@CASES.hold(
    "the free wobble of a sphere",
    because="(C - A)/A is zero: a division by it",
    against="an infinite period, and no number anywhere that is not one",
    bound=0.0,
)
def _sphere() -> float:
    periods = [float(free_wobble_period(0.0, 86164.0)), float(turns_rigid(0.0))]
    return float(sum(p != np.inf for p in periods))


@CASES.hold(
    "prolate and oblate wobble alike",
    because="the wobble goes the other way; periods count without sign",
    against="A/(C - A) turns, relative, down to H of 1e-15",
    bound=5e-15,
)
def _prolate() -> float:
    h = np.array([0.3, 3e-3, 1e-9, 1e-15])
    worst = 0.0
    for sign in (1, -1):
        found = np.asarray(turns_rigid(sign * h))
        worst = max(worst, float(np.max(np.abs(found * h / (1 - sign * h) - 1))))
    return worst


@CASES.refuse(
    "a wobble about the middle axis",
    because="the square of its period is below zero",
    saying="middle one of the three principal axes",
)
def _middle() -> None:
    turns_triaxial(1e-6, 3e-7, 1e-5)


@CASES.refuse(
    "a ladder with an exponent of loss of 2",
    because="the formula would give a wobble that gains energy, or numbers without meaning",
    saying="exponent",
)
def _exponent() -> None:
    wobble_ladder(anelastic_exponent=2.0)


@CASES.hold(
    "a wobble of one microarcsecond",
    because="the least that is ever told, on a pole given in arcseconds",
    against="excitation in proportion, and back, over its size",
    bound=2e-14,
)
def _microarcsecond() -> float:
    s = resonance.chandler_frequency(PERIOD, 100.0)
    chi = 1e-6 * ARCSEC * np.exp(0.3j * np.arange(2000.0))
    p = resonance.polar_motion_from(chi, 1.0, s)
    return float(np.max(abs(resonance.excitation(p, 1.0, s) - chi)) / np.max(abs(chi)))
