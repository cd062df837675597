"""The planted errors as data: what is replaced by what, and where it should be noticed."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
CATALOGUE = Path(__file__).with_name("mutants.toml")


@dataclass(frozen=True)
class Mutant:
    """One planted error.

    Attributes
    ----------
    name : str
        What is wrong, in a few words.
    kind : str
        ``sign``, ``swap``, ``factor``, ``power``, ``frame``, ``unit``, ``time``, ``function``,
        ``term``, ``index``, ``guard`` or ``error`` (of a claimed error).
    file : str
        Of the package, from the root of the repository.
    old, new : str
        Exact text, which stands once in the file, and what takes its place.
    tests : tuple of str
        Files of the suite that should notice, the likeliest first.
    """

    name: str
    kind: str
    file: str
    old: str
    new: str
    tests: tuple[str, ...]

    def planted_in(self, text: str) -> str:
        """Text of the file with the error in it.

        Raises
        ------
        ValueError
            If what is to be replaced does not stand there exactly once.
        """
        count = text.count(self.old)
        if count != 1:
            raise ValueError(f"mutant '{self.name}': {self.old!r} stands {count} times")
        return text.replace(self.old, self.new)


def load() -> list[Mutant]:
    """Read the catalogue."""
    rows = tomllib.loads(CATALOGUE.read_text(encoding="utf-8"))["mutant"]
    return [Mutant(**(row | {"tests": tuple(row["tests"])})) for row in rows]
