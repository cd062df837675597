"""Modules are found as attributes, and loaded only then."""

from tests.processes import printed

PROGRAM = """
import sys
import earthspin
before = set(sys.modules)
print("earthspin.bodies" in before, "earthspin.views" in before)
print(earthspin.bodies.JUPITER.name)
print("matplotlib" in sys.modules)
print("axes.grid" in earthspin.views.drawing.STYLE)
for place in (earthspin, earthspin.views):
    for name in ("nothing", "__nothing__"):
        print(hasattr(place, name))
"""


def test_modules_are_attributes() -> None:
    lines = printed(PROGRAM).split("\n")
    assert lines[:4] == ["False False", "jupiter", "False", "True"]
    assert lines[4:8] == ["False"] * 4
