"""What stands written on figures: every label names its unit in one way, and no words collide."""

import re
from collections.abc import Iterator
from functools import cache

import pytest
from matplotlib.dates import DateLocator
from matplotlib.figure import Figure

from earthspin.views.rendering import drawings_for
from tests import shipped

SCENES = ("precession", "torque", "pole", "iau", "wobble", "polar-motion", "free-rotor", "top-loop")

#: A quantity and, in brackets at the end, its unit; what is a ratio by its own words needs none.
LABEL = re.compile(
    r"[^()]+(\([^()]+\)[^()]+)?\s\([^()]+\)|.*\brelative error\b.*|amplitude\b.*\bover\b.*",
    re.DOTALL,
)


@cache
def figures(scene: str) -> list[Figure]:
    return [drawing.figure for drawing in drawings_for(shipped.tree(scene))]


def labels(figure: Figure) -> Iterator[str]:
    """Labels of all axes with numbers, those at the right, above and of colours among them."""
    for ax in figure.findobj(lambda artist: hasattr(artist, "get_xticklabels")):
        for axis in (ax.xaxis, ax.yaxis):
            texts = [tick.get_text() for tick in axis.get_ticklabels() if tick.get_visible()]
            numbers = [text for text in texts if re.fullmatch(r"[−\-\d.]+|\$.*\d.*\$", text)]
            if numbers and not isinstance(axis.get_major_locator(), DateLocator):
                yield axis.get_label_text()


@pytest.mark.slow
@pytest.mark.parametrize("scene", SCENES)
def test_every_label_is_a_quantity_and_its_unit_in_brackets(scene: str) -> None:
    for figure in figures(scene):
        figure.draw_without_rendering()
        for label in labels(figure):
            assert LABEL.fullmatch(label), label
