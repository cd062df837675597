"""Figures of the length of day: zonal tides, and observations with the tides and without them."""

from __future__ import annotations

from earthspin.engine.variables import si
from earthspin.views import drawing
from earthspin.views.drawing import BLUE, GREY, ORANGE, RED, Axes, Figure, Views, axes, page_figure
from earthspin.views.result_contents import Result, answer_of, section

_COLOURS = {"sun": ORANGE, "moon": BLUE, "total": "#222222"}


@page_figure(
    "Length of day by zonal tides",
    "The Moon's tide beats with its declination and distance, of 13.7 and 27.6 days; that of the "
    "Sun has half a year and a year.",
    phone=4.0,
)
def plot_length_of_day(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the change of the length of day by the zonal tide of each perturber, and their sum.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``length-of-day``.
    ax : Axes, optional
    """
    answer = answer_of(result)
    ax = axes(ax, 7.5, 3.4)
    for name in answer.perturber.values.tolist():
        series = answer.length_of_day.sel(perturber=name)
        width = 1.2 if name == "total" else 0.8
        ax.plot(answer.time, series, color=_COLOURS[name], lw=width, label=name)
    ax.set(xlabel="time (TDB)", ylabel="change of the\nlength of day (ms)")
    drawing.few_dates(ax)
    drawing.legend_above(ax)
    return ax


@page_figure(
    "Observed length of day",
    "Above: observed excess over 86400 s, and the zonal tides of Sun and Moon about its mean. "
    "Below: the rest, of winds, currents and the core, with the 95 % half-width of the table.",
    uses=("zonal_tides",),
)
def plot_observed_day(result: Result, *, figure: Figure | None = None) -> Figure:
    """Draw the observed length of day with the zonal tides over it, and the rest below.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``observed-day``; the section ``zonal_tides`` is computed if missing.
    figure : Figure, optional
    """
    answer = answer_of(result)
    figure, (upper, lower) = drawing.stacked(2, 4.8, figure, width=7.5)
    tides = si(section(result, "zonal_tides").length_of_day_tides) * 1e3
    taken_out = answer.length_of_day.attrs["zonal_tides"] == "taken out"
    observed = answer.length_of_day + (tides if taken_out else 0)
    rest = observed - tides
    upper.plot(answer.time, observed, color=BLUE, lw=1, label="observed")
    mean = float(observed.mean())
    upper.plot(answer.time, tides + mean, color=RED, lw=1, ls="--", label="zonal tides")
    upper.axhline(mean, color=GREY, lw=0.6)
    error = answer.length_of_day_error.values
    drawing.band(lower, answer.time.values, rest.values, error, BLUE, lw=1, label="without tides")
    upper.set_ylabel("length of day\n− 86400 s (ms)")
    lower.set(xlabel="time (UTC)", ylabel="without tides (ms)")
    drawing.few_dates(lower)
    drawing.legend_above(upper)
    lower.legend(loc="best")
    return figure


VIEWS = {"length-of-day": Views([plot_length_of_day]), "observed-day": Views([plot_observed_day])}
