"""The page of every scene, and the figures of every plain answer."""

import re
from html import unescape
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

import earthspin
from earthspin.scenes import shipped_scenes
from earthspin.views.of_question import drawings_for, figures_of, scene_page, solids_for, tables_for
from earthspin.views.report import write_report
from tests import shipped

FIGURES = {
    "precession": 2, "torque": 1, "pole": 1, "iau": 3, "long-term": 4, "wobble": 1,
    "polar-motion": 3,    "free-rotor": 2, "top-loop": 1, "spheroid": 0,
}  # fmt: skip


@pytest.mark.parametrize("scene", shipped_scenes())
def test_the_page_of_a_scene_has_all_that_there_is(scene: str) -> None:
    tree = shipped.tree(scene)
    page = scene_page(tree)
    headings = [unescape(words) for words in re.findall(r"<h2>(.*?)</h2>", page)]
    assert headings == [
        *(table.title for table in tables_for(tree)),
        *(solid.title for solid in solids_for(tree)),
        *(drawing.title for drawing in drawings_for(tree)),
        "Parts that ran, and parts left out",
    ]
    assert page.count("<svg") == len(drawings_for(tree))
    assert page.count("<canvas aria-label") == len(solids_for(tree))
    assert unescape(page).count(tree.attrs["neglected"]) == 1
    assert page.count('class="cost"') == 1
    assert not re.search(r"(?:src|href)\s*=\s*\"http", page)


@pytest.mark.parametrize(("scene", "count"), FIGURES.items())
def test_a_plain_answer_can_be_drawn(scene: str, count: int) -> None:
    figures = figures_of(shipped.answer(scene))
    assert len(figures) == count
    for figure in figures:
        assert isinstance(figure, Figure)
        figure.draw_without_rendering()


def test_every_question_is_drawn_here() -> None:
    asked = {earthspin.load_scene(scene).word for scene in FIGURES}
    assert asked == {earthspin.load_scene(scene).word for scene in shipped_scenes()}


def test_an_answer_draws_itself_and_a_slice_its_slice() -> None:
    answer = earthspin.run("free-rotor").sel(time=slice(0, 10))
    motion, herpolhode = answer.earthspin.plot()
    assert motion.axes[0].lines[0].get_xdata()[-1] == 10
    assert len(herpolhode.axes[0].lines[-1].get_xdata()) == answer.time.size


def test_several_starts_are_drawn_without_the_herpolhode() -> None:
    starts = [[0.3, 1.0, 0.1], [0.0, 0.0, 1.0]]
    many = earthspin.free_rotor([1.0, 2.0, 3.0], starts, np.linspace(0, 5, 11))
    (motion,) = figures_of(many)
    assert np.array_equal(motion.axes[0].lines[1].get_ydata(), many.omega_body[:, 1].isel(start=0))


def test_what_carries_no_question_is_refused_in_one_line() -> None:
    answer = earthspin.run("torque").mean("time", keep_attrs=False)
    with pytest.raises(earthspin.SceneError, match="does not carry the scene") as caught:
        figures_of(answer)
    assert "\n" not in str(caught.value)


def test_report_gives_the_tree_and_its_files(tmp_path: Path) -> None:
    tree, written = write_report(tmp_path, figures=False)
    assert [path.name for path in written] == ["index.html", "precession.nc"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["index.html", "precession.nc"]
    again = earthspin.open(tmp_path / "precession.nc")
    assert again["standstills"].identical(tree["standstills"])
    assert scene_page(again).count("<h2>") == len(tables_for(tree)) + 2 + 1
