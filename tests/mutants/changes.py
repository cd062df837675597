"""Expressions of the package that a person could get wrong, and wrong texts for each.

Docstrings, annotations, messages, decorators, and functions that return text are not changed.
"""

import ast
import difflib
import itertools
import random
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

#: Percentage of each kind in a sample. Places of one kind are equally likely.
SHARES = {"number": 30, "claimed error": 15, "operator": 14, "comparison": 10, "name": 8}
SHARES |= {"sign": 7, "forgotten": 6, "order": 5, "branch": 3, "index": 2}
#: Operators and names, each with what could stand there by mistake.
_OTHER = {"+": "-", "-": "+", "*": "/", "/": "*", "**": "*", "%": "/", "//": "/", "@": "*"}
_OTHER |= {"&": "|", "|": "&", "<<": ">>", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
_OTHER |= {"<": "<=, >", "<=": "<, >=", ">": ">=, <", ">=": ">, <=", "==": "!=", "!=": "=="}
_OTHER |= {"is": "is not", "is not": "is", "in": "not in", "not in": "in", "and": "or", "or": "and"}
_PAIRS = "sin cos, min max, minimum maximum, argmin argmax, arcsin arccos, asin acos, floor ceil, "
_PAIRS += "sinh cosh, exp expm1, log log1p, any all, degrees radians, deg2rad rad2deg, real imag, "
_PAIRS += "left right, mean median, first last, sqrt square, nan inf, x y, psi omega"
for _one, _other in map(str.split, _PAIRS.split(",")):
    _OTHER |= {_one: _other, _other: _one}
_FORGOTTEN = {"abs", "fabs", "sqrt", "square", "conj", "conjugate", "radians", "deg2rad"}
#: Functions whose arguments have no order.
_SYMMETRIC = {"hypot", "min", "max", "minimum", "maximum", "isclose", "array_equal"}
_CLAIM = "errors? half_widths? uncertain(ty|ties)? tolerances? bound spread missed tails? doubts? "
_CLAIM += "(co)?variances? deviations? rounding drift truncation"
_IS_CLAIM = re.compile(rf"(?i)(^|_)({_CLAIM.replace(' ', '|')})($|_)")
#: Lists would be repeated by a factor.
_MEASURES = (ast.Name, ast.Attribute, ast.BinOp, ast.Call, ast.Subscript, ast.IfExp)
_MESSAGE = re.compile(r"warn$|[A-Z]\w*(Error|Warning)$")
_SIGN = re.compile(r"is not\b|not in\b|is\b|in\b|and\b|or\b|[-+*/%@&|<>=!^]+")
_NUMBER = re.compile(r"\d+\.\d+")


@dataclass(frozen=True)
class Change:
    """One changed expression of a file.

    Attributes
    ----------
    file : str
        Relative to the project.
    start, end : int
        First and last line of the expression.
    kind : str
        One of `SHARES`.
    old, new : str
        The expression.
    before, after : str
        The file.
    """

    file: str
    start: int
    end: int
    kind: str
    old: str
    new: str
    before: str
    after: str

    @property
    def place(self) -> str:
        """File, line and kind."""
        return f"{self.file}:{self.start} ({self.kind})"

    @property
    def difference(self) -> str:
        """The change as a unified diff."""
        texts = self.before.splitlines(), self.after.splitlines()
        names = f"a/{self.file}", f"b/{self.file}"
        return "\n".join(difflib.unified_diff(*texts, *names, lineterm=""))

    @property
    def names(self) -> set[tuple[str, str, str]]:
        """File, first line and texts: with the new text, and without it."""
        pairs = zip(self.before.splitlines(), self.after.splitlines(), strict=False)
        line = next((old for old, new in pairs if old != new), "").strip()
        return {(self.file, line, self.old), (self.file, line, f"{self.old} -> {self.new}")}


def draw(root: Path, files: Sequence[Path], count: int, seed: int) -> list[Change]:
    """Draw changes of different places: the same for the same files and seed."""
    rng = random.Random(seed)
    sources = {file: Source(file.read_text(encoding="utf-8")) for file in sorted(files)}
    pools = {k: [(f, *p) for f, s in sources.items() for p in s.places[k].items()] for k in SHARES}
    changes: list[Change] = []
    while len(changes) < count and any(pools.values()):
        kind = rng.choices(list(SHARES), [SHARES[k] * bool(pools[k]) for k in SHARES])[0]
        file, (start, end), texts = pools[kind].pop(rng.randrange(len(pools[kind])))
        before, new = sources[file].text, rng.choice(texts)
        after = before[:start] + new + before[end:]
        if _meaning(after) not in ("", sources[file].meaning):
            lines = [before.count("\n", 0, place) + 1 for place in (start, end)]
            name = file.relative_to(root).as_posix()
            changes.append(Change(name, *lines, kind, before[start:end], new, before, after))
    return changes


class Source:
    """A module and the places where it can be changed."""

    def __init__(self, text: str) -> None:
        self.text, self.meaning, self._rows = text, _meaning(text), text.splitlines(keepends=True)
        self._starts = [0, *itertools.accumulate(map(len, self._rows))]
        #: By kind, and first and last place of an expression: wrong texts.
        self.places: dict[str, dict[tuple[int, int], list[str]]] = {kind: {} for kind in SHARES}
        nodes = list(ast.walk(ast.parse(text)))
        quiet = {id(n) for node in nodes for part in _quiet(node) for n in ast.walk(part)}
        self._claims = {id(value) for node in nodes for value in _claims(node)}
        self._claims -= {id(node.func) for node in nodes if isinstance(node, ast.Call)}
        for node in nodes:
            if isinstance(node, ast.expr | ast.AugAssign) and id(node) not in quiet:
                for kind, new in self._wrong(node):
                    self.places[kind].setdefault(self._span(node), []).append(new)

    def _segment(self, node: ast.AST) -> str:
        start, end = self._span(node)
        return self.text[start:end]

    def _span(self, node: Any) -> tuple[int, int]:
        start, end = (node.lineno, node.col_offset), (node.end_lineno, node.end_col_offset)
        return self._place(*start), self._place(*end)

    def _place(self, line: int, column: int) -> int:
        return self._starts[line - 1] + len(self._rows[line - 1].encode()[:column].decode())

    def _wrong(self, node: ast.AST) -> Iterator[tuple[str, str]]:
        """Yield wrong texts for an expression, each with its kind."""
        text, begin = self._segment(node), self._span(node)[0]
        if id(node) in self._claims:
            yield from (("claimed error", f"({factor} * ({text}))") for factor in (0.5, 2))
        for kind, left, right in _operands(node):
            sign = _SIGN.search(self.text, self._span(left)[1], self._span(right)[0])
            before, after = text[: sign.start() - begin], text[sign.end() - begin :]
            for other in _OTHER.get(sign[0], sign[0]).split(", "):
                yield kind, before + other + after
            if isinstance(node, ast.BinOp):
                yield "forgotten", (after if sign[0] in "+*" else before).strip()
                yield "forgotten", before.strip()
            if sign[0] in "*/":
                yield "sign", f"-{text}"
        for first, second in itertools.pairwise(_items(node)):
            yield "order", self._exchanged(node, first, second)
        match node:
            case ast.Constant(value=bool(value)):
                yield "branch", repr(not value)
            case ast.Constant(value=int() | float()):
                yield from (("number", other) for other in other_numbers(text))
            case ast.Constant(value=str(table)) if sum(map(str.isdigit, table)) > len(table) / 4:
                for number in _NUMBER.finditer(text):
                    begin, end = number.span()
                    for other in other_numbers(number[0]):
                        yield "number", text[:begin] + other + text[end:]
            case ast.UnaryOp(op=ast.USub() | ast.Not() | ast.Invert(), operand=operand):
                yield "sign", self._segment(operand)
            case ast.Attribute(attr="T", value=value):
                yield "forgotten", self._segment(value)
            case ast.Attribute(attr=name) | ast.Constant(value=str(name)) if name in _OTHER:
                yield "name", _OTHER[name].join(text.rsplit(name, 1))
            case ast.Call(func=ast.Name(id="min" | "max" | "any" | "all" as name)):
                yield "name", text.replace(name, _OTHER[name], 1)
            case ast.Call(args=[argument]) if _name(node.func) in _FORGOTTEN:
                yield "forgotten", f"({self._segment(argument)})"
            case ast.IfExp(body=first, orelse=second):
                yield "branch", self._exchanged(node, first, second)
            case ast.Slice(lower=lower, upper=upper):
                for end in (self._span(limit)[1] - begin for limit in (lower, upper) if limit):
                    yield from (("index", f"{text[:end]} {s} 1{text[end:]}") for s in "+-")

    def _exchanged(self, node: ast.AST, first: ast.AST, second: ast.AST) -> str:
        (start, end), text = self._span(node), self.text
        (a, b), (c, d) = sorted((self._span(first), self._span(second)))
        return text[start:a] + text[c:d] + text[b:c] + text[a:b] + text[d:end]


def other_numbers(text: str) -> list[str]:
    """Return numbers that a person could type instead of this one."""
    if float(text) == 0:
        return ["1"]
    if text.isdigit() and len(text) < 3:
        return [str(int(text) + 1), str(int(text) - 1)]
    result = [f"-{text}", f"(2 * {text})"]
    for i, digit in enumerate(text):
        if digit.isdigit():
            result += [f"{text[:i]}{(int(digit) + step) % 10}{text[i + 1 :]}" for step in (1, 9)]
            if text[i + 1 : i + 2].isdigit():
                result.append(text[:i] + text[i + 1] + digit + text[i + 2 :])
    return result


def _quiet(node: ast.AST) -> list[ast.AST]:
    """Parts of a statement or expression that are not changed."""
    match node:
        case (
            ast.Raise() | ast.Assert() | ast.JoinedStr() | ast.FunctionDef(returns=ast.Name("str"))
        ):
            return [node]
        case ast.Call(func=called) if _MESSAGE.search(_name(called)):
            return [node]
    parts = [getattr(node, field, None) for field in ("annotation", "returns", "type")]
    return [*filter(None, parts), *getattr(node, "decorator_list", []), *getattr(node, "bases", [])]


def _claims(node: ast.AST) -> list[ast.AST]:
    """Values that code gives the name of an error, and that can be multiplied."""
    named: list[tuple[str, ast.AST | None]] = []
    match node:
        case ast.keyword(arg=str(name), value=value):
            named = [(name, value)]
        case ast.Assign(targets=[target], value=value) | ast.AnnAssign(target=target, value=value):
            named = [(_name(target), value)]
        case ast.FunctionDef(name=name):
            named = [(name, n.value) for n in ast.walk(node) if isinstance(n, ast.Return)]
        case ast.Attribute(attr=name, ctx=ast.Load()):
            named = [(name, node)]
    return [
        value for name, value in named if _IS_CLAIM.search(name) and isinstance(value, _MEASURES)
    ]


def _operands(node: ast.AST) -> list[tuple[str, ast.AST, ast.AST]]:
    """Neighbours around each operator, after the kind."""
    match node:
        case ast.BinOp(left=left, right=right) | ast.AugAssign(target=left, value=right):
            return [("operator", left, right)]
        case ast.BoolOp(values=values):
            return [("branch", *pair) for pair in itertools.pairwise(values)]
        case ast.Compare(left=left, comparators=others):
            return [("comparison", *pair) for pair in itertools.pairwise([left, *others])]
    return []


def _items(node: ast.AST) -> list[ast.expr]:
    """Arguments or items, if their order matters."""
    items = node.elts if isinstance(node, ast.Tuple) else []
    if isinstance(node, ast.Call) and _name(node.func) not in _SYMMETRIC:
        items = node.args if len(node.args) > 1 else [word.value for word in node.keywords]
    return [] if any(isinstance(item, ast.Starred) for item in items) else items


def _name(node: ast.AST) -> str:
    return str(getattr(node, "attr", getattr(node, "id", "")))


def _meaning(text: str) -> str:
    """Return a module without its layout; nothing if it is no Python."""
    try:
        return ast.dump(ast.parse(text))
    except SyntaxError:
        return ""
