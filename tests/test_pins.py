"""The pins themselves are held to account, and so are tolerances in the tests."""

import ast
import json
from pathlib import Path

import pytest

from tests.conftest import REFERENCE, load_pins

TOPICS = sorted(path.stem for path in REFERENCE.glob("*.json"))


@pytest.mark.parametrize("topic", TOPICS)
def test_every_pin_has_a_source_and_a_tolerance_that_can_fail(topic: str) -> None:
    rows = json.loads((REFERENCE / f"{topic}.json").read_text())
    assert len({row["name"] for row in rows}) == len(rows)
    for pin in load_pins(topic).values():
        assert pin.source.strip(), pin
        assert 0 < pin.tolerance <= 10 * pin.measured_error, pin


#: Comparisons with tolerances of their own, and the keywords that must be named. Left out, they
#: are wide: rtol = 1e-7 stands beside atol = 1e-15, and 1e-12 is added to what rel = 1e-15 allows.
TOLERANCES = {
    "np.isclose": {"rtol", "atol"},
    "np.allclose": {"rtol", "atol"},
    "np.testing.assert_allclose": {"rtol"},
    "pytest.approx": {"abs"},
}
TESTS = sorted(Path(__file__).parent.rglob("test_*.py"))


@pytest.mark.parametrize("path", TESTS, ids=[p.stem for p in TESTS])
def test_no_comparison_falls_back_on_a_tolerance_that_is_not_named(path: Path) -> None:
    for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(call, ast.Call):
            continue
        named = {keyword.arg for keyword in call.keywords}
        wanted = TOLERANCES.get(ast.unparse(call.func), set())
        assert wanted <= named or None in named, f"line {call.lineno}: {ast.unparse(call)}"
