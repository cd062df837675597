"""Specify the members of an ensemble: which inputs vary, and how their values are drawn.

An input is a number of a question, or a name in it: an orbit table, a kernel, a model.

Each member has its own random generator, defined by its number and the seed (Philox with
``SeedSequence(seed, spawn_key=(member,))``). Member 17 is therefore the same alone, in any block
and on any machine. A member draws one standard normal number for each input, in the order in which
the inputs are named, and each distribution transforms it. Correlations are those of the normal
numbers.
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

from earthspin.engine.member_values import (
    read_file,
    units_from_dataset,
    values_from_dataset,
    values_from_scene,
)
from earthspin.errors import Where, nearest
from earthspin.numerics.arrays import FloatArray
from earthspin.units import Word, by_name, pack

#: Largest number of members, which limits the memory for the values of one input.
LARGEST_COUNT = 10_000_000

Shape = Literal["normal", "uniform", "choice", "grid"]
_SHAPES: dict[str, str] = {
    "normal": "a mean and one standard deviation",
    "uniform": "a lowest and a highest value",
    "choice": "one value or more",
    "grid": "one value or more; members take every combination of all grids",
}
#: Message for an input that is given more than once.
TWICE = "it is given twice, perhaps with a dot and in a table; give it once"
_SETTINGS = ("n", "seed", "uncertainty", "impossible", "only", "correlations", "values")


@dataclass(frozen=True)
class Distribution:
    """Probability distribution or grid of one input, with the numbers as the user wrote them.

    Attributes
    ----------
    shape : str
        ``"normal"``, ``"uniform"``, ``"choice"`` or ``"grid"``.
    numbers : tuple
        Numbers, text with units, or names.
    """

    shape: str
    numbers: tuple[Any, ...]

    @classmethod
    def read(cls, value: Mapping[str, Any], where: Where) -> Distribution:
        """Read a distribution from a table like ``{ normal = [0.00327, 2e-9] }``."""
        if len(value) != 1 or next(iter(value)) not in _SHAPES:
            problem = f"give one of {', '.join(_SHAPES)}, like normal = [1, 2]"
            raise where.error(dict(value), problem)
        ((shape, numbers),) = value.items()
        numbers = list(numbers) if isinstance(numbers, np.ndarray) and numbers.ndim else numbers
        many = len(numbers) if isinstance(numbers, (list, tuple)) else 0
        if many == 0 or (shape in ("normal", "uniform") and many != 2):
            raise where.error(numbers, f"{shape} takes {_SHAPES[shape]}")
        return cls(shape, tuple(map(_scene_value, numbers)))

    def checked(self, kind: Any, where: Where) -> Distribution:
        """Return the distribution in SI units; raise an error if the input cannot have it."""
        if by_name(kind):
            if self.shape not in ("choice", "grid"):
                problem = f"{self.shape} applies to numbers; for names give choice or grid"
                raise where.error(list(self.numbers), problem)
            return Distribution(self.shape, checked_names(self.numbers, kind, where))
        numbers = [kind.read(number, where) for number in self.numbers]
        if any(map(np.ndim, numbers)):
            raise where.error(self.numbers, "give single numbers")
        if self.shape == "normal" and not numbers[1] >= 0:
            raise where.error(self.numbers, "the standard deviation must be zero or positive")
        if self.shape == "uniform" and not numbers[0] <= numbers[1]:
            raise where.error(self.numbers, "give the lowest value first")
        return Distribution(self.shape, tuple(map(float, numbers)))

    def values(self, normal: FloatArray, index: FloatArray) -> NDArray[Any]:
        """Transform standard normal numbers into values with this distribution.

        Parameters
        ----------
        normal : ndarray, shape (n,)
        index : ndarray of int, shape (n,)
            Indices of the values of a grid; ignored by the other shapes.

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
            index = np.minimum((share * numbers.size).astype(int), numbers.size - 1)
        return np.asarray(numbers[index])


def checked_names(values: Iterable[Any], kind: Any, where: Where) -> tuple[str, ...]:
    """Return the names, such as files, given for an input; raise an error if one is invalid.

    Raises
    ------
    EarthspinError
        If the input does not take one of them, or one is not text.
    """
    names = tuple(values)
    for name in names:
        kind.read(name, where)
        if not isinstance(name, str):
            problem = "members are labelled by text: give a name or the path of a file"
            raise where.error(type(name).__name__, problem)
    return names


def _scene_value(number: Any) -> Any:
    """Convert a number, Quantity or path to the form in which scene files store it."""
    if isinstance(number, os.PathLike):
        return os.fspath(number)
    if hasattr(number, "to_value"):
        return f"{float(number.value)!r} {number.unit}"
    return number.item() if isinstance(number, np.generic) else number


