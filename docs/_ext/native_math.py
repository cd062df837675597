"""Formulas as MathML, which browsers draw by themselves: the pages work offline."""

from docutils import nodes
from mathml import convert
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator

CENTRED = "text-align: center; overflow-x: auto; margin: 1rem 0"
NUMBERED = '<div class="numbered"><div>{}</div><span>({})</span></div>'


def inline(translator: HTML5Translator, node: nodes.math) -> None:
    translator.body.append(convert(node.astext()))
    raise nodes.SkipNode


def block(translator: HTML5Translator, node: nodes.math_block) -> None:
    tex = " ".join(node.astext().split())
    formula = convert(tex, display="block")
    if node.get("label"):
        formula = NUMBERED.format(formula, node["label"])
    place = f' id="{node["ids"][0]}"' if node["ids"] else ""
    translator.body.append(f'<div{place} style="{CENTRED}" class="formula">{formula}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_html_math_renderer("native", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
