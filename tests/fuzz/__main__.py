"""Try many more inputs than the suite does: ``python -m tests.fuzz [SEED] [COUNT]``."""

import resource
import sys
import time

from tests.fuzz.judge import EXECUTED, KINDS, tried

# What reads without end must fail here, not on the machine.
resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))

seed = int(sys.argv[1]) if len(sys.argv) > 1 else 1
count = int(sys.argv[2]) if len(sys.argv) > 2 else 10_000
escaped = 0
for kind in KINDS:
    begun = time.perf_counter()
    many = round(count * EXECUTED.get(kind, 1.0))
    found = tried(kind, seed, many)
    escaped += len(found)
    for shown, what in found.items():
        print(f"{kind} {shown}\n    {what}")
    print(f"{kind}: {len(found)} of {many} escaped, {time.perf_counter() - begun:.1f} s")
sys.exit(bool(escaped))
