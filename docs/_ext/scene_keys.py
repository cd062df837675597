"""The directive `scene-keys`: what every question can be asked, from its class."""

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from earthspin.engine.question import Key, Question, keys_of
from earthspin.scenes import QUESTIONS


class SceneKeys(SphinxDirective):
    """Render the keys of every question as a table."""

    def run(self) -> list[nodes.Node]:
        holder = nodes.section(ids=["keys"])
        for question in QUESTIONS.values():
            part = nodes.section(ids=[f"keys-{question.word}"], names=[question.word])
            part += nodes.title(text=question.word)
            lines = StringList(_lines(question), source=question.__module__)
            self.state.nested_parse(lines, 0, part)
            holder += part
        return holder.children


def _lines(question: type[Question]) -> list[str]:
    head = (question.__doc__ or "").split("\n")[0]
    lines = [f"{head} In Python: `earthspin.{question.call}()`.", ""]
    lines += ["| key | what may be given | default | meaning |", "|---|---|---|---|"]
    for one in keys_of(question).values():
        name = f"{question.table}.{one.name}" if one.setting else one.name
        lines.append(f"| `{name}` | {one.kind.words} | {_default(one)} | {one.doc} |")
    sections = ", ".join(f"`{name}`" for name in question.graph.sections)
    return [*lines, "", f"Sections: {sections}.", ""]


def _default(one: Key) -> str:
    return "must be given" if one.required else one.default_words


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_directive("scene-keys", SceneKeys)
    return {"parallel_read_safe": True}
