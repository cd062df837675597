"""Stored references are computed again as they are, and refused for other problems."""

import numpy as np
import pytest

from earthspin.errors import UndefinedError
from tests.benchmarks.accuracy import compliances, long_term, pole
from tests.reference import figure_axis, makers, stored

#: Some machines have no more digits than float64.
needs_long_double = pytest.mark.skipif(
    np.finfo(np.longdouble).eps > 1e-18, reason="no long double here"
)


@pytest.mark.parametrize("name", makers.MAKERS)
def test_stored_references_are_refused_for_other_problems(name: str) -> None:
    with pytest.raises(UndefinedError, match=r"python -m tests\.reference"):
        stored.load(name, {"moments": [1, 2, 3]})


def differences(name: str) -> dict[str, np.ndarray]:
    """Differences of references computed again from those that are stored."""
    inputs, values = makers.MAKERS[name]()
    true, pairs = stored.load(name, inputs), {k: makers.pairs(v) for k, v in values.items()}
    return {k: (np.array(p["hi"]) - true[k]).hi + np.array(p["lo"]) for k, p in pairs.items()}


@pytest.mark.parametrize(
    ("name", "bound"),
    [
        *((name, 1e-28) for name in ("free-rotor", "top", "spheroid", "elements", "mean-orbit")),
        ("long-term", long_term.FLOOR),  # stored in double precision
    ],
)
def test_references_are_computed_again_as_stored(name: str, bound: float) -> None:
    for key, difference in differences(name).items():
        assert np.max(np.abs(difference)) < bound, key


@pytest.mark.slow
@needs_long_double
def test_tumbling_moon_is_computed_again_as_stored() -> None:
    for key, difference in differences("rotation").items():
        assert np.max(np.abs(difference)) < 5e-17, key  # halving its steps changes it by 4e-17


@needs_long_double
def test_compliances_are_computed_again_as_stored() -> None:
    """Up to the changes from other steps and starts."""
    true = stored.load("compliances", compliances.INPUTS)["answers"].hi
    own = np.sqrt(abs(np.diagonal(true)))
    difference = differences("compliances")["answers"]
    assert np.max(abs(difference) / np.outer(own, own)) < compliances.FLOOR
    # reciprocity, which nothing here enforces: 2.7e-18 measured
    assert np.max(abs(true - true.T) / np.outer(own, own)) < 1e-16


@needs_long_double
def test_pole_by_long_double_starts_as_stored() -> None:
    """The first days again, with steps of twice the length."""
    true = stored.load("pole", pole.INPUTS)
    start = true["start_axis"].hi.astype(np.longdouble)
    momentum = true["start_momentum"].hi + true["start_momentum"].lo.astype(np.longdouble)
    path = figure_axis.integrate(momentum, start, 16.0, 0.25)
    early = true["days"].hi <= 16
    axis = (path[:, :3] - path[:, 3:])[np.rint(true["days"].hi[early] * 4).astype(int)]
    figure = true["figure"][early]
    difference = (axis - figure.hi) - figure.lo
    assert early.sum() > 5
    # 5.5e-22 rad measured between steps of 3 and of 6 hours
    assert np.max(np.abs(difference)) < 5e-21
