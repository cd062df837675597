"""The report as a process against the bare imports of the libraries it stands on, as ratios."""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time

IMPORTS = "import numpy, scipy, xarray, skyfield.api, astropy.time"
RUNS = 5


def seconds(arguments: list[str]) -> float:
    """Wall time of one Python process."""
    begun = time.perf_counter()
    subprocess.run([sys.executable, *arguments], check=True, capture_output=True)
    return time.perf_counter() - begun


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        report = ["-m", "earthspin", "report", "--out", folder]
        variants = {"without figures": [*report, "--no-figures"], "with figures": report}
        for command in variants.values():  # the first run fills caches
            seconds(command)
        for label, command in variants.items():
            pairs = [(seconds(command), seconds(["-c", IMPORTS])) for _ in range(RUNS)]
            ratios = [ours / bare for ours, bare in pairs]
            print(
                f"report {label}: {statistics.median(p[0] for p in pairs):.2f} s, bare imports "
                f"{statistics.median(p[1] for p in pairs):.2f} s, ratio "
                f"{statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})"
            )
