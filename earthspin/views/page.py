"""Build an HTML page as a single file, for light and dark screens, with typeset numbers."""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape
from importlib import resources

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from earthspin.views.drawing import RAISED, Drawing
from earthspin.views.solids import Solid
from earthspin.views.tables import SHORT, TextTable


def page(
    title: str,
    tables: Sequence[TextTable] = (),
    drawings: Sequence[Drawing] = (),
    solids: Sequence[Solid] = (),
    *,
    last: Sequence[TextTable] = (),
    **words: object,
) -> str:
    """HTML text of a page that shows figures, three-dimensional pictures and tables, in this order.

    Parameters
    ----------
    title : str
    tables : sequence of TextTable
    drawings : sequence of Drawing
        If the first is square, it stands beside the title.
    solids : sequence of Solid
    last : sequence of TextTable
        Tables at the end, collapsed.
    **words
        `lead` and `note`, a sentence at the head, and what holds for all that follows; `links`,
        pairs of words and addresses of other pages, relative to this one; and `footer`.

    Returns
    -------
    str
        HTML, self-contained.
    """
    shows_first = bool(drawings) and drawings[0].square
    return rendered(
        "page.html.j2",
        title=title,
        tables=tables,
        first=drawings[0] if shows_first else None,
        drawings=drawings[1:] if shows_first else drawings,
        solids=solids,
        contents=[part.title for parts in (drawings, solids, tables, last) for part in parts],
        last=last,
        short=SHORT,
        figure_on_page=figure_on_page,
        script=source("touch.js") + source("solid.js"),
        **{"lead": "", "note": "", "links": (), "footer": ""} | words,
    )


def rendered(template: str, **content: object) -> str:
    """Insert content and the common style sheet into a template; return the HTML text."""
    return _TEMPLATES.get_template(template).render(sheet=source("page.css"), **content)


def source(name: str) -> str:
    """Text of a file in the folder of the templates, such as a style sheet or a script."""
    return resources.files("earthspin.views").joinpath("templates", name).read_text("utf-8")


# --- typesetting ---------------------------------------------------------------------------------


#: A number with an exponent: 5.71015(25)e21, 2.6e+35, 2e-06.
_POWER = re.compile(r"(?<![\w.])([+-]?\d+(?:\.\d+)?(?:\(\d+(?:\.\d+)?\))?)e([+-]?)0*(\d+)(?!\w)")
#: A minus before a number, but neither a hyphen nor a part of a date.
_MINUS = re.compile(r"(?<![\w.)\u00b7-])-(?=\d)")
_DIFFERENCE = re.compile(r"\bC( ?)-( ?)A\b")
#: A unit or a letter squared or cubed: kg m2, M a2, t3.
_SQUARE = re.compile(r"(?<=kg m)2\b|(?<=M a)2\b|(?<=^t)[23]$")
_SUBSCRIPT = re.compile(r"\b(psi|omega|eps|chi|p)_A\b")
_GREEK = {"psi": "\u03c8", "omega": "\u03c9", "eps": "\u03b5", "chi": "\u03c7", "p": "p"}


def typeset(words: str) -> Markup:
    """Convert the text of a table or a caption to HTML, with proper signs, powers and units.

    Parameters
    ----------
    words : str
        Plain text, as `earthspin.views.tables.TextTable` holds it.

    Returns
    -------
    Markup
        With true minus signs, powers of ten and of units, and angles of precession by their
        symbols.
    """
    text = escape(words, quote=False)
    text = _POWER.sub(_power, text)
    text = _MINUS.sub("\u2212", text)
    text = _DIFFERENCE.sub("C\\1\u2212\\2A", text)
    text = _SQUARE.sub(lambda match: match[0].translate(RAISED), text)
    text = _SUBSCRIPT.sub(lambda match: f"{_GREEK[match[1]]}<sub>A</sub>", text)
    text = re.sub(r"\buas\b", "\u00b5as", text).replace("W m-2", "W/m\u00b2")
    return Markup(text)  # escaped above  # nosec B704


def _power(match: re.Match[str]) -> str:
    exponent = f"{match[2].strip('+')}{match[3]}".translate(RAISED)
    return f"{match[1]}\u00a0\u00d7\u00a010{exponent}"


#: Greys and colours of figures, as the page's style sheet turns them for light and dark.
_GREYS = re.compile(r"#([0-9a-f]{2})\1\1(?![0-9a-f])", re.IGNORECASE)
_COLOURS = {"#0072b2": "blue", "#d55e00": "red", "#009e73": "green", "#cc79a7": "pink"}
_COLOURS |= {"#e69f00": "orange", "#56b4e9": "sky"}


def figure_on_page(svg: str, name: str, words: str, width: str) -> Markup:
    """HTML for a figure on a page with light and dark mode, readable by a screen reader.

    Parameters
    ----------
    svg : str
    name : str
        Name of the figure on its page; the parts of the figure are named after it, so that all
        names differ.
    words : str
        Description of the figure for screen readers.
    width : str
        ``"narrow"`` if it is shown on a phone alone, ``"usual"`` if elsewhere alone.

    Returns
    -------
    Markup
        Greys are mixtures of the page's ink and paper, colours those of its style sheet.
    """
    if not svg:
        return Markup()
    svg = re.sub("<[^>]*>", lambda tag: _on_page(tag[0], name), svg)
    head = f'<svg class="{width}" role="img" aria-label="{escape(words)}" '
    return Markup(svg.replace("<svg ", head, 1))  # from matplotlib  # nosec B704


def _on_page(tag: str, name: str) -> str:
    """SVG text of a figure with unique element names, and with colours from the page's style."""
    tag = re.sub(r'\bid="', f'id="{name}-', tag)
    tag = re.sub(r'(xlink:href="#|url\(#)', rf"\1{name}-", tag)
    tag = _GREYS.sub(_mixture, tag)
    for colour, called in _COLOURS.items():
        tag = re.sub(colour, f"var(--{called})", tag, flags=re.IGNORECASE)
    return tag


def _mixture(match: re.Match[str]) -> str:
    share = round(100 * (1 - int(match[1], 16) / 255))
    mixture = f"color-mix(in srgb, var(--ink) {share}%, var(--paper))"
    return {0: "var(--paper)", 100: "var(--ink)"}.get(share, mixture)


def anchor(title: str) -> str:
    """Name of a page section for links: its title in lower case, with hyphens."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")


_TEMPLATES = Environment(
    loader=PackageLoader("earthspin.views"),
    autoescape=True,
    undefined=StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)
_TEMPLATES.filters |= {"typeset": typeset, "anchor": anchor}
