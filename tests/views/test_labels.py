"""What stands written on figures: every label names its unit in one way, and no words collide."""

import re
from collections.abc import Iterator
from functools import cache
from itertools import combinations

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.dates import DateLocator
from matplotlib.figure import Figure
from matplotlib.text import Annotation, Text
from matplotlib.transforms import Bbox

from earthspin.views.drawing import empty, style
from earthspin.views.pole import plot_pole_residuals
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


@pytest.mark.parametrize("scene", SCENES)
def test_every_label_is_a_quantity_and_its_unit_in_brackets(scene: str) -> None:
    for figure in figures(scene):
        figure.draw_without_rendering()
        for label in labels(figure):
            assert LABEL.fullmatch(label), label


def words(figure: Figure) -> Iterator[tuple[str, Bbox]]:
    """Notes, titles and legends, and where they lie."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    renderer = canvas.get_renderer()
    ticks = {
        label for ax in figure.axes for label in (*ax.get_xticklabels(), *ax.get_yticklabels())
    }
    for text in figure.findobj(Text):
        if text in ticks or not text.get_visible() or not text.get_text().strip():
            continue
        if isinstance(text, Annotation):
            ax = text.axes
            assert ax is not None
            if not ax.bbox.contains(*ax.transData.transform(text.xy)):
                continue  # it is not drawn
            yield text.get_text(), Text.get_window_extent(text, renderer)
        elif not text.get_text().strip("−0123456789."):
            continue  # a tick beyond the limits
        else:
            yield text.get_text(), text.get_window_extent(renderer)


def collisions(figure: Figure) -> list[tuple[str, str]]:
    """Pairs of words that lie over one another."""
    return [
        (one, other)
        for (one, a), (other, b) in combinations(words(figure), 2)
        if a.padded(-0.5).overlaps(b.padded(-0.5))
    ]


@pytest.mark.parametrize("width", [5.5, 6.4, 8.0])
def test_words_above_the_residuals_keep_apart(width: float) -> None:
    with style():
        ax = plot_pole_residuals(shipped.tree("iau"), ax=empty(width, 3).add_subplot())
    assert collisions(ax.figure) == []
