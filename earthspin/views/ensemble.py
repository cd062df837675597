"""An ensemble: how far its numbers spread, and which inputs the spread comes from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from earthspin.engine.spread import inputs_of, members_needed, quantiles, sensitivity
from earthspin.errors import SceneError
from earthspin.views import plain
from earthspin.views.drawing import BLUE, CYCLE, GREY, RED, PageFigure, axes, empty
from earthspin.views.reading import Result, views_of
from earthspin.views.table import Table, short_exponents, with_error

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FloatArray = NDArray[np.float64]

#: Name, labels and unit of a number that differs among the members.
_Number = tuple[str, dict[str, Any], str]

#: The dimension of an ensemble.
MEMBER = "member"
#: So many values of one number are shown, and so many inputs have a colour.
MOST_ROWS, MOST_COLOURS = 12, 6
#: Shares of variance below this are not told apart.
SMALL = 5e-4


def tables(tree: Result) -> list[Table]:
    """Spread of each number, and shares of the inputs in it."""
    answer = _whole(tree)
    every = [*_numbers(answer)]
    if not every:
        alike, *others = plain.tables(answer)
        return [replace(alike, note=" ".join(filter(None, [_alike(answer), alike.note]))), *others]
    shown = every if len(every) <= 4 * MOST_ROWS else every[: 4 * MOST_ROWS]
    ends = quantiles(answer)
    rows = []
    for name, labels, units in shown:
        low, middle, high = ends[name].sel(labels).values
        value = with_error(middle, (high - low) / 2)
        rows.append((_words(name, labels), value, _digits(low, high), _digits(high, low), units))
    note = f"{answer.sizes[MEMBER]} members, which differ in {', '.join(_inputs(answer))}."
    if "members_dropped" in answer.attrs:
        note += f" Left out were {answer.attrs['members_dropped']}."
    if len(every) > len(shown):
        note += f" {len(every) - len(shown)} further numbers are not shown."
    headers = ("number", "middle, and half of the central 95 %", "2.5 %", "97.5 %", "unit")
    spread = Table("Spread of the members", headers, rows, note, words=(0, 4))
    return [spread, *_shares_table(answer)]


def _shares_table(answer: xr.Dataset) -> list[Table]:
    """Shares of the inputs in the variance, where there are members enough to tell."""
    if not _tells(answer):
        return []
    rows, shares, rest = _shares(answer)
    inputs = _inputs(answer)
    seen = [int(i) for i in np.flatnonzero(np.abs(shares).max(axis=0) >= SMALL)]
    others = [name for i, name in enumerate(inputs) if i not in seen]
    note = "By straight lines in all inputs together; the last column is what they leave."
    if others:
        note += f" Less than {100 * SMALL:g} % everywhere: {', '.join(others)}."
    return [
        Table(
            "Shares of the variance, in per cent",
            ("number", *(inputs[i].replace("_", " ") for i in seen), "rest"),
            [
                (_words(name, at), *map(_percent, (*own[seen].tolist(), left)))
                for (name, at, _), own, left in zip(rows, shares, rest, strict=True)
            ],
            note,
        )
    ]


def _shares(answer: xr.Dataset) -> tuple[list[_Number], FloatArray, list[float]]:
    """The chief numbers, shares of the inputs in their variances, and what these leave."""
    result, chiefs = sensitivity(answer), _chiefs(answer)
    rows = [row for row in _numbers(answer) if row[0] in chiefs]
    shares = np.array([result[f"{name}_share"].sel(labels).values for name, labels, _ in rows])
    rest = [float(result[f"{name}_unexplained"].sel(labels)) for name, labels, _ in rows]
    return rows, shares, rest


def lead(tree: Result) -> str:
    """The chief number in a sentence, and what most of its spread comes from."""
    answer = _whole(tree)
    if not _chiefs(answer):
        return _alike(answer)
    name, labels, units = _chief(answer)
    low, middle, high = quantiles(answer)[name].sel(labels).values
    said = f"{answer.sizes[MEMBER]} members: {_words(name, labels)}, "
    said += f"{with_error(middle, (high - low) / 2)} {units.replace('1', '', 1).strip()}".rstrip()
    if not _tells(answer):
        return f"{said}."
    shares = sensitivity(answer)[f"{name}_share"].sel(labels)
    most = str(shares.input.values[int(shares.values.argmax())])
    return f"{said}. {100 * float(shares.max()):.1f} % of the variance comes from {most}."


def _caption_of_spread(tree: Result) -> str:
    answer = _whole(tree)
    name, labels, _ = _chief(answer)
    words = _words(name, labels).capitalize()
    return f"{words}, of {answer.sizes[MEMBER]} members; the band is the central 95 %."


def _caption_of_shares(tree: Result) -> str:
    return f"Share of each input in the variance of {_whole(tree).sizes[MEMBER]} members."


def plot_spread(result: Result, name: str = "", *, ax: Axes | None = None) -> Axes:
    """Histogram of one number over the members, its central 95 % as a band.

    Parameters
    ----------
    result : Dataset or DataTree
    name : str
        The chief number of the question by default.
    ax : Axes, optional

    Raises
    ------
    SceneError
        If no number of that name differs among the members.
    """
    answer = _whole(result)
    name, labels, units = _chief(answer, name)
    values = answer[name].sel(labels).values
    low, middle, high = np.quantile(values, (0.025, 0.5, 0.975))
    ax = axes(ax, 7.5, 3.6)
    bins = int(np.clip(np.sqrt(values.size), 5, 60))
    ax.hist(values - middle, bins, color=BLUE, alpha=0.75)
    ax.axvspan(low - middle, high - middle, color=RED, alpha=0.12, lw=0, zorder=0)
    ax.axvline(0, color=RED, lw=1)
    behind = f" ({units})" if units not in ("", "1") else ""
    ax.set_xlabel(f"{_words(name, labels)} minus {_digits(middle, high)}{behind}")
    ax.set_ylabel("members")
    ax.locator_params(axis="x", nbins=5)  # so few that they stay apart on a phone
    return ax


def plot_shares(result: Result, *, ax: Axes | None = None) -> Axes:
    """Shares of the inputs in the variance of the chief numbers, as bars.

    Parameters
    ----------
    result : Dataset or DataTree
    ax : Axes, optional

    Raises
    ------
    SceneError
        If no number differs among the members, or they are too few.
    """
    answer = _whole(result)
    if not _chiefs(answer):
        raise SceneError("ensemble", answer.attrs["title"], _alike(answer))
    rows, shares, _ = _shares(answer)
    rows, shares, inputs = rows[:MOST_ROWS], shares[:MOST_ROWS], _inputs(answer)
    order = np.argsort(-shares.max(axis=0))
    seen = [int(i) for i in order if shares[:, i].max() >= SMALL][:MOST_COLOURS]
    if ax is None:
        ax = empty(7.5, 1.2 + 0.32 * len(rows)).add_subplot()
    left = np.zeros(len(rows))
    for colour, i in zip(CYCLE, seen, strict=False):
        ax.barh(np.arange(len(rows)), shares[:, i], 0.7, left, color=colour, label=inputs[i])
        left = left + shares[:, i]
    ax.barh(np.arange(len(rows)), 1 - left, 0.7, left, color=GREY, alpha=0.3, label="rest")
    ax.set_yticks(np.arange(len(rows)), [_words(name, at) for name, at, _ in rows])
    ax.invert_yaxis()
    ax.set_xlim(0, 1)
    ax.set_xlabel("share of the variance")
    ax.grid(axis="y", visible=False)
    ax.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=2, fontsize=8)
    return ax


FIGURES = [
    PageFigure(
        "How the members spread",
        _caption_of_spread,
        plot_spread,
        applies=lambda tree: bool(_chiefs(_whole(tree))),
    ),
    PageFigure(
        "Where the spread comes from",
        _caption_of_shares,
        plot_shares,
        applies=lambda tree: bool(_chiefs(_whole(tree))) and _tells(_whole(tree)),
    ),
]


# --- what is shown -------------------------------------------------------------------------------


def _whole(result: Result) -> xr.Dataset:
    return result.to_dataset() if isinstance(result, xr.DataTree) else result


def _inputs(answer: xr.Dataset) -> list[str]:
    """Names of what differs, as `sensitivity` has them."""
    return list(inputs_of(answer))


def _tells(answer: xr.Dataset) -> bool:
    """Whether there are members enough to fit straight lines."""
    return bool(answer.sizes[MEMBER] >= members_needed(answer))


def _numbers(answer: xr.Dataset) -> Iterator[_Number]:
    """Every number that differs among the members: its name, its labels and its unit."""
    for name, of in answer.data_vars.items():
        if MEMBER not in of.dims or of.dtype.kind != "f" or "_error" in str(name):
            continue
        others = [dim for dim in of.dims if dim != MEMBER]
        for place in product(*(range(of.sizes[dim]) for dim in others)):
            values = of.isel(dict(zip(others, place, strict=True))).values
            if np.isfinite(values).all() and np.ptp(values) > 4 * np.finfo(float).eps * abs(
                values[0]
            ):
                labels = {str(dim): of[dim].values[k] for dim, k in zip(others, place, strict=True)}
                yield str(name), labels, str(of.attrs.get("units", ""))


def _alike(answer: xr.Dataset) -> str:
    """Sentence about an ensemble without a spread."""
    count, inputs = answer.sizes[MEMBER], ", ".join(_inputs(answer))
    return f"No finite number differs among the members: {count} members, inputs {inputs}."


def _chiefs(answer: xr.Dataset) -> tuple[str, ...]:
    """Names of the numbers that a question is about, as far as they differ among the members.

    If the view of the question names none that differs, this is the first number that does; empty
    if no number differs.
    """
    named = getattr(views_of(answer), "CHIEF", ())
    differing = dict.fromkeys(name for name, *_ in _numbers(answer))
    return tuple(name for name in named if name in differing) or tuple(differing)[:1]


def _chief(answer: xr.Dataset, name: str = "") -> _Number:
    """The last value of the chief number: the total, the last rung, the last time."""
    wanted = (name,) if name else _chiefs(answer)[:1]
    rows = [row for row in _numbers(answer) if row[0] in wanted]
    if not rows:
        words = f"'{name}' does not differ among the members" if name else _alike(answer)
        raise SceneError("ensemble", answer.attrs["title"], words)
    return rows[-1]


def _words(name: str, labels: dict[str, Any]) -> str:
    """A number with its labels, for people."""
    at = ", ".join(
        str(of.astype("M8[m]")) if isinstance(of, np.datetime64) else str(of)
        for of in labels.values()
    )
    return f"{name.replace('_', ' ')}{f', {at}' if at else ''}"


def _digits(value: float, other: float) -> str:
    """A number with as many digits as tell it from another, and two more."""
    apart = abs(other - value) / max(abs(value), abs(other), 1e-300)
    digits = int(np.clip(2 - np.floor(np.log10(max(apart, 1e-15))), 3, 16))
    return short_exponents(f"{value:.{digits}g}")


def _percent(share: float) -> str:
    return f"{100 * share:.2f}" if abs(share) >= SMALL else "0"
