"""What leaving out saves: each shipped scene in a process of its own, against running them all.

Run it with `python tests/benchmarks/leaving_out.py`; it prints a table. Parts
and modules are counted, time and memory are those of whole processes, medians of several. Scenes
run with all their sections; beside that stands what the answer alone takes.
"""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
import time
from typing import Any

from earthspin.scenes import QUESTIONS, shipped_scenes

RUNS = 3

BARE = "import numpy, scipy, xarray; ran = set()"
SCENES = """
import earthspin
ran = set()
sections, *names = sys.argv[1:]
for name in names:
    answer = earthspin.run_tree(name, sections) if sections else earthspin.run(name)
    ran |= {(one.__module__, one.name) for one in earthspin.plan(name, sections or ()).parts}
"""
TELL = """
print(json.dumps({
    "parts": len(ran),
    "modules": len(sys.modules),
    "own": sum(name.startswith("earthspin") for name in sys.modules),
    "heavy": [n for n in ("jplephem", "erfa", "astropy", "matplotlib") if n in sys.modules],
    "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
}))
"""


def process(work: str, *words: str) -> dict[str, Any]:
    """Run Python code in fresh processes: what it loaded, and medians of its time and memory."""
    command = [sys.executable, "-c", f"import json, resource, sys\n{work}\n{TELL}", *words]
    subprocess.run(command, capture_output=True, check=True)  # warms the file cache
    seconds, told = [], []
    for _ in range(RUNS):
        begun = time.perf_counter()
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        seconds.append(time.perf_counter() - begun)
        told.append(json.loads(done.stdout))
    memory = statistics.median(row["memory"] for row in told)
    return told[-1] | {"memory": memory, "seconds": statistics.median(seconds)}


def main() -> None:
    """Print the table, as Markdown."""
    scenes = list(shipped_scenes())
    graphs = [question.graph for question in QUESTIONS.values()]
    parts = len({id(part) for graph in graphs for part in graph.parts.values()})
    rows = {"none: numpy, scipy and xarray alone": process(BARE)}
    rows |= {f"`{name}`": process(SCENES, "all", name) for name in scenes}
    rows["all of them"] = everything = process(SCENES, "all", *scenes)
    answers = {f"`{name}`": process(SCENES, "", name) for name in scenes}
    answers["all of them"] = process(SCENES, "", *scenes)
    print(
        f"| scene | parts run, of {parts} | modules of ours | modules in all | beside numpy, "
        "scipy, xarray | time | of all | memory | the answer alone: parts | time |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name, row in rows.items():
        print(
            f"| {name} | {row['parts']} | {row['own']} | {row['modules']} | "
            f"{', '.join(row['heavy']) or 'none'} | {row['seconds']:.2f} s | "
            f"{row['seconds'] / everything['seconds']:.0%} | {row['memory']:.0f} MB | "
            f"{_alone(answers.get(name))} |"
        )


def _alone(row: dict[str, Any] | None) -> str:
    return "| " if row is None else f"{row['parts']} | {row['seconds']:.2f} s"


if __name__ == "__main__":
    main()
