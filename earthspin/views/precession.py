"""Tables and figures of the rate and period of precession, and of their consequences."""

from __future__ import annotations

from functools import partial

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from earthspin.bodies import in_a_sentence
from earthspin.constants import DAY, JULIAN_YEAR, P_A_RATE, TROPICAL_YEAR
from earthspin.engine.variables import si
from earthspin.errors import SceneError, listed
from earthspin.numerics.arrays import FloatArray
from earthspin.views import drawing, result_contents, star_chart, tables, torque
from earthspin.views.drawing import Axes, Figure, Views, axes, note, page_figure
from earthspin.views.result_contents import Result, answer_of, section, stored_section
from earthspin.views.tables import Column, TextTable, measured, table_along

#: Once round, arcsec.
FULL_TURN = 360 * 3600.0

#: A pole that comes so near a star passes it, degrees.
PASSED = 2.0


def lead(tree: Result) -> str:
    """First words of the precession page: periods of each torque, of the wobble, of all effects."""
    answer, known = answer_of(tree), stored_section(tree, "iau_2006")
    wobble, names = stored_section(tree, "free_wobble"), answer.perturber.values.tolist()
    ends = (answer.isel(perturber=k) for k in (0, -1))
    first, last = (measured(row, "precession_period", "years") for row in ends)
    words = f"The axis of {result_contents.body_of(answer)} goes once round in "
    if len(names) > 2:
        words += f"{first} by the torque of {in_a_sentence(names[0])} alone, and in "
    words += (
        f"{last} by the pull of {result_contents.perturbers_of(answer)} on the equatorial bulge"
    )
    if moons := _satellites(answer):
        words += f" and on the orbits of its satellites {moons}, which precess with it"
    words += ", and nothing else."
    if wobble is not None:
        rigid = measured(wobble, "free_wobble_period", "days")
        words += f" Its free wobble takes {rigid} if it is rigid"
        if "observed_period" in wobble:
            words += f", and {measured(wobble, 'observed_period', 'days')} as observed"
        words += "."
    if known is not None:
        period, error = _with_known_effects(known)
        more = period - float(answer.precession_period[-1])
        words += " All known effects together give a precession period of "
        words += f"{tables.with_error(period, error)} years, {more:.2f} years more; IAU 2006 has "
        words += f"{FULL_TURN / float(known.iau_rate):.3f} years."
    return words


def _satellites(answer: xr.Dataset) -> str:
    """Names of the satellites that precess with the body; empty if there are none."""
    _, _, names = answer.precession_rate.attrs["pole"].partition("mean over the nodes of ")
    return listed(names.split(", ")) if names else ""


def _with_known_effects(known: xr.Dataset) -> tuple[float, float]:
    """Precession period that includes all published effects, and its 95 % half-width, yr."""
    rate = float(known.iau_rate + known.closure)
    return FULL_TURN / rate, float(known.closure_error) * FULL_TURN / rate**2


# --- tables --------------------------------------------------------------------------------------


def periods(tree: Result) -> TextTable:
    """Table of the precession period by three definitions, and the use of each definition."""
    answer, known, seasons = answer_of(tree), section(tree, "iau_2006"), section(tree, "seasons")
    total, iau = answer.isel(perturber=-1), FULL_TURN / float(known.iau_rate)
    period, error = _with_known_effects(known)
    general = measured(seasons, "general_precession_period"), f"{FULL_TURN / P_A_RATE.value:.3f}"
    known_effects = tables.with_error(period, error), f"{iau:.3f}"
    alone, textbooks = measured(total, "precession_period"), "25800 in textbooks"
    fixed = "equator on a fixed ecliptic, all known effects"
    rows = [
        ("general precession, moving ecliptic", *general, f"the equinox, the seasons; {textbooks}"),
        (fixed, *known_effects, "the motion of the celestial pole"),
        ("the same, torques of Sun and Moon alone", alone, "", "the theory of rigid bodies"),
    ]
    return TextTable(
        "Which period to quote",
        ("period", "years", "IAU 2006", "quote it for"),
        rows,
        f"Known effects beside the torques of Sun and Moon add "
        f"{period - float(total.precession_period):.2f} years. "
        f"{abs(period - iau):.3f} years remain unexplained, {_millionths(known)} millionths of "
        f"the rate and {abs(float(known.closure / known.closure_error)):.1f} half-widths: the "
        "half-widths contain the uncertainties of H, of the masses and of the average, but the "
        "published sizes of the known effects have none. H was inferred from the observed "
        "precession, so the agreement with IAU 2006 is a test of consistency. With J2 and the "
        f"layers of PREM the second period is {float(known.period_from_prem):.1f} years; the "
        "moment of inertia among the data of PREM also came from the precession.",
        words=(0, 3),
    )


