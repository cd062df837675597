"""The directive `equation-map`: docs/equations.toml as a table."""

import tomllib
from pathlib import Path

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective


class EquationMap(SphinxDirective):
    """Render every entry of the map."""

    def run(self) -> list[nodes.Node]:
        path = Path(self.env.srcdir) / "equations.toml"
        self.env.note_dependency(str(path))
        entries = tomllib.loads(path.read_text(encoding="utf-8"))["equation"]
        lines = ["| number | what | function | test |", "|---|---|---|---|"]
        for entry in entries:
            if "why_not" in entry:
                function, test = entry["why_not"], ""
            else:
                function, test = f"`{entry['function']}`", f"`{entry['test']}`"
            lines.append(f"| {entry['number']} | {entry['what']} | {function} | {test} |")
        holder = nodes.container()
        self.state.nested_parse(StringList(lines, source=str(path)), 0, holder)
        return holder.children


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_directive("equation-map", EquationMap)
    return {"parallel_read_safe": True}
