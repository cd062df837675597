"""Variants of a question: copies that differ in inputs given by name, such as file names.

Members that differ in the orbit, the kernel or a model belong to different questions. Members with
the same names share one question; parts that do not depend on the numbers of members run once.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from earthspin.engine.question import NEGLECTED, Question
from earthspin.engine.run import Run

if TYPE_CHECKING:
    import xarray as xr

#: What is chosen, in the order of the keys; empty if nothing is.
Names = tuple[str, ...]
#: Questions whose parts are kept at a time.
LARGEST_NUMBER_OF_RUNS = 16
#: Names in a description besides those of variables: the attributes of the whole, and the versions
#: and checksums of files.
_WHOLE, _SOURCES = "/", "/sources"


class Variants:
    """Variants of a question: copies that differ in inputs given by name, such as file names.

    Parameters
    ----------
    question : Question
    keys : tuple of str
        Keys whose names vary.
    """

    def __init__(self, question: Question, keys: tuple[str, ...]) -> None:
        self._question, self._keys = question, keys
        self._runs: OrderedDict[Names, Run] = OrderedDict()
        self._descriptions: dict[Names, dict[str, Mapping[str, Any]]] = {}

    def question(self, names: Names) -> Question:
        """Return the variant of the question with the given names (such as file names) as inputs.

        Raises
        ------
        EarthspinError
            If the names do not fit the other keys of the question.
        """
        if not names:
            return self._question
        return self._question.replace(**dict(zip(self._keys, names, strict=True)))

    def __getitem__(self, names: Names) -> Run:
        """Return the stored `Run` of the variant that has the given names as inputs."""
        if names not in self._runs:
            self._runs[names] = Run(self.question(names))
            if len(self._runs) > LARGEST_NUMBER_OF_RUNS:
                self._runs.popitem(last=False)
        self._runs.move_to_end(names)
        return self._runs[names]

    def nominal(self, names: Names) -> xr.Dataset:
        """Compute the answer of one variant with the question's own numbers."""
        run = self[names]
        answer = run.answer()
        self._descriptions[names] = {
            _WHOLE: answer.attrs,
            _SOURCES: run.provenance([*run.graph.answer, NEGLECTED]),
            **{str(name): array.attrs for name, array in answer.variables.items()},
        }
        return answer

    def _attributes(self, groups: Iterable[Names], name: str) -> dict[Names, Mapping[str, Any]]:
        """Attributes of one variable, or of the whole answer, in each variant of the question."""
        for names in groups:
            if names not in self._descriptions:
                self.nominal(names)
        return {
            names: self._descriptions[names][name]
            for names in groups
            if name in self._descriptions[names]
        }

    def provenance(self, groups: Iterable[Names]) -> dict[str, str]:
        """Software versions and checksums of files behind the results of all variants."""
        return {
            f"{name} of {', '.join(names)}" if names else name: source
            for names, sources in self._attributes(groups, _SOURCES).items()
            for name, source in sources.items()
        }

    def describe(self, answer: xr.Dataset, groups: Iterable[Names]) -> xr.Dataset:
        """Set the attributes of an ensemble to the combined attributes of all variants.

        Texts that differ are listed with the names of the variants.
        """
        described = answer.assign_attrs(_joined(self._attributes(groups, _WHOLE)))
        for name in described.variables:
            attributes = self._attributes(groups, str(name))
            if len(attributes) > 1:
                described[name].attrs = _joined(attributes)
        return described


def _joined(attributes: Mapping[Names, Mapping[str, Any]]) -> dict[str, Any]:
    """Combine the attributes of all variants: keep equal values, and list texts that differ.

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
