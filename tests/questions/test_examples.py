"""The examples in docstrings print what they say."""

import doctest
import inspect

import pytest

import earthspin
from earthspin.scenes import QUESTIONS


@pytest.mark.parametrize("word", QUESTIONS)
def test_the_example_of_every_question(word: str) -> None:
    question = QUESTIONS[word]
    text = inspect.getdoc(getattr(earthspin, question.call)) or ""
    test = doctest.DocTestParser().get_doctest(text, {}, question.call, None, None)
    assert len(test.examples) >= 2
    assert any(example.want for example in test.examples)
    told: list[str] = []
    runner = doctest.DocTestRunner()
    result = runner.run(test, out=told.append)
    assert result.failed == 0, "".join(told)
    assert inspect.cleandoc(question.__doc__ or "").split("Examples")[1].strip() in text
