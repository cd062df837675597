"""Tables and figures of an ensemble: spread of the results, and contribution of each input."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from earthspin.engine.accessor import inputs_of, members_needed
from earthspin.engine.members import MEMBER
from earthspin.errors import SceneError
from earthspin.views.drawing import BLUE, CYCLE, GREY, RED, Axes, Views, axes, literal, page_figure
from earthspin.views.result_contents import Result, dataset_of, question_of
from earthspin.views.tables import TextTable, short_exponents, tables_of, with_error

#: The figure of shares has at most so many bars and colours.
MOST_ROWS, MOST_COLOURS = 12, 6
#: Shares of variance below this are not told apart.
SMALL = 5e-4


class VaryingNumber(NamedTuple):
    """Name, coordinate labels and unit of one number that differs among the ensemble members."""

    name: str
    labels: dict[str, Any]
    units: str

    @property
    def words(self) -> str:
        """Name and coordinate labels of the number, as text."""
        labels = (
            str(label.astype("M8[m]") if isinstance(label, np.datetime64) else label)
            for label in self.labels.values()
        )
        return ", ".join([self.name.replace("_", " "), *labels])


def tables(tree: Result) -> list[TextTable]:
    """Tables of an ensemble: median and spread of results, and each input's share of the variance.

    The brackets behind a median hold half the width of the interval with the central 95 % of the
    members. If no number differs among the members, the tables are those of the first.
    """
    answer = dataset_of(tree)
    if not _numbers(answer):
        first, *others = tables_of(answer.isel({MEMBER: 0}), str(answer.attrs["title"]))
        return [replace(first, note=f"{_alike(answer)}\n{first.note}"), *others]
    first, *others = tables_of(_spread(answer), "Spread of the members")
    note = (
        f"{answer.sizes[MEMBER]} members, which differ in {', '.join(inputs_of(answer))}. Values "
        "are medians; brackets hold half of the central 95 %."
    )
    if "members_dropped" in answer.attrs:
        note += f" Left out were {answer.attrs['members_dropped']}."
    if _enough(answer):
        others += tables_of(_percentages(answer), "Shares of the variance")
    return [replace(first, note=f"{note}\n{first.note}"), *others]


def _spread(answer: xr.Dataset) -> xr.Dataset:
    """Median and half-width of the central 95 % of each quantity that differs among the members."""
    names = [*dict.fromkeys(number.name for number in _numbers(answer))]
    spread = answer.earthspin.quantiles()[names].reset_coords(drop=True)
    low, middle, high = (spread.isel(quantile=k, drop=True) for k in range(3))
    half = ((high - low) / 2).rename({name: f"{name}_error" for name in names})
    for name in names:
        middle[name].attrs["ancillary_variables"] = f"{name}_error"
        half[f"{name}_error"].attrs["units"] = middle[name].attrs.get("units", "")
    merged: xr.Dataset = middle.merge(half)
    return merged


def _percentages(answer: xr.Dataset) -> xr.Dataset:
    """Share of each input in the variance of the main quantity, %; last row: unexplained part."""
    result = answer.earthspin.sensitivity()
    labels = ("input", [*map(str, result["input"].values), "rest"], result["input"].attrs)
    result = result.drop_vars("input")  # xarray 2025.6 cannot concatenate labels that are words
    name = _main_numbers(answer)[0].name
    share, error, rest = (
        100 * result[f"{name}_{what}"] for what in ("share", "share_error", "unexplained")
    )
    shown = abs(share) >= 100 * SMALL
    rest = rest.where(abs(rest) >= 100 * SMALL, 0.0).expand_dims("input")
    share = xr.concat([share.where(shown, 0.0), rest], "input")
    share.attrs = {
        "units": "%",
        "long_name": f"share of the variance of {name.replace('_', ' ')}, from a linear fit "
        "in all inputs; the last row is the unexplained part",
        "ancillary_variables": f"{name}_error",
    }
    half = xr.concat([error.where(shown, 0.0), xr.zeros_like(rest)], "input")
    half.attrs = {"units": "%", "long_name": "from the number of members"}
    return xr.Dataset({name: share, f"{name}_error": half}, {"input": labels})


def lead(tree: Result) -> str:
    """Sentence with an ensemble's main quantity, and the input that causes most of its spread."""
    answer = dataset_of(tree)
    if not _numbers(answer):
        return _alike(answer)
    number = _main_numbers(answer)[-1]
    low, middle, high = answer.earthspin.quantiles()[number.name].sel(number.labels).values
    value = with_error(middle, (high - low) / 2, number.units.replace("1", "", 1).strip())
    words = f"{answer.sizes[MEMBER]} members: {number.words}, {value}."
    if not _enough(answer):
        return words
    share = answer.earthspin.sensitivity()[f"{number.name}_share"].sel(number.labels)
    cause = share.input.values[int(share.values.argmax())]
    return f"{words} {100 * float(share.max()):.1f} % of the variance comes from {cause}."


