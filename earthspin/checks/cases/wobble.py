"""Stiff and extreme cases of the free wobble and of what excites it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from earthspin.checks.case import Distances, holds, refused, relative_error, temporary
from earthspin.constants import UAS
from earthspin.questions.polar_motion import excitation, polar_motion
from earthspin.rotor.axisymmetric import free_wobble_period
from earthspin.sky.eop import c04_path, read_polar_motion
from earthspin.wobble import resonance
from earthspin.wobble.ladder import turns_rigid

PERIOD = 433.0
DAYS = 64 * 365 + 16


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


@holds(bound=2e-11, unit="mas")
def _no_loss() -> Distances:
    """no loss at all: an infinite quality factor

    Hard because: nothing forgets the start, so that errors stay for ever
    Held against: the excitation that drove the pole, and that pole, over 64 years
    """
    yield from _round_trip(np.inf)


@holds(bound=1e-11, unit="mas")
def _all_loss() -> Distances:
    """quality factor of one half

    Hard because: the wobble dies within a period; its start decays to 1e-60
    Held against: the excitation that drove the pole, and that pole, over 64 years
    """
    yield from _round_trip(0.5)


@holds(bound=5e-12, unit="mas")
def _resonant_step() -> Distances:
    """step of exactly one free period

    Hard because: the pole comes back to where it was, but for the loss: 3 per cent tell what drove
        it
    Held against: the excitation that drove the pole, and that pole, over 400 steps
    """
    yield from _round_trip(100.0, step=PERIOD, size=400)


@holds(bound=1e-6, unit="mas")
def _tiny_steps() -> Distances:
    """steps of a second

    Hard because: the pole moves by 1e-7 of itself from one to the next
    Held against: the excitation that drove the pole; rounding of the pole times 6e6
    """
    yield from _round_trip(100.0, step=1 / 86400, size=5000)


@refused("a gap of 21.0 d")
def _gap() -> None:
    """a gap of twenty days in the observed pole

    Hard because: what is bridged over it would pass for data
    """
    lines = c04_path().read_text(encoding="ascii", errors="replace").splitlines(keepends=True)
    rows = [n for n, line in enumerate(lines) if line[:1].isdigit() or line[:5].strip().isdigit()]
    cut = set(rows[5000:5020])
    with temporary("gap") as file:
        file.write_text("".join(line for n, line in enumerate(lines) if n not in cut))
        read_polar_motion(file)


@refused("even")
def _uneven() -> None:
    """excitation over steps that are not even

    Hard because: each step has its own response; one for all would be wrong by per cents
    """
    excitation(polar_motion().isel(time=[0, 1, 2, 4, 5]))


@holds(bound=0.0)
def _sphere() -> Distances:
    """the free wobble of a sphere

    Hard because: (C - A)/A is zero: a division by it
    Held against: an infinite period, and no number anywhere that is not one
    """
    yield free_wobble_period(0.0, 86164.0) != np.inf
    yield turns_rigid(0.0) != np.inf


@holds(bound=5e-15)
def _prolate() -> Distances:
    """prolate and oblate wobble alike

    Hard because: the wobble goes the other way; periods count without sign
    Held against: A/(C - A) turns, relative, down to H of 1e-15
    """
    h = np.array([0.3, 3e-3, 1e-9, 1e-15])
    for sign in (1, -1):
        yield turns_rigid(sign * h) * h / (1 - sign * h) - 1


@holds(bound=2e-14)
def _microarcsecond() -> Distances:
    """a wobble of one microarcsecond

    Hard because: the least that is ever told, on a pole given in arcseconds
    Held against: excitation in proportion, and back, over its size
    """
    s = resonance.chandler_frequency(PERIOD, 100.0)
    chi = UAS * np.exp(0.3j * np.arange(2000.0))
    p = resonance.polar_motion_from(chi, 1.0, s)
    yield relative_error(resonance.excitation(p, 1.0, s), chi)
