r"""Polar motion and its excitation: exact and approximate schemes, in both directions.

The excitation consists of sinusoids and steps, and its polar motion has a closed form. With
p' = i s (p - chi), a sinusoid chi = c exp(i w t) gives

    p = c [exp(i w t) - exp(i s t)] s/(s - w)

and a step of size c at time u gives c [1 - exp(i s (t - u))] after u. The steps occur at times of
every series, so that they are constant within each interval.
"""

from collections.abc import Callable

import numpy as np
from scipy.signal import lfilter

from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.excitation import chandler_frequency, excitation, polar_motion_from
from tests.benchmarks.accuracy.ladder import Ladder, Run

#: Period (d) and quality factor of the free wobble, and length of the series (d).
PERIOD, QUALITY, SPAN = 433.0, 100.0, 14400.0
#: Complex frequency of the free wobble, rad/d.
FREQUENCY = chandler_frequency(PERIOD, QUALITY)
#: Amplitudes (mas) and periods (d) of the sinusoids; negative periods are retrograde.
WAVES = ((15.0, 365.25), (6.0, -365.25), (4.0, 182.6), (3.0, -61.0), (2.0, 27.6))
#: Sizes (mas) and times (d) of the steps.
JUMPS = ((8.0 - 3.0j, 360.0), (-5.0 + 2.0j, 1080.0))
START = 60.0 + 40.0j  # mas
STEPS = (20.0, 10.0, 5.0, 2.0, 1.0, 0.5)


def central_difference(p: ComplexArray, step: float, s: complex) -> ComplexArray:
    """Excitation at inner samples of polar motion, by central differences, shape (n - 2,)."""
    return np.asarray(p[1:-1] + 1j / s * (p[2:] - p[:-2]) / (2 * step))


def wilson_filter(p: ComplexArray, step: float, s: complex) -> ComplexArray:
    """Excitation midway between samples of polar motion, by Wilson's filter, shape (n - 1,).

    chi = i e^(-i pi F D)/(s D) (p1 - e^(i s D) p0) (Wilson 1985, Geophys. J. R. astr. Soc.
    80, 551): the exact relation but for terms of second order in s D.
    """
    shift = np.exp(-0.5j * s.real * step)
    return np.asarray(1j * shift / (s * step) * (p[1:] - np.exp(1j * s * step) * p[:-1]))


def euler_forward(chi: ComplexArray, step: float, s: complex, start: complex = 0j) -> ComplexArray:
    """Polar motion driven by an excitation, in explicit Euler steps, shape (n + 1,).

    The method is unstable; it serves for comparison.
    """
    growth = 1 + 1j * s * step
    driven = lfilter([1 - growth], [1.0, -growth], chi, zi=np.array([growth * start]))[0]
    return np.concatenate([[start], driven])


#: Ways from polar motion to excitation, and from excitation to polar motion, by name.
TO_EXCITATION: dict[str, Callable[[ComplexArray, float, complex], ComplexArray]] = {
    "exact": excitation,
    "central difference": central_difference,
    "wilson": wilson_filter,
}
FROM_EXCITATION: dict[str, Callable[..., ComplexArray]] = {
    "exact": polar_motion_from,
    "explicit euler": euler_forward,
}


def to_excitation() -> Ladder:
    """Methods for the excitation from polar motion."""
    return _ladder(
        "Excitation from polar motion",
        "mean excitation of an interval",
        {
            "exact mean": _runs(_excitation, "exact"),
            "central difference": _runs(_excitation, "central difference"),
            "Wilson's filter": _runs(_excitation, "wilson"),
        },
        {"exact mean": 1.1 * weighting_error(STEPS[-1], resonant=False)},
    )


def from_excitation() -> Ladder:
    """Methods for polar motion from its excitation."""
    return _ladder(
        "Polar motion from excitation",
        "polar motion at the end of an interval",
        {
            "exact step": _runs(_polar_motion, "exact"),
            "explicit Euler": dict(list(_runs(_polar_motion, "explicit euler").items())[-3:]),
        },
        {"exact step": 1.1 * weighting_error(STEPS[-1], resonant=True)},
    )


def _ladder(
    title: str, subject: str, runs: dict[str, dict[str, Run]], bounds: dict[str, float]
) -> Ladder:
    return Ladder(
        title=title,
        problem=f"{SPAN / 365.25:.0f} years of polar motion with a free wobble of {PERIOD:g} d, "
        f"Q = {QUALITY:g}, driven by five sinusoids and two steps; the error is the largest of "
        f"the {subject}",
        reference="closed form, for sinusoids and steps",
        unit="mas",
        floor=2e-13,
        error=lambda values: np.max(np.abs(values[0] - values[1])),
        runs=runs,
        bounds=bounds,
    )


def true_polar_motion(t: FloatArray) -> ComplexArray:
    """Exact polar motion at times in d, mas."""
    s = FREQUENCY
    p = START * np.exp(1j * s * t)
    for size, period in WAVES:
        w = 2 * np.pi / period
        p = p + size * s / (s - w) * (np.exp(1j * w * t) - np.exp(1j * s * t))
    for jump, begin in JUMPS:
        p = p - jump * np.expm1(1j * s * np.maximum(t - begin, 0.0))
    return np.asarray(p)


def true_mean(begin: FloatArray, length: float) -> ComplexArray:
    """Exact mean excitation over successive equal intervals, mas."""
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
    weights of the response by c s w D^2/12. The polar motion (`resonant`) differs by s/(s - w)
    times as much, and by the same amount again from the start.
    """
    s, total = FREQUENCY, 0.0
    for size, period in WAVES:
        w = 2 * np.pi / period
        gain = 2 * abs(s / (s - w)) if resonant else 1.0
        total += gain * size * abs(s * w) * step**2 / 12
    return float(total)


def _runs(kind: Run, scheme: str) -> dict[str, Run]:
    return {f"{step:g} d": kind(scheme, step) for step in STEPS}


def _excitation(scheme: str, step: float) -> Run:
    """Prepare a run that returns computed and true excitation with one time step."""
    t = step * np.arange(round(SPAN / step) + 1)
    intervals = 2 if scheme == "central difference" else 1
    p, true = true_polar_motion(t), true_mean(t[:-intervals], intervals * step)
    return lambda: ((TO_EXCITATION[scheme](p, step, FREQUENCY), true), t.size)


def _polar_motion(scheme: str, step: float) -> Run:
    """Prepare a run that returns computed and true polar motion with one time step."""
    t = step * np.arange(round(SPAN / step) + 1)
    chi, true = true_mean(t[:-1], step), true_polar_motion(t)
    return lambda: ((FROM_EXCITATION[scheme](chi, step, FREQUENCY, START), true), t.size)
