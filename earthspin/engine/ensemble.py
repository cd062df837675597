"""A question asked for many members: drawn, checked, made in blocks, laid along `member`.

A question whose physics is arrays through and through says so (`made_of`, `together`); its members
are computed side by side, and every other question member by member. Side by side, members stand in
rows of `ROW`, each at the place of its number: whatever adds up products by the row (a BLAS) then
rounds them alike, however many members there are, and a member is the same bits alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from earthspin.engine import loop
from earthspin.engine import run as running
from earthspin.engine.inputs import (
    along_members,
    changed,
    inputs_of,
    one_member,
    published,
    with_bodies,
)
from earthspin.engine.members import MEMBER, Members, count_of, draw
from earthspin.engine.question import Question
from earthspin.engine.run import SCENE, Again, scene_text
from earthspin.engine.series import asked_of
from earthspin.engine.unfinished import Layout
from earthspin.errors import ApartError, EarthspinError

if TYPE_CHECKING:
    import xarray as xr

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
        Of every member that is made.
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
        distributions = dict(published(self.question)) if members.published else {}
        distributions |= members.distributions
        self.inputs = inputs_of(self.question, [*distributions, *members.values], where)
        if not self.inputs:
            words = "no body of this question has a published uncertainty; say what differs"
            raise where.error(None, words)
        n = count_of(members, distributions, where)
        self.which = np.array(members.only or range(n))
        numbers = {
            name: of.values(self.inputs[name].kind, where.at(name))
            for name, of in distributions.items()
        }
        self.values = draw(members, distributions, numbers, self.which, where)
        self.values |= {name: of[self.which] for name, of in members.values.items()}
        self.dropped: list[int] = []
        self._leave_out_the_impossible(members.impossible == "drop", n)
        self._length = block

    def __getstate__(self) -> dict[str, Any]:
        _ = self.layout, self.width  # known before it is sent
        return {name: of for name, of in vars(self).items() if name not in ("again", "nominal")}

    # --- what there is to do ---------------------------------------------------------------------

    @property
    def what(self) -> str:
        """What is made, for people."""
        return f"{self.question.word} members"

    @cached_property
    def again(self) -> Again:
        """The question, whose parts that no input touches run once."""
        return Again(self.question, {one.key for one in self.inputs.values()})

    @cached_property
    def nominal(self) -> xr.Dataset:
        """The question as it is, without members."""
        return self.again.answer(self.question)

    @cached_property
    def width(self) -> int:
        """How many members are computed side by side; 1 if one by one."""
        together = self.question.graph.together
        fit = all(one.key in together and one.labelled for one in self.inputs.values())
        if not fit or getattr(self.question, "accuracy", None) is not None:
            return 1  # what is chosen for an accuracy is chosen for each alone
        rows = BLOCK_BYTES * 4 // (self.nominal.nbytes * ROW)
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
        """The question with its members, the versions and the kernel."""
        return asked_of(self.asked_question, self.again)

    def plan_data(self) -> xr.Dataset:
        """The plan of one member, as data."""
        return running.plan_data(self.again(self.question).plan)

    def hold(self, client: object = None) -> xr.Dataset:
        """Make it in memory.

        Raises
        ------
        SceneError
            If it does not fit.
        """
        size = self.nominal.nbytes * self.layout.size
        if size > LARGEST_IN_MEMORY:
            words = f"they take about {size / 1e9:.3g} GB; write them to a store: give a path"
            raise self.question.error("members", self.layout.size, words)
        return loop.hold(self, client=client)

    def write(self, path: str | Path, client: object = None) -> Path:
        """Make it in a store, or go on with one."""
        return loop.write(self, path, client=client)

    # --- the members -----------------------------------------------------------------------------

    def _leave_out_the_impossible(self, drop: bool, n: int) -> None:
        """Refuse members that cannot exist, or leave them out; say which and why."""
        wrong = dict(self._impossible())
        if not wrong:
            return
        numbers = [int(self.which[place]) for place in wrong]
        named = _named(numbers)
        if not drop or len(numbers) == len(self.which):
            words = f"of {n} these cannot be: {next(iter(wrong.values()))}"
            remedy = "" if drop else "; change the distributions, or set impossible = 'drop'"
            raise self.question.error("members", named, words + remedy)
        kept = np.delete(np.arange(len(self.which)), list(wrong))
        self.which, self.dropped = self.which[kept], numbers
        self.values = {name: of[kept] for name, of in self.values.items()}

    def _impossible(self) -> Iterator[tuple[int, EarthspinError]]:
        """Places of members that cannot exist, and why; at once where arrays tell."""
        at_once = all(one.field and one.labelled for one in self.inputs.values())
        if at_once:
            try:
                together = along_members(self.values, slice(None))
                with_bodies(self.question, self.inputs, together)
                return
            except EarthspinError:
                pass
        make = with_bodies if at_once else changed
        for place in range(len(self.which)):
            try:
                make(self.question, self.inputs, one_member(self.values, place))
            except EarthspinError as error:
                yield place, error

    # --- blocks ----------------------------------------------------------------------------------

    def first(self) -> xr.Dataset:
        """Block 0, with the attributes of the whole."""
        attributes = self.nominal.attrs | {
            "title": self.asked_question.title,
            SCENE: scene_text(self.asked_question),
        }
        if self.dropped:
            told = f"{len(self.dropped)} that cannot exist: {_named(self.dropped)}"
            attributes["members_dropped"] = told
        return self.make(0).assign_attrs(attributes)

    def make(self, number: int) -> xr.Dataset:
        """Make one block of members."""
        first, last = self.layout.bounds(number)
        one_by_one = (self._single(place) for place in range(first, last))
        pieces = [*one_by_one] if self.width == 1 else [*self._side_by_side(first, last)]
        laid = _laid(pieces)
        return laid.assign_coords(self._labels(slice(first, last), laid))

    def _side_by_side(self, first: int, last: int) -> Iterator[xr.Dataset]:
        """Members in whole rows, and of these the ones that are wanted."""
        for begin in range(first - first % ROW, last, self.width):
            end = min(begin + self.width, -(-last // ROW) * ROW)
            row = np.arange(begin, end)
            values = along_members(self.values, np.clip(row, first, last - 1))
            wanted = slice(max(first - begin, 0), min(last, end) - begin)
            try:
                made = self._numbers(values, f"{max(begin, first)} to {min(end, last) - 1}")
            except ApartError:
                yield from map(self._single, range(max(begin, first), min(end, last)))
            else:
                yield made.isel({MEMBER: wanted} if MEMBER in made.dims else {})

    def _single(self, place: int) -> xr.Dataset:
        made = self._numbers(one_member(self.values, place), str(self.which[place]))
        for name, label in self.nominal.coords.items():
            if name not in made.coords or not label.equals(made.coords[name]):
                words = f"member {self.which[place]} has other labels along '{name}'"
                raise self.question.error("members", list(self.inputs), words)
        numbers = [name for name, of in made.data_vars.items() if of.dtype.kind in "fiubM"]
        return made.assign({name: made[name].expand_dims(MEMBER) for name in numbers})

    def _numbers(self, values: Mapping[str, Any], which: str) -> xr.Dataset:
        try:
            return self.again.numbers(changed(self.question, self.inputs, values))
        except EarthspinError as error:
            error.args = (f"member {which}: {error}",)
            raise

    def _labels(self, which: slice, laid: xr.Dataset) -> dict[str, Any]:
        """Numbers of members, and their inputs; of what moves, as theta, the one that is given."""
        labels: dict[str, Any] = {
            MEMBER: (MEMBER, self.which[which], {"long_name": "number of the member"})
        }
        for name, one in self.inputs.items():
            values = self.values[name][which]
            dims = (MEMBER, *(f"{one.label}_{k}" for k in range(values.ndim - 1)))
            attrs = {"long_name": f"{name} of the member", "units": one.unit or "1", "input": name}
            label = f"{one.label}_given" if one.label in laid.variables else one.label
            labels[label] = (dims, values, attrs)
        return labels


def _named(numbers: list[int]) -> str:
    """Numbers of members, the first few by name."""
    more = f" and {len(numbers) - NAMED} more" if len(numbers) > NAMED else ""
    return f"{', '.join(map(str, numbers[:NAMED]))}{more}"


def _laid(pieces: list[xr.Dataset]) -> xr.Dataset:
    """Pieces one after the other, `member` first; what no input touches stands once."""
    import xarray as xr

    laid: dict[Any, Any] = {}
    for name, of in pieces[0].data_vars.items():
        laid[name] = of.variable
        if MEMBER in of.dims:
            parts = [piece[name].variable.transpose(MEMBER, ...) for piece in pieces]
            together = np.concatenate([part.values for part in parts])
            laid[name] = xr.Variable(parts[0].dims, together, parts[0].attrs)
    return xr.Dataset(laid, pieces[0].coords)


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
    own: Members | None = question.members
    if members is None and own is None:
        words = "say how many members, or give a file or a table"
        raise question.error("members", None, words)
    counted = isinstance(members, (int, np.integer)) and not isinstance(members, bool)
    if members is None:
        asked = own
    else:
        asked = Members.read(members, question.where("members"))
        if own is not None and counted:
            asked = replace(own, n=asked.n)
    assert asked is not None
    changes = {name: of for name, of in more.items() if of is not None}
    if seed is not None:
        changes["seed"] = Members.read({"n": 1, "seed": seed}, question.where("members")).seed
    return question.replace(members=replace(asked, **changes))
