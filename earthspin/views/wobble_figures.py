"""Figures of the free wobble: the ladder, the pole's path, its spectra, its amplitude."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from earthspin.constants import MAS
from earthspin.views.drawing import Drawing
from earthspin.views.figures import STYLE, _axes, _svg
from earthspin.wobble.observed import YEAR, spectrum

_BLUE, _ORANGE, _GREEN, _GREY = "#0072B2", "#D55E00", "#009E73", "0.35"


def plot_ladder(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Period of each rung in days, the observed one as a band.

    Parameters
    ----------
    result : Dataset
        Of the question ``wobble``.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    ax = _axes(ax, figsize=(7.5, 4))
    place = np.arange(result.rung.size)
    period, error = result.period_solar.values, result.period_solar_error.values
    if "observed_period" in result:
        seen, half = float(result.observed_period), float(result.observed_period_error)
        ax.axhspan(seen - half, seen + half, color=_ORANGE, alpha=0.3, lw=0)
        ax.annotate(
            f"observed, {seen:.1f} d", (-0.4, seen), xytext=(0, 5), textcoords="offset points",
            color=_ORANGE, fontsize=9,
        )  # fmt: skip
    ax.step(place, period, where="mid", color=_BLUE, lw=1, alpha=0.5)
    ax.errorbar(place, period, error, fmt="o", color=_BLUE, ms=6, capsize=3, lw=1.2)
    for at, value, factor in zip(place, period, result.factor.values, strict=True):
        below = at == result.rung.size - 1 or factor < 1
        ax.annotate(
            f"{value:.1f} d" + (f"\n× {factor:.4f}" if at else ""),
            (at, value),
            xytext=(0, -12 if below else 10),
            textcoords="offset points",
            ha="center",
            va="top" if below else "bottom",
            fontsize=8,
        )
    ax.set_xticks(place, [str(r) for r in result.rung.values])
    ax.set_ylabel("period of the free wobble (d)")
    ax.margins(x=0.08, y=0.2)
    ax.grid(axis="x", visible=False)
    return ax


def plot_polhode(result: xr.Dataset, *, years: float | None = 6.0, ax: Axes | None = None) -> Axes:
    """Path of the pole in milliarcseconds, and in metres on the far sides.

    The prime meridian points up and 90 degrees west to the right: the ground as seen from
    above, where the spin and the free wobble turn counter-clockwise.

    Parameters
    ----------
    result : Dataset
        `x`, `y` over `time`; `polar_radius` for metres.
    years : float, optional
        The last so many; all with None. For any other window select it before:
        ``result.sel(time=slice("1990", "1996"))``.
    ax : Axes, optional
    """
    ax = _axes(ax, figsize=(7.6, 6))
    if years is not None:
        first = result.time.values[-1] - np.timedelta64(round(years * 365.25), "D")
        result = result.sel(time=slice(first, None))
    scale = 1e3 if result.x.attrs.get("units") == "arcsec" else 1.0
    x, y = result.x.values * scale, result.y.values * scale
    when = 1970 + (result.time.values - np.datetime64("1970-01-01")) / np.timedelta64(1, "D") / YEAR
    ax.plot(y, x, color="0.8", lw=0.6, zorder=1)
    dots = ax.scatter(y, x, c=when, s=3, cmap="viridis", zorder=2)
    ax.plot(y[-1], x[-1], "o", color=_ORANGE, ms=6, zorder=3)
    ax.annotate(
        str(np.datetime64(result.time.values[-1], "D")), (y[-1], x[-1]),
        xytext=(7, 0), textcoords="offset points", color=_ORANGE, fontsize=8,
    )  # fmt: skip
    ax.set_aspect("equal")
    ax.set_ylabel("x, towards the prime meridian (mas)")
    ax.set_xlabel("y, towards 90° west (mas)")
    if "polar_radius" in result:
        metres = float(result.polar_radius) * MAS
        ax.secondary_xaxis("top", functions=_times(metres)).set_xlabel("m")
        ax.secondary_yaxis("right", functions=_times(metres)).set_ylabel("m")
    bar = ax.figure.colorbar(dots, ax=ax, pad=0.05, aspect=35, format="%.0f")
    bar.locator = MaxNLocator(8, integer=True)
    return ax


def _times(factor: float) -> Any:
    """A scale and its inverse, for a second axis."""
    return lambda v: v * factor, lambda v: v / factor


def plot_spectra(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Amplitude spectra of polar motion, prograde and retrograde over each other.

    Parameters
    ----------
    result : Dataset
        `x`, `y` over `time`, evenly spaced.
    ax : Axes, optional
    """
    ax = _axes(ax, figsize=(7.5, 3.8))
    scale = 1e3 if result.x.attrs.get("units") == "arcsec" else 1.0
    days = (result.time.values - result.time.values[0]) / np.timedelta64(1, "D")
    frequency, amplitude = spectrum(days, (result.x.values - 1j * result.y.values) * scale)
    for sign, colour, words in ((1, _BLUE, "prograde"), (-1, _ORANGE, "retrograde")):
        inside = (sign * frequency > 0.2) & (sign * frequency < 2.6)
        ax.semilogy(sign * frequency[inside], amplitude[inside], color=colour, lw=1, label=words)
    for period, words, side in (
        (433.0, "free wobble", "right"), (YEAR, "year", "left"), (YEAR / 2, "half a year", "left"),
    ):  # fmt: skip
        at = 365.25 / period
        ax.axvline(at, color="0.7", lw=0.7, zorder=0)
        ax.annotate(
            words, (at, 0.97), xycoords=("data", "axes fraction"), fontsize=8, color=_GREY,
            ha=side, va="top", xytext=(-4 if side == "right" else 4, 0), textcoords="offset points",
        )  # fmt: skip
    ax.set_ylim(0.05, None)
    ax.set_xlabel("frequency (cycles per year)")
    ax.set_ylabel("amplitude (mas)")
    ax.legend(loc="upper right", bbox_to_anchor=(1, 0.9))
    return ax


