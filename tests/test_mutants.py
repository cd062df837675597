"""The sampler of random changes, on a package of two functions, and its list of exceptions."""

import tomllib
from pathlib import Path

import pytest

from tests.mutants.__main__ import EQUIVALENT, ROOT, interval, main
from tests.mutants.changes import SHARES, draw

LAW = '''"""The law of 1638."""


def fallen(time: float) -> float:
    """Return 1 for 1."""
    if time is None:
        raise ValueError(f"{1 + 1} times")
    return -time


def fallen_error(rounding: float) -> float:
    return rounding


def words(number: float) -> str:
    return str(2 * number)
'''
TEST = """from earthspin.fall.law import fallen, fallen_error

def test_fallen(): assert fallen(3.0) == -3.0
def test_error(): assert fallen_error(0.1) > 0
"""
SETTINGS = "[tool.coverage.run]\nrelative_files = true\n"
MEANINGLESS = """[[equivalent]]
file = "earthspin/fall/law.py"
line = "if time is None:"
change = "time is None -> time is not None"
reason = "for this test"
"""


@pytest.mark.slow
def test_changes_that_no_test_notices_are_shown(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = {"earthspin/__init__.py": "", "earthspin/fall/law.py": LAW, "tests/test_law.py": TEST}
    files |= {EQUIVALENT: MEANINGLESS, "pyproject.toml": SETTINGS}
    project, out = tmp_path / "project", tmp_path / "out.diff"
    for name, text in files.items():
        (project / name).parent.mkdir(parents=True, exist_ok=True)
        (project / name).write_text(text, encoding="utf-8")
    main(["9", "1", "fall", "--jobs", "2", "--out", str(out)], project, tmp_path / "cache")
    printed = capsys.readouterr().out
    assert "1 changes mean nothing" in printed
    assert "1 of 2 noticed; 95 % interval 9.5% to 90.5%" in printed
    assert printed.count(": tests/test_law.py::test_fallen\n") == 1
    assert out.read_text(encoding="utf-8").startswith(
        "# earthspin/fall/law.py:12 (claimed error)\n"
    )
    assert "-    return rounding\n" in out.read_text(encoding="utf-8")
    assert {n: (project / n).read_text(encoding="utf-8") for n in files} == files


def test_the_same_seed_draws_the_same_changes() -> None:
    files = [ROOT / "earthspin" / "torque" / name for name in ("rates.py", "average.py")]
    first, again, other = (draw(ROOT, files, 120, seed) for seed in (7, 7, 8))
    assert first == again != other
    assert {change.kind for change in first} == set(SHARES)


def test_meaningless_changes_are_of_lines_that_exist() -> None:
    rows = tomllib.loads((ROOT / EQUIVALENT).read_text(encoding="utf-8"))["equivalent"]
    for row in rows:
        assert row["line"] in (ROOT / row["file"]).read_text(encoding="utf-8")
        assert row["reason"]


def test_interval_solves_its_equation() -> None:
    """Wilson's limits p are those from which the share is 1.96 deviations away."""
    for part, count in ((0, 10), (3, 4), (61, 61), (38, 61)):
        for limit in interval(part, count):
            deviation = part - count * limit
            expected = 1.959964**2 * count * limit * (1 - limit)
            assert deviation**2 == pytest.approx(expected, rel=1e-9, abs=1e-9)