def _millionths(known: xr.Dataset) -> str:
    """Unexplained part of the precession rate, in millionths of the IAU 2006 rate, as text."""
    return f"{abs(float(known.closure / known.iau_rate)) * 1e6:.1f}"


def rates(tree: Result) -> TextTable:
    """Table of precession rate, period and mean torque of each perturber."""
    answer = answer_of(tree)
    if answer.sizes["perturber"] == 2:  # the total of one perturber says nothing more
        answer = answer.isel(perturber=[0])
    first = answer.perturber.values[0]
    errors = answer.precession_rate_error_method[-1], answer.precession_rate_error_input[-1]
    method, input_error = map(tables.two_digits, errors)

    columns = (
        *("precession_rate", "precession_period", "mean_torque"),
        Column("rate_ratio", ".5f", f"rate / {first}"),
    )
    note = (
        "Rates are in longitude along the fixed orbit and refer to "
        f"{tables.date(answer.reference_epoch, 'm')} TDB; the obliquity is "
        f"{float(answer.obliquity):.6f} deg. The torques are averages "
        f"({answer.precession_rate.attrs['window']}). In the error of the last rate, {method} "
        f"arcsec/yr are due to averaging and {input_error} arcsec/yr to the given numbers."
    )
    if moons := _satellites(answer):
        note += " The rate includes the satellites, which precess with the body; it is the mean "
        note += f"over the nodes of {moons}."
    return table_along(answer, "perturber", "Precession", columns, note, first="pulled by")


def sky_and_calendar(tree: Result) -> TextTable:
    """Table of general precession, tropical year and calendar drift, with values for comparison."""
    seasons, text = section(tree, "seasons"), "{} (source text, I.8)".format
    rows: list[tuple[Column | str, str]] = [
        ("general_precession", f"{P_A_RATE.value:.5f} (IAU 2006)"),
        ("general_precession_period", text("25800")),
        (Column("time_per_degree", ".3f", "years per degree"), text("72")),
        ("tropical_year:.6f", f"{TROPICAL_YEAR.value / DAY:.6f} (Simon et al. 1994)"),
        (Column("time_per_day_of_drift", ".2f", "years per day of calendar drift"), text("129.4")),
        (
            Column("time_per_dropped_leap_day", ".2f", "years per dropped leap day, Gregorian"),
            text("400/3"),
        ),
        (Column("time_per_day_of_gregorian_drift", ",.0f", "years per day of Gregorian drift"), ""),
    ]
    return TextTable(
        "Equinox and calendar",
        ("quantity", "computed", "for comparison"),
        [(*tables.quantity(seasons, row), other) for row, other in rows],
        "General precession is the precession of the equator, with the published effects that the "
        "torques of Sun and Moon leave out, minus the motion of the ecliptic, which is taken from "
        "IAU 2006. A calendar of 365.25 days drifts against the "
        "tropical year, which already contains the precession; the source text has 129.4 years and "
        'does not say from what. I.8 is a section of the source text, Appendix I, "Rigid Body '
        'Dynamics".',
    )


