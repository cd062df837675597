"""Lessons of the course as Jupyter notebooks: each page offers itself for download."""

from pathlib import Path

import nbformat
from docutils import nodes
from lessons import for_jupyter
from sphinx.application import Sphinx

RUN = "jupyter_execute"  # where myst-nb keeps what it has run, beside the pages
LINK = '<a href="{}.ipynb" download>Take this page as a notebook</a>'


def is_lesson(page: str) -> bool:
    return page.startswith("course/") and page != "course/index"


def offer(app: Sphinx, page: nodes.document) -> None:
    """Put a link to the notebook below the title of a lesson."""
    if is_lesson(app.env.docname):
        title = next(iter(page.findall(nodes.title)))
        link = nodes.raw("", LINK.format(app.env.docname.split("/")[-1]), format="html")
        below = title.parent.index(title) + 1
        title.parent.insert(below, nodes.paragraph("", "", link, classes=["take"]))


def write(app: Sphinx, failure: Exception | None) -> None:
    """Write the notebooks beside their pages, figures and results included."""
    if failure or app.builder.format != "html":
        return
    for page in filter(is_lesson, app.env.found_docs):
        notebook = nbformat.read(Path(app.outdir).parent / RUN / f"{page}.ipynb", as_version=4)
        for cell in notebook.cells:
            if cell.cell_type == "markdown":
                cell.source = for_jupyter(cell.source).strip()
        notebook.cells = [cell for cell in notebook.cells if cell.source]
        nbformat.write(notebook, Path(app.outdir) / f"{page}.ipynb")


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_css_file("course.css")
    app.connect("doctree-read", offer)
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
