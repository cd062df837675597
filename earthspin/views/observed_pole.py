"""Figures of the observed pole: polar motion, celestial pole offsets, and the forecast."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr

from earthspin.constants import DAYS_PER_YEAR, MAS
from earthspin.numerics.arrays import FloatArray
from earthspin.views import drawing, tables
from earthspin.views.drawing import Axes, Figure, Views, axes, note, page_figure
from earthspin.views.result_contents import Result, answer_of, section, stored_section
from earthspin.wobble.record import NEAR, YEAR


def _metres(answer: xr.Dataset) -> float:
    """Distance on the surface, m, for 1 mas of polar motion; 0 if the polar radius is not known."""
    return float(answer.polar_radius) * MAS if "polar_radius" in answer else 0.0


@page_figure(
    "Amplitude and phase in time",
    "Amplitude and phase of the free wobble, fitted in sliding windows of one beat of the free and "
    "the annual wobble. Near 2018 the free wobble almost vanished, and returned with a different "
    "phase.",
    section="chandler",
)
def plot_amplitude_and_phase(tree: Result) -> Figure:
    """Draw amplitude and phase of the free wobble and amplitude of the annual wobble over time.

    Parameters
    ----------
    tree : Dataset or DataTree
        See `plot_amplitude`.
    """
    figure, (upper, lower) = drawing.stacked(2, 5.2, width=7.5, height_ratios=[3, 2])
    plot_amplitude(tree, ax=upper)
    plot_phase(tree, ax=lower)
    upper.set_xlabel("")
    return figure


@page_figure(
    "The path of the pole",
    "Path of the pole over the ground. The annual and the free wobble beat with a period of "
    "6.4 years, and the mean position drifts.",
    phone=5.4,
)
def plot_polhode(result: Result, *, years: float | None = 6.0, ax: Axes | None = None) -> Axes:
    """Draw the path of the pole, with scales in milliarcseconds and in metres.

    The prime meridian points up and 90 degrees west to the right: the ground as seen from
    above, where the spin and the free wobble turn counter-clockwise.

    Parameters
    ----------
    result : Dataset or DataTree
        `x`, `y` over `time`; `polar_radius` for metres.
    years : float, optional
        Number of years to draw, up to the last date; None draws all. For other years, select them:
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
    bar = drawing.path_in_time(ax, y, x, when, "time (UTC, years)", format="%.0f")
    bar.locator = MaxNLocator(8, integer=True)
    ax.plot(y[-1], x[-1], "o", color=drawing.RED, ms=6, zorder=3)
    note(ax, tables.date(answer.time[-1]), (y[-1], x[-1]), (7, 0), color=drawing.RED)
    ax.set(xlabel="y, towards 90° west (mas)", ylabel="x, towards the prime meridian (mas)")
    if metres := _metres(answer):
        ax.secondary_xaxis("top", functions=_scaling(metres)).set_xlabel("y (m)")
        ax.secondary_yaxis("right", functions=_scaling(metres)).set_ylabel("x (m)")
    return ax


@page_figure(
    "Prograde and retrograde spectra",
    "Amplitude spectra of polar motion. The free wobble is prograde only, in the sense of the "
    "spin; the annual wobble is mostly prograde.",
    section="spectrum",
)
def plot_spectra(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the prograde and retrograde amplitude spectra of polar motion.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``polar-motion``; computed again if the section ``spectrum`` is
        missing.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 3.8)
    spectrum = section(result, "spectrum").spectral_amplitude
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
    """Draw the amplitudes of the free wobble, with a 95 % band, and of the annual wobble.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``polar-motion``, computed again if the section ``chandler`` is
        missing, or a result of `fit_chandler`.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 3.4)
    fit, time = _plot_free_wobble(ax, result, drawing.BLUE, "free")
    ax.plot(time, fit.annual_amplitude, color=drawing.GREEN, lw=1, label="annual")
    ax.axhline(200, color=drawing.GREY, lw=0.8, ls="--")
    note(ax, '0.2", source text', (time[0], 200), (2, 3), color=drawing.GREY)
    ax.set(ylim=(0, 235), xlabel="time (UTC)", ylabel="amplitude (mas)")
    if metres := _metres(answer_of(result)):
        ax.secondary_yaxis("right", functions=_scaling(metres)).set_ylabel("amplitude (m)")
    ax.legend(loc="lower left", ncols=2)
    return ax


def plot_modelled(observed: xr.Dataset, modelled: xr.Dataset, *, ax: Axes | None = None) -> Axes:
    """Draw the observed amplitude of the free wobble, and the amplitude driven by an excitation.

    Parameters
    ----------
    observed, modelled : Dataset
        Results of `fit_chandler`: for an observed pole, and for a pole from `polar_motion_from`,
        whose attribute ``source`` names its excitation.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 3.4)
    _plot_free_wobble(ax, observed, drawing.BLUE, "observed")
    driver = modelled.attrs.get("source", "driven by a given excitation")
    _plot_free_wobble(ax, modelled, drawing.RED, driver)
    ax.set(ylim=(0, None), xlabel="time (UTC)", ylabel="amplitude (mas)")
    ax.legend(loc="best")
    return ax