@page_figure(
    "How the members spread",
    "Main number of the members minus its median; the band is the central 95 %.",
    applies=lambda tree: bool(_numbers(dataset_of(tree))),
)
def plot_spread(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw a histogram of the main number of an ensemble, with its central 95 % as a band.

    Parameters
    ----------
    result : Dataset or DataTree
    ax : Axes, optional

    Raises
    ------
    SceneError
        If no number differs among the members.
    """
    answer = dataset_of(result)
    number = _main_numbers(answer)[-1]
    values = answer[number.name].sel(number.labels).values
    low, middle, high = np.quantile(values, (0.025, 0.5, 0.975))
    ax = axes(ax, 7.5, 3.6)
    bins = int(np.clip(np.sqrt(values.size), 5, 60))
    ax.hist(values - middle, bins, color=BLUE, alpha=0.75)
    ax.axvspan(low - middle, high - middle, color=RED, alpha=0.12, lw=0, zorder=0)
    ax.axvline(0, color=RED, lw=1)
    unit = f" ({number.units})" if number.units not in ("", "1") else ""
    ax.set_xlabel(f"{literal(number.words)} minus {_digits(middle, high)}{unit}")
    ax.set_ylabel("members")
    ax.locator_params(axis="x", nbins=5)  # so few that they stay apart on a phone
    return ax


@page_figure(
    "Where the spread comes from",
    "Share of each input in the variance of the members.",
    applies=lambda tree: bool(_numbers(dataset_of(tree))) and _enough(dataset_of(tree)),
)
def plot_shares(result: Result, *, ax: Axes | None = None) -> Axes:
    """Draw the share of each input in the variance of the main numbers, as bars.

    Parameters
    ----------
    result : Dataset or DataTree
    ax : Axes, optional

    Raises
    ------
    SceneError
        If no number differs among the members, or they are too few.
    """
    answer = dataset_of(result)
    rows, inputs = _main_numbers(answer)[:MOST_ROWS], [*inputs_of(answer)]
    result = answer.earthspin.sensitivity()
    share = np.array([result[f"{row.name}_share"].sel(row.labels).values for row in rows])
    order = np.argsort(-share.max(axis=0))
    shown = [int(i) for i in order if share[:, i].max() >= SMALL][:MOST_COLOURS]
    ax = axes(ax, 7.5, 1.2 + 0.32 * len(rows))
    place, start = np.arange(len(rows)), np.zeros(len(rows))
    for colour, i in zip(CYCLE, shown, strict=False):
        ax.barh(place, share[:, i], 0.7, start, color=colour, label=literal(inputs[i]))
        start = start + share[:, i]
    ax.barh(place, 1 - start, 0.7, start, color=GREY, alpha=0.3, label="rest")
    ax.set_yticks(place, [literal(number.words) for number in rows])
    ax.invert_yaxis()
    ax.set(xlim=(0, 1), xlabel="share of the variance")
    ax.grid(axis="y", visible=False)
    ax.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=2, fontsize=8)
    return ax


VIEWS = Views([plot_spread, plot_shares], lead=lead)


# --- what is shown -------------------------------------------------------------------------------


def _enough(answer: xr.Dataset) -> bool:
    """Return True if an ensemble has enough members to fit a linear function of all inputs."""
    return bool(answer.sizes[MEMBER] >= members_needed(answer))


def _numbers(answer: xr.Dataset) -> list[VaryingNumber]:
    """List all finite quantities of an ensemble whose values differ among the members."""
    numbers = []
    for name, variable in answer.data_vars.items():
        if MEMBER not in variable.dims or variable.dtype.kind != "f" or "_error" in str(name):
            continue
        values, first = variable.transpose(..., MEMBER).values, variable.isel({MEMBER: 0})
        least = values.min(axis=-1) + 4 * np.finfo(float).eps * abs(first.values)
        differs = np.isfinite(values).all(axis=-1) & (values.max(axis=-1) > least)
        for place in np.argwhere(differs).tolist():
            at = zip(first.dims, place, strict=True)
            labels = {str(dim): variable[dim].values[k] for dim, k in at}
            numbers.append(VaryingNumber(str(name), labels, str(variable.attrs.get("units", ""))))
    return numbers


def _alike(answer: xr.Dataset) -> str:
    """Sentence that says that all members of an ensemble give the same numbers."""
    count, inputs = answer.sizes[MEMBER], ", ".join(inputs_of(answer))
    return f"No finite number differs among the members: {count} members, inputs {inputs}."


def _main_numbers(answer: xr.Dataset) -> list[VaryingNumber]:
    """Numbers that differ among ensemble members, in the variable that is quoted first.

    It is the headline of the question, or else the first variable that differs. Its last number
    is for example the total, or the value at the last time.

    Raises
    ------
    SceneError
        If no number differs.
    """
    numbers, question = _numbers(answer), question_of(answer)
    if not numbers:
        raise SceneError("ensemble", answer.attrs["title"], _alike(answer))
    main = [n for n in numbers if question and n.name == question.headline]
    return main or [number for number in numbers if number.name == numbers[0].name]


def _digits(value: float, other: float) -> str:
    """Format a number with enough digits to distinguish it from another number."""
    difference = abs(other - value) / max(abs(value), abs(other), 1e-300)
    digits = int(np.clip(2 - np.floor(np.log10(max(difference, 1e-15))), 3, 16))
    return short_exponents(f"{value:.{digits}g}")
