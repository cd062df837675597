"""Processor time and peak memory of the main calls against the size of the result.

`python -m tests.benchmarks.how_large` writes the figure and the table of docs/how_fast.md. Each
size is computed in its own process, after a small call that loads what is needed; the memory is
the increase of the peak memory during the call. The last line compares insolation with the
plain formula, which gives no errors; `side_by_side.py` has the ratios of ensembles to single calls,
and `accuracy` those of the torque, the pole and the rotation to other libraries.
"""

import json
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

import earthspin
from earthspin.views.drawing import BLUE, GREEN, ORANGE, PINK, RED, SKY, Drawing, style

MEASURED = Path(__file__).parents[2] / "docs" / "measured"
LATITUDES = np.radians(np.arange(-89.5, 90))
ROUNDS = 5


def span(start: str, step: int, count: int) -> dict[str, Any]:
    """Keys of a series with a number of times and a step in seconds."""
    stop = np.datetime64(start, "s") + (count - 1) * step
    return {"start": start, "stop": str(stop), "step": f"{step} s"}


def past(kyr: int) -> xr.Dataset:
    """Orbit and obliquity each thousand years."""
    return earthspin.long_term(f"-{kyr} kyr", "0 kyr", "1 kyr")


def insolation(answer: xr.Dataset) -> xr.Dataset:
    """Insolation at 180 latitudes at the June solstice."""
    return earthspin.daily_insolation(answer, list(LATITUDES), "90 deg")


#: By call: what the size counts, sizes, and the call; insolation is given an answer of `past`.
CALLS: dict[str, tuple[str, tuple[int, ...], Callable[..., Any]]] = {
    "torque_series": (
        "times",
        (10**3, 10**4, 10**5, 10**6),
        lambda n: earthspin.torque_series(**span("1990-01-01", 900, n)),
    ),
    "pole": (
        "times",
        (10**2, 10**3, 10**4, 10**5),
        lambda n: earthspin.pole(**span("1990-01-01", 7200, n)),
    ),
    "rotation": (
        "days",
        (10, 10**2, 10**3),
        lambda n: earthspin.rotation(**span("2000-01-01", 86400, n)),
    ),
    "long_term": ("epochs", (10, 10**2, 10**3, 10**4), past),
    "daily_insolation": ("epochs", (10, 10**2, 10**3, 10**4), insolation),
    "ensemble of precession": (
        "members",
        (10**2, 10**3, 10**4, 10**5),
        lambda n: earthspin.ensemble("precession", n),
    ),
}


def peak() -> float:
    """Largest memory of this process so far, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def measured(name: str, size: int) -> tuple[float, float, float]:
    """Seconds of the processor, peak memory and size of the result, MB, of one call."""
    _, sizes, call = CALLS[name]
    given: Any = past(size) if call is insolation else size
    call(past(sizes[0]) if call is insolation else sizes[0])
    before, begun = peak(), time.process_time()
    result = call(given)
    return time.process_time() - begun, peak() - before, result.nbytes / 1e6


def in_own_process(name: str, size: int) -> list[float]:
    """Return the numbers of `measured` from a new process."""
    command = [sys.executable, "-m", __spec__.name, name, str(size)]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    return [float(number) for number in json.loads(run.stdout)]


def plain_insolation(answer: xr.Dataset) -> np.ndarray:
    """Berger's formula on arrays, as one would write it, without errors."""
    eps, w = np.radians(answer.obliquity.values), answer.longitude_of_perihelion.values
    e, phi = answer.eccentricity.values, LATITUDES[:, np.newaxis]
    near = (1 + e * np.cos(np.pi / 2 - np.radians(w) - np.pi)) / (1 - e**2)
    half = np.arccos(np.clip(-np.tan(phi) * np.tan(eps), -1, 1))
    day = half * np.sin(phi) * np.sin(eps) + np.cos(phi) * np.cos(eps) * np.sin(half)
    return np.asarray(1361 / np.pi * near**2 * day)


def ratio_to_the_formula() -> float:
    """Time of insolation with errors over that of the plain formula; median of rounds."""
    answer, ratios = past(10_000), []
    for _ in range(ROUNDS):
        moments = [time.process_time()]
        for call in (insolation, plain_insolation):
            call(answer)
            moments.append(time.process_time())
        ratios.append((moments[1] - moments[0]) / (moments[2] - moments[1]))
    return statistics.median(ratios)


def main() -> None:
    """Measure, and write the table and the figure."""
    figure = Figure(figsize=(7.5, 3.8), layout="constrained")
    with style():
        axes = figure.subplots(1, 2, sharex=True)
        rows = [
            "| call | size | processor | memory | result |",
            "| --- | ---: | ---: | ---: | ---: |",
        ]
        for (name, (what, sizes, _)), colour in zip(
            CALLS.items(), (BLUE, GREEN, RED, ORANGE, PINK, SKY), strict=True
        ):
            numbers = [in_own_process(name, size) for size in sizes]
            for ax, column, least in zip(
                axes, zip(*numbers, strict=True), (1e-3, 0.1), strict=False
            ):
                ax.loglog(sizes, np.maximum(column, least), "o-", color=colour, label=name)
            seconds, memory, result = numbers[-1]
            rows.append(
                f"| `{name}` | {sizes[-1]:,} {what} | {seconds:.2g} s | {memory:.0f} MB "
                f"| {max(result, 1):.0f} MB |"
            )
        axes[0].set_ylabel("processor time (s)")
        axes[1].set_ylabel("peak memory (MB)")
        for ax in axes:
            ax.set_xlabel("times, days, epochs or members")
        lines, names = axes[0].get_legend_handles_labels()
        figure.legend(lines, names, fontsize=7, ncols=6, loc="outside upper center")
        drawing = Drawing("Time and memory", "Main calls against the size of the result", figure)
        (MEASURED / "how-large.svg").write_text(drawing.svg + "\n", encoding="utf-8")
    rows += [
        "",
        f"Insolation takes {ratio_to_the_formula():.1f} times as long as the plain formula.",
    ]
    (MEASURED / "how-large.inc").write_text("\n".join(rows) + "\n", encoding="utf-8")
    print("\n".join(rows))


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(json.dumps(measured(sys.argv[1], int(sys.argv[2]))))
    else:
        main()
