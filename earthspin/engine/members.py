"""Specification of an ensemble: read distributions or values of inputs, and draw random values.

An input that varies is a number of a question, or a name in it: an orbit table, a kernel, a model.
Its values are drawn from a distribution, taken from a grid, or listed for each member.

Each member has its own random generator, defined by its number and the seed (Philox with
``SeedSequence(seed, spawn_key=(member,))``). Member 17 is therefore the same alone, in any block
and on any machine. A member draws one standard normal number for each input, in the order in which
the inputs are named, and each distribution transforms it. Correlations are those of the normal
numbers.
"""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from earthspin._lazy import xr
from earthspin.errors import OutputError, Where, nearest
from earthspin.numerics.arrays import FloatArray
from earthspin.process import signals_held
from earthspin.units import (
    Whole,
    Word,
    by_name,
    has_unit,
    in_order,
    in_unit,
    is_whole,
    numbers_and_unit,
    pack,
    unpack,
)

IntArray = NDArray[np.int64]

#: Name of the dimension of an ensemble.
MEMBER = "member"
#: Largest number of parts between dots in the name of a key; problem of a table with more.
MOST_PARTS, ENDLESS = 32, "a table contains itself; give a table that ends"
#: Largest number of members, which limits the memory for the values of one input; largest seed.
LARGEST_COUNT, LARGEST_SEED = 10_000_000, 2**64 - 1
_COUNT, _INDEX = Whole(1, LARGEST_COUNT), Whole(0, LARGEST_COUNT)
#: Message for an input that is given more than once.
TWICE = "it is given twice, perhaps with a dot and in a table; give it once"
_SHAPES: dict[str, str] = {
    "normal": "a mean and one standard deviation",
    "uniform": "a lowest and a highest value",
    "choice": "one value or more",
    "grid": "one value or more; members take every combination of all grids",
}


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
        shape, numbers = next(iter(value.items()), ("", ()))
        if len(value) != 1 or shape not in _SHAPES:
            problem = f"give one of {', '.join(_SHAPES)}, like normal = [1, 2]"
            raise where.error(dict(value), problem)
        if isinstance(numbers, np.ndarray) and numbers.ndim:
            numbers = numbers.tolist() if type(numbers) is np.ndarray else list(numbers)
        many = len(numbers) if isinstance(numbers, (list, tuple)) else 0
        if many == 0 or (shape in ("normal", "uniform") and many != 2):
            raise where.error(numbers, f"{shape} takes {_SHAPES[shape]}")
        return cls(shape, tuple(map(_scene_value, numbers)))

    def checked(self, kind: Any, where: Where) -> Distribution:
        """Return the distribution in SI units; raise an error if the input does not allow it."""
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

    def values(self, normal: FloatArray, index: IntArray) -> NDArray[Any]:
        """Transform standard normal numbers into values of this distribution, or index a grid.

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
        if self.shape == "grid":
            return np.asarray(numbers[index])
        if self.shape == "normal":
            return np.asarray(numbers[0] + numbers[1] * normal)
        share = ndtr(normal)
        if self.shape == "uniform":
            return np.asarray(numbers[0] + (numbers[1] - numbers[0]) * share)
        return np.asarray(numbers[np.minimum((share * numbers.size).astype(int), numbers.size - 1)])


def checked_names(values: Iterable[Any], kind: Any, where: Where) -> tuple[str, ...]:
    """Check the text values (such as file names) of an input, and return them as a tuple.

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
    if type(number) in (float, int, str):
        return number
    if isinstance(number, os.PathLike):
        return os.fspath(number)
    number, unit = numbers_and_unit(number)
    if unit is not None:
        return f"{float(number)!r} {unit}"
    return number.item() if isinstance(number, np.generic) else number