def plot_amplitude(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Amplitude of free and annual wobble in time, with the free one's 95 % band.

    Parameters
    ----------
    result : Dataset
        Of the question ``polar-motion``, or of `fit_chandler`.
    ax : Axes, optional
    """
    ax = _axes(ax, figsize=(7.5, 3.4))
    time, size, half = _over_time(result, "chandler_amplitude", "chandler_amplitude_error")
    ax.fill_between(time, np.maximum(size - half, 0), size + half, color=_BLUE, alpha=0.2, lw=0)
    ax.plot(time, size, color=_BLUE, lw=1.4, label="free")
    ax.plot(time, result.annual_amplitude, color=_GREEN, lw=1, label="annual")
    ax.axhline(200, color=_GREY, lw=0.8, ls="--")
    ax.annotate(
        '0.2", the text', (time[0], 200), xytext=(2, 3), textcoords="offset points",
        fontsize=8, color=_GREY,
    )  # fmt: skip
    ax.set_ylim(0, 235)
    ax.set_ylabel("amplitude (mas)")
    if "polar_radius" in result:
        metres = float(result.polar_radius) * MAS
        ax.secondary_yaxis("right", functions=_times(metres)).set_ylabel("m")
    ax.legend(loc="lower left", ncols=2)
    return ax


def plot_phase(result: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Phase of the free wobble against a steady one of the fitted period.

    Where the amplitude is below twice its error the phase is drawn faintly.

    Parameters
    ----------
    result : Dataset
        Of the question ``polar-motion``, or of `fit_chandler`.
    ax : Axes, optional
    """
    ax = _axes(ax, figsize=(7.5, 2.6))
    time, size, half = _over_time(result, "chandler_amplitude", "chandler_amplitude_error")
    phase = result.chandler_phase.values
    ax.plot(time, phase, color=_BLUE, lw=1, alpha=0.35)
    ax.plot(time, np.where(size > 2 * half, phase, np.nan), color=_BLUE, lw=1.6)
    ax.set_ylabel("phase (deg)")
    return ax


def _over_time(result: xr.Dataset, *names: str) -> tuple[Any, ...]:
    time = result[names[0]].dims[0]
    return (result[time].values, *(result[name].values for name in names))


# --- drawings for a page -------------------------------------------------------------------------


def rungs(result: xr.Dataset) -> Drawing:
    """The ladder."""
    with rc_context(STYLE):
        ax = plot_ladder(result)
        return Drawing(
            "From the rigid to the yielding body",
            "Period of the free wobble, rung by rung, with 95 % errors from sampled inputs; the "
            "band is the observed period.",
            _svg(_figure(ax)),
        )


def polhode(result: xr.Dataset, years: float | None = 6.0) -> Drawing:
    """The path of the pole."""
    with rc_context(STYLE):
        ax = plot_polhode(result, years=years)
        return Drawing(
            "The path of the pole",
            "Annual and free wobble beat every 6.4 years; the spiral's middle drifts.",
            _svg(_figure(ax)),
        )


def spectra(result: xr.Dataset) -> Drawing:
    """The spectra."""
    with rc_context(STYLE):
        ax = plot_spectra(result)
        return Drawing(
            "Prograde and retrograde",
            "The free wobble turns one way only, with the spin; the year is nearly so.",
            _svg(_figure(ax)),
        )


def amplitude_and_phase(result: xr.Dataset) -> Drawing:
    """Amplitude above, phase below."""
    with rc_context(STYLE):
        figure = Figure(figsize=(7.5, 5.2), layout="constrained")
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
        plot_amplitude(result, ax=upper)
        plot_phase(result, ax=lower)
        return Drawing(
            "Amplitude and phase in time",
            "In windows of one beat. The free wobble all but died near 2018 and came back with "
            "another phase.",
            _svg(figure),
        )


def _figure(ax: Axes) -> Figure:
    assert isinstance(ax.figure, Figure)
    return ax.figure
