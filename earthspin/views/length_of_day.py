"""Figure of the observed length of day, with the zonal tides and without them."""

from __future__ import annotations

from earthspin.views import drawing
from earthspin.views.drawing import BLUE, GREY, RED, Figure, Views, page_figure
from earthspin.views.result_contents import Result, answer_of


@page_figure(
    "Observed length of day",
    "Above: observed excess over 86400 s, and the zonal tides of Sun and Moon about its mean. "
    "Below: the rest, of winds, currents and the core, with the 95 % half-width of the table.",
)
def plot_observed_day(result: Result, *, figure: Figure | None = None) -> Figure:
    """Draw the observed length of day with the zonal tides over it, and the rest below.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``observed-day``.
    figure : Figure, optional
    """
    answer = answer_of(result)
    figure, (upper, lower) = drawing.stacked(2, 4.8, figure, width=7.5)
    observed, tides = answer.length_of_day, answer.length_of_day_tides
    if observed.attrs["zonal_tides"] == "taken out":
        observed = observed + tides
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


VIEWS = {"observed-day": Views([plot_observed_day])}
