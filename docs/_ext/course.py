"""Pages of the course as Jupyter notebooks: each page offers itself for download.

myst-nb keeps what it has run as a notebook, in the words of these pages; Jupyter knows other
words for numbers of formulas and for solutions that fold.
"""

import re
from pathlib import Path

import nbformat
from docutils import nodes
from sphinx.application import Sphinx

RUN = "jupyter_execute"  # where myst-nb keeps notebooks, beside the pages

#: Words of these pages, and what Jupyter understands for them.
IN_JUPYTER = (
    (re.compile(r"\$\$ \(([^)]+)\)$", re.MULTILINE), r"\\tag{\1}$$"),
    (re.compile(r"\{place\}`([^`<]+?) <[^`]+>`"), r"\1"),
    (re.compile(r"\{(?:place|eq)\}`([^`]+)`"), r"(\1)"),
    (re.compile(r"\{\w+\}`([^`]+?)(?: <[^`]+>)?`"), r"`\1`"),
    (re.compile(r'<details class="solution">\n<summary>(.*?)</summary>'), r"**\1**"),
    (re.compile(r"</details>"), ""),
    (re.compile(r"\]\(((?:\.\./)?[\w/-]+)\.md(#[\w.-]+)?\)"), r"](\1.html\2)"),
)


def is_lesson(page: str) -> bool:
    return page.startswith("course/") and page != "course/index"


def offer(app: Sphinx, doctree: nodes.document) -> None:
    """Put a link to the notebook below the title of a lesson."""
    if not is_lesson(app.env.docname):
        return
    name = f"{app.env.docname.split('/')[-1]}.ipynb"
    link = nodes.raw("", f'<a href="{name}" download>Take this page as a notebook</a>', format="html")
    title = next(iter(doctree.findall(nodes.title)))
    title.parent.insert(title.parent.index(title) + 1, nodes.paragraph("", "", link, classes=["take"]))


def for_jupyter(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """Tell the text of a notebook in the words of Jupyter."""
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            for ours, theirs in IN_JUPYTER:
                cell.source = ours.sub(theirs, cell.source)
    notebook.cells = [cell for cell in notebook.cells if cell.source.strip()]
    return notebook


def write(app: Sphinx, failure: Exception | None) -> None:
    """Write the notebooks beside their pages."""
    if failure or app.builder.format != "html":
        return
    for page in filter(is_lesson, app.env.found_docs):
        run = Path(app.outdir).parent / RUN / f"{page}.ipynb"
        notebook = for_jupyter(nbformat.read(run, as_version=4))
        nbformat.write(notebook, Path(app.outdir) / f"{page}.ipynb")


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_css_file("course.css")
    app.connect("doctree-read", offer)
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
