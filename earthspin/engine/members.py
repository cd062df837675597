"""Members of an ensemble: what differs among them, and how it is drawn.

What differs are numbers of a question, or words in it: the table of an orbit, a kernel, a model.

Every member has random numbers of its own, by its number and the seed (Philox over
``SeedSequence(seed, spawn_key=(member,))``), so that member 17 is the same alone, in any block and
on any machine. A member draws one standard normal number for each input, in the order in which they
are named, and each distribution turns it into its own: correlations are those of these numbers.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from earthspin.engine.given import from_scene, of_dataset, read_file
from earthspin.errors import Where, nearest
from earthspin.units import FloatArray, Word, by_name, pack

#: As many members as numbers of one kind are ever held whole.
MOST = 10_000_000

Shape = Literal["normal", "uniform", "choice", "grid"]
_SHAPES: dict[str, str] = {
    "normal": "a mean and one standard deviation",
    "uniform": "a lowest and a highest value",
    "choice": "one value or more",
    "grid": "one value or more, of which every combination is made",
}
_SETTINGS = ("n", "seed", "uncertainty", "impossible", "only", "correlations", "values")


@dataclass(frozen=True)
class Distribution:
    """How one input is distributed, its numbers as they were given.

    Attributes
    ----------
    shape : str
        ``"normal"``, ``"uniform"``, ``"choice"`` or ``"grid"``.
    numbers : tuple
        Numbers, text with units, or words.
    """

    shape: str
    numbers: tuple[Any, ...]

    @classmethod
    def read(cls, value: Mapping[str, Any], where: Where) -> Distribution:
        """Read a table like ``{ normal = [0.00327, 2e-9] }``."""
        if len(value) != 1 or next(iter(value)) not in _SHAPES:
            problem = f"give one of {', '.join(_SHAPES)}, like normal = [1, 2]"
            raise where.error(dict(value), problem)
        ((shape, numbers),) = value.items()
        numbers = numbers.tolist() if isinstance(numbers, np.ndarray) else numbers
        many = len(numbers) if isinstance(numbers, (list, tuple)) else 0
        if many == 0 or (shape in ("normal", "uniform") and many != 2):
            raise where.error(numbers, f"{shape} takes {_SHAPES[shape]}")
        return cls(shape, tuple(map(_plain, numbers)))

    def checked(self, kind: Any, where: Where) -> Distribution:
        """Return it with its numbers as the input is kept, or its words, checked."""
        if by_name(kind):
            if self.shape not in ("choice", "grid"):
                problem = f"{self.shape} is of numbers; of words and names give choice or grid"
                raise where.error(list(self.numbers), problem)
            return Distribution(self.shape, texts(self.numbers, kind, where))
        numbers = [kind.read(number, where) for number in self.numbers]
        if any(map(np.ndim, numbers)):
            raise where.error(self.numbers, "give single numbers")
        if self.shape == "normal" and not numbers[1] >= 0:
            raise where.error(self.numbers, "a standard deviation is zero or more")
        if self.shape == "uniform" and not numbers[0] <= numbers[1]:
            raise where.error(self.numbers, "the lowest value comes first")
        return Distribution(self.shape, tuple(map(float, numbers)))

    def values(self, normal: FloatArray, place: FloatArray) -> NDArray[Any]:
        """Turn standard normal numbers into those of the distribution.

        Parameters
        ----------
        normal : ndarray, shape (n,)
        place : ndarray of int, shape (n,)
            Of a grid: which value.

        Returns
        -------
        ndarray, shape (n,)
        """
        from scipy.special import ndtr

        numbers = np.array(self.numbers)
        if self.shape == "normal":
            return np.asarray(numbers[0] + numbers[1] * normal)
        share = ndtr(normal)
        if self.shape == "uniform":
            return np.asarray(numbers[0] + (numbers[1] - numbers[0]) * share)
        if self.shape == "choice":
            place = np.minimum((share * numbers.size).astype(int), numbers.size - 1)
        return np.asarray(numbers[place])


def texts(values: Iterable[Any], kind: Any, where: Where) -> tuple[str, ...]:
    """Words of an input that is no number, as they were given, each checked.

    Raises
    ------
    EarthspinError
        If the input does not take one, or it is told by more than text.
    """
    names = tuple(values)
    for word in names:
        kind.read(word, where)
        if not isinstance(word, str):
            problem = "members are labelled by text: give a name, or the path of a file it is in"
            raise where.error(type(word).__name__, problem)
    return names


def _plain(number: Any) -> Any:
    """A number as a scene holds it, or a path."""
    if isinstance(number, os.PathLike):
        return os.fspath(number)
    if hasattr(number, "to_value"):
        return f"{float(number.value)!r} {number.unit}"
    return number.item() if isinstance(number, np.generic) else number


def standard_normal(seed: int, members: FloatArray, inputs: int) -> FloatArray:
    """Standard normal numbers of members, each from a generator of its own.

    Parameters
    ----------
    seed : int
    members : ndarray of int, shape (n,)
    inputs : int
        How many for each.

    Returns
    -------
    ndarray, shape (n, inputs)
    """
    normal = np.empty((len(members), inputs))
    for row, member in zip(normal, members.tolist(), strict=True):
        sequence = np.random.SeedSequence(seed, spawn_key=(member,))
        np.random.Generator(np.random.Philox(sequence)).standard_normal(out=row)
    return normal


@dataclass(frozen=True, eq=False)
class Members:
    """The members that a question is asked for.

    Attributes
    ----------
    n : int or None
        How many are drawn; None if grids or values say it.
    seed : int
    published : bool
        Whether the numbers of the bodies are drawn from their published uncertainties.
    impossible : str
        ``"refuse"`` or ``"drop"``: what is done with members that cannot exist.
    only : tuple of int
        Numbers of the members that are made; all, if empty.
    correlations : tuple of (str, str, float)
    distributions : mapping of str to Distribution
        By the name of the input, like ``"body.j2"``.
    values : mapping of str to ndarray, shape (n, ...)
        Given member by member: numbers, or words.
    """

    n: int | None = None
    seed: int = 0
    published: bool = False
    impossible: Literal["refuse", "drop"] = "refuse"
    only: tuple[int, ...] = ()
    correlations: tuple[tuple[str, str, float], ...] = ()
    distributions: Mapping[str, Distribution] = field(default_factory=dict)
    values: Mapping[str, NDArray[Any]] = field(default_factory=dict)

    words: ClassVar[str] = "how many, a table of distributions, or a Dataset along `member`"
    hint: ClassVar[str] = "int | Mapping[str, Any] | xr.Dataset | str"

    # --- as a scene ------------------------------------------------------------------------------

    @classmethod
    def read(cls, value: object, where: Where) -> Members:
        """Read how many, a table, a Dataset, or the path of a file with one.

        Raises
        ------
        SceneError
            If it is none of these, a name or a number is wrong, or there is no member.
        """
        if isinstance(value, Members):
            return value
        if isinstance(value, (int, np.integer)) and not isinstance(value, bool):
            return cls(n=_whole(value, where, 1), published=True)
        if isinstance(value, (str, os.PathLike)):
            value = read_file(Path(value))
        if hasattr(value, "data_vars"):
            return cls(values=of_dataset(value, where))
        if not isinstance(value, Mapping):
            raise where.error(value, f"give {cls.words}")
        return cls._of_table(value, where)

    @classmethod
    def _of_table(cls, table: Mapping[str, Any], where: Where) -> Members:
        settings = {name: entry for name, entry in table.items() if name in _SETTINGS}
        inputs = {name: entry for name, entry in table.items() if name not in _SETTINGS}
        for name, entry in inputs.items():
            if not isinstance(entry, Mapping):
                problem = f"{nearest(name, _SETTINGS)}, or a table like normal = [1, 2]"
                raise where.at(name).error(entry, problem)
        uncertainty = settings.get("uncertainty")
        if uncertainty is not None:
            Word(("sample",)).read(uncertainty, where.at("uncertainty"))
        impossible: Any = settings.get("impossible", "refuse")
        Word(("refuse", "drop")).read(impossible, where.at("impossible"))
        values = settings.get("values", {})
        if not isinstance(values, Mapping):
            raise where.at("values").error(values, "give a table of inputs, each with its values")
        for name in ("only", "correlations"):
            if not isinstance(settings.get(name, ()), (list, tuple)):
                raise where.at(name).error(settings[name], "give a list")
        n = settings.get("n")
        return cls(
            n=None if n is None else _whole(n, where.at("n"), 1),
            seed=_whole(settings.get("seed", 0), where.at("seed"), 0, 2**64 - 1),
            published=uncertainty is not None,
            impossible=impossible,
            only=tuple(_whole(m, where.at("only"), 0) for m in settings.get("only", ())),
            correlations=tuple(_correlations(settings.get("correlations", ()), where)),
            distributions=dict(_distributions(inputs, where)),
            values={name: from_scene(entry, where.at(name)) for name, entry in values.items()},
        )

    def write(self) -> dict[str, Any]:
        """Give the table, with every number."""
        table: dict[str, Any] = {"seed": self.seed, "impossible": self.impossible}
        options = {
            "n": self.n,
            "uncertainty": "sample" if self.published else "",
            "only": list(self.only),
            "correlations": [list(correlation) for correlation in self.correlations],
        }
        table |= {name: value for name, value in options.items() if value}
        table |= {
            name: {entry.shape: list(entry.numbers)} for name, entry in self.distributions.items()
        }
        if self.values:
            table["values"] = {
                name: entry.tolist() if entry.dtype.kind == "U" else pack(entry)
                for name, entry in self.values.items()
            }
        return table


def _whole(value: Any, where: Where, low: int, high: int = MOST) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise where.error(value, "give a whole number")
    if not low <= int(value) <= high:
        raise where.error(value, f"it lies between {low} and {high}")
    return int(value)


def _distributions(
    table: Mapping[str, Any], where: Where, before: str = ""
) -> Iterator[tuple[str, Distribution]]:
    """Distributions by name; TOML makes tables within tables of names with points."""
    for name, entry in table.items():
        full = f"{before}{name}"
        if not isinstance(entry, Mapping):
            raise where.at(full).error(entry, "give a table like normal = [1, 2]")
        inner = [*entry.values()]
        if inner and not set(entry) & set(_SHAPES) and all(isinstance(i, Mapping) for i in inner):
            yield from _distributions(entry, where, f"{full}.")
        else:
            yield full, Distribution.read(entry, where.at(full))


def _correlations(rows: Any, where: Where) -> Iterator[tuple[str, str, float]]:
    for row in rows:
        try:
            first, second, size = row
        except (TypeError, ValueError):
            first = second = size = None
        if not (isinstance(first, str) and isinstance(second, str) and first != second):
            problem = 'give two names and a number: ["a", "b", 0.5]'
            raise where.at("correlations").error(row, problem)
        if isinstance(size, bool) or not isinstance(size, (int, float)) or not abs(size) < 1:
            problem = "a correlation lies between -1 and 1, both excluded"
            raise where.at("correlations").error(row, problem)
        yield first, second, float(size)


# --- drawing -------------------------------------------------------------------------------------


def count_of(members: Members, inputs: Mapping[str, Distribution], where: Where) -> int:
    """How many members there are, by number, grids or values, which must agree.

    Raises
    ------
    SceneError
        If they do not, or nothing says it.
    """
    grids = [len(entry.numbers) for entry in inputs.values() if entry.shape == "grid"]
    grid = math.prod(grids)
    counts = {"n": members.n} if members.n is not None else {}
    counts |= {name: len(entry) for name, entry in members.values.items()}
    if len(set(counts.values())) > 1:
        raise where.error(counts, "these are not equally many")
    n = next(iter(counts.values()), grid if grids else None)
    if n is None:
        raise where.at("n").error(None, "say how many members are drawn")
    if grids and n % grid:
        raise where.at("n").error(n, f"the grid has {grid} points: give a multiple of that")
    if max((*members.only, 0)) >= n:
        raise where.at("only").error(max(members.only), f"there are {n} members, from 0")
    return int(n)


def draw(
    members: Members, inputs: Mapping[str, Distribution], which: FloatArray, where: Where
) -> dict[str, NDArray[Any]]:
    """Draw the values of every input that is drawn.

    Parameters
    ----------
    members : Members
    inputs : mapping of str to Distribution
        With their numbers as the inputs are kept.
    which : ndarray of int, shape (n,)
        Numbers of the members.
    where : Where

    Returns
    -------
    dict of str to ndarray, shape (n,)
    """
    if not inputs:
        return {}
    normal = standard_normal(members.seed, which, len(inputs))
    if members.correlations:
        normal = _mixed(normal, _root(members, [*inputs], where))
    place, values = which.astype(int), {}
    for (name, distribution), column in zip(inputs.items(), normal.T, strict=True):
        size = len(distribution.numbers)
        values[name] = distribution.values(column, place % size)
        if distribution.shape == "grid":
            place = place // size
    return values


def _mixed(normal: FloatArray, root: FloatArray) -> FloatArray:
    """Each row times the root, summed number by number: a BLAS rounds a row alone otherwise."""
    mixed = np.zeros_like(normal)
    for column, weights in zip(normal.T, root.T, strict=True):
        mixed += np.multiply.outer(column, weights)
    return mixed


def _root(members: Members, names: list[str], where: Where) -> FloatArray:
    """Lower triangle whose product with its transpose is the matrix of correlations."""
    matrix = np.eye(len(names))
    for first, second, size in members.correlations:
        for name in (first, second):
            if name not in names:
                raise where.at("correlations").error(name, nearest(name, names))
        i, j = names.index(first), names.index(second)
        matrix[i, j] = matrix[j, i] = size
    try:
        return np.asarray(np.linalg.cholesky(matrix))
    except np.linalg.LinAlgError:
        rows = [list(row) for row in members.correlations]
        problem = "no numbers are correlated so; the matrix is not positive"
        raise where.at("correlations").error(rows, problem) from None
