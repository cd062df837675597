r"""Compare error and run time of methods for polar motion and its excitation.

Methods: the exact schemes and approximate ones.

The excitation consists of sinusoids and steps, and its polar motion has a closed form. With
p' = i s (p - chi), a sinusoid chi = c exp(i w t) gives

    p = c [exp(i w t) - exp(i s t)] s/(s - w)

and a step of size c at time u gives c [1 - exp(i s (t - u))] after u. The steps occur at times of
every series, so that they are constant within each interval.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from earthspin.checks.work_precision import FloatArray, Ladder, Method, Setting
from earthspin.constants import MAS
from earthspin.wobble.resonance import FROM_EXCITATION, TO_EXCITATION, chandler_frequency

Complex = NDArray[np.complex128]

#: Period (d), quality factor, and length of the series (d), shorter in a quick run.
PERIOD, QUALITY = 433.0, 100.0
SPAN, SHORT_SPAN = 14400.0, 1440.0
#: Amplitudes (mas) and periods (d) of the sinusoids; negative periods are retrograde.
WAVES = ((15.0, 365.25), (6.0, -365.25), (4.0, 182.6), (3.0, -61.0), (2.0, 27.6))
#: Sizes (mas) and times (d) of the steps.
JUMPS = ((8.0 - 3.0j, 360.0), (-5.0 + 2.0j, 1080.0))
START = 60.0 + 40.0j  # mas
STEPS = (20.0, 10.0, 5.0, 2.0, 1.0, 0.5)

TO, FROM = "excitation from polar motion", "polar motion from excitation"


def ladder(quick: bool) -> Ladder:
    """Return the comparison (`Ladder`) of methods for polar motion and its excitation."""
    span = SHORT_SPAN if quick else SPAN
    steps = (10.0, 1.0) if quick else STEPS
    to, back = partial(_excitation_setting, span=span), partial(_polar_motion_setting, span=span)
    return Ladder(
        quantity="excitation",
        unit="mas",
        problem=f"{span / 365.25:.0f} years of polar motion with a free wobble of {PERIOD:g} d, "
        f"Q = {QUALITY:g}, driven by five sinusoids and two steps; the error is the largest of "
        "the mean excitation of an interval, or of the polar motion at its end",
        subject="excitation",
        reference="closed form of both, for sinusoids and steps",
        reference_error=2e-13 * MAS,
        methods=[
            _method("exact mean", TO, steps, partial(to, "exact")),
            _method("central difference", TO, steps, partial(to, "central difference")),
            _method("Wilson's filter", TO, steps, partial(to, "wilson")),
            _method("exact step", FROM, steps, partial(back, "exact")),
            _method("explicit Euler", FROM, steps[-3:], partial(back, "explicit euler")),
        ],
        useful=10 * MAS,
        error=lambda values: float(np.max(np.abs(values[0] - values[1]))) * MAS,
    )


def frequency() -> complex:
    """Complex frequency of the free wobble in the test problem, rad/d."""
    return chandler_frequency(PERIOD, QUALITY)


def true_polar_motion(t: FloatArray) -> Complex:
    """Exact polar motion of the test problem at times in d, mas."""
    s = frequency()
    p = START * np.exp(1j * s * t)
    for size, period in WAVES:
        w = 2 * np.pi / period
        p = p + size * s / (s - w) * (np.exp(1j * w * t) - np.exp(1j * s * t))
    for jump, begin in JUMPS:
        after = np.maximum(t - begin, 0.0)
        p = p - jump * np.expm1(1j * s * after)
    return np.asarray(p)


def true_mean(begin: FloatArray, length: float) -> Complex:
    """Exact mean excitation of the test problem over successive equal intervals, mas."""
    middle = begin + length / 2
    chi = np.zeros(begin.shape, dtype=complex)
    for size, period in WAVES:
        chi += size * np.sinc(length / period) * np.exp(2j * np.pi * middle / period)
    for jump, when in JUMPS:
        chi += jump * np.clip((begin + length - when) / length, 0.0, 1.0)
    return chi


def weighting_error(step: float, *, resonant: bool) -> float:
    """Bound on the error from replacing a weighted mean over an interval by the plain mean, mas.

    The plain mean of c exp(i w t) over an interval of length D differs from the mean with the
    weights of the response by c s w D^2/12. The polar motion differs by s/(s - w) times as much,
    and by the same amount again from the start.

    Parameters
    ----------
    step : float
        Interval D, d.
    resonant : bool
        Return the error of the polar motion rather than that of the excitation.
    """
    s = frequency()
    total = 0.0
    for size, period in WAVES:
        w = 2 * np.pi / period
        gain = 2 * abs(s / (s - w)) if resonant else 1.0
        total += gain * size * abs(s * w) * step**2 / 12
    return float(total)


def _method(
    name: str, task: str, steps: tuple[float, ...], setting: Callable[[float], Setting]
) -> Method:
    """Make the `Method` of one numerical scheme, with a `Setting` for each time step.

    Only exact schemes have a finite error bound.
    """
    claimed = 1.1 * weighting_error(steps[-1], resonant=task == FROM) * MAS
    bound = claimed if name.startswith("exact") else np.inf
    return Method(name, [setting(step) for step in steps], bound, task)


def _excitation_setting(scheme: str, step: float, span: float) -> Setting:
    """Make the `Setting` that computes excitation from polar motion with one time step.

    It returns the computed excitation, and the exact mean excitation over the same intervals.
    """
    t, s = np.asarray(step * np.arange(round(span / step) + 1)), frequency()
    intervals = 2 if scheme == "central difference" else 1
    p, true = true_polar_motion(t), true_mean(t[:-intervals], intervals * step)
    return Setting(f"{step:g} d", lambda: ((TO_EXCITATION[scheme](p, step, s), true), t.size))


def _polar_motion_setting(scheme: str, step: float, span: float) -> Setting:
    """Make the `Setting` that computes polar motion from excitation with one time step.

    It returns the computed polar motion, and the exact polar motion at the same times.
    """
    t, s = np.asarray(step * np.arange(round(span / step) + 1)), frequency()
    chi, true = true_mean(t[:-1], step), true_polar_motion(t)
    return Setting(
        f"{step:g} d", lambda: ((FROM_EXCITATION[scheme](chi, step, s, START), true), t.size)
    )