class ListedValues(NamedTuple):
    """Values of one input for all members of an ensemble, and the unit of the values.

    Attributes
    ----------
    values : ndarray, shape (n, ...)
        Finite numbers, or names as text.
    unit : str or None
        Unit of the numbers; None means SI.
    """

    values: NDArray[Any]
    unit: str | None = None

    @classmethod
    def read(cls, value: Any, where: Where) -> ListedValues:
        """Read the values of one input from a scene file: a packed array, or a list of names."""
        if isinstance(value, Mapping):
            unit = value.get("unit")
            return cls(unpack(value, where), unit if unit is None else str(unit))
        return cls(_names(np.array(value, dtype=object), where))

    @classmethod
    def of(cls, array: Any, where: Where) -> ListedValues:
        """Take the values of one input from a DataArray: finite numbers, or names."""
        if MEMBER not in array.dims:
            dims = f"dimensions {', '.join(map(str, array.dims)) or 'none'}"
            raise where.error(dims, f"one of the dimensions must be '{MEMBER}'")
        array = array.drop_vars(MEMBER, errors="ignore").transpose(MEMBER, ...)
        numbers, unit = numbers_and_unit(in_order(array, where))
        values = np.asarray(numbers)
        if values.dtype.kind not in "fiu":
            return cls(_names(values.astype(object), where))
        if not np.isfinite(values).all():
            whole = np.isfinite(values.reshape(len(values), -1)).all(axis=1)
            raise where.error(f"member {int(np.argmin(whole))}", "give finite numbers")
        return cls(values.astype(float), unit if unit is None else str(unit))

    def checked(self, kind: Any, where: Where) -> NDArray[Any]:
        """Return the values for all members, converted to the unit of the input type `kind`.

        Raises
        ------
        EarthspinError
            If names were given for a number, the input does not take one of the names, or the unit
            is of another kind.
        """
        if by_name(kind):
            checked_names(np.unique(self.values).tolist(), kind, where)
        elif self.values.dtype.kind == "U":
            raise where.error(str(self.values[0]), "give finite numbers")
        elif self.unit is not None:
            example = f"1 {kind.unit}".strip()
            return in_unit(self.values, self.unit, kind.unit, where, example)
        return self.values

    def write(self) -> Any:
        """Convert the values to the form in which scene files store them."""
        unit = {} if self.unit is None else {"unit": self.unit}
        return self.values.tolist() if self.values.dtype.kind == "U" else pack(self.values) | unit


@dataclass(frozen=True, eq=False)
class Members:
    """Specification of an ensemble: the number of members, and the inputs that vary.

    Attributes
    ----------
    n : int or None
        Number of members that are drawn; None if it follows from grids or values.
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
    values : mapping of str to ListedValues
        Numbers or names of every member, by name of the input.
    labels : tuple
        Labels of the members that have values, as given; their numbers if empty.
    """

    n: int | None = None
    seed: int = 0
    published: bool = False
    impossible: Literal["refuse", "drop"] = "refuse"
    only: tuple[int, ...] = ()
    correlations: tuple[tuple[str, str, float], ...] = ()
    distributions: Mapping[str, Distribution] = field(default_factory=dict)
    values: Mapping[str, ListedValues] = field(default_factory=dict)
    labels: tuple[Any, ...] = ()

    words: ClassVar[str] = "how many, a table of distributions, or a Dataset along `member`"
    hint: ClassVar[str] = "int | Mapping[str, Any] | xr.Dataset | str"

    # --- reading and writing ---------------------------------------------------------------------

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
        if is_whole(value):
            return cls(n=_COUNT.read(value, where), published=True)
        if isinstance(value, (str, os.PathLike)):
            value = _read_file(Path(value))
        if hasattr(value, "data_vars"):
            return cls(values=_values_of(value, where), labels=_labels_of(value))
        if not isinstance(value, Mapping):
            raise where.error(value, f"give {cls.words}")
        inputs = {name: entry for name, entry in value.items() if name not in _SETTINGS}
        for name, entry in inputs.items():
            if not isinstance(entry, Mapping):
                problem = f"{nearest(name, _SETTINGS)}, or a table like normal = [1, 2]"
                raise where.at(name).error(entry, problem)
        settings: dict[str, Any] = {
            name: read(value[name], where.at(name))
            for name, read in _SETTINGS.items()
            if value.get(name) is not None
        }
        published = settings.pop("uncertainty", None) is not None
        distributions: dict[str, Distribution] = {}
        for name, distribution in _distributions(inputs, where):
            if name in distributions:  # in a dotted and in a nested spelling
                raise where.at(name).error(list(distribution.numbers), TWICE)
            distributions[name] = distribution
        return cls(**settings, published=published, distributions=distributions)

    def write(self) -> dict[str, Any]:
        """Convert the specification to a table for a scene file; `read` restores all values."""
        table: dict[str, Any] = {
            "seed": self.seed,
            "impossible": self.impossible,
            "n": self.n,
            "uncertainty": "sample" if self.published else "",
            "only": list(self.only),
            "correlations": [list(correlation) for correlation in self.correlations],
            **{name: {each.shape: list(each.numbers)} for name, each in self.distributions.items()},
            "values": {name: entry.write() for name, entry in self.values.items()},
            "labels": list(self.labels),
        }
        return {name: value for name, value in table.items() if value or name == "seed"}

    # --- drawing ---------------------------------------------------------------------------------

    def count(self, where: Where) -> int:
        """Number of ensemble members: given as `n`, or implied by the grids or the listed values.

        Nothing is drawn, however large the number is.

        Raises
        ------
        SceneError
            If these disagree, none of them is given, or the members that are computed are too many.
        """
        grids = [len(d.numbers) for d in self.distributions.values() if d.shape == "grid"]
        points = math.prod(grids)
        counts = {"n": self.n} if self.n is not None else {}
        counts |= {name: len(entry.values) for name, entry in self.values.items()}
        counts |= {"labels": len(self.labels)} if self.labels else {}
        if len(set(counts.values())) > 1:
            raise where.error(counts, "these numbers of members differ; give equally many values")
        n = next(iter(counts.values()), points if grids else None)
        if n is None:
            raise where.at("n").error(None, "give the number of members to draw")
        if (len(self.only) or n) > LARGEST_COUNT:
            product = f" ({' times '.join(map(str, grids))})" if len(grids) > 1 else ""
            problem = (
                f"an ensemble has at most {LARGEST_COUNT} members; give shorter grids, or draw n "
                "members from 'choice' or 'uniform', or list the members to compute in 'only'"
            )
            raise where.error(f"{n} members{product}", problem)
        if grids and n % points:
            problem = f"the grid has {points} points: give a multiple of {points}"
            raise where.at("n").error(n, problem)
        if max((*self.only, 0)) >= n:
            raise where.at("only").error(max(self.only), f"members are numbered from 0 to {n - 1}")
        return int(n)


