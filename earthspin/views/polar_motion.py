"""Observed polar motion: the path of the pole, its spectra, and its free wobble."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from earthspin.constants import MAS
from earthspin.views import drawing
from earthspin.views.drawing import PageFigure, axes, note
from earthspin.views.reading import Result, answer_of, needed, of_sections
from earthspin.views.table import Table, date, measured, quantities, with_error
from earthspin.wobble.record import NEAR, YEAR

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

JULIAN = 365.25  # d, the year of the axes


# --- tables --------------------------------------------------------------------------------------


def tables(tree: Result) -> list[Table]:
    """The series, the observed wobble, and the statements of the source text about it."""
    makers = (observed, statements)
    return [series(tree), *(t for make in makers for t in of_sections(tree, {"chandler": make}))]


def series(tree: Result) -> Table:
    """Range of the observed coordinates of the pole."""
    answer = answer_of(tree)
    first, last = date(answer.time[0]), date(answer.time[-1])
    return Table(
        "Polar motion",
        ("coordinate, arcsec", "smallest", "largest", "last"),
        [
            (
                name,
                f"{float(answer[name].min()):+.6f}",
                f"{float(answer[name].max()):+.6f}",
                measured(answer.isel(time=-1), name),
            )
            for name in ("x", "y")
        ],
        f"{answer.time.size} epochs from {first} to {last}; source: "
        f"{answer.x.attrs['references']}.",
    )


def observed(tree: Result) -> Table:
    """Period, quality factor and present amplitude of the observed wobble."""
    found = needed(tree, "chandler")
    rows = quantities(found, "chandler_period")
    if "chandler_quality_factor" in found:
        low, high = (float(found[f"chandler_quality_factor_{end}"]) for end in ("low", "high"))
        ends = f"{low:.0f} to {high:.0f}" if math.isfinite(high) else f"{low:.0f} or more"
        rows.append(("quality factor", f"{float(found.chandler_quality_factor):.0f} ({ends})"))
    size = found.chandler_amplitude.values
    for words, at in (("largest", size.argmax()), ("smallest", size.argmin()), ("last", -1)):
        of = found.isel(middle=at)
        year = date(of.middle, "Y")
        rows.append((f"{words} amplitude, mas, {year}", measured(of, "chandler_amplitude")))
    annual = f"{float(found.annual_amplitude.median()):.1f}"
    return Table(
        "The observed wobble",
        ("quantity", "value"),
        [*rows, ("median amplitude of the prograde annual wobble, mas", annual)],
        f"Method: {found.chandler_period.attrs['method']}. Errors and intervals are 95 %. "
        "Amplitudes are means over windows of one beat of the free and the annual wobble; the year "
        "is that of the middle of the window.",
    )


def statements(tree: Result) -> Table:
    """Statements of the source text about the wobble, and the years in which they held."""
    found, metres = needed(tree, "chandler"), _metres(answer_of(tree))
    period, error = float(found.chandler_period), float(found.chandler_period_error)
    amplitude = found.chandler_amplitude
    rows = [
        (
            words,
            f"{float(amplitude.min()) * scale:{shown}} to {float(amplitude.max()) * scale:{shown}}",
            _years_near(amplitude, size / scale),
        )
        for words, size, scale, shown in (
            ("circle of 6 m", 6.0, metres, ".1f"),
            ("cone of 0.2 arcsec", 0.2, 1e-3, ".3f"),
        )
        if scale
    ]
    within = "within the error" if abs(434 - period) <= error else "outside the error"
    return Table(
        "Statements of the source text (I.6)",
        ("statement", "observed", "true within 25 %"),
        [*rows, ("period of 434 days", with_error(period, error), within)],
        'The source text is Appendix I, "Rigid Body Dynamics". The observed values are those of '
        "the free wobble alone, without the annual one.",
    )


def _metres(answer: xr.Dataset) -> float:
    """Metres on the ground for a milliarcsecond; 0 if the radius is not known."""
    return float(answer.polar_radius) * MAS if "polar_radius" in answer else 0.0


def _years_near(amplitude: xr.DataArray, size: float) -> str:
    """First and last year in which an amplitude is within a quarter of a size."""
    near = abs(amplitude.values / size - 1) <= 0.25
    if not near.any():
        return "never"
    times = amplitude.middle.values[near]
    return f"{date(times[0], 'Y')} to {date(times[-1], 'Y')}, {near.mean():.0%} of the time"


# --- figures -------------------------------------------------------------------------------------


def _plot_amplitude_and_phase(tree: Result) -> Figure:
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
    """Path of the pole in milliarcseconds, and in metres on the far sides.

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
        first = answer.time.values[-1] - np.timedelta64(round(years * 365.25), "D")
        answer = answer.sel(time=slice(first, None))
    x, y = _in_mas(answer)
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
    """Amplitude spectra of polar motion, prograde and retrograde over each other.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``polar-motion``, which is run again without its section ``spectrum``.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 3.8)
    found = needed(result, "spectrum").spectral_amplitude
    frequency, amplitude = found.frequency.values * JULIAN, found.values
    for sign, colour, words in ((1, drawing.BLUE, "prograde"), (-1, drawing.RED, "retrograde")):
        inside = (sign * frequency > 0.2) & (sign * frequency < 2.6)
        ax.semilogy(sign * frequency[inside], amplitude[inside], color=colour, lw=1, label=words)
    marks = (NEAR, "free wobble", "right", -4), (YEAR, "year", "left", 4)
    for period, words, side, by in (*marks, (YEAR / 2, "half a year", "left", 4)):
        at = JULIAN / period
        ax.axvline(at, color="0.7", lw=0.7, zorder=0)
        where = {"xycoords": ("data", "axes fraction"), "ha": side, "va": "top"}
        note(ax, words, (at, 0.97), (by, 0), color=drawing.GREY, **where)
    ax.set_ylim(0.05, None)
    ax.set(xlabel="frequency (cycles per year)", ylabel="amplitude (mas)")
    ax.legend(loc="upper right", bbox_to_anchor=(1, 0.9))
    return ax


def plot_amplitude(result: Result, *, ax: Axes | None = None) -> Axes:
    """Amplitude of free and annual wobble in time, with the free one's 95 % band.

    Parameters
    ----------
    result : Dataset or DataTree
        Of the question ``polar-motion``, which is run again without its section ``chandler``, or
        of `fit_chandler`.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 3.4)
    found, time, size, half = _free_wobble(result)
    drawing.band(ax, time, size, half, drawing.BLUE, alpha=0.2, lowest=0.0, lw=1.4, label="free")
    ax.plot(time, found.annual_amplitude, color=drawing.GREEN, lw=1, label="annual")
    ax.axhline(200, color=drawing.GREY, lw=0.8, ls="--")
    note(ax, '0.2", the text', (time[0], 200), (2, 3), color=drawing.GREY)
    ax.set(ylim=(0, 235), ylabel="amplitude (mas)")
    if metres := _metres(answer_of(result)):
        ax.secondary_yaxis("right", functions=_times(metres)).set_ylabel("amplitude (m)")
    ax.legend(loc="lower left", ncols=2)
    return ax