def iau(tree: Result) -> TextTable:
    """Table of the computed precession rate compared with that of IAU 2006."""
    known, answer = section(tree, "iau_2006"), answer_of(tree)
    left_out = stored_section(tree, "neglected")
    effects = () if left_out is None else tables.along(left_out, "effect")
    rows = [
        ("computed", measured(answer.isel(perturber=-1), "precession_rate")),
        ("IAU 2006, psi_A", f"{float(known.iau_rate):.8f}"),
        ("difference", measured(known, "difference_from_iau")),
        *((f"  left out: {name}", f"{float(e.neglected_effect):+.6f}") for name, e in effects),
        ("difference after the effects left out", measured(known, "closure")),
    ]
    return TextTable(
        "Comparison with IAU 2006",
        (f"rate at {tables.date(answer.reference_epoch)}", "arcsec/yr"),
        rows,
        "The sizes of the effects left out are published: Capitaine, Wallace & Chapront 2003, "
        "table 3. H itself comes from observed precession, so the comparison tests consistency, "
        "not the theory. Errors include the uncertainty of the inputs only. The "
        f"difference that remains is {_millionths(known)} millionths of the rate.",
    )


def standstills(tree: Result) -> TextTable:
    """Table of lunar standstills: dates, and declinations of the Moon."""
    extremes, text = section(tree, "standstills"), {"major": "28.58", "minor": "18.30"}
    error = float(extremes.standstill_declination_error.values.max(initial=0.0))
    columns = (
        Column("standstill", lambda row: tables.date(row.standstill), "date (TDB)"),
        *("standstill_kind", "standstill_declination:+.4f"),
        Column("", lambda row: text[row.standstill_kind.item()], "source text (I.8), deg"),
    )
    note = (
        "Northern and southern extreme of each standstill, each of a single month, seen from the "
        "centre of the body. The source text "
        "takes 23.44 plus or minus 5.14 degrees; the Sun makes the inclination of the orbit vary "
        "between 5.0 and 5.3 degrees, so the largest declination reaches 28.7 and the smallest "
        f"extreme is near 18.1. Errors, from the kernel alone, are at most {error:.0e} deg."
    )
    return table_along(extremes, "standstill", "Lunar standstills", columns, note, first="")


TABLES = [
    ("iau_2006 seasons", periods),
    ("", rates),
    ("iau_2006", iau),
    ("seasons", sky_and_calendar),
    ("standstills", standstills),
]


# --- figures -------------------------------------------------------------------------------------


def chain_figure(tree: Result, year: Result) -> drawing.Drawing:
    """Figure, with caption, of the steps from declination and torque to the precession rate."""
    return drawing.PageFigure(
        "From declination to the period of precession",
        "Top: declination of each perturber through a year, at the mean equator of date. Middle: "
        "the component of the torque towards the equinox that follows (I.8.7); dashed: its mean. "
        "Bottom: the rate of precession from the torque averaged over longer and longer windows, "
        "and the period that follows.",
        partial(plot_chain, year=year),
    ).drawn(tree)


def plot_chain(result: Result, year: Result, *, figure: Figure | None = None) -> Figure:
    """Draw declination and torque over time, the averaged rate, and the precession period.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``precession``; computed again if the section
        ``convergence`` is missing.
    year : Dataset or DataTree
        Answer to the question ``torque``.
    figure : Figure, optional
        A figure of its own by default.
    """
    figure = drawing.empty(8, 6.6) if figure is None else figure
    upper, middle, lower = figure.subplots(3, 1)
    upper.sharex(middle)
    torque.plot_declination(year, ax=upper)
    torque.plot_torque(year, ax=middle)
    upper.tick_params(labelbottom=False)
    total, curve = answer_of(result).isel(perturber=-1), section(result, "convergence")
    drawing.lines(lower, curve.window_length, curve.rate_by_window.transpose(..., "window"), lw=1.1)
    rate = float(total.precession_rate)
    lower.axhline(rate, color="0.3", lw=0.8, ls="--")
    words = f"{rate:.3f}\u2033/yr: once round in {float(total.precession_period):.0f} years"
    note(lower, words, (float(curve.window_length[-1]), rate), (0, -30), ha="right", color="0.2")
    lower.set_xlabel("length of the averaging window (yr)")
    lower.set_ylabel("averaged rate\n(arcsec per year)")
    drawing.legend_above(lower)
    return figure


