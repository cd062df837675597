"""Numbers on the pages are those of the program: a sample, and in a run of its own all.

What stands in `numbers` is found in the text, made again, and compared to half a unit of the last
printed digit, or to what is said there. `make numbers` runs all of it.
"""

from __future__ import annotations

import json
import re
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from tests.docs.numbers import PAGES, STORED
from tests.docs.numbers.sentence import (
    NUMBER,
    ROOT,
    Column,
    Part,
    Sentence,
    Told,
    half_a_unit,
    read,
    unaccounted,
)
from tests.docs.numbers.trust import measured_again, rows_of_stability

MODULES = [import_module(f"tests.docs.numbers.{name}") for name in PAGES]
MEASURED: list[Sentence] = [one for module in MODULES for one in getattr(module, "MEASURED", ())]
TOLD: list[Told | Column | Part] = [
    one for module in MODULES for one in getattr(module, "TOLD", ())
]
#: Values that pages read, by page and name.
VALUES = [
    (name, key)
    for name, module in zip(PAGES, MODULES, strict=True)
    for key in getattr(module, "VALUES", ())
]
#: Pages that compute their numbers when they are built; the first page has those of the README,
#: which are tested there.
COMPUTED = "execution_mode: inline"
FIRST_PAGE = ROOT / "docs" / "index.md"
SAMPLE = [one for one in MEASURED if not one.slow]
#: Pages state what the newest tables and versions give.
pytestmark = pytest.mark.any_version

#: Pages, examples, and scripts of the gallery with the heads of its sections; listings that
#: commands write stand in docs/measured.
WRITTEN = (
    "*.md",
    "course/*.md",
    "howto/*.md",
    "paper/*.md",
    "reference/*.md",
    "tutorials/*.md",
    "examples/*.py",
    "gallery/**/*.py",
    "gallery/**/*.rst",
)
READ = sorted(
    str(path.relative_to(ROOT))
    for kind in WRITTEN
    for path in (ROOT / "docs").glob(kind)
    if path != FIRST_PAGE and COMPUTED not in path.read_text(encoding="utf-8")
)


@pytest.mark.parametrize("sentence", SAMPLE, ids=str)
def test_a_sample_of_each_page(sentence: Sentence) -> None:
    assert not list(sentence.differences())


@pytest.mark.every_number
@pytest.mark.parametrize("sentence", [s for s in MEASURED if s.slow and s.can_be_made], ids=str)
def test_every_number(sentence: Sentence) -> None:
    assert not list(sentence.differences())


@pytest.mark.every_number
@pytest.mark.parametrize(("page", "name"), VALUES)
def test_every_stored_value(page: str, name: str) -> None:
    """Stored values, held to two digits: some are maxima of rounding errors."""
    stored = json.loads(STORED.read_text(encoding="utf-8"))[page][name]
    again = import_module(f"tests.docs.numbers.{page}").VALUES[name]()
    assert np.asarray(stored) == pytest.approx(np.asarray(again), rel=0.01, abs=0)


@pytest.mark.every_number
@pytest.mark.parametrize("row", rows_of_stability(), ids=lambda row: str(row[0]))
def test_every_row_of_the_extreme_cases(row: tuple[str, str]) -> None:
    """Rounding errors differ with the processor, by a factor of three or four."""
    name, printed = row
    again = measured_again(name)
    assert again <= max(4 * float(printed), 1e-14)
    assert again >= float(printed) / 4 or float(printed) < 1e-14


@pytest.mark.parametrize("sentence", [*MEASURED, *TOLD], ids=str)
def test_a_sentence_stands_on_its_page(sentence: Sentence | Told | Column | Part) -> None:
    assert sentence.found().groups()


@pytest.mark.parametrize("page", READ)
def test_every_number_of_a_page_is_accounted_for(page: str) -> None:
    """Those with decimals, a power of ten or a unit; code, formulas apart and sources not."""
    left = unaccounted(page, [*MEASURED, *TOLD])
    assert not left, f"put these into tests/docs/numbers: {left}"


@pytest.mark.parametrize(
    ("told", "value", "half"),
    [
        ("31.349", 31.349, 5e-4),
        ("6.5e-7", 6.5e-7, 5e-9),
        ("146", 146.0, 0.5),
        (r"3\times10^{-11}", 3e-11, 5e-12),
        ("10^{-13}", 1e-13, 5e-14),
        ("−1.32·10⁵", -1.32e5, 500.0),
        ("3·10⁻¹²", 3e-12, 5e-13),
        ("10⁸", 1e8, 5e7),
        ("5,040,431.0", 5040431.0, 0.05),
    ],
)
def test_numbers_as_pages_write_them(told: str, value: float, half: float) -> None:
    assert re.fullmatch(NUMBER, told)
    assert read(told) == pytest.approx(value, rel=1e-15, abs=0)
    assert half_a_unit(told) == pytest.approx(half, rel=1e-12, abs=0)


def test_what_a_page_and_a_script_say_in_their_own_words(tmp_path: Path) -> None:
    page, script = tmp_path / "page.md", tmp_path / "plot_script.py"
    page.write_text(
        "---\nformat: 1.5\n---\n\nIt is $p = 16$ arcsec, $10^{-9}$ of it, 10⁻⁶ or 3·10⁻⁷, in 81 "
        "thousand years (I.8.7, of 2026-01-01).\n\n$$ a = 2.5 $$\n\n"
        "```{code-cell} ipython3\nx = 3.5  # of 4.5 km\ny = '# 5.5', \"it's # 6.5\"\n```\n\n"
        "```toml\nz = 7.5  # of 8.5\n```\n",
        encoding="utf-8",
    )
    script.write_text(
        'r"""\nTitle\n=====\n\nA turn takes 7 days, ``8.5`` of them (I.8.7).\n"""\n\n'
        'x, words = 1.5, """2.5"""  # 9.5 kg\n',
        encoding="utf-8",
    )
    told = ["16$ arcsec", "10^{-9}", "10⁻⁶", "3·10⁻⁷", "81 thousand years", "4.5 km"]
    assert unaccounted(str(page), []) == told
    assert unaccounted(str(script), []) == ["7 days", "9.5 kg"]


@pytest.mark.parametrize("name", ["time", "family"])
def test_a_column_is_that_column_alone(name: str) -> None:
    header = "| family | cases | worst error | time |"
    cells = Column("docs/rotors.md", header, name, "").found().groups()
    assert len(cells) > 20
    assert ("spheroid, oblate" in cells[0]) == (name == "family")
    assert not any(cell.strip() == "600" for cell in cells)
    with pytest.raises(AssertionError, match="no one column 'place'"):
        Column("docs/rotors.md", header, "place", "").found()
    with pytest.raises(AssertionError, match="has no table"):
        Column("docs/rotors.md", f"{header} place |", name, "").found()


def test_a_number_that_does_not_hold_is_told() -> None:
    one = Sentence("docs/wobble.md", "H$ itself comes from precession.{}", lambda: 1.0)
    with pytest.raises(AssertionError, match="stands 0 times"):
        one.found()
    wrong = Sentence("docs/wobble.md", "one gets $1/H$ = {}.", lambda: 305.4)
    assert list(wrong.differences()) == [f"{wrong}: 305.5 is printed, 305.4 is made"]
