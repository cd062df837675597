"""Tests of refused input as tables: calls or arguments, the error that each raises, its words."""

from collections.abc import Callable
from typing import Any

import pytest

from earthspin import EarthspinError


def refused(
    *rows: tuple[Any, ...],
    call: Callable[..., object] = lambda call: call(),
    kind: type[Exception] | tuple[type[Exception], ...] = EarthspinError,
) -> Callable[[tuple[Any, ...]], None]:
    """Make a test that each row is refused in one line.

    Parameters
    ----------
    *rows : tuple
        Arguments of the call, the class of the error if it is not `kind`, and a pattern that its
        message holds. With the default call, the one argument is a function to be called.
    call : callable
        What is given the arguments of each row.
    kind : class or tuple of classes
        Error of rows that name none.
    """

    @pytest.mark.parametrize("row", rows, ids=lambda row: str(row[-1]))
    def test(row: tuple[Any, ...]) -> None:
        *arguments, words = row
        named = isinstance(arguments[-1], type) and issubclass(arguments[-1], Exception)
        with pytest.raises(arguments.pop() if named else kind, match=words) as error:
            call(*arguments)
        assert "\n" not in str(error.value)

    return test
