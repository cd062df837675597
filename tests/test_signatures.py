"""The signatures that editors see are those of the classes."""

import ast
import inspect

import earthspin
from data_tools.signatures import FILE, INDEX, index, signatures
from earthspin.engine.question import keys_of
from earthspin.scenes import QUESTIONS


def test_the_file_is_what_the_command_writes() -> None:
    written, made = (ast.dump(ast.parse(t)) for t in (FILE.read_text("utf-8"), signatures()))
    assert written == made, "run `python -m data_tools signatures`"


def test_the_reference_lists_what_there_is() -> None:
    assert INDEX.read_text("utf-8") == index(), "run `python -m data_tools signatures`"


def test_arguments_are_those_of_the_calls() -> None:
    tree = ast.parse(FILE.read_text("utf-8"))
    told = {node.name: node.args for node in tree.body if isinstance(node, ast.FunctionDef)}
    for question in QUESTIONS.values():
        call = inspect.signature(getattr(earthspin, question.call))
        arguments = told[question.call]
        assert [a.arg for a in (*arguments.args, *arguments.kwonlyargs)] == list(call.parameters)
        required = {n for n, p in call.parameters.items() if p.default is inspect.Parameter.empty}
        assert required == {n for n, k in keys_of(question).items() if k.required}