def plot_phase(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the phase of the free wobble relative to a sinusoid of the fitted period, over time.

    The phase is drawn faintly if the amplitude is below twice its error.

    Parameters
    ----------
    result : Dataset or DataTree
        See `plot_amplitude`.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 2.6)
    fit, time = _fit(result)
    phase = fit.chandler_phase.values
    known = fit.chandler_amplitude.values > 2 * fit.chandler_amplitude_error.values
    ax.plot(time, phase, color=drawing.BLUE, lw=1, alpha=0.35)
    ax.plot(time, np.ma.masked_where(~known, phase), color=drawing.BLUE, lw=1.6)
    ax.set(xlabel="time (UTC)", ylabel="phase (deg)")
    return ax


def _fit(result: Result) -> tuple[xr.Dataset, FloatArray]:
    """Return the Dataset of the free wobble fitted in sliding windows, and the window mid-times."""
    fit = result if "chandler_amplitude" in result else section(result, "chandler")
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


def _scaling(factor: float) -> tuple[Callable[[Any], Any], Callable[[Any], Any]]:
    """Return functions that multiply and divide by `factor`, for a second axis in other units."""
    return lambda v: v * factor, lambda v: v / factor


# --- celestial pole offsets ----------------------------------------------------------------------


#: Largest offset that is drawn, mas: the noise of the first years is larger.
LARGEST_OFFSET = 1.5


@page_figure(
    "Observed offsets in time",
    "Observed celestial pole minus that of IAU 2006/2000A, with the 95 % half-widths of the "
    "table as bands.",
)
def plot_offsets(result: Result, *, figure: Figure | None = None) -> Figure:
    """Draw the observed celestial pole offsets dX and dY over time, with 95 % error bands.

    Parameters
    ----------
    result : Dataset or DataTree
        `dX`, `dY` over `time`.
    figure : Figure, optional
    """
    answer = answer_of(result)
    figure, panels = drawing.stacked(2, 4.8, figure, width=7.5, sharey=True)
    for ax, name, colour in zip(panels, ("dX", "dY"), (drawing.BLUE, drawing.RED), strict=True):
        value, error = answer[name].values, answer[f"{name}_error"].values
        drawing.band(ax, answer.time.values, value, error, colour, lw=0.5)
        ax.legend(loc="upper right")
        ax.set(ylabel=f"{name} (mas)", ylim=(-LARGEST_OFFSET, LARGEST_OFFSET))
    panels[-1].set_xlabel("time (UTC)")
    return figure