@page_figure(
    "How the average converges",
    "Difference between the rate averaged over a window and the adopted rate, against the "
    "length of the window. To see: a plain mean converges slowly, whatever its length; a "
    "tapered mean is far closer once the window holds three or more whole cycles. Dashed: the "
    "error claimed for averaging.",
    section="convergence",
)
def plot_convergence(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the difference of averaged and adopted precession rate against the averaging time.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``precession``; computed again if the section
        ``convergence`` is missing.
    ax : Axes, optional
        Drawn on a figure of its own by default.
    """
    total, curve = answer_of(result).isel(perturber=-1), section(result, "convergence")
    ax = axes(ax)
    difference = abs(curve.rate_by_window - total.precession_rate).clip(1e-8)
    drawing.lines(ax, curve.window_cycles, difference.transpose(..., "window"), lw=1.2)
    ax.set_yscale("log")
    ax.yaxis.set_major_formatter(drawing.power_of_ten)
    error = float(total.precession_rate_error_method)
    ax.axhline(error, color="0.3", lw=0.9, ls="--")
    words = f"error claimed for averaging, {tables.two_digits(error)} arcsec/yr"
    note(ax, words, (1.05, error), (0, -3), va="top", color="0.3")
    ax.set_xlabel("length of the window (cycles of the slowest perturbation)")
    ax.set(ylabel="difference (arcsec per year)", ylim=(3e-7, None))
    ax.legend(loc="upper right", ncols=2)
    return ax


def _caption_of_circle(tree: Result) -> str:
    """Caption for the figure of the pole's path; the caption names bright stars near the path."""
    total = answer_of(tree).isel(perturber=-1)
    years = np.arange(-9900, 14001, 100)
    path = _circle(total, years)
    places = star_chart.project(star_chart.star_vectors(), float(np.radians(total.obliquity)))
    passed = []
    for (name, *_), place in zip(star_chart.STARS, places, strict=True):
        away = np.linalg.norm(path - place, axis=1)
        if away.min() < PASSED:
            year = int(years[away.argmin()])
            passed.append((year, f"{name} about {year if year > 0 else f'{-year} BC'}"))
    *others, last = [words for _, words in sorted(passed)] or [""]
    passes = f"It passes {', '.join(others)} and {last}." if others else ""
    return (
        "Path of the celestial pole at the present rate and obliquity, centred on the pole of the "
        f"ecliptic; the sky as seen from inside, with stars at their present places. {passes}"
    )


def _circle(total: xr.Dataset, years: ArrayLike) -> FloatArray:
    """Positions (deg) of the celestial pole on the star chart in given years, at constant rate."""
    radius, rate = float(total.obliquity), float(si(total.precession_rate))
    back = rate * (np.asarray(years) - 2000) * JULIAN_YEAR  # its longitude falls: to the left
    return np.stack([-radius * np.sin(back), radius * np.cos(back)], axis=-1)


@page_figure(
    "The circle of the pole among the stars",
    _caption_of_circle,
    section="seasons",
    applies=lambda tree: bool(np.isfinite(answer_of(tree).precession_period[-1])),
    square=True,
    phone=drawing.NARROW,
)
def plot_pole_circle(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the path of the celestial pole among the stars through one period of precession.

    The sky from inside, centred on the pole of the ecliptic, the present pole on top; the
    obliquity is held at its present value.

    Parameters
    ----------
    result : Dataset or DataTree
        Answer to the question ``precession``.
    ax : Axes, optional

    Raises
    ------
    SceneError
        If the body is not the Earth, whose sky this is.
    """
    answer = answer_of(result)
    if (body := answer.earthspin.scene.body).known_as != "earth":
        raise SceneError("plot_pole_circle", body.name, "the chart is of the sky of the Earth")
    total = answer.isel(perturber=-1)
    turn = float(total.precession_period)
    years = [year for year in star_chart.YEARS if abs(year - 2000) <= 12_000]
    dates = star_chart.year_labels(years, _circle(total, years))
    path = _circle(total, np.linspace(2000 - turn / 2, 2000 + turn / 2, 361))
    ax = star_chart.plot_path(path, dates, float(np.radians(total.obliquity)), ax)
    ax.set_title(f"at the rate of this model, once round in {turn:.0f} years")
    return ax


VIEWS = {"precession": Views([plot_pole_circle, plot_convergence], tables=TABLES, lead=lead)}
