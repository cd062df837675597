"""The directive `gallery-picture`: a picture of the gallery on a page, with its script's own words.

Its title and first paragraph are the caption, so that a caption changes with what it describes; the
picture leads to the script.
"""

import ast
from pathlib import Path

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective


def caption_of(script: Path) -> tuple[str, str]:
    """Title and first paragraph of what a script says of its picture, in reST."""
    words = ast.get_docstring(ast.parse(script.read_text(encoding="utf-8"))) or ""
    title, _, rest = words.partition("\n")
    paragraph = rest.split("\n\n")[1]
    return title, " ".join(paragraph.split())


class GalleryPicture(SphinxDirective):
    """``gallery-picture`` with a script's path in the gallery, as ``pole/plot_pole_path``."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        section, name = self.arguments[0].split("/")
        script = Path(self.env.srcdir) / "gallery" / section / f"{name}.py"
        self.env.note_dependency(str(script))
        title, words = caption_of(script)
        folder = f"/auto_gallery/{section}"
        lines = [
            f".. figure:: {folder}/images/sphx_glr_{name}_001.png",
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