@page_figure(
    "Free core nutation",
    "Amplitude of the free core nutation in sliding windows, with its 95 % band. Noise alone "
    "exceeds the dashed limit in 1 % of the windows. It is not detected in last windows that are "
    "shaded.",
    section="core_nutation",
)
def plot_core_nutation(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the amplitude of the free core nutation over time, with 95 % band and detection limit.

    The line is faint where nothing is detected.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``pole-offsets``; computed again if the section ``core_nutation`` is
        missing.
    ax : Axes, optional
    """
    ax = axes(ax, 7.5, 3.6)
    fit = section(result, "core_nutation")
    time, size = fit.middle.values, fit.core_nutation_amplitude.values
    detected = fit.detected.values.astype(bool)
    error = fit.core_nutation_amplitude_error.values
    drawing.band(
        ax, time, size, error, drawing.BLUE, alpha=0.2, lowest=0.0, lw=0.8, ls=":", zorder=2
    )
    shown = np.ma.masked_where(~detected, size)
    ax.plot(time, shown, color=drawing.BLUE, lw=1.8, label="amplitude, detected")
    ax.plot(time, fit.detection_limit, color=drawing.GREY, lw=1, ls="--", label="detection limit")
    if not detected[-1]:
        last = time[detected][-1] if detected.any() else time[0]
        ax.axvspan(last, time[-1], color="0.93", lw=0, zorder=0)
        where = {"xycoords": ("data", "axes fraction"), "ha": "right", "va": "top"}
        words = f"not detected\nafter {tables.date(last)}"
        note(ax, words, (time[-1], 0.96), (-2, 0), color=drawing.GREY, **where)
    highest = 1.1 * float(np.max(size + np.minimum(error, size)))
    ax.set(ylim=(0, highest), xlabel="time (UTC)", ylabel="amplitude (µas)")
    ax.legend(loc="upper left", ncols=2)
    return ax


# --- forecast ------------------------------------------------------------------------------------


#: Days after the origin that the axis of the skill names, and days after the first at which the
#: path has an ellipse, unless they are close to the last.
TICKS, ELLIPSES = (1, 3, 10, 30, 90, 180, 365, 730), (30, 90, 365)
#: Half-width of an interval over the standard deviation, and the same of an ellipse of 95 %.
ONE_COORDINATE, BOTH = 1.959964, float(np.sqrt(-2 * np.log(0.05)))
#: Sets of origins whose skill is drawn, with their colours and the forecast beside ours: those that
#: no parameter was chosen on.
SKILL_SETS = {
    "C04 2014-2025": (drawing.BLUE, "least squares with autoregression"),
    "releases": (drawing.RED, "Bulletin A"),
}


@page_figure(
    "Forecast of both coordinates",
    "Forecast of x and y with 95 % intervals; dashed, the prediction of Bulletin A where the "
    "table has one from the same day.",
    uses=("bulletin_a",),
)
def plot_coordinates(result: Result, *, figure: Figure | None = None) -> Figure:
    """Draw the forecast coordinates x and y of the pole over time, with 95 % bands.

    The prediction of Bulletin A is added if the answer has it.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``forecast``.
    figure : Figure, optional
        Drawn on one of its own by default.
    """
    answer, bulletin = answer_of(result), stored_section(result, "bulletin_a")
    figure, panels = drawing.stacked(2, 5.2, figure, width=7.5)
    for ax, name, colour in zip(panels, ("x", "y"), (drawing.BLUE, drawing.GREEN), strict=True):
        value, error = answer[name].values, answer[f"{name}_error"].values
        drawing.band(ax, answer.time.values, value, error, colour, label="forecast")
        if bulletin is not None:
            how: dict[str, Any] = {"color": drawing.RED, "lw": 1, "ls": "--", "label": "Bulletin A"}
            ax.plot(bulletin.time, bulletin[f"bulletin_a_{name}"], **how)
        ax.set_ylabel(f"{name} (mas)")
        ax.legend(loc="best")
    panels[-1].set_xlabel("time (UTC)")
    drawing.few_dates(panels[-1])
    return figure


@page_figure(
    "Path of the pole",
    "Forecast path of the pole over the ground; the ellipse of a day contains the pole of that "
    "day in 95 % of cases.",
)
def plot_path(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the forecast path of the pole, with 95 % ellipses on some days and on the last.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``forecast``.
    ax : Axes, optional
    """
    from matplotlib.patches import Ellipse

    ax = axes(ax, 6.0, 6.0)
    answer = answer_of(result)
    x, y = answer.x.values, answer.y.values
    clear = {"fc": "white", "ec": "none", "alpha": 0.7, "pad": 0.5}
    words = f"forecast from {tables.date(answer.time[0])}"
    ax.plot(y, x, color=drawing.BLUE, lw=1.4, label=words, marker="o", markevery=[0], ms=4)
    days = (answer.time.values - answer.time.values[0]) / np.timedelta64(1, "D")
    marked = [day for day in ELLIPSES if day < 0.7 * days[-1]]
    for number in (*np.searchsorted(days, marked).tolist(), -1):
        row = answer.isel(time=number)
        sx, sy = (float(row[name]) / ONE_COORDINATE for name in ("x_error", "y_error"))
        across = float(row.correlation_xy) * sx * sy
        values, vectors = np.linalg.eigh([[sy**2, across], [across, sx**2]])
        width, height = 2 * BOTH * np.sqrt(values)
        turn = np.degrees(np.arctan2(vectors[1, 0], vectors[0, 0]))
        centre = float(row.y), float(row.x)
        words = "95 % ellipse" if number == -1 else ""
        ellipse = Ellipse(centre, width, height, angle=turn, fc="none", ec=drawing.RED, label=words)
        ax.add_patch(ellipse)
        ax.plot(*centre, "o", color=drawing.RED, ms=4)
        note(ax, tables.date(row.time), centre, (6, 5), color=drawing.RED, bbox=clear)
    ax.set(aspect="equal", ylabel="x, towards the prime meridian (mas)")
    ax.set_xlabel("y, towards 90° west (mas)")
    ax.legend(loc="best")
    return ax


@page_figure(
    "Error of a direction",
    "95 % half-width of a direction between sky and ground from UT1 and polar motion; dashed, the "
    "part of polar motion. UT1 of the first seven days is that of Bulletin A, if the table has it.",
    section="universal_time",
)
def plot_direction(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the error of a direction over time, from UT1 and polar motion, and from the latter.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``forecast``.
    ax : Axes, optional
    """
    ax = axes(ax, 7.0, 3.6)
    answer, rotation = answer_of(result), section(result, "universal_time")
    both, time = rotation.direction_error.values, answer.time.values
    scale = 1e3 if answer.x.attrs.get("units") == "arcsec" else 1.0
    pole = scale * np.hypot(answer.x_error.values, answer.y_error.values)
    ax.semilogy(time, both, color=drawing.RED, lw=1.6, label="UT1 and polar motion")
    ax.semilogy(time, pole, color=drawing.BLUE, lw=1, ls="--", label="polar motion alone")
    metres = float(rotation.ground_error[-1] / both[-1])
    ax.secondary_yaxis("right", functions=_scaling(metres)).set_ylabel("at the equator (m)")
    ax.set(ylabel="95 % half-width (mas)", xlabel="time (UTC)")
    drawing.few_dates(ax)
    ax.legend(loc="best")
    return ax


@page_figure(
    "Error and coverage by horizon",
    "Mean absolute error of one coordinate and share of 95 % intervals that contain the "
    "observed pole, in hindcasts with C04 and on releases of finals2000A; dashed, the other "
    "forecast from the same origins.",
    section="skill",
)
def plot_skill(result: Result, *, figure: Figure | None = None) -> Figure:
    """Draw the measured error of past forecasts, and the coverage of their 95 % intervals.

    The origins were not used to choose parameters.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``forecast``.
    figure : Figure, optional
    """
    data = section(result, "skill").mean("coordinate")
    figure, (errors, shares) = drawing.stacked(2, 5.6, figure, width=7.0, height_ratios=(2, 1))
    for name, (colour, other) in SKILL_SETS.items():
        rows = data.sel(case=data.skill_set == name)
        days = rows.horizon.values
        how: dict[str, Any] = {"color": colour, "lw": 1.4, "marker": "o", "ms": 4}
        errors.plot(days, rows.mean_absolute_error, label=f"forecast, {name}", **how)
        dashed = how | {"ls": "--", "mfc": "white"}
        errors.plot(days, rows.other_mean_absolute_error, label=f"{other}, {name}", **dashed)
        shares.plot(days, 100 * rows.coverage, **how)
    shares.axhline(95, color=drawing.GREY, lw=1, ls=":")
    errors.set(xscale="log", yscale="log", ylabel="mean absolute error (mas)")
    errors.set_yticks([0.1, 1, 10], ["0.1", "1", "10"])
    errors.legend(loc="lower right")
    shares.set(xlabel="time after the origin (days)", ylabel="coverage (%)", ylim=(80, 101))
    shares.set_xticks(TICKS, [str(day) for day in TICKS])
    shares.minorticks_off()
    return figure


VIEWS = {
    "polar-motion": Views([plot_amplitude_and_phase, plot_spectra, plot_polhode]),
    "pole-offsets": Views([plot_offsets, plot_core_nutation]),
    "forecast": Views([plot_coordinates, plot_path, plot_direction, plot_skill]),
}
