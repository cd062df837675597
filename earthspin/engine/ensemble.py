"""A question asked for many members: drawn, checked, made in blocks, laid along `member`.

A question whose physics takes arrays throughout says so (`define_parts`, `together`); its members
are computed side by side, and those of every other question one by one. Side by side, members stand
in rows of `ROW`, each at the place of its number: whatever adds up products by the row (a BLAS)
then rounds them alike, however many members there are, and a member is the same bits alone. Members
that differ in words stand side by side with those of the same words.
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

from earthspin.engine import loop
from earthspin.engine.given import MEMBER
from earthspin.engine.inputs import Input, along_members, changed, inputs_of, one_member, published
from earthspin.engine.members import Members, count_of, draw
from earthspin.engine.plan import SCENE
from earthspin.engine.question import Question
from earthspin.engine.run import plan_data, scene_text
from earthspin.engine.series import asked_of
from earthspin.engine.unfinished import Layout
from earthspin.engine.variants import Variants, Words
from earthspin.errors import ApartError, EarthspinError

if TYPE_CHECKING:
    import xarray as xr

IntArray = NDArray[np.int64]

#: Members that stand in a row.
ROW = 64
#: Bytes that a block should have, and the most members in one.
BLOCK_BYTES, LONGEST_BLOCK = 8_000_000, 16_384
#: The same where members are computed one by one, and a block is what a kill may cost.
ONE_BY_ONE = 16
#: Bytes of an ensemble that is held in memory.
LARGEST_IN_MEMORY = 4_000_000_000
#: Members that a message names.
NAMED = 5


class Ensemble:
    """A question asked for many members, as work in blocks.

    Parameters
    ----------
    question : Question
        With members.
    block : int, optional
        How many make a block; by their size if not given.

    Attributes
    ----------
    inputs : dict of str to Input
        What differs among them.
    values : dict of str to ndarray, shape (n, ...)
        Of every member that is made; text where words differ.
    which : ndarray of int
        Their numbers.
    dropped : list of int
        Numbers of those that cannot exist, where these are left out.

    Raises
    ------
    SceneError
        If nothing differs among the members, or some cannot exist.
    """

    def __init__(self, question: Question, *, block: int | None = None) -> None:
        self.asked_question, self.question = question, question.replace(members=None)
        members = question.members or Members()
        where = question.where("members")
        distributions = published(self.question) if members.published else {}
        distributions |= members.distributions
        self.inputs = inputs_of(self.question, [*distributions, *members.values], where)
        if not self.inputs:
            problem = "no body of this question has a published uncertainty; say what differs"
            raise where.error(None, problem)
        n = count_of(members, distributions, where)
        self.which = np.array(members.only or range(n))
        drawn = {
            name: distribution.checked(self.inputs[name].kind, where.at(name))
            for name, distribution in distributions.items()
        }
        self.values = draw(members, drawn, self.which, where)
        self.values |= {
            name: self.inputs[name].checked(values, where.at(name))[self.which]
            for name, values in members.values.items()
        }
        self.dropped: list[int] = []
        self._leave_out_the_impossible(members.impossible == "drop", n)
        self._length = block

    def __getstate__(self) -> dict[str, Any]:
        _ = self.layout, self.width  # known before it is sent
        return {n: value for n, value in vars(self).items() if n not in ("variants", "nominal")}

    # --- what there is to do ---------------------------------------------------------------------

    @property
    def what(self) -> str:
        """What is made, for people."""
        return f"{self.question.word} members"

    @cached_property
    def numbers(self) -> dict[str, Input]:
        """The inputs that are numbers; the others are words."""
        return {name: entry for name, entry in self.inputs.items() if not entry.named}

    @cached_property
    def variants(self) -> Variants:
        """The question, or one for all the words of a member."""
        keys = tuple(entry.key for entry in self.inputs.values() if entry.named)
        return Variants(self.question, keys, {entry.key for entry in self.numbers.values()})

    def words(self, place: int) -> Words:
        """What is chosen for a member that is not a number."""
        names = (name for name, entry in self.inputs.items() if entry.named)
        return tuple(str(self.values[name][place]) for name in names)

    @cached_property
    def every(self) -> dict[Words, IntArray]:
        """Places of the members of all words that there are, ascending."""
        if len(self.numbers) == len(self.inputs):
            return {(): np.arange(len(self.which))}
        places: dict[Words, list[int]] = {}
        for place in range(len(self.which)):
            places.setdefault(self.words(place), []).append(place)
        return {words: np.array(group) for words, group in places.items()}

    @cached_property
    def nominal(self) -> xr.Dataset:
        """The question as it is, without members; its words are those of the first."""
        return self.variants.nominal(next(iter(self.every)))

    @cached_property
    def width(self) -> int:
        """How many members are computed side by side; 1 if one by one."""
        rows = BLOCK_BYTES * 4 // (self.nominal.nbytes * ROW)
        if not self.numbers:
            return rows * ROW or 1  # nothing is computed but the answer to each of their words
        together = self.question.graph.together
        fit = all(entry.key in together and entry.labelled for entry in self.numbers.values())
        if not fit or getattr(self.question, "accuracy", None) is not None:
            return 1  # what is chosen for an accuracy is chosen for each alone
        return min(rows * ROW, self.question.graph.widest) or 1

    @cached_property
    def layout(self) -> Layout:
        """Cut along its members."""
        length = self._length
        if length is None:
            fits = BLOCK_BYTES // self.nominal.nbytes
            rows = max(1, min(fits, LONGEST_BLOCK) // ROW) * ROW
            length = rows if self.width > 1 else max(1, min(fits, ONE_BY_ONE))
        return Layout(MEMBER, len(self.which), min(length, len(self.which)))

    @cached_property
    def asked(self) -> Mapping[str, str]:
        """The question with its members, the versions, and checksums of what is read."""
        return asked_of(self.asked_question, self.variants.provenance(self.every))

    def plan_data(self) -> xr.Dataset:
        """The plan of one member, as data."""
        return plan_data(self.variants[self.words(0)]().plan)

    def hold(self, client: object = None) -> xr.Dataset:
        """Make it in memory.

        Raises
        ------
        SceneError
            If it does not fit.
        """
        size = self.nominal.nbytes * self.layout.size
        if size > LARGEST_IN_MEMORY:
            problem = f"they take about {size / 1e9:.3g} GB; write them to a store: give a path"
            raise self.question.error("members", self.layout.size, problem)
        return loop.hold(self, client=client)

    def write(self, path: str | Path, client: object = None) -> Path:
        """Make it in a store, or go on with one."""
        return loop.write(self, path, client=client)

    # --- the members -----------------------------------------------------------------------------

    def _leave_out_the_impossible(self, drop: bool, n: int) -> None:
        """Refuse members that cannot exist, or leave them out; say which and why."""
        wrong = dict(sorted(self._impossible(), key=itemgetter(0)))
        if not wrong:
            return
        numbers = [int(self.which[place]) for place in wrong]
        named = _named(numbers)
        if not drop or len(numbers) == len(self.which):
            problem = f"of {n} these cannot be: {next(iter(wrong.values()))}"
            remedy = "" if drop else "; change the distributions, or set impossible = 'drop'"
            raise self.question.error("members", named, problem + remedy)
        possible = np.delete(np.arange(len(self.which)), list(wrong))
        self.which, self.dropped = self.which[possible], numbers
        self.values = {name: values[possible] for name, values in self.values.items()}
        del self.every

    def _impossible(self) -> Iterator[tuple[int, EarthspinError]]:
        """Places of members that cannot exist, and why; at once where arrays tell."""
        at_once = all(entry.field and entry.labelled for entry in self.numbers.values())
        for words, places in self.every.items():
            try:
                question = self.variants.question(words)
            except EarthspinError as error:
                yield from ((int(place), error) for place in places)
                continue
            if at_once:
                with suppress(EarthspinError):
                    changed(question, self.numbers, along_members(self._of_numbers, places))
                    continue
            for place in places.tolist():
                try:
                    changed(question, self.numbers, one_member(self._of_numbers, place))
                except EarthspinError as error:
                    yield place, error

    # --- blocks ----------------------------------------------------------------------------------

    def first(self) -> xr.Dataset:
        """Block 0, with the attributes of the whole."""
        question = self.asked_question
        attributes = {"title": question.title, SCENE: scene_text(question)}
        if self.dropped:
            count = f"{len(self.dropped)} that cannot exist: {_named(self.dropped)}"
            attributes["members_dropped"] = count
        return self.variants.describe(self.make(0), self.every).assign_attrs(attributes)

    def make(self, number: int) -> xr.Dataset:
        """Make one block of members."""
        first, last = self.layout.bounds(number)
        if self.width == 1:
            places = [np.array([place]) for place in range(first, last)]
            pieces = [self._single(place) for place in range(first, last)]
        else:
            places, pieces = map(list, zip(*self._side_by_side(first, last), strict=True))
        block = _laid(pieces)
        order = np.argsort(np.concatenate(places))
        if (np.diff(order) != 1).any():
            block = block.isel({MEMBER: order} if MEMBER in block.dims else {})
        return block.assign_coords(self._labels(slice(first, last), block))

    def _side_by_side(self, first: int, last: int) -> Iterator[tuple[IntArray, xr.Dataset]]:
        """Members in whole rows, and of these the ones that are wanted, by their words."""
        for begin in range(first - first % ROW, last, self.width):
            end = min(begin + self.width, -(-last // ROW) * ROW)
            row = np.arange(begin, end)
            for words, all_places in self.every.items():
                places = all_places[np.searchsorted(all_places, max(begin, first)) :]
                places = places[: np.searchsorted(places, min(end, last))]
                if not places.size:
                    continue
                stand_in = np.where(np.isin(row, places), row, places[0])
                values = along_members(self._of_numbers, stand_in)
                which = _named(self.which[places].tolist())
                try:
                    answer = self._answer(words, values, which)
                except ApartError:
                    yield from ((np.array([place]), self._single(place)) for place in places)
                    continue
                if words:
                    answer = _for_each(answer, len(row))
                if MEMBER in answer.dims:
                    answer = answer.isel({MEMBER: _short(places - begin)})
                yield places, answer

    def _single(self, place: int) -> xr.Dataset:
        values, which = one_member(self._of_numbers, place), str(self.which[place])
        return _for_each(self._answer(self.words(place), values, which), 1)

    def _answer(self, words: Words, values: Mapping[str, Any], which: str) -> xr.Dataset:
        """The numbers of one member, or of several with the same words."""
        try:
            rerun = self.variants[words]
            answer = rerun(changed(rerun.plan.question, self.numbers, values)).numbers()
        except EarthspinError as error:
            error.args = (f"member {which}: {error}",)
            raise
        for name, label in self.nominal.coords.items():
            if name not in answer.coords or not label.equals(answer.coords[name]):
                problem = f"member {which} has other labels along '{name}'"
                raise self.question.error("members", list(self.inputs), problem)
        return answer

    @property
    def _of_numbers(self) -> dict[str, NDArray[Any]]:
        """Values of the inputs that are numbers."""
        return {name: self.values[name] for name in self.numbers}

    def _labels(self, which: slice, block: xr.Dataset) -> dict[str, Any]:
        """Numbers of members, and their inputs; of what moves, as theta, the one that is given."""
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


def _named(numbers: list[int]) -> str:
    """Numbers of members, the first few by name."""
    more = f" and {len(numbers) - NAMED} more" if len(numbers) > NAMED else ""
    return f"{', '.join(map(str, numbers[:NAMED]))}{more}"


def _short(places: IntArray) -> IntArray | slice:
    """Places as a slice where they stand next to one another, which takes no copy."""
    first, last = int(places[0]), int(places[-1])
    return slice(first, last + 1) if last - first + 1 == len(places) else places


def _for_each(answer: xr.Dataset, count: int) -> xr.Dataset:
    """An answer whose every number stands along `member`, that of one for so many."""
    alone = {
        name: variable.expand_dims({MEMBER: count})
        for name, variable in answer.data_vars.items()
        if variable.dtype.kind in "fiubM" and MEMBER not in variable.dims
    }
    return answer.assign(alone)


def _laid(pieces: list[xr.Dataset]) -> xr.Dataset:
    """Pieces one after the other, `member` first; what no input touches stands once."""
    import xarray as xr

    variables: dict[Any, Any] = {}
    for name, variable in pieces[0].data_vars.items():
        variables[name] = variable.variable
        if MEMBER in variable.dims:
            parts = [piece[name].variable.transpose(MEMBER, ...) for piece in pieces]
            values = np.concatenate([part.values for part in parts])
            variables[name] = xr.Variable(parts[0].dims, values, parts[0].attrs)
    return xr.Dataset(variables, pieces[0].coords)


def asked_of_members(
    question: Question, members: object, seed: int | None = None, **more: Any
) -> Question:
    """Put members into a question, in place of its own where they are given.

    Parameters
    ----------
    question : Question
    members : object, optional
        As the key takes them; a number alone changes how many the question has.
    seed : int, optional
    **more
        Fields of `Members` to change.
    """
    own, where = question.members, question.where("members")
    request: Members | None = own if members is None else Members.read(members, where)
    if request is None:
        raise where.error(None, "say how many members, or give a file or a table")
    if own is not None and isinstance(members, (int, np.integer)):
        request = replace(own, n=request.n)
    changes = {name: value for name, value in {"seed": seed, **more}.items() if value is not None}
    checked = Members.read({"n": 1} | changes, where)
    changes = {name: getattr(checked, name) for name in changes}
    return question.replace(members=replace(request, **changes))
