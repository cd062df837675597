"""Ensembles: answer one question for many sets of inputs (members), block by block.

If the parts of a question take arrays (`define_parts`, `together`), its members are computed
together; otherwise separately. Members that are computed together are arranged in rows of `ROW`,
each at the index of its number. A BLAS, which sums products by row, then rounds in the same way
for any number of members, and a member has the same bits alone. Only members with the same names
in all inputs that are names are computed together.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from operator import itemgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from earthspin.engine import blocks
from earthspin.engine.blocks import Layout, request_of
from earthspin.engine.inputs import (
    Input,
    along_members,
    inputs_of,
    one_member,
    published,
    with_values,
)
from earthspin.engine.member_values import MEMBER
from earthspin.engine.members import TWICE, Members, count_of, draw
from earthspin.engine.question import SCENE, Question, scene_text
from earthspin.engine.variants import Names, Variants
from earthspin.errors import ApartError, EarthspinError

if TYPE_CHECKING:
    import xarray as xr

IntArray = NDArray[np.int64]

#: Number of members in a row.
ROW = 64
#: Intended size of a block in bytes, and the largest number of members in a block.
BLOCK_BYTES, LONGEST_BLOCK = 8_000_000, 16_384
#: Largest block of members that are computed separately; a killed run loses at most one block.
SEPARATE_BLOCK = 16
#: Largest size of an ensemble in memory, bytes.
LARGEST_IN_MEMORY = 4_000_000_000
#: Largest number of members that a message lists.
LISTED = 5


class Ensemble:
    """A question with many ensemble members, whose answers are computed in blocks.

    Parameters
    ----------
    question : Question
        Question with members.
    block : int, optional
        Number of members in a block; chosen from their size by default.

    Attributes
    ----------
    inputs : dict of str to Input
        Inputs in which the members differ.
    values : dict of str to ndarray, shape (n, ...)
        Values of each input for all computed members; text for inputs that are names.
    which : ndarray of int
        Numbers of the computed members.
    dropped : list of int
        Numbers of the impossible members that were left out.

    Raises
    ------
    SceneError
        If the members have no varying input, or some cannot exist.
    """

    def __init__(self, question: Question, *, block: int | None = None) -> None:
        nominal = {name: getattr(question, name) for name in question.by_body}
        self.full_question, self.question = question, question.replace(members=None, **nominal)
        members = question.members or Members()
        where = question.where("members")
        for name in members.distributions.keys() & members.values.keys():
            raise where.at(name).error("...", TWICE)
        distributions = published(self.question) if members.published else {}
        distributions |= members.distributions
        self.inputs = inputs_of(self.question, [*distributions, *members.values], where)
        if not self.inputs:
            problem = (
                "no input of this question has a published uncertainty; name the inputs to vary"
            )
            raise where.error(None, problem)
        n = count_of(members, distributions, where)
        self.which = np.array(members.only or range(n))
        drawn = {
            name: distribution.checked(self.inputs[name].kind, where.at(name))
            for name, distribution in distributions.items()
        }
        self.values = draw(members, drawn, self.which, where)
        self.values |= {
            name: self.inputs[name].checked(values, members.units.get(name), where.at(name))[
                self.which
            ]
            for name, values in members.values.items()
        }
        self.dropped: list[int] = []
        self._drop_impossible_members(members.impossible == "drop", n)
        self._length = block

    def __getstate__(self) -> dict[str, Any]:
        _ = self.layout, self.width  # computed once, before workers receive copies
        return {n: value for n, value in vars(self).items() if n not in ("variants", "nominal")}

    # --- work of `loop` --------------------------------------------------------------------------

    @property
    def what(self) -> str:
        """Name of the ensemble, shown in the progress bar."""
        return f"{self.question.word} members"

    @cached_property
    def numbers(self) -> dict[str, Input]:
        """Inputs of the ensemble that are numbers; other inputs are names, such as files."""
        return {name: entry for name, entry in self.inputs.items() if not entry.named}

    @cached_property
    def variants(self) -> Variants:
        """Copies of the question, one for each combination of inputs by name (such as files)."""
        keys = tuple(entry.key for entry in self.inputs.values() if entry.named)
        return Variants(self.question, keys)

    def names(self, index: int) -> Names:
        """Inputs of one member that are given by name, such as files, as a tuple of names."""
        inputs = (name for name, entry in self.inputs.items() if entry.named)
        return tuple(str(self.values[name][index]) for name in inputs)

    @cached_property
    def groups(self) -> dict[Names, IntArray]:
        """Indices of members with equal inputs by name (such as files), by the tuple of names."""
        if len(self.numbers) == len(self.inputs):
            return {(): np.arange(len(self.which))}
        indices: dict[Names, list[int]] = {}
        for index in range(len(self.which)):
            indices.setdefault(self.names(index), []).append(index)
        return {names: np.array(group) for names, group in indices.items()}

    @cached_property
    def nominal(self) -> xr.Dataset:
        """Answer with the question's own numbers and with the first member's inputs by name."""
        return self.variants.nominal(next(iter(self.groups)))

    @cached_property
    def width(self) -> int:
        """Number of members that are computed together as arrays; 1 if each is computed alone."""
        rows = BLOCK_BYTES * 4 // (self.nominal.nbytes * ROW)
        if not self.numbers:
            return rows * ROW or 1  # one answer for each combination of names is computed
        together = self.question.graph.together
        fit = all(entry.key in together and entry.labelled for entry in self.numbers.values())
        if not fit:
            return 1
        return min(rows * ROW, self.question.graph.widest) or 1

    @cached_property
    def layout(self) -> Layout:
        """Division of the ensemble into blocks of members."""
        length = self._length
        if length is None:
            fits = BLOCK_BYTES // self.nominal.nbytes
            rows = max(1, min(fits, LONGEST_BLOCK) // ROW) * ROW
            length = rows if self.width > 1 else max(1, min(fits, SEPARATE_BLOCK))
        return Layout(MEMBER, len(self.which), min(length, len(self.which)))

    @cached_property
    def request(self) -> Mapping[str, str]:
        """Texts that identify the run: question, software versions and checksums of files."""
        return request_of(self.full_question, self.variants.provenance(self.groups))

    def plan_data(self) -> xr.Dataset:
        """Plan of the computation for the first member, as a Dataset."""
        return self.variants[self.names(0)].plan().dataset()

    def hold(self, client: object = None) -> xr.Dataset:
        """Compute the ensemble and return it in memory.

        Raises
        ------
        SceneError
            If the result is too large for memory.
        """
        size = self.nominal.nbytes * self.layout.size
        if size > LARGEST_IN_MEMORY:
            problem = f"they need about {size / 1e9:.3g} GB; give a path to write them to a store"
            raise self.question.error("members", self.layout.size, problem)
        return blocks.hold(self, client=client)

    def write(self, path: str | Path, client: object = None) -> Path:
        """Compute the ensemble into a Zarr store, or continue an unfinished store."""
        return blocks.write(self, path, client=client)

    # --- the members -----------------------------------------------------------------------------

    def _drop_impossible_members(self, drop: bool, n: int) -> None:
        """Omit members with impossible inputs if the user allowed it; else raise an error."""
        impossible = dict(sorted(self._impossible_members(), key=itemgetter(0)))
        if not impossible:
            return
        numbers = [int(self.which[index]) for index in impossible]
        if not drop or len(numbers) == len(self.which):
            count = f"{len(numbers)} of {n} members cannot exist"
            problem = f"{count}: {next(iter(impossible.values()))}"
            remedy = "" if drop else "; change the distributions, or set impossible = 'drop'"
            raise self.question.error("members", _list_of_numbers(numbers), problem + remedy)
        possible = np.delete(np.arange(len(self.which)), list(impossible))
        self.which, self.dropped = self.which[possible], numbers
        self.values = {name: values[possible] for name, values in self.values.items()}
        del self.groups

    def _impossible_members(self) -> Iterator[tuple[int, EarthspinError]]:
        """Yield the index and the error of each member whose inputs are impossible."""
        arrays = all(entry.field and entry.labelled for entry in self.numbers.values())
        for names, indices in self.groups.items():
            try:
                question = self.variants.question(names)
            except EarthspinError as error:
                yield from ((int(index), error) for index in indices)
                continue
            if arrays:
                with suppress(EarthspinError):
                    with_values(question, self.numbers, along_members(self._number_values, indices))
                    continue
            for index in indices.tolist():
                try:
                    with_values(question, self.numbers, one_member(self._number_values, index))
                except EarthspinError as error:
                    yield index, error

    # --- blocks ----------------------------------------------------------------------------------

    def first(self) -> xr.Dataset:
        """Compute the first block of members, with the global attributes of the whole ensemble."""
        question = self.full_question
        attributes = {"title": question.title, SCENE: scene_text(question)}
        if self.dropped:
            count = f"{len(self.dropped)} that cannot exist: {_list_of_numbers(self.dropped)}"
            attributes["members_dropped"] = count
        return self.variants.describe(self.make(0), self.groups).assign_attrs(attributes)

    def make(self, number: int) -> xr.Dataset:
        """Compute one block of members, by its number."""
        first, last = self.layout.bounds(number)
        if self.width == 1:
            indices = [np.array([index]) for index in range(first, last)]
            pieces = [self._single(index) for index in range(first, last)]
        else:
            indices, pieces = map(list, zip(*self._together(first, last), strict=True))
        block = _concatenated(pieces)
        order = np.argsort(np.concatenate(indices))
        if (np.diff(order) != 1).any():
            block = block.isel({MEMBER: order} if MEMBER in block.dims else {})
        return block.assign_coords(self._labels(slice(first, last), block))

    def _together(self, first: int, last: int) -> Iterator[tuple[IntArray, xr.Dataset]]:
        """Compute members `first` to `last` - 1, in groups with equal inputs by name.

        Yield their indices and answers.

        Columns of other members hold a copy of a wanted one, so that a row is always complete.
        """
        for begin in range(first - first % ROW, last, self.width):
            end = min(begin + self.width, -(-last // ROW) * ROW)
            row = np.arange(begin, end)
            for names, group in self.groups.items():
                indices = group[np.searchsorted(group, max(begin, first)) :]
                indices = indices[: np.searchsorted(indices, min(end, last))]
                if not indices.size:
                    continue
                columns = np.where(np.isin(row, indices), row, indices[0])
                values = along_members(self._number_values, columns)
                which = _list_of_numbers(self.which[indices].tolist())
                try:
                    answer = self._answer(names, values, which)
                except ApartError:
                    yield from ((np.array([index]), self._single(index)) for index in indices)
                    continue
                if names:
                    answer = _along_all_members(answer, len(row))
                if MEMBER in answer.dims:
                    answer = answer.isel({MEMBER: _as_slice(indices - begin)})
                yield indices, answer

    def _single(self, index: int) -> xr.Dataset:
        values, which = one_member(self._number_values, index), str(self.which[index])
        return _along_all_members(self._answer(self.names(index), values, which), 1)

    def _answer(self, names: Names, values: Mapping[str, Any], which: str) -> xr.Dataset:
        """Compute the answer for one member, or for several members with equal inputs by name."""
        try:
            nominal = self.variants[names]
            changed = with_values(nominal.question, self.numbers, values)
            answer = nominal.again(changed).numbers()
        except EarthspinError as error:
            error.args = (f"member {which}: {error}",)
            raise
        for name, label in self.nominal.coords.items():
            if name not in answer.coords or not label.equals(answer.coords[name]):
                problem = f"member {which} has other labels along '{name}'"
                raise self.question.error("members", list(self.inputs), problem)
        return answer

    @property
    def _number_values(self) -> dict[str, NDArray[Any]]:
        """Values of all members for each input that is a number, by input name."""
        return {name: self.values[name] for name in self.numbers}

    def _labels(self, which: slice, block: xr.Dataset) -> dict[str, Any]:
        """Make the coordinates along `member`: member numbers and input values.

        An input with the name of a result, such as theta, is labelled ``<name>_given``.
        """
        labels: dict[str, Any] = {
            MEMBER: (MEMBER, self.which[which], {"long_name": "number of the member"})
        }
        for name, entry in self.inputs.items():
            values = self.values[name][which]
            dims = (MEMBER, *(f"{entry.label}_{k}" for k in range(values.ndim - 1)))
            attrs = {"long_name": f"{name} of the member"}
            attrs |= {} if entry.named else {"units": entry.unit or "1"}
            attrs |= {"input": name}
            label = f"{entry.label}_given" if entry.label in block.variables else entry.label
            labels[label] = (dims, values, attrs)
        return labels


def _list_of_numbers(numbers: list[int]) -> str:
    """Write member numbers as text; list at most `LISTED`, and count the rest."""
    more = f" and {len(numbers) - LISTED} more" if len(numbers) > LISTED else ""
    return f"{', '.join(map(str, numbers[:LISTED]))}{more}"


def _as_slice(indices: IntArray) -> IntArray | slice:
    """Return consecutive indices as a slice, which avoids a copy."""
    first, last = int(indices[0]), int(indices[-1])
    return slice(first, last + 1) if last - first + 1 == len(indices) else indices


def _along_all_members(answer: xr.Dataset, count: int) -> xr.Dataset:
    """Repeat variables without the dimension `member` once for each of `count` members."""
    repeated = {
        name: variable.expand_dims({MEMBER: count})
        for name, variable in answer.data_vars.items()
        if variable.dtype.kind in "fiubM" and MEMBER not in variable.dims
    }
    return answer.assign(repeated)


def _concatenated(pieces: list[xr.Dataset]) -> xr.Dataset:
    """Join the Datasets of successive members along `member`."""
    import xarray as xr

    variables: dict[Any, Any] = {}
    for name, variable in pieces[0].data_vars.items():
        variables[name] = variable.variable
        if MEMBER in variable.dims:
            parts = [piece[name].variable.transpose(MEMBER, ...) for piece in pieces]
            values = np.concatenate([part.values for part in parts])
            variables[name] = xr.Variable(parts[0].dims, values, parts[0].attrs)
    return xr.Dataset(variables, pieces[0].coords)


def with_members(
    question: Question, members: object, seed: int | None = None, **more: Any
) -> Question:
    """Return a question with changed ensemble members: their number, seed or distributions.

    If `members` is None, those of the question are kept, and only the given fields are changed.

    Parameters
    ----------
    question : Question
    members : object, optional
        Value of the key `members`; a whole number changes only the number of members.
    seed : int, optional
    **more
        Fields of `Members` to change.
    """
    own, where = question.members, question.where("members")
    request: Members | None = own if members is None else Members.read(members, where)
    if request is None:
        raise where.error(None, "give the number of members, a file or a table")
    if own is not None and isinstance(members, (int, np.integer)):
        request = replace(own, n=request.n)
    changes = {name: value for name, value in {"seed": seed, **more}.items() if value is not None}
    checked = Members.read({"n": 1} | changes, where)
    changes = {name: getattr(checked, name) for name in changes}
    return question.replace(members=replace(request, **changes))
