"""The page of every scene, and the figures of every plain answer."""

import re
from functools import cache
from html import unescape
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

import earthspin
from earthspin.scenes import QUESTIONS, shipped_scenes
from earthspin.views import rendering
from earthspin.views.drawing import Drawing
from earthspin.views.page import typeset
from earthspin.views.rendering import (
    ERRORS,
    drawings_for,
    figures_of,
    scene_page,
    solids_for,
    tables_for,
)
from earthspin.views.report import write_report
from tests import shipped


@cache
def drawings_of(scene: str) -> list[Drawing]:
    return drawings_for(shipped.tree(scene))


@pytest.mark.slow
@pytest.mark.parametrize("scene", shipped_scenes())
def test_the_page_of_a_scene_has_all_that_there_is(
    scene: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    tree, drawings = shipped.tree(scene), drawings_of(scene)
    monkeypatch.setattr(rendering, "drawings_for", lambda _: drawings)  # they are drawn once
    page, solids = scene_page(tree), solids_for(tree)
    headings = [unescape(words) for words in re.findall(r"<h2>(.*?)</h2>", page)]
    # a square first figure stands beside the title, where it needs no heading
    beside_the_title = int(any(drawing.square for drawing in drawings[:1]))
    assert headings == [
        *(drawing.title for drawing in drawings[beside_the_title:]),
        *(solid.title for solid in solids),
        *(table.title for table in tables_for(tree)),
        "Parts that ran, and parts left out",
    ]
    assert page.count('<svg class="usual"') == len(drawings)
    assert page.count("<canvas") == len(solids)
    linked = set(re.findall(r'<a href="#(.*?)"', page))
    assert linked <= set(re.findall(r'<(?:section|details) id="(.*?)"', page))
    assert typeset(f"Left out: {tree.attrs['neglected']}.") in page
    assert page.count('class="cost"') == 1
    assert not re.search(r"(?:src|href)\s*=\s*\"http", page)
    # names are the page's own, and figures have words
    names = re.findall(r'\bid="(.*?)"', page)
    assert len(names) == len(set(names))
    for words in re.findall(r"<svg[^>]*>", page):
        assert re.search(r'role="img" aria-label="[^"]{40,}"', words)


def test_the_head_of_the_precession_page_says_of_which_number_it_speaks() -> None:
    tree = shipped.tree("precession")
    page = scene_page(tree)
    known = tree["iau_2006"]
    rate = float(tree.precession_rate[-1]) + float(tree["neglected"].neglected_effect.sum())
    lead = page[page.index('class="lead"') : page.index("<nav")]
    assert f"IAU 2006 has {360 * 3600 / float(known.iau_rate):.3f}" in lead
    # the solar and the combined period and the free wobble first, each with its error
    numbers = re.findall(r"(\d+\.\d+)\(\d", lead)
    periods = [f"{float(tree.precession_period[k]):.3f}" for k in (0, -1)]
    assert numbers == [*periods, "303.62464", "430.9", f"{360 * 3600 / rate:.3f}"]
    mars = scene_page(earthspin.run_tree(earthspin.load_scene("precession", {"body": "mars"})))
    assert "The axis of Mars goes once round" in mars
    for word in ("Polaris", "IAU 2006", "I.8", "of the Earth"):
        assert word not in mars, word


@pytest.mark.parametrize(
    "scene", [*shipped.SCENES.values(), "precession-ensemble", "wobble-ensemble"]
)
def test_a_plain_answer_can_be_drawn(scene: str) -> None:
    """With the sections that its figures need, as they are on its page."""
    figures = figures_of(shipped.tree(scene).to_dataset())
    assert len(figures) == len(drawings_of(scene))
    assert all(isinstance(figure, Figure) for figure in figures)


def test_a_page_names_pages_of_the_documentation_that_there_are() -> None:
    docs = Path(__file__).parents[2] / "docs"
    for name in {question.page for question in QUESTIONS.values()} - {""} | {ERRORS}:
        assert (docs / f"{name}.md").exists()
    page = scene_page(shipped.tree("spheroid").to_dataset())
    assert "docs/rotors.md" in page
    assert f"docs/{ERRORS}.md" in page


def test_an_answer_draws_itself_and_a_slice_its_slice() -> None:
    answer = earthspin.run("free-rotor")
    motion, herpolhode = answer.earthspin.plot()
    x, y = herpolhode.axes[0].lines[-1].get_data()
    turned = np.abs(np.diff(np.unwrap(np.arctan2(y, x))))
    assert np.degrees(turned.max()) < 5
    (motion,) = answer.sel(time=slice(0, 10)).earthspin.plot()
    assert motion.axes[0].lines[0].get_xdata()[-1] == 10


def test_love_numbers_lag_more_at_long_periods() -> None:
    (lag,) = figures_of(earthspin.run("love-numbers"))
    above, below = lag.axes
    assert len(above.lines) == len(below.lines) == 5 + 3  # numbers, and marked periods
    day = np.searchsorted(above.lines[0].get_xdata(), 1.0)
    assert 0 < below.lines[0].get_ydata()[day] < 1


def test_several_starts_are_drawn_without_the_herpolhode() -> None:
    starts = [[0.3, 1.0, 0.1], [0.0, 0.0, 1.0]]
    many = earthspin.free_rotor([1.0, 2.0, 3.0], starts, np.linspace(0, 5, 11))
    (motion,) = figures_of(many)
    for start, ax in enumerate(motion.findobj(lambda artist: hasattr(artist, "get_xticks"))):
        drawn = np.interp(many.time, *ax.lines[1].get_data())
        np.testing.assert_allclose(
            drawn, many.omega_body.isel(start=start)[:, 1], rtol=0, atol=1e-4
        )


def test_what_carries_no_question_is_drawn_from_its_labels() -> None:
    answer = earthspin.run("torque").mean("time", keep_attrs=False)
    (figure,) = answer.earthspin.plot()
    assert [ax.get_ylabel() for ax in figure.axes][:2] == ["right ascension", "declination"]
    with pytest.raises(earthspin.SceneError, match="single numbers"):
        answer.mean().earthspin.plot()


def test_the_report_is_stored_before_it_is_drawn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def cannot_draw(*_: object, **__: object) -> None:
        raise ValueError("no picture")

    monkeypatch.setattr("earthspin.views.report.page_of", cannot_draw)
    with pytest.raises(ValueError, match="no picture"):
        write_report(tmp_path, figures=False)
    assert earthspin.open(tmp_path / "precession.nc")["standstills"].sizes["standstill"] > 0