def standard_normal(seed: int, members: FloatArray, inputs: int) -> FloatArray:
    """Draw standard normal numbers, with a separate random generator for each member.

    Parameters
    ----------
    seed : int
    members : ndarray of int, shape (n,)
    inputs : int
        How many numbers each member draws.

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
    """Specification of an ensemble: the number of members, and the inputs that vary.

    Attributes
    ----------
    n : int or None
        How many members are drawn; None if the number follows from grids or values.
    seed : int
    published : bool
        Whether the numbers of the bodies are drawn from their published uncertainties.
    impossible : str
        ``"refuse"`` or ``"drop"``: how members that cannot exist are treated.
    only : tuple of int
        Numbers of the members that are computed; all if empty.
    correlations : tuple of (str, str, float)
    distributions : mapping of str to Distribution
        Distributions by name of the input, like ``"body.j2"``.
    values : mapping of str to ndarray, shape (n, ...)
        Numbers or names of every member, by name of the input.
    units : mapping of str to str
        Units of these numbers, by name of the input; SI if it has none.
    """

    n: int | None = None
    seed: int = 0
    published: bool = False
    impossible: Literal["refuse", "drop"] = "refuse"
    only: tuple[int, ...] = ()
    correlations: tuple[tuple[str, str, float], ...] = ()
    distributions: Mapping[str, Distribution] = field(default_factory=dict)
    values: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)

    words: ClassVar[str] = "how many, a table of distributions, or a Dataset along `member`"
    hint: ClassVar[str] = "int | Mapping[str, Any] | xr.Dataset | str"

    # --- as a scene ------------------------------------------------------------------------------

    @classmethod
    def read(cls, value: object, where: Where) -> Members:
        """Read a specification from a number of members, a table, a Dataset, or a file path.

        Raises
        ------
        SceneError
            If the value is none of these, a name or a number is wrong, or there are no members.
        """
        if isinstance(value, Members):
            return value
        if isinstance(value, (int, np.integer)) and not isinstance(value, bool):
            return cls(n=_whole_number(value, where, 1), published=True)
        if isinstance(value, (str, os.PathLike)):
            value = read_file(Path(value))
        if hasattr(value, "data_vars"):
            return cls(values=values_from_dataset(value, where), units=units_from_dataset(value))
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
            n=None if n is None else _whole_number(n, where.at("n"), 1),
            seed=_whole_number(settings.get("seed", 0), where.at("seed"), 0, 2**64 - 1),
            published=uncertainty is not None,
            impossible=impossible,
            only=tuple(_whole_number(m, where.at("only"), 0) for m in settings.get("only", ())),
            correlations=tuple(_correlations(settings.get("correlations", ()), where)),
            distributions=_once(_distributions(inputs, where), where),
            values={
                name: values_from_scene(entry, where.at(name)) for name, entry in values.items()
            },
            units={
                name: str(entry["unit"])
                for name, entry in values.items()
                if isinstance(entry, Mapping) and "unit" in entry
            },
        )

    def write(self) -> dict[str, Any]:
        """Convert the specification to a table for a scene file; `read` restores all values."""
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
            for name, unit in self.units.items():
                table["values"][name]["unit"] = unit
        return table


def _whole_number(value: Any, where: Where, low: int, high: int = LARGEST_COUNT) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise where.error(value, "give a whole number")
    if not low <= int(value) <= high:
        raise where.error(value, f"give a number from {low} to {high}")
    return int(value)


def _distributions(
    table: Mapping[str, Any], where: Where, before: str = ""
) -> Iterator[tuple[str, Distribution]]:
    """Yield the name and the distribution of each varying input in a table.

    TOML turns a dotted name into a table within a table.
    """
    for name, entry in table.items():
        full = f"{before}{name}"
        if not isinstance(entry, Mapping):
            raise where.at(full).error(entry, "give a table like normal = [1, 2]")
        inner = [*entry.values()]
        if inner and not set(entry) & set(_SHAPES) and all(isinstance(i, Mapping) for i in inner):
            yield from _distributions(entry, where, f"{full}.")
        else:
            yield full, Distribution.read(entry, where.at(full))


def _once(named: Iterable[tuple[str, Distribution]], where: Where) -> dict[str, Distribution]:
    """Return distributions by name; refuse a name in dotted and in nested spelling."""
    distributions: dict[str, Distribution] = {}
    for name, distribution in named:
        if name in distributions:
            raise where.at(name).error(list(distribution.numbers), TWICE)
        distributions[name] = distribution
    return distributions


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
    """Number of members of an ensemble, from `n`, from its grids or from its listed values.

    Raises
    ------
    SceneError
        If these disagree, or none of them is given.
    """
    grids = [len(entry.numbers) for entry in inputs.values() if entry.shape == "grid"]
    grid = math.prod(grids)
    counts = {"n": members.n} if members.n is not None else {}
    counts |= {name: len(entry) for name, entry in members.values.items()}
    if len(set(counts.values())) > 1:
        raise where.error(counts, "these numbers of members differ; give equally many values")
    n = next(iter(counts.values()), grid if grids else None)
    if n is None:
        raise where.at("n").error(None, "give the number of members to draw")
    if grids and n % grid:
        raise where.at("n").error(n, f"the grid has {grid} points: give a multiple of {grid}")
    if max((*members.only, 0)) >= n:
        problem = f"members are numbered from 0 to {n - 1}"
        raise where.at("only").error(max(members.only), problem)
    return int(n)


def draw(
    members: Members, inputs: Mapping[str, Distribution], which: FloatArray, where: Where
) -> dict[str, NDArray[Any]]:
    """Draw the values of all varying inputs for each member, from their distributions.

    Parameters
    ----------
    members : Members
    inputs : mapping of str to Distribution
        Distributions with numbers in SI units.
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
        normal = _correlated(normal, _root(members, [*inputs], where))
    index, values = which.astype(int), {}
    for (name, distribution), column in zip(inputs.items(), normal.T, strict=True):
        size = len(distribution.numbers)
        values[name] = distribution.values(column, index % size)
        if distribution.shape == "grid":
            index = index // size
    return values


def _correlated(normal: FloatArray, root: FloatArray) -> FloatArray:
    """Correlate standard normal numbers: multiply each row by the matrix `root`, without BLAS.

    The rounding of BLAS depends on the number of rows.
    """
    mixed = np.zeros_like(normal)
    for column, weights in zip(normal.T, root.T, strict=True):
        mixed += np.multiply.outer(column, weights)
    return mixed


def _root(members: Members, names: list[str], where: Where) -> FloatArray:
    """Cholesky factor of the correlation matrix of the inputs."""
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
        problem = "the matrix of correlations is not positive definite; give smaller ones"
        raise where.at("correlations").error(rows, problem) from None
