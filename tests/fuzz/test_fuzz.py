"""Malformed inputs from fixed seeds: each ends in an answer or in one clear line.

More of them: ``make fuzz``, or ``python -m tests.fuzz SEED COUNT``.
"""

import pytest

import earthspin
from tests.fuzz import inputs
from tests.fuzz.judge import escapes, only_planned, tried

#: How many of each kind; the first three are only planned. 5 s together.
COUNTS = {
    "scenes": 400,
    "commands": 300,
    "calls": 350,
    "executed": 20,
    "answers": 30,
    "borders": 60,
    "tables": 60,
}


@pytest.mark.parametrize("kind", COUNTS)
def test_nothing_escapes(kind: str) -> None:
    assert tried(kind, seed=0, count=COUNTS[kind]) == {}


WRONG = {
    "ORBIT.to_file": lambda: inputs.ORBIT.to_file([1]),
    "ensemble": lambda: earthspin.ensemble("precession", 2, path=[1]),
    "to_skycoord": lambda: inputs.ANSWER.earthspin.to_skycoord([1]),
    "rotation": lambda: earthspin.rotation(start_omega=[1e200, 0, 0]),
    "attitude": lambda: earthspin.rotation(start_attitude=[1e200, 0, 0, 0]),
    "quantiles": lambda: inputs.ANSWER.earthspin.quantiles([10**400]),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_types_and_sizes_end_in_one_line(name: str) -> None:
    with only_planned():
        assert escapes(WRONG[name], names=("path",)) == ""
