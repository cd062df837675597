"""Stiff and extreme cases: an answer near a reference at the ends of a range, or a refusal.

A test that must hold yields its distances from a reference. Every warning is an error, as in all
tests, and so is every overflow, division by zero and invalid operation of numpy. The docstrings
are the rows of the table that `make extreme` writes:

    @holds(bound=1e-14, unit="rad")
    def test_something() -> Distances:
        \"\"\"name of the case

        Hard because: reason why it is extreme
        Compared with: reference
        \"\"\"
        yield result - reference
"""

import re
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import chdir, contextmanager
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import ArrayLike

from earthspin.errors import EarthspinError

Distances = Iterable[ArrayLike]
Test = Callable[[Callable[[str, str], None]], None]


def holds(*, bound: float, unit: str = "") -> Callable[[Callable[[], Distances]], Test]:
    """Make a test of a function that yields distances, none of which may exceed the bound."""

    def decorate(measure: Callable[[], Distances]) -> Test:
        def test(record_property: Callable[[str, str], None]) -> None:
            with np.errstate(over="raise", invalid="raise", divide="raise"):
                sizes = [float(np.max(np.abs(distance))) for distance in measure()]
            worst = int(np.argmax(sizes))  # the first NaN, if there is one
            record_property("measured", f"{sizes[worst]:.2g} {unit}")
            record_property("bound", f"{bound:.2g} {unit}")
            words = f"distance {worst + 1} of {len(sizes)} is {sizes[worst]:.4g}"
            assert sizes[worst] <= bound, f"{words}, which exceeds {bound:g} {unit}".rstrip()

        test.__doc__ = measure.__doc__
        return test

    return decorate


def refused(message: str) -> Callable[[Callable[[], object]], Test]:
    """Make a test of a function that must raise an error of one line with this message."""

    def decorate(attempt: Callable[[], object]) -> Test:
        def test(record_property: Callable[[str, str], None]) -> None:
            with (
                np.errstate(over="raise", invalid="raise", divide="raise"),
                pytest.raises(EarthspinError, match=re.escape(message)) as error,
            ):
                attempt()
            assert "\n" not in str(error.value)
            record_property("refusal", str(error.value))

        test.__doc__ = attempt.__doc__
        return test

    return decorate


def relative_error(values: ArrayLike, reference: ArrayLike) -> float:
    """Largest absolute difference of two arrays, relative to the largest value of the second."""
    difference = np.max(np.abs(np.subtract(values, reference)))
    return float(difference / np.max(np.abs(reference)))


@contextmanager
def temporary(name: str) -> Iterator[Path]:
    """Yield the path of a file in a temporary folder, which is the working folder meanwhile."""
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        yield Path(name)
