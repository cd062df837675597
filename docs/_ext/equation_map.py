"""Numbers of the source text: their places in the course, and the map of all of them.

In the course a formula with a label, ``$$ ... $$ (I.6.7)``, or the role ``{place}`I.6.7``` is
the place of a number; on any page a number in brackets leads there. `equation-map` shows
docs/equations.toml as tables that link each number to its place, its function and its test;
`equation-code` shows the source of these functions or tests.
"""

import ast
import re
import tomllib
from itertools import groupby
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util.docutils import ReferenceRole, SphinxDirective
from sphinx.util.nodes import make_refnode

ROOT = Path(__file__).resolve().parents[2]
MAP, CODE_PAGE = "equations.toml", "equation_code"
NUMBER = re.compile(r"(?<=\()(I\.\d\.\d+[abc]?)(?=\))")
COLUMNS = {"number": 13, "what": 38, "function": 25, "test": 24}  # widths, per cent


def anchor(number: str) -> str:
    """Return the id that Sphinx gives to a formula with this label."""
    return nodes.make_id(f"equation-{number}")


class Place(ReferenceRole):
    """Where the course comes to a number that no formula on display carries."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        words = self.title if self.has_explicit_title else f"({self.target})"
        kept = [] if self.has_explicit_title else ["place"]  # on one line
        node = nodes.inline(self.rawtext, words, ids=[anchor(self.target)], classes=kept)
        self.env.domains.math_domain.note_equation(self.env.docname, self.target, location=node)
        return [node], []


def link_numbers(app: Sphinx, page: nodes.document) -> None:
    """Let each number in a sentence, ``(I.6.7)``, lead to its place in the course."""
    known = {entry["number"] for entry in read_map(app.env)["equation"]}
    for text in list(page.findall(nodes.Text)):
        words = NUMBER.split(text)
        if isinstance(text.parent, nodes.paragraph) and known.intersection(words[1::2]):
            text.parent.replace(text, [
                nodes.Text(word) if word not in known or k % 2 == 0 else
                reference("place", word, nodes.Text(word), app.env.docname)
                for k, word in enumerate(words)
            ])  # fmt: skip


def to_the_place(
    app: Sphinx, env: BuildEnvironment, node: pending_xref, words: nodes.TextElement
) -> nodes.reference | None:
    """Resolve a reference to the place of a number."""
    number = node["reftarget"]
    if node["reftype"] != "place" or number not in env.domains.math_domain.equations:
        return None
    page, _ = env.domains.math_domain.equations[number]
    return make_refnode(app.builder, node["refdoc"], page, anchor(number), words)


def read_map(env: BuildEnvironment) -> dict[str, list[dict[str, str]]]:
    """Return docs/equations.toml."""
    return tomllib.loads((Path(env.srcdir) / MAP).read_text(encoding="utf-8"))


def reference(
    kind: str, target: str, words: nodes.Node, page: str, domain: str = ""
) -> pending_xref:
    """Return a reference on a page, resolved when all pages are read; a warning if it is not."""
    return pending_xref(
        "", words, refdomain=domain, reftype=kind, reftarget=target, refdoc=page,
        refexplicit=True, refwarn=True,
    )  # fmt: skip


class EquationMap(SphinxDirective):
    """One table for each section of the source text."""

    def run(self) -> list[nodes.Node]:
        self.env.note_dependency(MAP)
        read = read_map(self.env)
        titles = {section["number"]: section["title"] for section in read["section"]}
        sections: list[nodes.Node] = []
        for number, entries in groupby(read["equation"], key=lambda entry: entry["number"][:3]):
            section = nodes.section(ids=[nodes.make_id(f"section-{number}")])
            section += nodes.title("", f"{number} {titles[number]}")
            section += self.table([self.row(entry) for entry in entries])
            sections.append(section)
        return sections

    def table(self, rows: list[nodes.row]) -> nodes.table:
        group = nodes.tgroup("", cols=len(COLUMNS))
        group += [nodes.colspec(colwidth=width) for width in COLUMNS.values()]
        head = nodes.row("", *(cell(nodes.Text(name)) for name in COLUMNS))
        group += [nodes.thead("", head), nodes.tbody("", *rows)]
        return nodes.table("", group, classes=["equation-map", "colwidths-given"])

    def row(self, entry: dict[str, str]) -> nodes.row:
        here, number = self.env.docname, entry["number"]
        place = reference("place", number, nodes.Text(short(number)), here)
        what = self.parse_inline(entry["what"], lineno=self.lineno)[0]
        row = nodes.row("", cell(place), cell(*what))
        if "why_not" in entry:
            reason = self.parse_inline(entry["why_not"], lineno=self.lineno)[0]
            row += cell(*reason, morecols=1, classes=["why-not"])
            return row
        page = self.env.app.builder.get_relative_uri(here, CODE_PAGE)
        function, test = (
            nodes.reference("", "", words, refuri=f"{page}#{nodes.make_id(entry[kind])}")
            for kind, words in (
                ("function", nodes.literal("", entry["function"].rsplit(".", 1)[1])),
                ("test", nodes.Text(in_words(entry["test"]))),
            )
        )
        row += [cell(function), cell(test)]
        return row


class EquationCode(SphinxDirective):
    """The source of each `function` or `test` that the map names, by file."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        kind = self.arguments[0]
        self.env.note_dependency(MAP)
        names = sorted({entry[kind] for entry in read_map(self.env)["equation"] if kind in entry})
        sections: list[nodes.Node] = []
        for file, members in groupby(names, key=file_of):
            self.env.note_dependency(str(ROOT / file))
            section = nodes.section(ids=[nodes.make_id(file)])
            section += nodes.title("", file)
            source = (ROOT / file).read_text(encoding="utf-8")
            for name in members:
                code = nodes.literal_block("", source_of(name, source), language="python")
                title = in_words(name) if kind == "test" else name.rsplit(".", 1)[1]
                section += nodes.rubric("", title, ids=[nodes.make_id(name)])
                section += code
            sections.append(section)
        return sections


def file_of(name: str) -> str:
    """Return the file of a test (``file::test``) or of a function (``module.function``)."""
    if "::" in name:
        return name.split("::")[0]
    module = name.rsplit(".", 1)[0]
    path = module.replace(".", "/")
    return f"{path}.py" if (ROOT / f"{path}.py").exists() else f"{path}/__init__.py"


def source_of(name: str, source: str) -> str:
    """Return the lines of a function, a class or a test, its decorators included."""
    (node,) = (
        node
        for node in ast.parse(source).body
        if isinstance(node, ast.FunctionDef | ast.ClassDef)
        and node.name == re.split(r"::|\.", name)[-1]
    )
    first = min(part.lineno for part in [node, *node.decorator_list])
    return "\n".join(source.splitlines()[first - 1 : node.end_lineno])


def in_words(test: str) -> str:
    """Return the name of a test as the sentence that it is."""
    return test.split("::test_")[1].replace("_", " ")


def short(number: str) -> str:
    """Return what names an entry in the table of its section: a number, or an exercise."""
    return number if "exercise" not in number else number.split(": ")[0].split(" ", 1)[1]


def cell(*words: nodes.Node, **settings: Any) -> nodes.entry:
    return nodes.entry("", nodes.paragraph("", "", *words), **settings)


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_role("place", Place())
    app.add_directive("equation-map", EquationMap)
    app.add_directive("equation-code", EquationCode)
    app.connect("doctree-read", link_numbers)
    app.connect("missing-reference", to_the_place)
    return {"parallel_read_safe": True}
