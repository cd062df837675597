"""How far DE421 is from another kernel, in places and in axes: `sky.kernel_differences`."""

from __future__ import annotations

import argparse

import numpy as np

from earthspin.constants import ARCSEC
from earthspin.questions.pole import pole
from earthspin.sky.ephemeris import Ephemeris, open_ephemeris
from earthspin.sky.kernel_differences import DIFFERENCES

SPAN = ("1901-01-01", "2050-01-01")
STEP = 1.7  # days: no body comes back to the same place


def largest_differences(
    kernel_a: Ephemeris, kernel_b: Ephemeris, codes: list[int], centre: int, step: float = STEP
) -> dict[int, tuple[float, float]]:
    """Largest differences in direction (mas) and distance (m) where both kernels cover.

    Parameters
    ----------
    kernel_a, kernel_b : Ephemeris
    codes : list of int
        NAIF codes.
    centre : int
        From where they are seen.
    step : float
        Days.
    """
    spans = [kernel.coverage({*codes, centre}) for kernel in (kernel_a, kernel_b)]
    days = np.arange(max(s[0] for s in spans), min(s[1] for s in spans), step)
    targets = {str(code): code for code in codes}
    first, second = (kernel.positions(targets, centre, days) for kernel in (kernel_a, kernel_b))
    differences = {}
    for label, code in targets.items():
        a, b = first[label], second[label]
        distance = np.linalg.norm(a, axis=1)
        angle = np.linalg.norm(np.cross(a, b), axis=1) / distance**2
        off = np.abs(distance - np.linalg.norm(b, axis=1))
        differences[code] = float(angle.max() / ARCSEC * 1e3), float(off.max())
    return differences


def drifts(kernel: str, step: str = "20 d") -> dict[str, tuple[float, float]]:
    """How far two kernels let axes part, at most, uas, and over the bound that is stated.

    Parameters
    ----------
    kernel : str
        Name or path.
    step : str
    """
    by_sky = {}
    for body, perturbers in (("earth", ("sun", "moon")), ("earth", ("sun",)), ("mars", ("sun",))):
        first, second = (
            pole(*SPAN, step, body=body, perturbers=perturbers, ephemeris=name)
            for name in ("de421", kernel)
        )
        apart = np.sqrt(
            (first.X - second.X) ** 2 + (first.Y - second.Y) ** 2 + (first.Z - second.Z) ** 2
        )
        apart = apart.max("axis") / ARCSEC
        over = float((apart / first.direction_error_kernel).max())
        by_sky[f"{body} under {' and '.join(perturbers)}"] = float(apart.max()) * 1e6, over
    return by_sky


def main(arguments: argparse.Namespace) -> int:
    """Print measured and stated differences side by side, pair by pair."""
    kernels = open_ephemeris("de421"), open_ephemeris(arguments.kernel)
    codes = sorted({code for pair in DIFFERENCES for code in pair})
    worse = 0
    print("from    to    measured: mas          m    stated: mas          m")
    for centre in codes:
        others = [code for code in codes if code > centre]
        for code, measured in largest_differences(*kernels, others, centre).items():
            stated = DIFFERENCES[centre, code]
            worse += measured[0] > stated[0] or measured[1] > stated[1]
            print(
                f"{centre:>4} {code:>5} {measured[0]:>16.4g} {measured[1]:>10.4g}"
                f" {stated[0]:>14.4g} {stated[1]:>10.4g}"
            )
    print("\naxes, 1901 to 2050            apart: uas    over the stated bound")
    for words, (apart, over) in drifts(arguments.kernel).items():
        worse += over > 1
        print(f"{words:<28} {apart:>11.3f} {over:>24.3f}")
    return int(worse > 0)
