"""The questions of an ensemble whose members differ in words: one for each that is chosen.

Another orbit, kernel or model is another question, not another number in one. Members with the same
words share theirs, whose parts that no number of a member touches run once.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from earthspin.engine.question import Question
from earthspin.engine.run import Rerun

if TYPE_CHECKING:
    import xarray as xr

#: What is chosen, in the order of the keys; empty if nothing is.
Words = tuple[str, ...]
#: Questions whose parts are kept at a time.
KEPT = 16


@dataclass(frozen=True)
class Description:
    """What the answer to one of the questions says beside its numbers.

    Attributes
    ----------
    provenance : mapping of str to str
        Versions, and checksums of the files that were read.
    attributes : mapping of str to str
        Of the whole.
    of_variables : mapping of str to mapping
        Attributes of each variable.
    """

    provenance: Mapping[str, str]
    attributes: Mapping[str, Any]
    of_variables: Mapping[str, Mapping[str, Any]]


class Variants:
    """A question with other words in some of its keys.

    Parameters
    ----------
    question : Question
    keys : tuple of str
        In which words differ.
    moving : iterable of str
        Keys in which numbers differ.
    """

    def __init__(self, question: Question, keys: tuple[str, ...], moving: Iterable[str]) -> None:
        self._question, self._keys, self._moving = question, keys, {*moving}
        self._kept: OrderedDict[Words, Rerun] = OrderedDict()
        self._descriptions: dict[Words, Description] = {}

    def question(self, words: Words) -> Question:
        """The question with these words.

        Raises
        ------
        EarthspinError
            If they do not go with its other keys.
        """
        if not words:
            return self._question
        return self._question.replace(**dict(zip(self._keys, words, strict=True)))

    def __getitem__(self, words: Words) -> Rerun:
        """The question with these words, its parts that no number touches having run."""
        if words not in self._kept:
            self._kept[words] = Rerun(self.question(words), self._moving)
            if len(self._kept) > KEPT:
                self._kept.popitem(last=False)
        self._kept.move_to_end(words)
        return self._kept[words]

    def nominal(self, words: Words) -> xr.Dataset:
        """Its answer, without members."""
        done = self[words]()
        answer = done.answer()
        of_variables = {str(name): array.attrs for name, array in answer.variables.items()}
        self._descriptions[words] = Description(done.provenance, answer.attrs, of_variables)
        return answer

    def _description(self, words: Words) -> Description:
        if words not in self._descriptions:
            self.nominal(words)
        return self._descriptions[words]

    # --- what all of them say ---------------------------------------------------------------------

    def provenance(self, every: Iterable[Words]) -> dict[str, str]:
        """Where the numbers of each come from, by name and words."""
        return {
            f"{name} of {', '.join(words)}" if words else name: source
            for words in every
            for name, source in self._description(words).provenance.items()
        }

    def attributes(self, every: Iterable[Words]) -> dict[str, Any]:
        """Attributes of the whole; where they differ, each with its words."""
        return _joined({words: self._description(words).attributes for words in every})

    def describe(self, answer: xr.Dataset, every: Iterable[Words]) -> xr.Dataset:
        """Give variables the attributes of all; where they differ, each with its words."""
        attributes = {words: self._description(words).of_variables for words in every}
        described = answer.copy()
        for name in described.variables:
            differing = {
                words: variables[str(name)]
                for words, variables in attributes.items()
                if str(name) in variables
            }
            if len(differing) > 1:
                described[name].attrs = _joined(differing)
        return described


def _joined(attributes: Mapping[Words, Mapping[str, Any]]) -> dict[str, Any]:
    """Attributes that all share; of words that differ all, and of numbers that do none."""
    joined: dict[str, Any] = {}
    for name in dict.fromkeys(name for entry in attributes.values() for name in entry):
        values = {words: entry[name] for words, entry in attributes.items() if name in entry}
        if len(values) == len(attributes) and len(set(map(repr, values.values()))) == 1:
            joined[name] = next(iter(values.values()))
        elif all(isinstance(value, str) for value in values.values()):
            joined[name] = "; ".join(
                f"{', '.join(words)}: {value}" for words, value in values.items()
            )
    return joined
