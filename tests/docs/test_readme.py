"""The README's numbers and its Python are those of the program."""

import re
from pathlib import Path

import xarray as xr

from earthspin.views.precession import periods
from tests.processes import printed

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_box_of_periods_is_the_one_that_is_printed(precession_tree: xr.DataTree) -> None:
    for row in periods(precession_tree).rows:
        assert " | ".join(row) in README


def test_the_unexplained_rest_is_one_number(precession_tree: xr.DataTree) -> None:
    """Years that remain between our period and that of IAU 2006: 0.019, not 0.020."""
    pattern = r"(0\.0\d+)\s+years.{0,80}unexplained"
    (printed_rest,) = re.findall(pattern, periods(precession_tree).note)
    paper = (ROOT / "docs" / "paper" / "paper.md").read_text(encoding="utf-8")
    texts = [README, paper]
    rests = {rest for text in texts for rest in re.findall(pattern, text, flags=re.DOTALL)}
    assert rests == {printed_rest}


def test_the_eight_lines_print_what_stands_below_them(tmp_path: Path) -> None:
    program, output = block("python", README), block("text", README)
    assert len([line for line in program.splitlines() if line.strip()]) == 8
    assert printed(program, cwd=tmp_path) == output
    assert (tmp_path / "torque.png").read_bytes().startswith(b"\x89PNG")


def block(language: str, page: str) -> str:
    """The one block of code in a language on a page."""
    text, *_ = re.findall(rf"```{language}\n(.*?)```", page, flags=re.DOTALL)
    return str(text)
