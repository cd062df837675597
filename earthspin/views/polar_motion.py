"""Figures of observed polar motion: path of the pole, spectra, and free wobble."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr

from earthspin.constants import DAYS_PER_YEAR, MAS
from earthspin.numerics.arrays import FloatArray
from earthspin.views import drawing
from earthspin.views.drawing import Axes, Figure, PageFigure, axes, note
from earthspin.views.reading import Result, answer_of, needed
from earthspin.views.table import date
from earthspin.wobble.record import NEAR, YEAR

# --- tables --------------------------------------------------------------------------------------


def _metres(answer: xr.Dataset) -> float:
    """Distance on the ground, m, that corresponds to 1 mas of polar motion; 0 if not known."""
    return float(answer.polar_radius) * MAS if "polar_radius" in answer else 0.0


def plot_amplitude_and_phase(tree: Result) -> Figure:
    """Draw amplitude and phase of the free wobble and amplitude of the annual wobble over time.

    Parameters
    ----------
    tree : Dataset or DataTree
        As of `plot_amplitude`.
    """
    figure, (upper, lower) = drawing.stacked(2, 5.2, width=7.5, height_ratios=[3, 2])
    plot_amplitude(tree, ax=upper)
    plot_phase(tree, ax=lower)
    return figure


def _caption_of_amplitude(tree: Result) -> str:
    first, last = needed(tree, "chandler").middle.values[[0, -1]]
    words = (
        "Amplitude and phase of the free wobble, fitted in sliding windows of one beat of the free "
        "and the annual wobble."
    )
    if first < np.datetime64("2018-01-01") < last:
        words += " The free wobble almost vanished near 2018 and returned with a different phase."
    return words


def plot_polhode(result: Result, *, years: float | None = 6.0, ax: Axes | None = None) -> Axes:
    """Draw the path of the pole, with scales in milliarcseconds and in metres.

    The prime meridian points up and 90 degrees west to the right: the ground as seen from
    above, where the spin and the free wobble turn counter-clockwise.

    Parameters
    ----------
    result : Dataset or DataTree
        `x`, `y` over `time`; `polar_radius` for metres.
    years : float, optional
        How many years to draw, up to the last date; all with None. For other years, select them:
        ``result.sel(time=slice("1990", "1996"))``.
    ax : Axes, optional
    """
    from matplotlib.ticker import MaxNLocator

    ax = axes(ax, 6.6, 7.4)
    answer = answer_of(result)
    if years is not None:
        first = answer.time.values[-1] - np.timedelta64(round(years * DAYS_PER_YEAR), "D")
        answer = answer.sel(time=slice(first, None))
    scale = 1e3 if answer.x.attrs.get("units") == "arcsec" else 1.0
    x, y = answer.x.values * scale, answer.y.values * scale
    when = 1970 + (answer.time.values - np.datetime64("1970-01-01")) / np.timedelta64(1, "D") / YEAR
    ax.plot(y, x, color="0.8", lw=0.6, zorder=1)
    dots = ax.scatter(y, x, c=when, s=3, cmap="viridis", zorder=2)
    ax.plot(y[-1], x[-1], "o", color=drawing.RED, ms=6, zorder=3)
    note(ax, date(answer.time[-1]), (y[-1], x[-1]), (7, 0), color=drawing.RED)
    ax.set(aspect="equal", ylabel="x, towards the prime meridian (mas)")
    ax.set_xlabel("y, towards 90° west (mas)")
    if metres := _metres(answer):
        ax.secondary_xaxis("top", functions=_times(metres)).set_xlabel("y (m)")
        ax.secondary_yaxis("right", functions=_times(metres)).set_ylabel("x (m)")
    bar = ax.figure.colorbar(
        dots, ax=ax, location="bottom", shrink=0.8, aspect=40, format="%.0f", label="time (years)"
    )
    bar.locator = MaxNLocator(8, integer=True)
    return ax


def plot_spectra(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the prograde and retrograde amplitude spectra of polar motion.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``polar-motion``, which is run again without its section ``spectrum``.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 3.8)
    spectrum = needed(result, "spectrum").spectral_amplitude
    frequency, amplitude = spectrum.frequency.values * DAYS_PER_YEAR, spectrum.values
    for sign, colour, words in ((1, drawing.BLUE, "prograde"), (-1, drawing.RED, "retrograde")):
        inside = (sign * frequency > 0.2) & (sign * frequency < 2.6)
        ax.semilogy(sign * frequency[inside], amplitude[inside], color=colour, lw=1, label=words)
    marks = (NEAR, "free wobble", "right", -4), (YEAR, "year", "left", 4)
    for period, words, side, by in (*marks, (YEAR / 2, "half a year", "left", 4)):
        at = DAYS_PER_YEAR / period
        ax.axvline(at, color="0.7", lw=0.7, zorder=0)
        where = {"xycoords": ("data", "axes fraction"), "ha": side, "va": "top"}
        note(ax, words, (at, 0.97), (by, 0), color=drawing.GREY, **where)
    ax.set(xlabel="frequency (cycles per year)", ylabel="amplitude (mas)", ylim=(0.05, None))
    ax.legend(loc="upper right", bbox_to_anchor=(1, 0.9))
    return ax


def plot_amplitude(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the amplitude of the free wobble with its 95 % band, and that of the annual wobble.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``polar-motion``, which is run again without its section ``chandler``, or
        of `fit_chandler`.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 3.4)
    fit, time = _plot_free_wobble(ax, result, drawing.BLUE, "free")
    ax.plot(time, fit.annual_amplitude, color=drawing.GREEN, lw=1, label="annual")
    ax.axhline(200, color=drawing.GREY, lw=0.8, ls="--")
    note(ax, '0.2", the text', (time[0], 200), (2, 3), color=drawing.GREY)
    ax.set(ylim=(0, 235), ylabel="amplitude (mas)")
    if metres := _metres(answer_of(result)):
        ax.secondary_yaxis("right", functions=_times(metres)).set_ylabel("amplitude (m)")
    ax.legend(loc="lower left", ncols=2)
    return ax


def plot_modelled(observed: xr.Dataset, modelled: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Draw the observed amplitude of the free wobble, and the amplitude driven by an excitation.

    Parameters
    ----------
    observed, modelled : Dataset
        As `fit_chandler` gives them, of an observed pole and of one of `polar_motion_from`; the
        attribute ``source`` of the second says what drove it.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 3.4)
    _plot_free_wobble(ax, observed, drawing.BLUE, "observed")
    driver = modelled.attrs.get("source", "driven by a given excitation")
    _plot_free_wobble(ax, modelled, drawing.RED, driver)
    ax.set(ylim=(0, None), ylabel="amplitude (mas)")
    ax.legend(loc="best")
    return ax


def plot_phase(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the phase of the free wobble relative to a sinusoid of the fitted period, over time.

    Where the amplitude is below twice its error the phase is drawn faintly.

    Parameters
    ----------
    result : Dataset or DataTree
        As of `plot_amplitude`.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 2.6)
    fit, time = _fit(result)
    phase = fit.chandler_phase.values
    known = fit.chandler_amplitude.values > 2 * fit.chandler_amplitude_error.values
    ax.plot(time, phase, color=drawing.BLUE, lw=1, alpha=0.35)
    ax.plot(time, np.where(known, phase, np.nan), color=drawing.BLUE, lw=1.6)
    ax.set_ylabel("phase (deg)")
    return ax


def _fit(result: Result) -> tuple[xr.Dataset, FloatArray]:
    """Return the Dataset of the fitted free wobble, and the mid-times of the sliding windows."""
    fit = result if "chandler_amplitude" in result else needed(result, "chandler")
    assert isinstance(fit, xr.Dataset)
    return fit, fit[fit.chandler_amplitude.dims[0]].values


def _plot_free_wobble(
    ax: Axes, result: Result, colour: str, words: str
) -> tuple[xr.Dataset, FloatArray]:
    """Draw the amplitude of the free wobble over time, with its 95 % band."""
    fit, time = _fit(result)
    size, error = fit.chandler_amplitude.values, fit.chandler_amplitude_error.values
    drawing.band(ax, time, size, error, colour, alpha=0.2, lowest=0.0, lw=1.4, label=words)
    return fit, time


def _times(factor: float) -> tuple[Callable[[Any], Any], Callable[[Any], Any]]:
    """Return functions that multiply and divide by a factor, for a second axis in other units."""
    return lambda v: v * factor, lambda v: v / factor


FIGURES = [
    PageFigure(
        "Amplitude and phase in time",
        _caption_of_amplitude,
        plot_amplitude_and_phase,
        section="chandler",
    ),
    PageFigure(
        "Prograde and retrograde spectra",
        "Amplitude spectra of polar motion. The free wobble is prograde only, in the sense of the "
        "spin; the annual wobble is mostly prograde.",
        plot_spectra,
        section="spectrum",
    ),
    PageFigure(
        "The path of the pole",
        "Path of the pole over the ground. The annual and the free wobble beat with a period of "
        "6.4 years, and the mean position drifts.",
        plot_polhode,
        phone=5.4,
    ),
]
