"""What a store costs beyond the computation: 20,000 members of 1,000 numbers each.

Run it with `python tests/benchmarks/ensemble.py`. The question is one of a test, a pendulum by
Jacobi's elliptic functions: its members are arrays through and through, and 160 MB of numbers take
seconds to compute. Three ways are timed in one run, in turn: the bare computation, which keeps no
number; the plain loop into a store, to the disk; and a local cluster of two, whose start is not
counted. On a machine that others use, the seconds of the processor tell the first ratio better than
those of the clock: both are printed.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from distributed import Client, LocalCluster
from scipy.special import ellipj

from earthspin.engine import blocks
from earthspin.engine.blocks import Layout

MEMBERS, NUMBERS, BLOCK = 20_000, 1_000, 1_024
ROUNDS = 2
#: Most that the plain loop may take over the bare computation, and two workers over the plain loop.
STORE, CLUSTER = 1.8, 1.2


@dataclass
class Pendulums:
    """Angles of pendulums with so many moduli, as work in blocks."""

    what = "pendulums"
    layout = Layout("member", MEMBERS, BLOCK)

    @property
    def request(self) -> Mapping[str, str]:
        return {"question": "pendulums"}

    def make(self, number: int) -> xr.Dataset:
        members = np.arange(*self.layout.bounds(number))
        modulus = 0.1 + 0.8 * members[:, np.newaxis] / MEMBERS
        sn, _, dn, _ = ellipj(np.linspace(0, 40, NUMBERS), modulus)
        angle = 2 * np.arctan2(np.sqrt(modulus) * sn, dn)
        return xr.Dataset({"angle": (("member", "time"), angle)}, {"member": members})


def seconds(run: Callable[[], object]) -> tuple[float, float]:
    """Seconds of one run, by the clock and of this processor."""
    begun = time.perf_counter(), time.process_time()
    run()
    return time.perf_counter() - begun[0], time.process_time() - begun[1]


def main() -> int:
    """Print the table; 1 if a ratio is missed."""
    work = Pendulums()
    bare: list[tuple[float, float]] = []
    plain: list[tuple[float, float]] = []
    two: list[tuple[float, float]] = []
    with (
        tempfile.TemporaryDirectory() as folder,
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster,
        Client(cluster) as client,
    ):
        place = Path(folder, "r.zarr")

        def written(by: Client | None) -> tuple[float, float]:
            taken = seconds(lambda: blocks.write(work, place, client=by))
            shutil.rmtree(place)
            return taken

        written(client)  # workers load what they need
        for _ in range(ROUNDS):
            bare.append(seconds(lambda: [work.make(n) for n in range(work.layout.count)]))
            plain.append(written(None))
            two.append(written(client))
    (alone, cpu_alone), (loop_s, cpu_loop) = min(bare), min(plain)
    store, by_two, busy = loop_s / alone, min(two)[0] / loop_s, cpu_loop / cpu_alone
    print(f"bare computation         {alone:6.2f} s")
    print(f"plain loop, to the disk  {loop_s:6.2f} s, {store:.2f} times (at most {STORE})")
    print(f"  of the processor                 {busy:.2f} times")
    print(
        f"cluster of two           {min(two)[0]:6.2f} s, {by_two:.2f} times the plain loop "
        f"(at most {CLUSTER})"
    )
    return int(busy > STORE or by_two > CLUSTER)


if __name__ == "__main__":
    sys.exit(main())
