"""Signatures of the public calls, for editors and type checkers, and the index of the reference.

``python -m data_tools signatures`` writes earthspin/__init__.pyi, and the list of questions in
docs/reference/index.md, from the classes of the questions.
"""

from __future__ import annotations

from pathlib import Path

import earthspin
from earthspin.engine.public_calls import arguments_of
from earthspin.engine.question import Key, Question
from earthspin.scenes import QUESTIONS

FILE = Path(earthspin.__file__).with_name("__init__.pyi")
INDEX = FILE.parents[1] / "docs" / "reference" / "index.md"

_HEAD = '''"""Signatures of the public names, written by `python -m data_tools signatures`."""

import datetime as dt
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal

import numpy as np
import pandas as pd
import xarray as xr
from astropy.time import Time
from astropy.units import Quantity
from numpy.typing import ArrayLike
from skyfield.jpllib import SpiceKernel
from skyfield.timelib import Time as SkyfieldTime
from skyfield.vectorlib import VectorFunction

from earthspin.interior.layers import LayeredBody
from earthspin.sky.orbit_table import OrbitTable

Value = str | float | Quantity | dt.timedelta | np.timedelta64
Pure = float | Quantity
Values = ArrayLike | Quantity | xr.DataArray | Sequence[Value] | Sequence[Sequence[Value]]
Date = str | dt.date | np.datetime64 | Time | SkyfieldTime
Dates = Time | SkyfieldTime | ArrayLike | xr.DataArray | Sequence[Date]
Epoch = str | Quantity | Date
Epochs = Quantity | Dates | Sequence[Epoch]
'''


def signatures() -> str:
    """Text of the file."""
    calls = {question.call: question for question in QUESTIONS.values()}
    lines = [_HEAD]
    for module, names in vars(earthspin)["_HOME"].items():
        lines += [f"from {module} import {name} as {name}" for name in names]
    lines += ["from earthspin._version import __version__ as __version__", ""]
    for question in calls.values():
        lines += ["", *_definition(question)]
    lines += ["", f"__all__ = {list(earthspin.__all__)!r}", ""]
    return "\n".join(lines)


def index() -> str:
    """Text of the index of the reference, with the calls of all questions."""
    text = INDEX.read_text(encoding="utf-8")
    before, mark, rest = text.partition("   :toctree: generated\n\n")
    calls = "".join(f"   {question.call}\n" for question in QUESTIONS.values())
    return f"{before}{mark}{calls}{rest[rest.index('```') :]}"


def _definition(question: type[Question]) -> list[str]:
    """A call with its arguments, each with what may be given."""
    lines = [f"def {question.call}("]
    named = False
    for name, argument in arguments_of(question).items():
        if name not in question.positional and not named:
            named = True
            lines.append("    *,")
        lines.append(f"    {name}: {_hint(name, argument)},")
    return [*lines, ") -> xr.Dataset: ..."]


def _hint(name: str, argument: Key | None) -> str:
    if argument is None:
        return "Date | None = ..."
    return argument.kind.hint if argument.required else f"{argument.kind.hint} | None = ..."


def main() -> int:
    """Write the file."""
    FILE.write_text(signatures(), encoding="utf-8")
    INDEX.write_text(index(), encoding="utf-8")
    return 0
