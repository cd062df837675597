"""TeX to the MathML that browsers draw well: MathML Core, with what a converter leaves undone.

`latex2mathml` does not know ``aligned``, writes letters of a style as a ``mathvariant`` that
browsers ignore, gives accents the gap of a limit, sets names of functions without space and a sign
as if it stood between two numbers, and shrinks a prime twice.
"""

import re

from latex2mathml.converter import convert as convert_plainly

#: The first of each block of letters of Unicode, by its style and what a letter is counted from.
BLOCKS = {
    "bold-italic": {"A": 0x1D468, "a": 0x1D482, "Α": 0x1D71C, "α": 0x1D736},
    "bold": {"A": 0x1D400, "a": 0x1D41A, "Α": 0x1D6A8, "α": 0x1D6C2},
    "sans-serif": {"A": 0x1D5A0, "a": 0x1D5BA},
}
#: Where each block ends.
LAST = {"A": "Z", "a": "z", "Α": "Ω", "α": "ω"}
THIN = "0.167em"
FUNCTIONS = "sin|cos|tan|cot|sec|csc|arcsin|arccos|arctan|sinh|cosh|tanh|exp|log|ln|arg|det|min|max"
_LETTER = re.compile(r'<mi mathvariant="(bold-italic|bold|sans-serif)">(&#x[0-9A-F]+;|.)</mi>')
_OVER = r'<mover>((?:(?!<mover).)*?)<mo(?: stretchy="true")?>(&#x0*(?:{});)</mo>'
_DOTS = re.compile(_OVER.format("2D9|A8"))
_ACCENT = re.compile(_OVER.format("5E|AF|2192|7E"))
_OPENS = r"<math[^>]*>|<mrow>|<mtd[^>]*>|</mo>"
_FUNCTION = re.compile(rf"({_OPENS})?<mi>({FUNCTIONS})</mi>(<mo[^>]*>&#x00028;)?")
_PRIME = re.compile(r"<msup>(<m[in][^>]*>[^<]*</m[in]>)<mi>&#x02032;</mi></msup>")
_SIGN = re.compile(
    r"(<mo[^>]*>(?:[=(,\[]|&#x0*(?:3D|28|2C|5B|2248|2264|2265);)</mo>)<mo>(&#x02212;|−)"
)


def convert(tex: str, display: str = "inline") -> str:
    """Turn one formula into MathML.

    Parameters
    ----------
    tex : str
    display : str
        ``"inline"`` or ``"block"``.
    """
    text = convert_plainly(tex.replace("{aligned}", "{align*}"), display=display)
    text = _LETTER.sub(_letter, text)
    # as an accent a dot would touch a capital
    text = _DOTS.sub(r'<mover>\1<mo stretchy="false" mathsize="115%">\2</mo>', text)
    text = _ACCENT.sub(r'<mover accent="true">\1<mo stretchy="false">\2</mo>', text)
    text = _PRIME.sub(r'<mrow>\1<mo lspace="0" rspace="0">&#x02032;</mo></mrow>', text)
    text = _SIGN.sub(r'\1<mo form="prefix">\2', text)
    return _FUNCTION.sub(_function, text)


def _letter(found: re.Match[str]) -> str:
    """A bold or upright letter as the character that it is."""
    code = found[2]
    letter = chr(int(code[3:-1], 16)) if code.startswith("&#x") else code
    for first, place in BLOCKS[found[1]].items():
        if first <= letter <= LAST[first]:
            return f"<mi>&#x{place + ord(letter) - ord(first):X};</mi>"
    return f"<mi>{letter}</mi>"


def _function(found: re.Match[str]) -> str:
    """The name of a function, with a thin space before it and before a bare argument."""
    before, name, bracket = found[1] or "", found[2], found[3] or ""
    left, right = "0" if before else THIN, "0" if bracket else THIN
    return f'{before}<mo form="prefix" lspace="{left}" rspace="{right}">{name}</mo>{bracket}'
