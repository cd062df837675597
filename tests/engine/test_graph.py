"""What questions are made of: parts that fit together."""

import pytest

from earthspin.engine.question import Question, define_parts, key, part
from earthspin.engine.variables import Neglected


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
