"""The directive `gallery-picture`: a picture of the gallery on a page, with its caption.

The heading and the first paragraph above the code are the caption, so that a caption changes with
what it describes; the picture leads to the script.
"""

from pathlib import Path

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective


def captions(script: Path) -> list[tuple[str, str]]:
    """Heading and first paragraph, in reST, of each picture of a script."""
    pictures = []
    for block in script.read_text(encoding="utf-8").split("\n# %%\n")[1:]:
        title, _, *rest = (line.removeprefix("#").strip() for line in block.splitlines())
        pictures.append((title, " ".join(rest[: rest.index("")])))
    return pictures


class GalleryPicture(SphinxDirective):
    """``gallery-picture`` with a script's path in the gallery and the number of its picture."""

    required_arguments = 2

    def run(self) -> list[nodes.Node]:
        path, number = self.arguments
        section, name = path.split("/")
        script = Path(self.env.srcdir) / "gallery" / section / f"{name}.py"
        self.env.note_dependency(str(script))
        title, words = captions(script)[int(number) - 1]
        folder = f"/auto_gallery/{section}"
        lines = [
            f".. figure:: {folder}/images/sphx_glr_{name}_{int(number):03d}.png",
            f"   :alt: {title}",
            "",
            f"   **{title}.** {words} (:doc:`Script <{folder}/{name}>`)",
        ]
        holder = nodes.container()
        rest = StringList(["```{eval-rst}", *lines, "```"], source=str(script))
        self.state.nested_parse(rest, 0, holder)
        return holder.children


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_directive("gallery-picture", GalleryPicture)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
