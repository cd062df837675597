"""The page of rotors and tops, opened in a headless browser."""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from earthspin.views.rendering import scene_page
from earthspin.views.report import gallery, gallery_page
from tests import shipped

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    *("--hide-scrollbars", "--enable-logging=stderr", "--virtual-time-budget=4000"),
)


@pytest.fixture(scope="module")
def browser() -> str:
    if BROWSER is None:
        if os.environ.get("EARTHSPIN_NEEDS_BROWSER"):
            pytest.fail("chromium is needed here and is not installed")
        pytest.skip("chromium is not installed")
    return BROWSER


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "rotors.html"
    path.write_text(gallery_page(), encoding="utf-8")
    return path


def opened(browser: str, page: Path, profile: Path, *words: str) -> tuple[str, str]:
    done = subprocess.run(
        [browser, *FLAGS, f"--user-data-dir={profile}", *words, page.as_uri()],
        capture_output=True,
        text=True,
        timeout=90,
        check=True,
    )
    return done.stdout, done.stderr


@pytest.mark.slow
def test_every_picture_is_painted_and_the_console_is_clean(
    browser: str, page: Path, tmp_path: Path
) -> None:
    html, log = opened(browser, page, tmp_path, "--dump-dom")
    assert html.count('data-painted="yes"') == len(gallery()) == 8
    assert "CONSOLE" not in log, log


def title_on_a_phone(browser: str, folder: Path, page: str, script: str) -> str:
    """Title that a script gives a frame of 390 pixels, in which `page` is the document."""
    frame = folder / "phone.html"
    content = json.dumps(page).replace("<", r"\u003c")
    frame.write_text(
        f"""<!DOCTYPE html><iframe width="390" height="800" frameborder="0"></iframe><script>
        const frame = document.querySelector("iframe");
        frame.onload = () => {{
          const page = frame.contentDocument, wide = page.documentElement.scrollWidth;
          {script}
        }};
        frame.srcdoc = {content};
        </script>""",
        encoding="utf-8",
    )
    html, log = opened(browser, frame, folder, "--dump-dom")
    assert "CONSOLE" not in log, log
    return re.search(r"<title>(.*?)</title>", html, re.DOTALL)[1]


@pytest.mark.slow
@pytest.mark.parametrize("scene", ["precession", "iau"])
def test_nothing_lies_beyond_the_edge_of_a_phone(browser: str, scene: str, tmp_path: Path) -> None:
    """In a frame of 390 pixels, the page is no wider, nor is any of its tables and figures."""
    script = """const beyond = [...page.querySelectorAll("main *, header *")]
        .filter((e) => !e.closest("thead, svg") && e.getBoundingClientRect().right > 390);
        document.title = `${wide} ${beyond.map((e) => e.outerHTML).join("")}`;"""
    page = scene_page(shipped.tree(scene))
    assert title_on_a_phone(browser, tmp_path, page, script) == "390 "


def test_the_page_needs_no_network(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert not re.search(r"(?:src|href)\s*=(?!\"#)", text)
    assert "http" not in text
