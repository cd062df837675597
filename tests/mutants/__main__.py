"""Change random places of the package, and run the tests that can notice."""

import argparse
import json
import math
import os
import queue
import tempfile
import time
import tomllib
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tests.mutants.changes import Change, draw
from tests.mutants.record import Record, function_of
from tests.mutants.trial import copied, noticed_by

ROOT = Path(__file__).resolve().parents[2]
CACHE = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "earthspin-mutants"
#: Changes that mean nothing: file, first changed line, "old -> new" or "old" alone, reason.
EQUIVALENT = "tests/mutants/equivalent.toml"
PHYSICS = str.split("mass torque motion nutation wobble interior secular rotor top numerics sky")
Outcome = tuple[Change, str, float]


def main(arguments: Sequence[str] | None = None, root: Path = ROOT, cache: Path = CACHE) -> None:
    """Try a sample of changes; print those that no test notices, and the share of the others."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__)
    parser.add_argument("count", nargs="?", type=int, default=100)
    parser.add_argument("seed", nargs="?", type=int, default=1)
    parser.add_argument("packages", nargs="*", default=PHYSICS, metavar="package")
    parser.add_argument("--jobs", type=int, default=2, help="processes at the same time")
    parser.add_argument("--out", type=Path, help="also add the changes that no test notices here")
    options = parser.parse_args(arguments)
    files = [f for name in options.packages for f in (root / "earthspin" / name).glob("*.py")]
    changes = draw(root, files, options.count, options.seed)
    rows = tomllib.loads((root / EQUIVALENT).read_text(encoding="utf-8"))["equivalent"]
    meaningless = {(row["file"], row["line"], row["change"]) for row in rows}
    counted = [change for change in changes if not change.names & meaningless]
    noticed = 0
    with (options.out or Path(os.devnull)).open("a", encoding="utf-8") as out:
        for change, test, seconds in tried(counted, root, cache, options.jobs):
            noticed += bool(test)
            print(f"{seconds:5.0f} s  {change.place}: {test or 'NOT NOTICED'}", flush=True)
            if not test:
                print(change.difference, flush=True)
                print(f"# {change.place}\n{change.difference}", file=out, flush=True)
    low, high = interval(noticed, len(counted))
    print(f"{len(changes) - len(counted)} changes mean nothing and are not counted.")
    print(f"{noticed} of {len(counted)} noticed; 95 % interval {low:.1%} to {high:.1%}")


def tried(changes: Sequence[Change], root: Path, cache: Path, jobs: int) -> Iterator[Outcome]:
    """Yield each change with what noticed it, and the time in seconds."""
    stored = cache / "noticed-by.json"
    earlier = json.loads(stored.read_text("utf-8")) if stored.exists() else {}
    free: queue.Queue[Path] = queue.Queue()

    def attempt(change: Change) -> Outcome:
        copy, begin = free.get(), time.perf_counter()
        tests = record.likely(change, earlier.get(function_of(change), []))
        test = noticed_by(copy, change, {test: record.seconds[test] for test in tests})
        free.put(copy)
        return change, test, time.perf_counter() - begin

    with tempfile.TemporaryDirectory(prefix="earthspin-mutants-") as folder:
        for i in range(jobs):
            free.put(copied(root, Path(folder).resolve() / str(i)))
        record = Record(free.queue[0], cache, jobs)
        with ThreadPoolExecutor(jobs) as pool:
            for change, test, seconds in pool.map(attempt, changes):
                tests = dict.fromkeys([test, *earlier.get(function_of(change), [])])
                earlier[function_of(change)] = list(filter(None, tests))[:5]
                stored.write_text(json.dumps(earlier), encoding="utf-8")
                yield change, test, seconds


def interval(part: int, count: int) -> tuple[float, float]:
    """Wilson's 95 % interval of a share."""
    z = 1.959964
    middle, scale = part + z * z / 2, count + z * z
    half_width = z * math.sqrt(part * (count - part) / max(count, 1) + z * z / 4)
    return (middle - half_width) / scale, (middle + half_width) / scale


if __name__ == "__main__":
    main()
