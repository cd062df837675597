"""A long series as work in blocks: each block is a stretch of its times."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from earthspin._version import __version__, version
from earthspin.engine.part import BLOCK, Block
from earthspin.engine.question import Question
from earthspin.engine.run import Rerun, scene_text
from earthspin.engine.unfinished import Layout

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Series:
    """A question over so many times that they are answered stretch by stretch.

    Attributes
    ----------
    question : Question
        One with a part that takes ``block``.
    size, length : int
        How many times there are, and how many make a block.
    """

    question: Question
    size: int
    length: int

    @property
    def what(self) -> str:
        """What is made, for people."""
        return f"{self.question.word} series"

    @property
    def layout(self) -> Layout:
        """Cut along its times."""
        return Layout("time", self.size, self.length)

    @cached_property
    def _rerun(self) -> Rerun:
        return Rerun(self.question, {BLOCK})

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if name != "_rerun"}

    @cached_property
    def asked(self) -> Mapping[str, str]:
        """The question, the versions and the kernel."""
        return asked_of(self.question, self._rerun.fixed.provenance)

    def first(self) -> xr.Dataset:
        """Answer the first stretch; its attributes are those of the whole."""
        return self.make(0)

    def make(self, number: int) -> xr.Dataset:
        """Answer one stretch."""
        return self._rerun(block=Block(*self.layout.bounds(number))).answer()


def asked_of(question: Question, provenance: Mapping[str, str]) -> dict[str, str]:
    """What is asked and of which versions, by name, for a store that may be gone on with.

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
