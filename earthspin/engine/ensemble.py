"""Ensembles: answer one question for many sets of inputs (members), block by block.

Members with the same names (orbits, kernels, interiors) share one run, of which only the parts that
depend on the numbers of members are repeated. If the parts take arrays (`define_parts`,
`together`), such members are computed together; otherwise separately. Arrays are filled up to a
multiple of `ROW` members: a BLAS, which sums products by row, then rounds in the same way for any
number of members, and a member has the same bits alone.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from earthspin._lazy import xr
from earthspin.engine import blocks
from earthspin.engine.ensemble_inputs import along_members, inputs_of, published, with_values
from earthspin.engine.members import MEMBER, IntArray, Members, draw
from earthspin.engine.question import SCENE, Question, scene_text
from earthspin.engine.run import Run
from earthspin.engine.variables import texts_as_labels
from earthspin.errors import ApartError, EarthspinError, SceneError
from earthspin.units import Number

#: Names of a member in all inputs that take names, in the order of these inputs.
Names = tuple[str, ...]
#: Arrays of members are filled up to a multiple of this number.
ROW = 64
#: Intended size of a block in bytes, and the largest number of members in a block.
BLOCK_BYTES, LONGEST_BLOCK = 8_000_000, 16_384
#: Largest block of members that are computed separately; a killed run loses at most one block.
SEPARATE_BLOCK = 16
#: Largest memory, bytes, and run time, days, of an ensemble that is not written to a store.
LARGEST_IN_MEMORY, LONGEST_IN_MEMORY = 4_000_000_000, 1
TO_A_STORE = "give a path to write them to a store"
#: Number of members that are drawn in a second; of more, memory and run time are estimated before.
MANY = 100_000
#: Combinations of names whose results are kept at a time.
LARGEST_NUMBER_OF_RUNS = 16
#: Largest number of members that a message lists.
LISTED = 5
#: Names in a description besides those of variables: the attributes of the whole, and the versions
#: and checksums of files.
_WHOLE, _SOURCES = "/", "/sources"


class Ensemble:
    """One question (computation) with many sets of inputs (members), computed block by block.

    Parameters
    ----------
    question : Question
        Question with members.
    block : int, optional
        Number of members in a block; chosen from their size by default.
    in_memory : bool
        Whether the answers will be held in memory, so that their size and run time are limited.

    Attributes
    ----------
    inputs : dict of str to Input
        Inputs in which the members differ.
    values : dict of str to ndarray, shape (n, ...)
        Values of each input for all computed members; text for inputs that are names.
    which : ndarray of int
        Numbers of the computed members.
    labels : Variable
        Labels of all members: those given with their values, or else their numbers.
    dropped : list of int
        Numbers of the impossible members that were left out.

    Raises
    ------
    SceneError
        If the members have no varying input, are too many, or some cannot exist.
    """

    def __init__(
        self, question: Question, *, block: int | None = None, in_memory: bool = False
    ) -> None:
        nominal = {name: getattr(question, name) for name in question.by_body}
        self.full_question, self.question = question, question.replace(members=None, **nominal)
        self._length = block
        members, where = question.members or Members(), question.where("members")
        distributions = published(self.question) if members.published else {}
        distributions |= members.distributions
        self.inputs = inputs_of(self.question, [*distributions, *members.values], where)
        if not self.inputs:
            problem = "no input of this question has a published uncertainty"
            raise where.error(None, f"{problem}; name the inputs to vary")
        self.named = {name: entry for name, entry in self.inputs.items() if entry.named}
        self.numbers = {name: entry for name, entry in self.inputs.items() if not entry.named}
        n = members.count(where)
        self.which = np.array(members.only) if members.only else np.arange(n)
        if in_memory and self.which.size > MANY:
            self._refuse_what_does_not_fit(members)
        kinds = {name: entry.kind for name, entry in self.inputs.items()}
        drawn = {n: d.checked(kinds[n], where.at(n)) for n, d in distributions.items()}
        self.values = draw(members, drawn, self.which, where)
        for name, listed in members.values.items():
            self.values[name] = listed.checked(kinds[name], where.at(name))[self.which]
        word, labels = ("label", members.labels) if members.labels else ("number", np.arange(n))
        self.labels = xr.Variable(MEMBER, np.array(labels), {"long_name": f"{word} of the member"})
        self.dropped: list[int] = []
        self._drop_impossible_members(members.impossible == "drop", n)

    def __getstate__(self) -> dict[str, Any]:
        _ = self.layout, self.width  # computed once, before workers receive copies
        results = ("nominal", "descriptions", "run")
        return {name: value for name, value in vars(self).items() if name not in results}

    # --- size and run time -----------------------------------------------------------------------

    def _refuse_what_does_not_fit(self, members: Members) -> None:
        """Raise an error if a few members show that the ensemble takes too much memory or time."""
        first = replace(members, only=tuple(self.which[:ROW].tolist()))
        try:
            sample = Ensemble(self.full_question.replace(members=first), block=1)
        except SceneError:  # the first members cannot exist; the others are checked after drawing
            return
        self.run = sample.run  # for the same questions
        together = ROW if sample.width > 1 else 1
        _ = sample.descriptions  # which do not depend on the number of members
        begun = time.perf_counter()
        answer = sample.make(0)
        days = (time.perf_counter() - begun) / together * self.which.size / 86_400
        arrays = answer.variables.values()
        self._refuse_size(sum(array.nbytes for array in arrays if MEMBER in array.dims))
        if days > LONGEST_IN_MEMORY:
            problem = f"they take about {days:.2g} days, and {LONGEST_IN_MEMORY} is allowed; "
            problem += f"{TO_A_STORE}, which an interrupted run continues"
            raise self.question.error("members", self.which.size, problem)

    def _refuse_size(self, member: int) -> None:
        """Raise an error if results of `member` bytes for each member exceed the memory limit."""
        size = 2 * member * self.which.size  # of all blocks, and of the whole made of them
        if size > LARGEST_IN_MEMORY:
            needed, allowed = f"{size / 1e9:.3g} GB of memory", f"{LARGEST_IN_MEMORY / 1e9:g}"
            problem = f"they need about {needed}, and {allowed} are allowed; {TO_A_STORE}"
            raise self.question.error("members", self.which.size, problem)

    # --- members that cannot exist ---------------------------------------------------------------

    def _drop_impossible_members(self, drop: bool, n: int) -> None:
        """Omit members with impossible inputs if `drop` is true; otherwise raise an error."""
        impossible = dict(self._impossible_members())
        if not impossible:
            return
        indices = sorted(impossible)
        numbers = self.which[indices].tolist()
        if not drop or len(numbers) == len(self.which):
            problem = f"{len(numbers)} of {n} members cannot exist: {impossible[indices[0]]}"
            remedy = "" if drop else "; change the distributions, or set impossible = 'drop'"
            raise self.question.error("members", _list_of_numbers(numbers), problem + remedy)
        possible = np.delete(np.arange(len(self.which)), indices)
        self.which, self.dropped = self.which[possible], numbers
        self.values = {name: values[possible] for name, values in self.values.items()}
        del self.groups

    def _impossible_members(self) -> Iterator[tuple[int, EarthspinError]]:
        """Yield the index and the error of each member whose inputs are impossible."""
        together = self.question.graph.together
        arrays = all(
            entry.labelled
            and (entry.field or (entry.key in together and isinstance(entry.kind, Number)))
            for entry in self.numbers.values()
        )
        for names, indices in self.groups.items():
            try:
                question = self.variant(names)
            except EarthspinError as error:
                yield from ((int(index), error) for index in indices)
                continue
            if arrays:
                with suppress(EarthspinError):
                    self._check_ranges(indices)
                    with_values(question, self.numbers, self._together(indices))
                    continue
            for index in indices.tolist():
                try:
                    with_values(question, self.numbers, self._alone(index))
                except EarthspinError as error:
                    yield index, error

    def _check_ranges(self, indices: IntArray) -> None:
        """Raise an error if a numerical input of a member (no body property) is out of range."""
        for name, entry in self.numbers.items():
            values = self.values[name][indices]
            for extreme in () if entry.field else (values.min(), values.max()):
                entry.kind.read(float(extreme), self.question.where(name))

    # --- groups of members, and runs for the names of each ---------------------------------------

    @cached_property
    def groups(self) -> dict[Names, IntArray]:
        """Indices of members with equal text inputs (such as file names), by the tuple of texts."""
        if not self.named:
            return {(): np.arange(len(self.which))}
        indices: dict[Names, list[int]] = {}
        columns = (self.values[name].tolist() for name in self.named)
        for index, names in enumerate(zip(*columns, strict=True)):
            indices.setdefault(names, []).append(index)
        return {names: np.array(group) for names, group in indices.items()}

    def variant(self, names: Names) -> Question:
        """Return the question with the given values of its text inputs (such as file names).

        Raises
        ------
        EarthspinError
            If the names do not fit the other keys of the question.
        """
        keys = (entry.key for entry in self.named.values())
        return self.question.replace(**dict(zip(keys, names, strict=True)))

    @cached_property
    def run(self) -> Callable[[Names], Run]:
        """Function that returns the cached run for given text inputs and the nominal numbers."""
        return lru_cache(LARGEST_NUMBER_OF_RUNS)(lambda names: Run(self.variant(names)))

    @property
    def nominal_run(self) -> Run:
        """Run for nominal numbers; text inputs (such as files) are those of the first member."""
        return self.run(next(iter(self.groups)))

    @cached_property
    def nominal(self) -> xr.Dataset:
        """Answer for nominal numbers; text inputs (such as files) are those of the first member."""
        return self.nominal_run.answer()

    @cached_property
    def descriptions(self) -> dict[str, dict[Names, Mapping[str, Any]]]:
        """Attributes of the result and its variables, and data sources, by set of text inputs."""
        descriptions: dict[str, dict[Names, Mapping[str, Any]]] = {}
        for names in self.groups:
            run = self.run(names)
            answer = run.answer()
            described = {str(name): array.attrs for name, array in answer.variables.items()}
            described[_WHOLE] = answer.attrs
            described[_SOURCES] = run.provenance(run.graph.ends)
            for name, attributes in described.items():
                descriptions.setdefault(name, {})[names] = attributes
        return descriptions

    # --- work of `blocks` ------------------------------------------------------------------------

    @property
    def what(self) -> str:
        """Name of the ensemble, shown in the progress bar."""
        return f"{self.question.word} members"

    @cached_property
    def width(self) -> int:
        """Number of members that are computed together as arrays; 1 if each is computed alone."""
        graph = self.question.graph
        widest = BLOCK_BYTES * 4 // (self.nominal.nbytes * ROW) * ROW
        entries = self.numbers.values()
        if not all(entry.key in graph.together and entry.labelled for entry in entries):
            return 1
        # without numbers, one answer for each combination of names is computed
        return (min(widest, graph.widest) if self.numbers else widest) or 1

    @cached_property
    def layout(self) -> blocks.Layout:
        """Division of the ensemble into blocks of members."""
        length = self._length
        if length is None:
            fits = max(1, BLOCK_BYTES // self.nominal.nbytes)
            rows = max(ROW, min(fits, LONGEST_BLOCK) // ROW * ROW)
            length = rows if self.width > 1 else min(fits, SEPARATE_BLOCK)
        return blocks.Layout(MEMBER, len(self.which), min(length, len(self.which)))

    @cached_property
    def request(self) -> Mapping[str, str]:
        """Texts that identify the run: question, software versions and checksums of files."""
        sources = {
            f"{name} of {', '.join(names)}" if names else name: source
            for names, provenance in self.descriptions[_SOURCES].items()
            for name, source in provenance.items()
        }
        return blocks.request_of(self.full_question, sources)

    def hold(self, client: object = None) -> xr.Dataset:
        """Compute the ensemble and return it in memory.

        Raises
        ------
        SceneError
            If the result is too large for memory.
        """
        if self.which.size <= MANY:  # more are estimated before they are drawn
            self._refuse_size(self.nominal.nbytes)
        return blocks.hold(self, client=client)

    def _with_attributes(self, block: xr.Dataset) -> xr.Dataset:
        """Return the first block with the attributes that describe the whole ensemble.

        Texts that differ between names are listed with the names.
        """
        block = block.assign_attrs(_joined(self.descriptions[_WHOLE]))
        for name in block.variables:
            attributes = self.descriptions.get(str(name), {})
            if len(attributes) > 1:
                block[name].attrs = _joined(attributes)
        question = self.full_question
        attrs = {"title": question.title, SCENE: scene_text(question)}
        if self.dropped:
            count = f"{len(self.dropped)} that cannot exist: {_list_of_numbers(self.dropped)}"
            attrs["members_dropped"] = count
        return block.assign_attrs(attrs)

    def make(self, number: int) -> xr.Dataset:
        """Compute and return one block of members, by block number."""
        first, last = self.layout.bounds(number)
        pieces: list[tuple[IntArray, xr.Dataset]] = []
        for names, group in self.groups.items():
            begin, end = np.searchsorted(group, (first, last)).tolist()
            for start in range(begin, end, self.width):
                pieces += self._pieces(names, group[start : min(start + self.width, end)])
        block = _concatenated([answer for _, answer in pieces])
        order = np.argsort(np.concatenate([indices for indices, _ in pieces]))
        if (np.diff(order) != 1).any():
            block = block.isel({MEMBER: order} if MEMBER in block.dims else {})
        block = texts_as_labels(block).assign_coords(self._labels(slice(first, last), block))
        return block if number else self._with_attributes(block)

    # --- members of a block ----------------------------------------------------------------------

    def _pieces(self, names: Names, indices: IntArray) -> list[tuple[IntArray, xr.Dataset]]:
        """Compute members with equal text inputs; return pairs of member indices and answer."""
        if self.width > 1:
            with suppress(ApartError):
                filled = np.pad(indices, (0, -indices.size % ROW), mode="edge")
                answer = self._answer(names, self._together(filled), indices)
                if MEMBER in answer.dims:
                    answer = answer.isel({MEMBER: slice(indices.size)})
                return [(indices, _along_all_members(answer, indices.size) if names else answer)]
        return [
            (index, _along_all_members(self._answer(names, self._alone(index[0]), index), 1))
            for index in indices[:, np.newaxis]
        ]

    def _together(self, indices: IntArray) -> dict[str, xr.DataArray]:
        """Values of the numerical inputs for several members, as arrays along `member`."""
        return {name: along_members(self.values[name][indices]) for name in self.numbers}

    def _alone(self, index: int) -> dict[str, Any]:
        """Values of the numerical inputs for one member."""
        values = {name: self.values[name][index] for name in self.numbers}
        return {name: value if np.ndim(value) else value.item() for name, value in values.items()}

    def _answer(self, names: Names, values: Mapping[str, Any], indices: IntArray) -> xr.Dataset:
        """Compute the answer for one member, or for several members with equal text inputs."""
        which = _list_of_numbers(self.which[indices].tolist())
        run = self.run(names)
        try:  # only what depends on the values is computed again
            answer = run.again(with_values(run.question, self.numbers, values)).numbers()
        except EarthspinError as error:
            error.args = (f"member {which}: {error}",)
            raise
        for name, label in self.nominal.drop_vars(answer.data_vars).coords.items():
            if name not in answer.coords or not label.variable.equals(answer[name].variable):
                problem = f"member {which} has other labels along '{name}'"
                raise self.question.error("members", list(self.inputs), problem)
        return answer

    def _labels(self, which: slice, block: xr.Dataset) -> dict[str, Any]:
        """Make the coordinates along `member`: member numbers and input values.

        An input with the name of a result, such as theta, is labelled ``<name>_given``.
        """
        labels = dict[str, Any]()
        labels[MEMBER] = self.labels[self.which[which]]
        for name, entry in self.inputs.items():
            values, label = self.values[name][which], name.replace(".", "_")
            dims = (MEMBER, *(f"{label}_{k}" for k in range(values.ndim - 1)))
            units = {} if entry.named else {"units": str(entry.kind.unit) or "1"}
            attrs = {"long_name": f"{name} of the member", **units, "input": name}
            labels[f"{label}_given" if label in block.variables else label] = (dims, values, attrs)
        return labels


def _list_of_numbers(numbers: list[int]) -> str:
    """Write member numbers as text; list at most `LISTED`, and count the rest."""
    more = f" and {len(numbers) - LISTED} more" if len(numbers) > LISTED else ""
    return f"{', '.join(map(str, numbers[:LISTED]))}{more}"


def _along_all_members(answer: xr.Dataset, count: int) -> xr.Dataset:
    """Add the dimension `member`, of length `count`, to numbers and dates without it."""
    repeated = {
        name: variable.expand_dims({MEMBER: count})
        for name, variable in answer.data_vars.items()
        if variable.dtype.kind in "fiubM" and MEMBER not in variable.dims
    }
    return answer.assign(repeated)


def _concatenated(pieces: list[xr.Dataset]) -> xr.Dataset:
    """Join Datasets, each for some successive members, into one Dataset along `member`."""
    variables: dict[Any, Any] = {}
    for name, variable in pieces[0].data_vars.items():
        variables[name] = variable.variable
        if MEMBER in variable.dims:
            parts = [piece[name].variable.transpose(MEMBER, ...) for piece in pieces]
            values = np.concatenate([part.values for part in parts])
            variables[name] = xr.Variable(parts[0].dims, values, parts[0].attrs)
    return xr.Dataset(variables, pieces[0].coords)


def _joined(attributes: Mapping[Names, Mapping[str, Any]]) -> dict[str, Any]:
    """Combine the attributes of all groups of members: keep equal values, list differing texts.

    Other differing attributes are dropped.
    """
    joined: dict[str, Any] = {}
    for name in dict.fromkeys(name for entry in attributes.values() for name in entry):
        values = {names: entry[name] for names, entry in attributes.items() if name in entry}
        if len(values) == len(attributes) and len(set(map(repr, values.values()))) == 1:
            joined[name] = next(iter(values.values()))
        elif all(isinstance(value, str) for value in values.values()):
            parts = (f"{', '.join(names)}: {value}" for names, value in values.items())
            joined[name] = "; ".join(parts)
    return joined