def plot_modelled(observed: xr.Dataset, modelled: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Amplitude of the free wobble, observed and driven by an excitation.

    Parameters
    ----------
    observed, modelled : Dataset
        As `fit_chandler` gives them, of an observed pole and of one of `polar_motion_from`; the
        attribute ``source`` of the second says what drove it.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 3.4)
    for found, colour, words in (
        (observed, drawing.BLUE, "observed"),
        (modelled, drawing.RED, modelled.attrs.get("source", "driven by a given excitation")),
    ):
        _, time, size, half = _free_wobble(found)
        drawing.band(ax, time, size, half, colour, alpha=0.2, lowest=0.0, lw=1.4, label=words)
    ax.set_ylim(0, None)
    ax.set_ylabel("amplitude (mas)")
    ax.legend(loc="best")
    return ax


def plot_phase(result: Result, *, ax: Axes | None = None) -> Axes:
    """Phase of the free wobble against a steady one of the fitted period.

    Where the amplitude is below twice its error the phase is drawn faintly.

    Parameters
    ----------
    result : Dataset or DataTree
        As of `plot_amplitude`.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 2.6)
    found, time, size, half = _free_wobble(result)
    phase = found.chandler_phase.values
    ax.plot(time, phase, color=drawing.BLUE, lw=1, alpha=0.35)
    ax.plot(time, np.where(size > 2 * half, phase, np.nan), color=drawing.BLUE, lw=1.6)
    ax.set_ylabel("phase (deg)")
    return ax


def _free_wobble(result: Result) -> tuple[xr.Dataset, np.ndarray, np.ndarray, np.ndarray]:
    """The fit, the middles of its windows, the amplitude and its error."""
    found = result if "chandler_amplitude" in result else needed(result, "chandler")
    assert isinstance(found, xr.Dataset)
    time = found[found.chandler_amplitude.dims[0]].values
    return found, time, found.chandler_amplitude.values, found.chandler_amplitude_error.values


def _in_mas(answer: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    scale = 1e3 if answer.x.attrs.get("units") == "arcsec" else 1.0
    return answer.x.values * scale, answer.y.values * scale


def _times(factor: float) -> tuple[Callable[[Any], Any], Callable[[Any], Any]]:
    """A scale and its inverse, for a second axis."""
    return lambda v: v * factor, lambda v: v / factor


FIGURES = [
    PageFigure(
        "Amplitude and phase in time",
        _caption_of_amplitude,
        _plot_amplitude_and_phase,
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
