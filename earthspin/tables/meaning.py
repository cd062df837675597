"""Comparison of the meaning of columns with known numbers.

A misfit is a distance from what is known of the Earth or another body, in units of its bound: up to
1 the columns agree with it. Declared columns are refused only if they disagree and another meaning
of the same numbers agrees; that meaning is offered, never applied.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Sequence

from earthspin.tables.columns import Meaning
from earthspin.tables.sheet import Sheet, typed

Columns = Sequence[Meaning]
Misfit = Callable[[Columns], float]
#: Misfit up to which no better meaning is looked for, and factor by which a meaning must be better:
#: with a few rows near J2000.0, ages that are read as the future stay within the bounds.
GOOD, BETTER = 0.1, 3.0
#: Interval around J2000.0 in which solutions and orbits are compared, Julian years; fewest rows in
#: it, since fewer do not tell the past from the future; and smallest change of a column, as a share
#: of its bound, since constants fit times in any unit.
NEAR, FEWEST, CHANGE = 20_000.0, 3, 0.1


def refuse_other_meaning(
    sheet: Sheet, columns: Columns, others: Iterable[Columns], misfit: Misfit
) -> None:
    """Refuse columns that are far from what is known if another meaning of them is near.

    Parameters
    ----------
    sheet : Sheet
    columns : list of Meaning
    others : iterable of list of Meaning
        Other meanings of the columns.
    misfit : callable

    Raises
    ------
    SeriesError
        The message has the other meaning.
    """
    distance = misfit(columns)
    if not distance > GOOD:
        return
    bound = 1 / BETTER if math.isinf(distance) else min(1.0, distance / BETTER)
    other = next((other for other in others if misfit(other) <= bound), None)
    if other is not None:
        problem = f"with {typed(columns)} its numbers are far from what is known"
        raise sheet.error(problem, f"they agree with {typed(other)}; give what is right")


def guessed(
    places: Iterable[int],
    times: Sequence[Columns],
    options: Sequence[Meaning],
    misfit: Misfit,
) -> tuple[float, list[Meaning]]:
    """Find the meaning of columns, one by one, that agrees best with what is known.

    Parameters
    ----------
    places : iterable of int
        Places of the columns whose meaning is looked for.
    times : sequence of list of Meaning
        All columns with each possible meaning of the time, blank where a meaning is looked for.
    options : sequence of Meaning
        Possible meanings of any other column.
    misfit : callable

    Returns
    -------
    float
        Share of the columns for which a meaning agrees.
    list of Meaning
        The best meaning, with columns left blank for which none agrees.
    """
    best, wanted = (0, math.inf, [*times[0]]), [*places]
    for time in times:
        meaning, worst = [*time], 0.0
        trials = sorted(
            (distance, place, option)
            for place, option in itertools.product(wanted, options)
            if not time[place].quantity and (distance := misfit(_with(time, place, option))) <= 1
        )
        for distance, place, option in trials:
            names = {column.quantity for column in meaning}
            if not meaning[place].quantity and option.quantity not in names:
                meaning[place], worst = option, max(worst, distance)
        found = sum(bool(meaning[place].quantity) and not time[place].quantity for place in wanted)
        if found > best[0] or (found == best[0] and max(GOOD, worst * BETTER) < best[1]):
            best = (found, worst, meaning)
    return best[0] / max(len(wanted), 1), best[2]


def _with(columns: Columns, place: int, column: Meaning) -> list[Meaning]:
    """Return columns with one of them replaced."""
    return [*columns[:place], column, *columns[place + 1 :]]
