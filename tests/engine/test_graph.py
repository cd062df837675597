"""What questions are made of: parts that fit together."""

import ast
import inspect
import sys
from collections.abc import Callable, Iterator
from functools import cache
from types import UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import pytest
import xarray as xr

import earthspin
from earthspin.engine.question import BLOCK, Block, Question, define_parts, key, part
from earthspin.engine.variables import Neglected, Variables
from earthspin.questions import MODULES


class Asked(Question, word="asked", call="asked"):
    """A question of the tests."""

    size: int = key(1, doc="a number")


@part
def answer(size: int) -> int:
    """Give it back."""
    return size


@part
def neglected() -> Neglected:
    """Nothing."""
    return Neglected()


@part
def size() -> int:
    """Have the name of a key."""
    return 1


@part
def lost(colour: str) -> str:
    """Ask for what there is not."""
    return colour


@pytest.mark.parametrize(
    ("parts", "sections", "words"),
    [
        ([size], {"neglected": neglected}, "share a name"),
        ([part(answer.function)], {"neglected": neglected}, "share a name"),
        ([lost], {"neglected": neglected}, "Asked: lost takes 'colour'"),
        ([], {}, "Asked has no part"),
    ],
)
def test_parts_that_do_not_fit_together_are_refused(
    parts: list, sections: dict, words: str
) -> None:
    with pytest.raises(TypeError, match=words):
        define_parts(Asked, answer=answer, sections=sections, parts=parts)


# --- types ----------------------------------------------------------------------------------------


@cache
def names_in(module: str) -> dict[str, Any]:
    """Names of a module, together with those that it imports for type checkers alone."""
    names = dict(vars(sys.modules[module]))
    for node in ast.parse(inspect.getsource(sys.modules[module])).body:
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            exec(compile(ast.Module(node.body, []), module, "exec"), names)
    return names


def hints_of(function: Callable[..., Any]) -> dict[str, Any]:
    """Types of the parameters and of the result of a function."""
    return get_type_hints(function, names_in(function.__module__))


def cases(hint: Any) -> set[Any]:
    """Members of a union; the type itself if it is none."""
    return set(get_args(hint)) if get_origin(hint) in (Union, UnionType) else {hint}


def takes(parameter: inspect.Parameter, wanted: set[Any], given: set[Any]) -> bool:
    """Whether a parameter has the type of what it receives, and is optional if it may be absent."""
    if parameter.default is None:
        given = given | {type(None)}
    others = {
        case
        for case in given - wanted
        if not (get_origin(case) is Literal and {type(word) for word in get_args(case)} <= wanted)
    }
    return Any in wanted or (not others and (type(None) in given or type(None) not in wanted))


def misfits(question: type[Question]) -> Iterator[str]:
    """Parameters of parts, and of their conditions, whose type is not that of the key or part."""
    parts = question.graph.parts.values()
    results = {part.name: hints_of(part.function)["return"] for part in parts}
    given = {name: cases(hint) for name, hint in get_type_hints(question).items()}
    for name, result in results.items():  # a run hands on variables as a Dataset
        is_labelled = isinstance(result, type) and issubclass(result, Variables)
        given[name] = {xr.Dataset} if is_labelled else cases(result)
    given[BLOCK] = {Block}
    for each in parts:
        for function in filter(None, (each.function, *each.unless, each.describe, each.same_for)):
            hints = hints_of(function)
            for name, parameter in inspect.signature(function).parameters.items():
                known = name in hints.keys() & given.keys()  # not of a lambda, and no **inputs
                if known and not takes(parameter, cases(hints[name]), given[name]):
                    yield f"{function.__name__}({name}: {hints[name]}), given {given[name]}"


@pytest.mark.parametrize("call", MODULES)
def test_parts_take_what_keys_and_other_parts_give(call: str) -> None:
    """A type checker does not see that a parameter receives the result of the part of its name."""
    assert [*misfits(getattr(earthspin, call).question)] == []


@part
def pair(size: int) -> tuple[int, int]:
    """Give two numbers."""
    return size, size


@part
def of_pair(pair: tuple[int, str], size: int | None) -> int:
    """Take a number and a text, and a key as if it could be None."""
    return pair[0]


def test_parts_that_take_another_type_are_found() -> None:
    class Paired(Question, word="paired", call="paired"):
        """A question of which one part takes two types that it does not get."""

        size: int = key(1, doc="a number")

    sections = {"neglected": neglected}
    define_parts(Paired, answer=of_pair, sections=sections, parts=[pair])
    assert [line.partition(":")[0] for line in misfits(Paired)] == ["of_pair(pair", "of_pair(size"]
