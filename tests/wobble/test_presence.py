"""Records without a free wobble are refused by every method, with the reason."""

import numpy as np
import pytest

from earthspin import UndefinedError
from earthspin.wobble import observed, record
from tests.reference import simulation

DAYS = np.arange(0.0, 65 * 365.25, 10.0)


def noise(seed: int, size: int = DAYS.size) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal((size, 2)) @ np.array([1, 1j])


NOTHING = {
    "constant": (np.full(DAYS.size, 30 - 300j), "stands still but for drift and seasons"),
    "annual": (90 * record.turning(DAYS, record.YEAR), "stands still"),
    "annual, of 365.25 d": (90 * record.turning(DAYS, 365.25), "more power at 3[67]"),
    "annual, of 365 d": (90 * record.turning(DAYS, 365.0), "more power at 3[67]"),
    "white noise": (noise(1), "times that of a smooth spectrum"),
    "random walk": (np.cumsum(noise(2)), "times that of a smooth spectrum"),
    "a wobble turning backwards": (
        100 * record.turning(DAYS, -433.0) + noise(3),
        "times that of a smooth spectrum",
    ),
    "a wobble of 380 d": (100 * record.turning(DAYS, 380.0) + noise(4), "more power at 3[78]"),
}


@pytest.mark.parametrize("method", observed.METHODS)
@pytest.mark.parametrize("what", NOTHING)
def test_no_wobble_is_refused(what: str, method: str) -> None:
    p, reason = NOTHING[what]
    with pytest.raises(UndefinedError, match=f"no free wobble.*{reason}"):
        observed.fit(DAYS, p, method)


def test_the_edge_of_what_is_looked_through() -> None:
    """Without the test of presence before it, too."""
    p = 90 * record.turning(DAYS, 390.0) + noise(5)
    with pytest.raises(UndefinedError, match="at the edge"):
        observed.METHODS["likelihood"](DAYS, p)


@pytest.mark.parametrize(("years", "walks"), [(14, False), (14, True), (65, False), (65, True)])
def test_noise_passes_once_in_a_hundred(years: float, walks: bool) -> None:
    """Measured in 400 records: 4, 8, 2 and 4 passed."""
    days = np.arange(0.0, years * 365.25, 30.0)
    passed = 0
    for seed in range(200):
        p = noise(seed, days.size)
        try:
            observed.need_wobble(days, np.cumsum(p) if walks else p)
            passed += 1
        except UndefinedError:
            pass
    assert passed <= 8  # two expected; more than eight by chance once in 4000


@pytest.mark.parametrize("years", [14.0, 65.0])
def test_a_wobble_is_seen(years: float) -> None:
    """Of the usual size all of sixty, measured; of a tenth of it most."""
    for seed in range(30):
        observed.need_wobble(*simulation.simulate(years, seed=seed))