def _read_file(path: Path) -> xr.Dataset:
    """Read input values of ensemble members from a CSV, netCDF or Zarr file."""
    # os.path.exists is false for a name that is too long, where Path.exists raises an error
    if not os.path.exists(path):
        raise OutputError(path, "there is no such file", "give a .csv, .nc or .zarr, or a number")
    try:
        if path.suffix == ".csv":
            import pandas as pd

            with warnings.catch_warnings():
                # rows that are longer than the header would shift the columns
                warnings.simplefilter("error", pd.errors.ParserWarning)
                frame = pd.read_csv(path, skipinitialspace=True, index_col=False)
            return xr.Dataset({name: (MEMBER, frame[name].to_numpy()) for name in frame})
        if path.suffix in (".nc", ".zarr"):
            options: dict[str, Any] = {"engine": "zarr", "consolidated": False}
            options = options if path.suffix == ".zarr" else {}
            with signals_held(), xr.open_dataset(path, **options) as dataset:
                return dataset.load()
    except Exception as error:  # pandas and xarray raise many types for damaged files
        raise OutputError(path, f"it cannot be read: {error}") from None
    remedy = "its name must end in .csv, .nc or .zarr"
    raise OutputError(path, "it is not a file of members", remedy)


def _values_of(dataset: Any, where: Where) -> dict[str, ListedValues]:
    """Take input values of all ensemble members from a Dataset: a table, or an earlier ensemble."""
    variables = {name: array for name, array in dataset.coords.items() if "input" in array.attrs}
    values = {
        name: ListedValues.of(array, where.at(name))
        for label, array in (variables or dataset.data_vars).items()
        if (name := str(array.attrs.get("input", label))) != MEMBER
    }
    if not values or not all(len(entry.values) for entry in values.values()):
        raise where.error("a Dataset", f"it has no members; give variables along '{MEMBER}'")
    return values


def _labels_of(dataset: Any) -> tuple[Any, ...]:
    """Labels of the members in a Dataset, as numbers or text; none if they are their numbers."""
    labels = dataset[MEMBER].values if MEMBER in dataset.variables else np.arange(0)
    if labels.dtype.kind not in "iuf":
        labels = labels.astype(str)
    return () if np.array_equal(labels, np.arange(labels.size)) else tuple(labels.tolist())


