"""Many bodies in one call: time and memory above the process, and the time of one body.

Run it with `python tests/benchmarks/many_bodies.py`. Each row is a process of its own, which has
asked the same of one body before the clock runs; times are of the processor, memory is the highest
that the process held less what it held before.
"""

from __future__ import annotations

import json
import subprocess
import sys

WORK = """
import json, resource, sys, time
import numpy as np, xarray as xr
import earthspin

def held():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024

call, size = getattr(earthspin, sys.argv[1]), int(sys.argv[2])
h = earthspin.EARTH.dynamical_flattening * np.linspace(0.999, 1.001, size)
many = earthspin.EARTH.replace(dynamical_flattening=xr.DataArray(h, dims="member"))
call()
begun = time.process_time()
call()
alone = time.process_time() - begun
before, begun = held(), time.process_time()
call(body=many)
print(json.dumps([alone, time.process_time() - begun, held() - before]))
"""

#: Calls, bodies, and what each should stay below: seconds of the processor, MB.
ROWS = (("precession", 100_000, 0.3, 100), ("wobble_ladder", 10_000, 5.0, 300))


def main() -> None:
    """Print the table, as Markdown."""
    print("| call | bodies | one body | all of them | over one | memory | targets |")
    print("|---|---|---|---|---|---|---|")
    for call, size, seconds, memory in ROWS:
        command = [sys.executable, "-c", WORK, call, str(size)]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        alone, many, held = json.loads(done.stdout)
        print(
            f"| `{call}` | {size} | {1e3 * alone:.0f} ms | {many:.2f} s "
            f"| {many / alone:.0f} times | {held:.0f} MB | {seconds} s, {memory} MB |"
        )


if __name__ == "__main__":
    main()
