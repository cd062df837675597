"""Members of an ensemble side by side, against one after the other: ten thousand of each question.

Run it with `python tests/benchmarks/side_by_side.py`. Seconds are of the processor; one after the
other, two hundred are made and the time is scaled. An axis over a million years is asked for at
eleven epochs.
"""

import time
from collections.abc import Callable
from typing import Any

from earthspin import EARTH
from earthspin.engine.ensemble import Ensemble
from earthspin.scenes import QUESTIONS

MANY, FEW = 10_000, 200
ASKED: dict[str, dict[str, Any]] = {
    "precession": {"body.j2": {"normal": [EARTH.j2, 1e-10]}},
    "wobble": {"body.dynamical_flattening": {"normal": [EARTH.dynamical_flattening, 1e-9]}},
    "free-rotor": {"moments.2": {"uniform": [2.5, 2.8]}},
    "top": {"spin": {"uniform": [2.0, 4.0]}},
    "spheroid": {"body.flattening": {"normal": [EARTH.flattening, 1e-9]}},
    "long-term": {"tides": {"uniform": [0.0, 1.2]}, "ellipticity": {"uniform": [0.998, 1.012]}},
}
KEYS: dict[str, dict[str, Any]] = {
    "free-rotor": {"moments": [1, 2, 2.8], "omega": [0.01, 1, 0], "times": [0, 10]},
    "top": {
        "transverse_moment": 1, "axial_moment": 1.2, "weight_moment": 1.5,
        "theta": "40 deg", "spin": 3, "times": [0, 1, 2],
    },
    "spheroid": {"position": ["7000 km", "0 km", "0 km"]},
    "long-term": {"step": "100 kyr"},
}  # fmt: skip


def seconds(run: Callable[[], object]) -> float:
    """Seconds of the processor."""
    begun = time.process_time()
    run()
    return time.process_time() - begun


def ensemble(word: str, members: int) -> Ensemble:
    """The members of a question, which itself is asked once before."""
    keys: dict[str, Any] = KEYS.get(word, {})
    made = Ensemble(QUESTIONS[word](members={"n": members, **ASKED[word]}, **keys))
    _ = made.nominal
    return made


def main() -> None:
    """Print the table, as Markdown."""
    print(f"| question | {MANY} side by side | one after the other | ratio |")
    print("|---|---|---|---|")
    for word in ASKED:
        together = ensemble(word, MANY)
        alone = ensemble(word, FEW)
        alone.width = 1  # as if the question did not take arrays
        side = seconds(together.hold)
        each = seconds(alone.hold) * MANY / FEW
        print(f"| {word} | {side:.2f} s | {each:.0f} s | {each / side:.0f} times |")


if __name__ == "__main__":
    main()
