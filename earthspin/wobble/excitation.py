"""Convert polar motion to excitation and back, exactly for the mean excitation in each step.

    p + (i/s) dp/dt = chi,    p = x - i y,    s = (2 pi/T)(1 + i/(2 Q))

(Barnes, Hide, White & Wilson 1983, Proc. R. Soc. A 387, 31; for the reported pole: Gross 1992,
Geophys. J. Int. 109, 162). Where chi is constant over a step D, or stands for its mean weighted
with the decaying response, the solution is p1 = a p0 + (1 - a) chi with a = exp(i s D), and either
follows from the other without error.
"""

from __future__ import annotations

import numpy as np

from earthspin.errors import UndefinedError
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.wobble.record import known_terms, least_squares

# --- the equation ---------------------------------------------------------------------------------

#: Share of a steady excitation's effect that must be left at the end of a step.
_LEAST_TRACE = 1e-10


def pole_of(x: FloatArray | float, y: FloatArray | float) -> ComplexArray:
    """Complex polar motion p = x - i y from the coordinates x and y."""
    return np.asarray(x - 1j * y)


def coordinates_of(p: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """Coordinates x and y from the complex polar motion p = x - i y."""
    return p.real, -p.imag


def excitation_of(chi1: FloatArray, chi2: FloatArray) -> ComplexArray:
    """Complex excitation chi1 + i chi2 from its two components."""
    return np.asarray(chi1 + 1j * chi2)


def middles_of_steps(ends: FloatArray) -> FloatArray:
    """Middles of the steps between consecutive times, shape (n - 1,)."""
    return np.asarray((ends[:-1] + ends[1:]) / 2)


def ends_of_steps(middles: FloatArray, step: float) -> FloatArray:
    """Start and end times of equal steps, from the middles of the steps, shape (n + 1,)."""
    return np.asarray(middles[0] - step / 2 + step * np.arange(middles.size + 1))


def chandler_frequency(period: float, quality_factor: float) -> complex:
    """Complex frequency of the free wobble, (2 pi/T)(1 + i/(2 Q)), from its period T and Q.

    Parameters
    ----------
    period : float
        T, in any unit of time.
    quality_factor : float
        Q; infinite without loss.

    Raises
    ------
    UndefinedError
        If T or Q is not greater than zero.
    """
    if not (period > 0 and np.isfinite(period)):
        raise UndefinedError(f"the period of the wobble is {period!r}; it is greater than zero")
    if not quality_factor > 0:
        raise UndefinedError(f"the quality factor is {quality_factor!r}; it is greater than zero")
    return complex(2 * np.pi / period * (1 + 0.5j / quality_factor))


def excitation(p: ComplexArray, step: float, s: complex) -> ComplexArray:
    """Mean excitation in each time step of a polar motion series, by an exact formula.

    Parameters
    ----------
    p : complex array, shape (n,)
        x - i y, evenly spaced.
    step : float
        D, in the unit of time of `s`.
    s : complex
        Result of `chandler_frequency`.

    Returns
    -------
    complex array, shape (n - 1,)
        In the unit of p.

    Raises
    ------
    UndefinedError
        For a step that is not greater than zero, or one of whole free periods without loss, at
        whose end nothing tells what drove it.
    """
    decay, rise = _response(step, s)
    if abs(rise) <= _LEAST_TRACE * abs(s.real * step):
        raise UndefinedError(
            f"a step of {s.real * step / (2 * np.pi):.6g} free periods without loss: what drives "
            f"the pole leaves no trace at its end; choose another step"
        )
    return np.asarray((p[1:] - decay * p[:-1]) / rise)


def polar_motion_from(
    chi: ComplexArray, step: float, s: complex, start: complex = 0j
) -> ComplexArray:
    """Polar motion driven by a series of mean excitations, by an exact formula.

    Parameters
    ----------
    chi : complex array, shape (n,)
        Means over consecutive steps.
    step, s
        See `excitation`.
    start : complex
        Polar motion at the start of the first step.

    Returns
    -------
    complex array, shape (n + 1,)
        Polar motion at the ends of the steps, the start included.
    """
    from scipy.signal import lfilter

    decay, rise = _response(step, s)
    driven = lfilter([rise], [1.0, -decay], chi, zi=np.array([decay * start]))[0]
    return np.concatenate([[start], driven])


def _response(step: float, s: complex) -> tuple[complex, complex]:
    """Factors exp(i s D) and 1 - exp(i s D) of a wobble of complex frequency s, over a step D.

    They are computed without cancellation.
    """
    if not step > 0:
        raise UndefinedError(f"a step of {step:g} is not possible: time runs forwards")
    return complex(np.exp(1j * s * step)), complex(-np.expm1(1j * s * step))


# --- polar motion driven by a known excitation ----------------------------------------------------


def fitted_start(time: FloatArray, p: ComplexArray, chi: ComplexArray, s: complex) -> complex:
    """Fit the initial pole position of driven polar motion to observations, by least squares.

    Drift and seasonal terms, which are the least accurate part of excitation models, are fitted at
    the same time and are not part of the result.

    Parameters
    ----------
    time : array, shape (n,)
        Even steps.
    p : complex array, shape (n,)
        Observed, x - i y.
    chi : complex array, shape (n - 1,)
        Means over the steps, in the unit of p.
    s : complex
        Result of `chandler_frequency`.
    """
    step = float((time[-1] - time[0]) / (time.size - 1))
    residual = p - polar_motion_from(chi, step, s)
    free_wobble = np.exp(1j * s * (time - time[0]))
    return complex(least_squares(np.column_stack([known_terms(time), free_wobble]), residual)[-1])


# --- what chi1 and chi2 mean ----------------------------------------------------------------------

#: Correlation with the excitation that moves the pole from which another meaning agrees with it,
#: and its smallest ratio to that of the given meaning.
LIKE, BETTER = 0.4, 2.0
#: Smallest number of days that are compared, and ratio of sizes from which the unit is another.
FEWEST, OTHER_UNIT = 365, 1e3
#: Period (d) and quality factor of the free wobble in the comparison.
_FREE = (433.0, 100.0)


def other_meaning(
    time: FloatArray, p: ComplexArray, chi: ComplexArray
) -> tuple[dict[str, str], float] | None:
    """Find another meaning of chi1 and chi2 that agrees with the pole where they do not.

    Drift and seasonal terms are removed first, of which ocean and land water have other signs than
    the atmosphere.

    Parameters
    ----------
    time : array, shape (n,)
        Days.
    p : complex array, shape (n,)
        Observed, x - i y.
    chi : complex array, shape (n - 1,)
        Means over the steps, in the unit of p.

    Returns
    -------
    dict of str to str
        What the numbers given as chi1 and chi2 are, such as ``{"chi1": "-chi2", "chi2": "chi1"}``.
    float
        Their size as a multiple of that of the excitation that moves the pole.

    None is returned if they agree, if no meaning agrees, or if less than a year is compared.
    """
    if time.size < 2 or (span := float(time[-1] - time[0])) < FEWEST:
        return None
    terms = known_terms(middles_of_steps(time))
    needed = excitation(p, span / (time.size - 1), chandler_frequency(*_FREE))
    observed, given = (part - terms @ least_squares(terms, part) for part in (needed, chi))
    series = np.array([given.real, given.imag, observed.real, observed.imag])
    sizes = np.std(series, axis=1)
    if not np.all(sizes > 0):
        return None
    ratio = float(np.hypot(*sizes[:2]) / np.hypot(*sizes[2:]))
    same = np.corrcoef(series)[:2, 2:]  # of the given chi1 and chi2 with the observed ones
    straight, exchanged = np.diagonal(same), np.diagonal(same[:, ::-1])
    meanings = ((straight, ("chi1", "chi2")), (exchanged, ("chi2", "chi1")))
    signs, names = max(meanings, key=lambda meaning: min(abs(meaning[0])))
    best = min(abs(signs))
    same_unit = 1 / OTHER_UNIT < ratio < OTHER_UNIT
    if best < LIKE or (same_unit and best < BETTER * min(straight)):
        return None
    words = ["-" * bool(sign < 0) + name for sign, name in zip(signs, names, strict=True)]
    return dict(zip(("chi1", "chi2"), words, strict=True)), ratio
