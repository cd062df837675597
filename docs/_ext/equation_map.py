"""Numbers of the source text: their places in the course, and the map of all of them.

In the course a formula with a label, ``$$ ... $$ (I.6.7)``, or the role ``{place}`I.6.7``` is
the place of a number. `equation-map` shows docs/equations.toml as tables that link each number
to its place, its function and its test; `equation-tests` shows the tests themselves.
"""

import ast
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
TESTS_PAGE = "equation_tests"
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


def numbers_as_in_the_text(_app: Sphinx, env: BuildEnvironment) -> None:
    """Let references show the label of a formula, which is its number in the source text."""
    equations: dict[str, tuple[str, Any]] = env.domains.math_domain.equations
    for label, (page, _) in equations.items():
        equations[label] = (page, label)


def to_the_place(
    app: Sphinx, env: BuildEnvironment, node: pending_xref, words: nodes.TextElement
) -> nodes.reference | None:
    """Resolve a reference to the place of a number."""
    number = node["reftarget"]
    if node["reftype"] != "place" or number not in env.domains.math_domain.equations:
        return None
    page, _ = env.domains.math_domain.equations[number]
    return make_refnode(app.builder, node["refdoc"], page, anchor(number), words)


class Map(SphinxDirective):
    """What the two directives share: the entries of the map."""

    def entries(self) -> list[dict[str, str]]:
        return self.read()["equation"]

    def read(self) -> dict[str, list[dict[str, str]]]:
        path = Path(self.env.srcdir) / "equations.toml"
        self.env.note_dependency(str(path))
        return tomllib.loads(path.read_text(encoding="utf-8"))


class EquationMap(Map):
    """One table for each section of the source text."""

    def run(self) -> list[nodes.Node]:
        titles = {section["number"]: section["title"] for section in self.read()["section"]}
        sections: list[nodes.Node] = []
        for number, entries in groupby(self.entries(), key=lambda entry: entry["number"][:3]):
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
        place = self.reference("place", entry["number"], nodes.Text(short(entry["number"])))
        what = self.parse_inline(entry["what"], lineno=self.lineno)[0]
        row = nodes.row("", cell(place), cell(*what))
        if "why_not" in entry:
            reason = self.parse_inline(entry["why_not"], lineno=self.lineno)[0]
            row += cell(*reason, morecols=1, classes=["why-not"])
            return row
        module, name = entry["function"].rsplit(".", 1)
        function = self.reference("obj", f"{module}.{name}", nodes.literal("", name), "py")
        page = self.env.app.builder.get_relative_uri(self.env.docname, TESTS_PAGE)
        test = nodes.reference(
            "", in_words(entry["test"]), refuri=f"{page}#{test_anchor(entry['test'])}"
        )
        row += [cell(function), cell(test)]
        return row

    def reference(self, kind: str, target: str, words: nodes.Node, domain: str = "") -> nodes.Node:
        return pending_xref(
            "", words, refdomain=domain, reftype=kind, reftarget=target,
            refdoc=self.env.docname, refexplicit=True, refwarn=True,
        )  # fmt: skip


class EquationTests(Map):
    """The source of each test that the map names, by file."""

    def run(self) -> list[nodes.Node]:
        named = sorted({entry["test"] for entry in self.entries() if "test" in entry})
        sections: list[nodes.Node] = []
        for file, tests in groupby(named, key=lambda test: test.split("::")[0]):
            self.env.note_dependency(str(ROOT / file))
            section = nodes.section(ids=[nodes.make_id(file)])
            section += nodes.title("", file.removeprefix("tests/"))
            source = (ROOT / file).read_text(encoding="utf-8")
            for test in tests:
                code = nodes.literal_block("", source_of(test, source), language="python")
                section += nodes.rubric("", in_words(test), ids=[test_anchor(test)])
                section += code
            sections.append(section)
        return sections


def source_of(test: str, source: str) -> str:
    """Return the lines of a test, its decorators included."""
    name = test.split("::")[1]
    (node,) = (
        node
        for node in ast.parse(source).body
        if isinstance(node, ast.FunctionDef) and node.name == name
    )
    first = min(part.lineno for part in [node, *node.decorator_list])
    return "\n".join(source.splitlines()[first - 1 : node.end_lineno])


def in_words(test: str) -> str:
    """Return the name of a test as the sentence that it is."""
    return test.split("::test_")[1].replace("_", " ")


def short(number: str) -> str:
    """Return what names an entry in the table of its section: a number, or an exercise."""
    return number if "exercise" not in number else number.split(": ")[0].split(" ", 1)[1]


def test_anchor(test: str) -> str:
    return nodes.make_id(test)


def cell(*words: nodes.Node, **settings: Any) -> nodes.entry:
    return nodes.entry("", nodes.paragraph("", "", *words), **settings)


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_role("place", Place())
    app.add_directive("equation-map", EquationMap)
    app.add_directive("equation-tests", EquationTests)
    app.connect("env-updated", numbers_as_in_the_text)
    app.connect("missing-reference", to_the_place)
    return {"parallel_read_safe": True}
