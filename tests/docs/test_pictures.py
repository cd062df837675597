"""Pictures on pages come from scripts of the gallery."""

import re
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"


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
