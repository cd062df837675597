"""Columns of a table and their meaning, which is declared as text and never guessed.

A declaration is ``quantity (unit)`` for each column, like ``epoch (kyr BP), eccentricity,,
obliquity (deg)``. It comes from the user, from the header of a file, or from a known layout.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from earthspin.errors import SeriesError
from earthspin.units import COMMON, time_scale

#: Names in a table for units, and units that are none of `units.COMMON`: the unit of
#: which they are a multiple, and the factor.
_SPELLINGS = {'"': "arcsec", "''": "arcsec", "as": "arcsec", "degrees": "deg", "radians": "rad"}
_MULTIPLES = {"uas": ("mas", 1e-3), "0.1 arcsec": ("arcsec", 0.1), "ms": ("s", 1e-3)}
#: End of a declaration that stands for any more columns.
MORE = "..."


class Meaning(NamedTuple):
    """Meaning of a column; a column without a quantity is not read.

    Attributes
    ----------
    quantity : str
    unit : str
        Unit as text; empty if it has none, or if it is not known.
    sign : float
        -1 if the column has the opposite sign, as ``-y`` declares it.
    """

    quantity: str
    unit: str = ""
    sign: float = 1.0

    def __str__(self) -> str:
        name = "-" * (self.sign < 0) + self.quantity
        return f"{name} ({self.unit})" if self.unit else name

    @property
    def is_time(self) -> bool:
        """Whether the column holds epochs."""
        return self.quantity in ("epoch", "t")

    def conversion(self, unit: str) -> tuple[float, float]:
        """Factor and shift that convert the numbers of the column to a unit.

        An epoch is converted to Julian years from J2000.0. Without a unit, numbers stay as they
        are.

        Raises
        ------
        ValueError
            If the unit of the column is unknown or of another dimension.
        """
        if self.is_time:
            scale = time_scale(self.unit)
            if scale is None:
                raise ValueError(self.unit)
            return scale
        own, factor = _MULTIPLES.get(self.unit, (self.unit, 1.0))
        if {own, unit} <= {*COMMON} and COMMON[own][0] == COMMON[unit][0]:
            return self.sign * factor * (COMMON[own][1] / COMMON[unit][1]), 0.0
        if own != unit and (own or unit != "1"):
            raise ValueError(self.unit)
        return self.sign * factor, 0.0


BLANK = Meaning("")


def declared(text: str) -> list[Meaning]:
    """Split a declaration into columns; ``...`` at its end is ignored."""
    cells = text.strip().removesuffix(MORE).rstrip(" ,") if text.strip().endswith(MORE) else text
    return [column_of(cell) for cell in cells.split(",")]


def column_of(cell: str) -> Meaning:
    """Read the declaration of one column, or its name in a header, like ``PM_x [mas]``."""
    name, unit = re.fullmatch(r"([^(\[]*)(.*)", cell.strip(), re.DOTALL).groups()  # type: ignore[union-attr]
    unit = unit.strip("()[] ")
    name = name.strip()
    return Meaning(
        name.removeprefix("-"), _SPELLINGS.get(unit, unit), -1.0 if name[:1] == "-" else 1.0
    )


def written(columns: Iterable[Meaning], more: bool = False) -> str:
    """Return the declaration of columns, the inverse of `declared`."""
    cells = [*map(str, columns), *[MORE] * more]
    return re.sub(r", (?=,|$)", ",", ", ".join(cells)).rstrip()


def fits(text: str, width: int) -> bool:
    """Return True if a declaration has a given number of columns."""
    count = len(declared(text))
    return count == width or (text.strip().endswith(MORE) and count < width)


def places(
    file: object, names: Sequence[str], vocabulary: Mapping[str, Sequence[str]]
) -> dict[str, int]:
    """Place of each quantity among names of columns; equal case goes before other case.

    Parameters
    ----------
    file : object
        File of the table, for messages.
    names : sequence of str
        Names, with or without units, which pandas may have numbered.
    vocabulary : mapping of str to sequence of str
        Names, in lower case or with their own case, of each quantity.

    Raises
    ------
    SeriesError
        If two columns have the name of a quantity.
    """
    bare = [re.sub(r"\.\d+$", "", column_of(name).quantity) for name in names]
    found = {}
    for quantity, words in vocabulary.items():
        exact = [place for place, name in enumerate(bare) if name in words]
        loose = [place for place, name in enumerate(bare) if name.lower() in words]
        for place in (exact or loose)[:1]:
            if bare.count(bare[place]) > 1:
                problem = f"its header has '{bare[place]}' twice"
                raise SeriesError(file, problem, "rename one, or name all in columns='...'")
            found[quantity] = place
    return found


def with_words(columns: Sequence[Meaning], words: Mapping[str, str]) -> list[Meaning]:
    """Replace quantities and units by others, such as ``{"deg": "rad"}``."""
    return [
        column._replace(
            quantity=words.get(column.quantity, column.quantity),
            unit=words.get(column.unit, column.unit),
        )
        for column in columns
    ]
