"""What a call costs beyond its physics: reading, planning, laying out; everything loaded.

Run it with `python tests/benchmarks/call_overhead.py`. The seconds of the parts are those that the
run itself counts; what is left of the call is overhead. Parts that end in a Dataset label it, too:
that share is measured at `Variables.dataset`, and is no part of the overhead. Medians of calls.
"""

import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import xarray as xr

import earthspin
from earthspin.bodies.planets import MEAN_MOON, MEAN_SUN
from earthspin.engine.variables import Variables

RUNS = 31
#: At most so long may a call take beyond its physics, ms.
TARGET = 3.0

CALLS: dict[str, Callable[[], xr.Dataset]] = {
    "precession": earthspin.precession,
    "precession by elements": lambda: earthspin.precession(perturbers=[MEAN_SUN, MEAN_MOON]),
    "precession, one of many": lambda: earthspin.precession(
        body=earthspin.EARTH.replace(spin_period=82800.0)
    ),
    "torque_series, a date": lambda: earthspin.torque_series(times=["2000-01-01"]),
    "torque_series, a year": lambda: earthspin.torque_series("2000-01-01", "2001-01-01", "6 h"),
    "pole, a year": lambda: earthspin.pole("2000-01-01", "2001-01-01", "5 d"),
    "compare_iau": earthspin.compare_iau,
    "wobble_ladder": earthspin.wobble_ladder,
    "polar_motion": earthspin.polar_motion,
    "free_rotor": lambda: earthspin.free_rotor([1, 2, 2.8], [0.01, 1, 0], [0, 10, 20]),
    "heavy_top": lambda: earthspin.heavy_top(
        [0, 1, 2], transverse_moment=1, axial_moment=1.2, weight_moment=1.5, theta="40 deg", spin=3
    ),
    "spheroid_field": lambda: earthspin.spheroid_field(["7000 km", "0 km", "0 km"]),
}


@contextmanager
def labelling() -> Iterator[list[float]]:
    """Seconds of each dataset that is labelled."""
    seconds: list[float] = []
    dataset = Variables.dataset

    def timed(variables: Variables) -> xr.Dataset:
        begun = time.perf_counter()
        labelled = dataset(variables)
        seconds.append(time.perf_counter() - begun)
        return labelled

    Variables.dataset = timed  # type: ignore[method-assign]
    try:
        yield seconds
    finally:
        Variables.dataset = dataset  # type: ignore[method-assign]


def measured(call: Callable[[], xr.Dataset]) -> tuple[float, float, float]:
    """Medians of a call: in all, beyond its parts, and labelling inside them; ms."""
    once = time.perf_counter()
    call()  # imports, caches
    runs = RUNS if time.perf_counter() - once < 1 else 3
    rows = []
    for _ in range(runs):
        with labelling() as labelled:
            begun = time.perf_counter()
            result = call()
            total = time.perf_counter() - begun
        parts = sum(result.earthspin.plan.seconds.values())
        rows.append((total, total - parts, sum(labelled)))
    total, beyond, words = (1e3 * statistics.median(column) for column in zip(*rows, strict=True))
    return total, beyond, words


def main() -> None:
    """Print the table, as Markdown."""
    print("| call | in all | beyond its parts | labelling in its parts |")
    print("|---|---|---|---|")
    slow = []
    for name, call in CALLS.items():
        total, beyond, words = measured(call)
        slow += [name] if beyond > TARGET else []
        print(f"| {name} | {total:.2f} ms | {beyond:.2f} ms | {words:.2f} ms |")
    print(f"\nbeyond {TARGET:g} ms: {', '.join(slow) or 'none'}")


if __name__ == "__main__":
    main()
