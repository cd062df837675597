"""Compute a long time series in blocks of consecutive times."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from earthspin._version import __version__, version
from earthspin.engine.part import BLOCK, Block
from earthspin.engine.question import NEGLECTED, Question, scene_text
from earthspin.engine.run import Run
from earthspin.engine.unfinished import Layout

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Series:
    """A question with so many times that its answer is computed in blocks.

    Attributes
    ----------
    question : Question
        Question with a part that takes ``block``.
    size, length : int
        Number of times in total and in a block.
    """

    question: Question
    size: int
    length: int

    @property
    def what(self) -> str:
        """Name of the series, which the progress bar shows."""
        return f"{self.question.word} series"

    @property
    def layout(self) -> Layout:
        """Division of the series into blocks of consecutive times."""
        return Layout("time", self.size, self.length)

    @cached_property
    def _run(self) -> Run:
        """Run that keeps the results which all blocks share."""
        return Run(self.question, block=self._block(0))

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if name != "_run"}

    def _block(self, number: int) -> Block:
        return Block(*self.layout.bounds(number))

    @cached_property
    def request(self) -> Mapping[str, str]:
        """Texts that identify the run: question, software versions and checksums of files."""
        ends = [*self.question.graph.answer, NEGLECTED]
        return request_of(self.question, self._run.provenance(ends, but=[BLOCK]))

    def first(self) -> xr.Dataset:
        """Compute the first block of times, with the attributes of the whole series."""
        return self.make(0)

    def make(self, number: int) -> xr.Dataset:
        """Compute one block of consecutive times, by its number."""
        return self._run.again(block=self._block(number)).answer()


def request_of(question: Question, provenance: Mapping[str, str]) -> dict[str, str]:
    """Texts that identify a run: the question and versions; an unfinished store must match.

    Parameters
    ----------
    question : Question
    provenance : mapping of str to str
        Further versions, and checksums of the files that are read.
    """
    return {
        "question": scene_text(question),
        "version of earthspin": __version__,
        "version of numpy": version("numpy"),
    } | dict(provenance)
