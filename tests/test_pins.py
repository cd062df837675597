"""Tolerances: every pin has one that can fail, and no comparison falls back on a default."""

import ast
import math
from pathlib import Path

from tests.conftest import REFERENCE, load_pins

#: Comparisons with tolerances of their own, and the keywords that must be named. Left out, they
#: are wide: rtol = 1e-7 stands beside atol = 1e-15, and 1e-12 is added to what rel = 1e-15 allows.
TOLERANCES = {
    "np.isclose": {"rtol", "atol"},
    "np.allclose": {"rtol", "atol"},
    "np.testing.assert_allclose": {"rtol"},
    "pytest.approx": {"abs"},
}


def test_every_pin_has_a_source_and_a_tolerance_that_can_fail() -> None:
    for path in REFERENCE.glob("*.json"):
        for pin in load_pins(path.stem).values():
            assert pin.source.strip(), pin
            assert 0 < pin.tolerance < (abs(pin.value) or math.inf), pin


def test_no_comparison_falls_back_on_a_tolerance_that_is_not_named() -> None:
    unnamed = []
    for path in sorted(Path(__file__).parent.rglob("test_*.py")):
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(call, ast.Call):
                named = {keyword.arg for keyword in call.keywords}
                if not (TOLERANCES.get(ast.unparse(call.func), set()) <= named or None in named):
                    unnamed.append(f"{path}:{call.lineno}: {ast.unparse(call)}")
    assert not unnamed
