"""Plant one error at a time in a copy of the project and run the suite until a test fails.

An error counts as caught if a test fails with it that passes without it: whatever caught one
is run again on a copy without any error. Tests that never get to run do not count. The test that
caught an error last time, by the page with the results, runs first and alone.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from tests.mutants.catalogue import ROOT, Mutant
from tests.mutants.witness import NOTE

#: Copied: what is changed, and what must lie beside it. All else that is there is linked to.
_COPIED = ("earthspin", "tests", "data_tools")
_LEFT = {".git", ".venv", "report", "build", "dist"}
#: Results of the last run of all errors.
PAGE = ROOT / "docs" / "measured" / "mutants.md"
#: For errors that change nothing quickly, such as a loop that never ends.
_LONGEST = 1200.0  # s


@dataclass(frozen=True)
class Finding:
    """What became of a planted error.

    Attributes
    ----------
    mutant : Mutant
    witness : str
        The first test that failed; empty if none did.
    seconds : float
        Until it failed.
    whole_suite : bool
        Whether the tests that should have noticed did not.
    trouble : str
        Why the outcome does not count; empty if it does.
    """

    mutant: Mutant
    witness: str
    seconds: float
    whole_suite: bool = False
    trouble: str = ""

    @property
    def caught(self) -> bool:
        """Whether a test noticed."""
        return bool(self.witness) and not self.trouble


def hunt(mutants: Sequence[Mutant], jobs: int = 2) -> tuple[list[Finding], float]:
    """Try every mutant; say how each fared as soon as it is known.

    Returns
    -------
    findings : list of Finding
        In the order of the mutants.
    seconds : float
        For all of them, the control included.
    """
    begin = time.perf_counter()
    found: list[Finding] = []
    with ThreadPoolExecutor(jobs) as pool:
        for finding in pool.map(try_mutant, mutants):
            found.append(finding)
            print(f"[{len(found):3}/{len(mutants)}] {_words(finding)}", flush=True)
    # What none of the mapped tests noticed goes through the whole suite, on all cores.
    found = [f if f.witness or f.trouble else _try_whole_suite(f, jobs) for f in found]
    print("control: the same tests without an error", flush=True)
    unsound = failing_without_error(sorted({f.witness for f in found if f.witness}))
    found = [
        replace(f, trouble="the test fails without the error too") if f.witness in unsound else f
        for f in found
    ]
    return found, time.perf_counter() - begin


def last_witnesses() -> dict[str, str]:
    """By name of the error, the test that caught it last time, without the names of its cases."""
    rows = re.findall(r"^\| (.*?) \| \w+ \| `.*?` \| `(.*?)[\[` ]", PAGE.read_text("utf-8"), re.M)
    return {name.replace("\\|", "|"): f"tests/{witness}" for name, witness in rows}


def defined(test: str) -> bool:
    """Whether a test, by file and name, is there: a function, or what a call returns."""
    file, _, name = test.partition("::")
    path = ROOT / file
    made = rf"^(def {name}\(|{name} = )"
    return path.exists() and bool(re.search(made, path.read_text(encoding="utf-8"), re.M))


def try_mutant(mutant: Mutant) -> Finding:
    """Run the test that noticed last time, then the tests that should notice, file by file."""
    begin = time.perf_counter()
    last = [test for test in [last_witnesses().get(mutant.name, "")] if test and defined(test)]
    with copy_of_project() as copy:
        plant(mutant, copy)
        for tests in (*last, *mutant.tests):
            witness, trouble = _run(copy, [tests])
            if witness or trouble:
                return Finding(mutant, witness, time.perf_counter() - begin, trouble=trouble)
    return Finding(mutant, "", time.perf_counter() - begin)


def _try_whole_suite(finding: Finding, jobs: int) -> Finding:
    print(f"{finding.mutant.name}: not noticed; trying the whole suite", flush=True)
    begin = time.perf_counter()
    with copy_of_project() as copy:
        plant(finding.mutant, copy)
        spread = ["--numprocesses", str(jobs), "--dist=loadfile"]
        # These look at the repository, and at the planted error itself.
        skipped = ["--ignore=tests/test_package.py", "--ignore=tests/test_mutants.py"]
        witness, trouble = _run(copy, ["tests", *spread, *skipped])
    seconds = finding.seconds + time.perf_counter() - begin
    return Finding(finding.mutant, witness, seconds, whole_suite=True, trouble=trouble)


def failing_without_error(witnesses: Sequence[str]) -> set[str]:
    """Those of some tests that fail on an unchanged copy."""
    failing: set[str] = set()
    with copy_of_project() as copy:
        left = list(witnesses)
        while left:
            witness, trouble = _run(copy, left)
            if trouble:
                raise RuntimeError(f"control: {trouble}")
            if not witness:
                break
            failing.add(witness)
            left.remove(witness)
    return failing


@contextmanager
def copy_of_project() -> Iterator[Path]:
    """Give a copy of the project in a temporary folder."""
    with tempfile.TemporaryDirectory(prefix="earthspin-mutant-") as folder:
        copy = Path(folder).resolve()
        for entry in ROOT.iterdir():
            if entry.name in _COPIED:
                shutil.copytree(entry, copy / entry.name)
            elif entry.name not in _LEFT:
                (copy / entry.name).symlink_to(entry)
        yield copy


def plant(mutant: Mutant, copy: Path) -> None:
    """Put the error into a copy."""
    file = copy / mutant.file
    planted = mutant.planted_in(file.read_text(encoding="utf-8"))
    for stale in (file.parent / "__pycache__").glob(f"{file.stem}.*"):
        stale.unlink()
    file.write_text(planted, encoding="utf-8")


def _run(copy: Path, arguments: list[str]) -> tuple[str, str]:
    """Run pytest in a copy up to the first failure: which test it was, or what went wrong."""
    note = copy / "first-failure"
    note.unlink(missing_ok=True)
    command = [
        *(sys.executable, "-m", "pytest", "-x", "-q", "--tb=no", "--no-header"),
        # zarr's plugin would import all of zarr, for more than a second each time.
        *("-p", "no:cacheprovider", "-p", "no:zarr", "-p", "tests.mutants.witness"),
        *("-m", "not every_kill", *arguments),
    ]
    # Hypothesis draws the same examples each time, so that the control means something.
    environment = os.environ | {"PYTHONPATH": str(copy), "CI": "1", NOTE: str(note)}
    try:
        run = subprocess.run(
            command,
            cwd=copy,
            env=environment,
            capture_output=True,
            text=True,
            timeout=_LONGEST,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return "", f"no end within {_LONGEST:.0f} s"
    if note.exists():
        return note.read_text(encoding="utf-8"), ""
    if run.returncode != 0:
        return "", f"pytest ended with {run.returncode}: {(run.stdout + run.stderr)[-300:]}"
    return "", ""


def _words(finding: Finding) -> str:
    outcome = finding.trouble or finding.witness or "not noticed"
    return f"{finding.seconds:5.1f} s  {finding.mutant.name}: {outcome}"
