"""Names of bodies that mean something to a reader: each reader shows them as they are."""

import io
import json
import re
import warnings
from html.parser import HTMLParser
from pathlib import Path

import pandas as pd
import pytest
import xarray as xr

import earthspin
from earthspin.cli import main
from earthspin.views import rendering

NAMES = (
    r"$\frac{a}{$", "_moon", "<b>", 'a"b', "[red]", "a;rm", "M\u00f6nd \u6708", "x" * 400, "&amp;",
    "a/b", "</script>", 'id="q" #0072b2 url(#', "{0}%s\\", "trail ",
)  # fmt: skip


def asked(name: str) -> xr.DataTree:
    moon = earthspin.MOON.replace(name=name)
    scene = earthspin.load_scene("torque", {"span": ["2000-01-01", "2000-02-01"]})
    return earthspin.run_tree(scene.replace(perturbers=(earthspin.SUN, moon)), "all")


class Words(HTMLParser):
    """Texts of a page."""

    def __init__(self) -> None:
        super().__init__()
        self.words: list[str] = []

    def handle_data(self, data: str) -> None:
        self.words.append(data)


def squeezed(text: str) -> str:
    return re.sub(r"\s", "", text)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES, ids=lambda name: name[:20])
def test_every_reader_shows_a_name_as_it_is(
    tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    tree = asked(name)
    figure = tree.to_dataset().earthspin.plot()[0]
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing")  # of the font for pictures alone
        figure.savefig(io.BytesIO())
    legend = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert legend[-1].strip("\u200b\u2026").replace(r"\$", "$") == name[:40]
    page = Words()
    page.feed(rendering.scene_page(tree))
    assert name[:40].strip() in {words.strip("\n \u200b\u2026") for words in page.words}
    for kind in ("nc", "zarr"):
        back = earthspin.open(earthspin.write(tree, tmp_path / f"r.{kind}"))
        assert back.load().identical(tree)
        assert earthspin.load_scene(back).perturbers[1].name == name
    scene, table = tmp_path / "scene.toml", tmp_path / "r.csv"
    scene.write_text(tree.attrs["scene"], encoding="utf-8")
    for words in (["plan"], ["run", "--json"], ["run", "--out", str(table)]):
        capsys.readouterr()
        assert main([words[0], str(scene), *words[1:]]) == 0
        out = capsys.readouterr().out
        if "--json" in words:
            assert json.loads(out)["coords"]["perturber"]["data"] == ["sun", name]
    assert squeezed(name[:8]) in squeezed(out)
    assert set(pd.read_csv(table).perturber) == {"sun", name}
