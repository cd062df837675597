"""The questions of an ensemble whose members differ in words: one for each that is chosen.

Another orbit, kernel or model is another question, not another number in one. Members with the same
words share theirs, whose parts that no number of a member touches run once.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from earthspin.engine.question import Question
from earthspin.engine.run import Rerun

if TYPE_CHECKING:
    import xarray as xr

#: What is chosen, in the order of the keys; empty if nothing is.
Words = tuple[str, ...]
#: Questions whose parts are kept at a time.
KEPT = 16
#: Names in a description, beside those of variables: the attributes of the whole, and the versions
#: and checksums of files.
_WHOLE, _SOURCES = "/", "/sources"


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
        self._descriptions: dict[Words, dict[str, Mapping[str, Any]]] = {}

    def question(self, words: Words) -> Question:
        """Return the question with these words.

        Raises
        ------
        EarthspinError
            If they do not go with its other keys.
        """
        if not words:
            return self._question
        return self._question.replace(**dict(zip(self._keys, words, strict=True)))

    def __getitem__(self, words: Words) -> Rerun:
        """Return the question with these words, its parts that no number touches having run."""
        if words not in self._kept:
            self._kept[words] = Rerun(self.question(words), self._moving)
            if len(self._kept) > KEPT:
                self._kept.popitem(last=False)
        self._kept.move_to_end(words)
        return self._kept[words]

    def nominal(self, words: Words) -> xr.Dataset:
        """Return its answer, without members."""
        run = self[words]()
        answer = run.answer()
        self._descriptions[words] = {
            _WHOLE: answer.attrs,
            _SOURCES: run.provenance,
            **{str(name): array.attrs for name, array in answer.variables.items()},
        }
        return answer

    def _attributes(self, every: Iterable[Words], name: str) -> dict[Words, Mapping[str, Any]]:
        """Attributes of the whole or of a variable by words, where the answer has it."""
        for words in every:
            if words not in self._descriptions:
                self.nominal(words)
        return {
            words: self._descriptions[words][name]
            for words in every
            if name in self._descriptions[words]
        }

    def provenance(self, every: Iterable[Words]) -> dict[str, str]:
        """Sources of the numbers of each, by name and words."""
        return {
            f"{name} of {', '.join(words)}" if words else name: source
            for words, sources in self._attributes(every, _SOURCES).items()
            for name, source in sources.items()
        }

    def describe(self, answer: xr.Dataset, every: Iterable[Words]) -> xr.Dataset:
        """Give an answer the attributes of all; where they differ, each with its words."""
        described = answer.assign_attrs(_joined(self._attributes(every, _WHOLE)))
        for name in described.variables:
            attributes = self._attributes(every, str(name))
            if len(attributes) > 1:
                described[name].attrs = _joined(attributes)
        return described


def _joined(attributes: Mapping[Words, Mapping[str, Any]]) -> dict[str, Any]:
    """Attributes that all share; of words that differ all, and of numbers that do none."""
    joined: dict[str, Any] = {}
    for name in dict.fromkeys(name for entry in attributes.values() for name in entry):
        values = {words: entry[name] for words, entry in attributes.items() if name in entry}
        if len(values) == len(attributes) and len(set(map(repr, values.values()))) == 1:
            joined[name] = next(iter(values.values()))
        elif all(isinstance(value, str) for value in values.values()):
            parts = (f"{', '.join(words)}: {value}" for words, value in values.items())
            joined[name] = "; ".join(parts)
    return joined
