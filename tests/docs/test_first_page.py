"""The first page: its lines run, print what stands there, and draw a figure."""

import re
from pathlib import Path

from tests.processes import printed

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "index.md").read_text(encoding="utf-8")


def test_the_eight_lines_print_what_stands_below_them(tmp_path: Path) -> None:
    (program,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    (shown,) = re.findall(r"```text\n(.*?)```", PAGE, flags=re.DOTALL)
    assert len([line for line in program.splitlines() if line.strip()]) == 8
    assert printed(program, cwd=tmp_path) == shown
    assert (tmp_path / "torque.png").read_bytes().startswith(b"\x89PNG")


def test_pictures_on_pages_come_from_scripts() -> None:
    for page in DOCS.rglob("*.md"):
        text = page.read_text(encoding="utf-8")
        for picture in re.findall(r"```\{figure\} (\S+)", text):
            found = re.fullmatch(r"auto_gallery/(\w+)/images/sphx_glr_(plot_\w+)_001\.png", picture)
            assert found, f"{page.name}: {picture}"
            assert page.name == "index.md", "elsewhere {gallery-picture} takes the script's caption"
            assert (DOCS / "gallery" / found[1] / f"{found[2]}.py").is_file(), picture
        for script in re.findall(r"```\{gallery-picture\} (\S+)", text):
            assert (DOCS / "gallery" / f"{script}.py").is_file(), script
