"""Which tests run a line, in the order in which they are likely to notice that it is wrong.

A record in the cache belongs to one state of the package. Test files that are new or changed are
recorded again.
"""

import ast
import hashlib
import itertools
import json
import os
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from coverage import CoverageData

from tests.mutants.changes import Change
from tests.mutants.trial import run_tests

#: Processor time of the tests of one change, s: of those that run the changed lines, and of those
#: that are near because a fixture or a cache can hide that they run them.
LONGEST, LONGEST_NEAR = 120.0, 20.0
#: Folders and files of tests about pages, files, texts of the checkout, and changes themselves.
_NOT_RECORDED = re.compile(r"^tests/(docs|views|fuzz|force|data_tools)/|/test_(pack|sig|mut|pin)")


class Record:
    """Tests of a project, their times, and the lines that they run.

    Parameters
    ----------
    project : Path
        Copy of the project, where tests run that the cache lacks.
    cache : Path
    jobs : int
        Processes that record.
    """

    def __init__(self, project: Path, cache: Path, jobs: int) -> None:
        package = sorted((project / "earthspin").rglob("*.py"))
        folder = cache / _state(package)
        folder.mkdir(parents=True, exist_ok=True)
        listed, lines = folder / "tests.json", folder / "lines.db"
        known = json.loads(listed.read_text(encoding="utf-8")) if listed.exists() else {}
        files = sorted((project / "tests").rglob("test_*.py"))
        states = {file.relative_to(project).as_posix(): _state([file]) for file in files}
        states = {name: s for name, s in states.items() if not _NOT_RECORDED.search(name)}
        stale = [name for name in states if known.get(name, {}).get("state") != states[name]]
        for where, group in itertools.groupby(stale, os.path.dirname):
            print(f"recording which lines the tests of {where} run", flush=True)
            names = list(group)
            known |= {name: {"state": states[name], "seconds": {}} for name in names}
            for test, seconds in _recorded(project, names, lines, jobs).items():
                known[test.partition("::")[0]]["seconds"][test] = seconds
            listed.write_text(json.dumps(known), encoding="utf-8")
        rows = (known[name]["seconds"].items() for name in states)
        self.seconds: dict[str, float] = dict(itertools.chain.from_iterable(rows))
        data = CoverageData(basename=str(lines))
        data.read()
        #: By file and line: tests, after their names the phase in which they run it.
        self._lines = {file: data.contexts_by_lineno(file) for file in data.measured_files()}
        contexts = (c for rows in self._lines.values() for row in rows.values() for c in row)
        self._size = Counter(context.rpartition("|")[0] for context in contexts)
        texts = ((p.relative_to(project).as_posix(), p.read_text("utf-8")) for p in package)
        self._texts = [(f, i, row) for f, t in texts for i, row in enumerate(t.splitlines(), 1)]

    def likely(self, change: Change, first: Sequence[str] = ()) -> list[str]:
        """Return tests for a change: the given ones first, then those that run fewest lines."""
        lines, names = _lines_and_names(change)
        running = self._running((change.file, line) for line in lines) or self._reading(names)
        files = tuple({f"{test.partition('::')[0]}::" for test in running})
        files = files or (f"tests/{Path(change.file).parent.name}/",)
        near = [test for test in self.seconds if test.startswith(files)]
        chosen = self._cheapest(running, LONGEST) + self._cheapest(near, LONGEST_NEAR)
        return list(dict.fromkeys([*filter(self.seconds.__contains__, first), *chosen]))

    def _running(self, lines: Iterable[tuple[str, int]]) -> set[str]:
        contexts = {c for file, line in lines for c in self._lines.get(file, {}).get(line, ())}
        return {context.rpartition("|")[0] for context in contexts} & self.seconds.keys()

    def _reading(self, names: Iterable[str], depth: int = 3) -> set[str]:
        """Tests that run a line with one of the names, or with a constant made from them."""
        word = re.compile(rf"\b({'|'.join(filter(None, names))})\b")
        lines = [line for line in self._texts if word.search(line[2])]
        made = {name for *_, row in lines for name in re.findall(r"^(\w+)(?:: .*)? = ", row)}
        further = self._reading(made, depth - 1) if made and depth else set()
        return self._running((file, number) for file, number, _ in lines) | further

    def _cheapest(self, tests: Iterable[str], longest: float) -> list[str]:
        order = sorted(tests, key=lambda test: (self._size[test], self.seconds[test]))
        times = itertools.accumulate(self.seconds[test] for test in order)
        return [t for t, time in zip(order, times, strict=True) if time < longest] or order[:1]


def function_of(change: Change) -> str:
    """File of a change, and the functions and classes around it."""
    return " ".join([change.file, *(n.name for n in _around(change) if hasattr(n, "name"))])


def _around(change: Change) -> list[ast.stmt]:
    """Statements that contain a change, the innermost last."""
    nodes = [n for n in ast.walk(ast.parse(change.before)) if isinstance(n, ast.stmt)]
    return [n for n in nodes if n.lineno <= change.start and change.end <= (n.end_lineno or 0)]


def _lines_and_names(change: Change) -> tuple[range, set[str]]:
    """Lines that run what changed, and the names under which other lines reach it."""
    *outer, inner = _around(change)
    functions = [node.name for node in outer if isinstance(node, ast.FunctionDef)]
    if functions:
        end = change.end if hasattr(inner, "body") else inner.end_lineno or 0
        return range(inner.lineno, end + 1), {functions[-1]}
    targets = getattr(inner, "targets", [getattr(inner, "target", inner)])
    names = {getattr(node, "id", "") for target in targets for node in ast.walk(target)}
    return range(0), {getattr(inner, "name", "")} | names


def _recorded(project: Path, files: Sequence[str], lines: Path, jobs: int) -> dict[str, float]:
    """Run test files, add their lines to a file, and return the times of those that passed."""
    options = ["--cov=earthspin", "--cov-context=test", "--cov-report=", "--cov-append", "-rp"]
    options += ["-vv", "--durations=0", "--durations-min=0", "--dist=loadfile"]
    options += ["-n", str(jobs if jobs > 1 else 0)]
    ended = run_tests(project, files, options, "unlimited", str(lines))
    if ended.returncode > 1:
        raise RuntimeError(f"{files}: pytest ended with {ended.returncode}\n{ended.stderr[-2000:]}")
    seconds = dict.fromkeys(re.findall(r"(?m)^PASSED (.+?)(?: - .*)?$", ended.stdout), 0.0)
    for time, test in re.findall(r"(?m)^([\d.]+)s (?:setup|call) +(.+)$", ended.stdout):
        if test in seconds:
            seconds[test] += float(time)
    return seconds


def _state(files: Iterable[Path]) -> str:
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()[:16]
