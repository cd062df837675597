"""How far DE421 is from another kernel: the numbers of `KERNEL_DIFFERENCE`."""

from __future__ import annotations

import argparse

import numpy as np

from earthspin.constants import ARCSEC
from earthspin.sky.ephemeris import KERNEL_DIFFERENCE, Ephemeris, open_ephemeris

STEP = 1.7  # days: no body comes back to the same place


def largest_differences(
    one: Ephemeris, other: Ephemeris, codes: list[int], centre: int = 399, step: float = STEP
) -> dict[int, tuple[float, float]]:
    """Largest differences in direction (mas) and distance (m) where both kernels cover.

    Parameters
    ----------
    one, other : Ephemeris
    codes : list of int
        NAIF codes.
    centre : int
        From where they are seen.
    step : float
        Days.
    """
    spans = [kernel.coverage({*codes, centre}) for kernel in (one, other)]
    days = np.arange(max(s[0] for s in spans), min(s[1] for s in spans), step)
    targets = {str(code): code for code in codes}
    first, second = (kernel.positions(targets, centre, days) for kernel in (one, other))
    found = {}
    for label, code in targets.items():
        a, b = first[label], second[label]
        distance = np.linalg.norm(a, axis=1)
        angle = np.linalg.norm(np.cross(a, b), axis=1) / distance**2
        off = np.abs(distance - np.linalg.norm(b, axis=1))
        found[code] = float(angle.max() / ARCSEC * 1e3), float(off.max())
    return found


def main(given: argparse.Namespace) -> int:
    """Print measured and stated differences side by side."""
    codes = list(KERNEL_DIFFERENCE)
    measured = largest_differences(open_ephemeris("de421"), open_ephemeris(given.kernel), codes)
    worse = 0
    print("NAIF    measured: mas          m    stated: mas          m")
    for code, (angle, distance) in measured.items():
        stated = KERNEL_DIFFERENCE[code]
        worse += angle > stated[0] or distance > stated[1]
        print(f"{code:>4} {angle:>16.4g} {distance:>10.4g} {stated[0]:>14.4g} {stated[1]:>10.4g}")
    return int(worse > 0)
