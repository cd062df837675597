"""The free wobble with a known excitation, from files of angular momentum, for docs/wobble.md.

The observed pole is fitted with the excitation, and compared with the pole that the excitation
drives. The limit is the Cramer-Rao bound on the half-width of the period: with p' = i s (p - chi),
and an unknown rest of the excitation of density S (mas squared times days),

    half-width of s >= 1.96 |s| sqrt(S / (2 sum |p - chi|^2))    for daily values.

Poles of known period, driven by the same excitation and an unknown rest, show how often the
intervals contain the truth.
"""

from __future__ import annotations

import argparse
import os
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

import earthspin
from earthspin.constants import MAS, NORMAL_95
from earthspin.sky.angular_momentum import read_angular_momentum
from earthspin.sky.eop import read_polar_motion
from earthspin.wobble.observed import fit_with_excitation
from earthspin.wobble.record import NEAR, known_terms, least_squares
from earthspin.wobble.resonance import chandler_frequency, excitation, polar_motion_from

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
PAGE = Path(__file__).parent.parent / "docs" / "measured" / "driven-wobble.inc"
COMPONENTS = {
    "atmosphere, ocean": ["AAM", "OAM"],
    "atmosphere, ocean, land water": ["AAM", "OAM", "HAM"],
}
#: Band of periods in which the power of the rest is measured, d, and a typical quality factor.
BAND, TYPICAL = (395.0, 480.0), 100.0
YEARS = (2000, 2005, 2010, 2015, 2019)
#: Truths and number of simulated poles, density of the rest at the wobble (mas squared times days),
#: half of it white and half red, and the memory of the red half, d.
QUALITY, DRAWS, DENSITY, MEMORY = (50.0, 100.0, 180.0), 100, 2600.0, 365.0


def known(folders: list[str], components: list[str]) -> tuple[Array, Complex, Complex]:
    """Days, observed pole and excitation, mas, from the first to the last day that both cover."""
    table = read_polar_motion("c04")
    momentum = read_angular_momentum(folders, components, daily=True)
    first = int(np.searchsorted(table.mjd, momentum.mjd[0] - 0.5))
    count = min(momentum.mjd.size, table.mjd.size - first - 1)
    rows = slice(first, first + count + 1)
    p = np.asarray((table.x - 1j * table.y)[rows] / MAS, dtype=complex)
    return table.mjd[rows], p, momentum.chi[:count] / MAS


def density(time: Array, p: Complex, chi: Complex, s: complex) -> float:
    """Power of the rest of the excitation at periods near the wobble, mas squared times days."""
    rest = excitation(p, 1.0, s) - chi
    middles = time[:-1] + 0.5
    columns = known_terms(middles)
    window = np.hanning(rest.size)
    spectrum = np.fft.fft((rest - columns @ least_squares(columns, rest)) * window)
    frequency = np.fft.fftfreq(rest.size)
    near = (frequency > 1 / BAND[1]) & (frequency < 1 / BAND[0])
    return float((abs(spectrum[near]) ** 2).mean() / (window**2).sum())


def limit(time: Array, p: Complex, chi: Complex, s: complex, power: float) -> float:
    """Smallest possible 95 % half-width of the period, d."""
    moving, columns = p[:-1] - chi, known_terms(time[:-1])
    moving = moving - columns @ least_squares(columns, moving)
    rate = NORMAL_95 * abs(s) * np.sqrt(power / (2 * (abs(moving) ** 2).sum()))
    return float(rate * NEAR**2 / (2 * np.pi))


def simulated(time: Array, start: complex, chi: Complex, quality: float) -> str:
    """Row of the table of coverage, for one quality factor."""
    s, turn = chandler_frequency(NEAR, quality), np.exp(-2j * np.pi / NEAR)
    keep = np.exp(-1 / MEMORY)
    fits, limits = [], []
    for seed in range(DRAWS):
        noise = np.random.default_rng(seed).standard_normal((4, chi.size)) / np.sqrt(2)
        white, drive = noise[0] + 1j * noise[1], noise[2] + 1j * noise[3]
        red = abs(1 - keep * turn) * lfilter([1.0], [1.0, -keep], drive)
        p = polar_motion_from(chi + np.sqrt(DENSITY / 2) * (white + red), 1.0, s, start)
        limits.append(limit(time, p, chi, s, DENSITY))
        fitted = fit_with_excitation(time, p, chi)
        fits.append((fitted.period, fitted.period_error, *fitted.quality_bounds))
    period, error, low, high = np.array(fits).T
    cells = (
        f"{quality:.0f}",
        f"{period.mean() - NEAR:+.2f}",
        f"{NORMAL_95 * period.std():.1f}",
        f"{np.median(error):.1f}",
        f"{np.median(limits):.1f}",
        f"{np.mean(abs(period - NEAR) <= error):.0%}",
        f"{np.mean((low <= quality) & (quality <= high)):.0%}",
    )
    return f"| {' | '.join(cells)} |"


def amplitudes(pole: Any) -> str:
    """Cells with the amplitude of the free wobble in `YEARS`, mas."""
    series = earthspin.fit_chandler(pole).chandler_amplitude
    return " | ".join(
        f"{float(series.sel(time=f'{year}-01-01', method='nearest')):.0f}" for year in YEARS
    )


def main(arguments: argparse.Namespace) -> int:
    """Write the three tables of the page."""
    s = chandler_frequency(NEAR, TYPICAL)
    fits: list[str] = []
    sizes: list[str] = []
    for name, components in COMPONENTS.items():
        time, p, chi = known(arguments.excitation, components)
        fitted = fit_with_excitation(time, p, chi)
        power = density(time, p, chi, s)
        low, high = fitted.quality_bounds
        fits.append(
            f"| {name} | {fitted.period:.1f} ± {fitted.period_error:.1f} | "
            f"{fitted.quality_factor:.0f} ({low:.0f} to {high:.0f}) | {power:.0f} | "
            f"{limit(time, p, chi, s, power):.1f} |"
        )
        pole = earthspin.polar_motion(span=(f"{YEARS[0] - 4}-01-01", "2025-12-31"))
        series = earthspin.read_excitation(arguments.excitation, components=components, daily=True)
        driven = earthspin.polar_motion_from(
            series, period=fitted.period, quality_factor=fitted.quality_factor, fitted_to=pole
        )
        if not sizes:
            sizes.append(f"| observed | {amplitudes(pole)} |")
        sizes.append(f"| driven by {name} | {amplitudes(driven)} |")
    with ProcessPoolExecutor(os.cpu_count()) as workers:
        truths = list(workers.map(partial(simulated, time, complex(p[0]), chi), QUALITY))
    lines = [
        "| excitation | period, d | Q | power of the rest, mas² d | smallest half-width, d |",
        "|---|---|---|---|---|",
        *fits,
        "",
        f"| amplitude of the wobble, mas | {' | '.join(map(str, YEARS))} |",
        "|---" * (len(YEARS) + 1) + "|",
        *sizes,
        "",
        "| true Q | bias, d | scatter (95 %), d | half-width, d | smallest, d | T held | Q held |",
        "|---|---|---|---|---|---|---|",
        *truths,
        "",
    ]
    text = "\n".join(lines).replace("inf)", "∞)")
    PAGE.write_text(text, encoding="utf-8")
    print(text)
    return 0