def _names(values: NDArray[Any], where: Where) -> NDArray[Any]:
    """Check that an array has one text for each member, and return the array as text."""
    if values.ndim != 1 or not values.size:
        raise where.error(f"shape {values.shape}", "give one name for each member")
    for index, name in enumerate(values):
        if not isinstance(name, str):
            unit = "numbers with their unit as attrs['units']" if has_unit(name) else "numbers"
            raise where.error(f"member {index}", f"give finite {unit}, or a name for each member")
    return values.astype(str)


def _distributions(
    table: Mapping[str, Any], where: Where, before: str = ""
) -> Iterator[tuple[str, Distribution]]:
    """Yield the name and the distribution of each varying input in a table of tables.

    TOML turns a dotted name into a table within a table.
    """
    for name, entry in table.items():
        if before.count(".") > MOST_PARTS:
            raise where.error("a table", ENDLESS)
        inner = entry.values()
        if inner and not set(entry) & set(_SHAPES) and all(isinstance(i, Mapping) for i in inner):
            yield from _distributions(entry, where, f"{before}{name}.")
        else:
            yield f"{before}{name}", Distribution.read(entry, where.at(f"{before}{name}"))


def _list(value: Any, where: Where) -> list[Any]:
    if not isinstance(value, (list, tuple)):
        raise where.error(value, "give a list")
    return [*value]


def _correlation(row: Any, where: Where) -> tuple[str, str, float]:
    try:
        first, second, size = row
    except (TypeError, ValueError):
        first = second = size = None
    if not (isinstance(first, str) and isinstance(second, str) and first != second):
        raise where.error(row, 'give two names and a number: ["a", "b", 0.5]')
    if isinstance(size, bool) or not isinstance(size, (int, float)) or not abs(size) < 1:
        raise where.error(row, "a correlation lies between -1 and 1, both excluded")
    return first, second, float(size)


def _tables(value: Any, where: Where) -> dict[str, ListedValues]:
    if not isinstance(value, Mapping):
        raise where.error(value, "give a table of inputs, each with its values")
    return {name: ListedValues.read(entry, where.at(name)) for name, entry in value.items()}


#: Settings in a table of members, each with the function that reads it; other names are inputs.
_SETTINGS: dict[str, Callable[[Any, Where], Any]] = {
    "n": _COUNT.read,
    "seed": Whole(0, LARGEST_SEED).read,
    "uncertainty": Word(("sample",)).read,
    "impossible": Word(("refuse", "drop")).read,
    "only": lambda value, where: tuple(_INDEX.read(m, where) for m in _list(value, where)),
    "correlations": lambda value, where: tuple(_correlation(r, where) for r in _list(value, where)),
    "values": _tables,
    "labels": lambda value, where: tuple(_list(value, where)),
}


# --- drawing -------------------------------------------------------------------------------------


def draw(
    members: Members, inputs: Mapping[str, Distribution], which: IntArray, where: Where
) -> dict[str, NDArray[Any]]:
    """Draw, for each member, a value of every varying input from the distribution of the input.

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
    root = _root(members, [*inputs], where)
    if all(distribution.shape == "grid" for distribution in inputs.values()):
        normal = np.broadcast_to(np.nan, (len(which), len(inputs)))  # grids take no random numbers
    else:
        normal = standard_normal(members.seed, which, len(inputs))
        if members.correlations:  # not by a BLAS, whose rounding depends on the number of rows
            normal = sum(map(np.multiply.outer, normal.T, root.T))
    index, values = which, {}
    for (name, distribution), column in zip(inputs.items(), normal.T, strict=True):
        size = len(distribution.numbers)
        values[name] = distribution.values(column, index % size)
        if distribution.shape == "grid":
            index = index // size
    return values


def standard_normal(seed: int, which: IntArray, inputs: int) -> FloatArray:
    """Draw standard normal numbers, with a separate random generator for each member.

    Parameters
    ----------
    seed : int
    which : ndarray of int, shape (n,)
        Numbers of the members.
    inputs : int
        Number of random numbers for each member.

    Returns
    -------
    ndarray, shape (n, inputs)
    """
    normal = np.empty((len(which), inputs))
    for row, member in zip(normal, which.tolist(), strict=True):
        sequence = np.random.SeedSequence(seed, spawn_key=(member,))
        np.random.Generator(np.random.Philox(sequence)).standard_normal(out=row)
    return normal


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
