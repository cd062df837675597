"""Typeset numbers, units and figures for HTML pages.

Tables hold plain text that a terminal can print and a program can read again: ``5.71015(25)e21``,
``-0.0192``, ``kg m2``. The page sets the same text with signs, powers and subscripts.
"""

from __future__ import annotations

import re
from html import escape

from markupsafe import Markup

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
        Plain text, as `earthspin.views.table.Table` holds it.

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
    text = _SQUARE.sub(lambda found: f"<sup>{found[0]}</sup>", text)
    text = _SUBSCRIPT.sub(lambda found: f"{_GREEK[found[1]]}<sub>A</sub>", text)
    text = re.sub(r"\buas\b", "\u00b5as", text)
    return Markup(text)


def _power(found: re.Match[str]) -> str:
    sign = "\u2212" if found[2] == "-" else ""
    return f"{found[1]} \u00d7 10<sup>{sign}{found[3]}</sup>"


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
        Of the figure on its page; its parts are named after it, so that no two are alike.
    words : str
        What it shows, for those who do not see it.
    width : str
        ``"narrow"`` if it is shown on a phone alone, ``"usual"`` if elsewhere alone.

    Returns
    -------
    Markup
        Greys are mixtures of the page's ink and paper, colours those of its style sheet.
    """
    if not svg:
        return Markup()
    svg = re.sub(r'\bid="', f'id="{name}-', svg)
    svg = re.sub(r'(xlink:href="#|url\(#)', rf"\1{name}-", svg)
    svg = _GREYS.sub(_mixture, svg)
    for colour, called in _COLOURS.items():
        svg = re.sub(colour, f"var(--{called})", svg, flags=re.IGNORECASE)
    svg = re.sub(
        r"<svg ",
        lambda _: f'<svg class="{width}" role="img" aria-label="{escape(words)}" ',
        svg,
        count=1,
    )
    return Markup(svg)


def _mixture(found: re.Match[str]) -> str:
    share = round(100 * (1 - int(found[1], 16) / 255))
    if share == 100:
        return "var(--ink)"
    return (
        "var(--paper)" if share == 0 else f"color-mix(in srgb, var(--ink) {share}%, var(--paper))"
    )


def anchor(title: str) -> str:
    """Name of a page section for links: its title in lower case, with hyphens."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")
