"""Copies of the project, and runs of pytest there. The checkout is never changed."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tests.mutants.changes import Change

#: Tests of the first run of pytest, which collects less than the second.
_FIRST = 8
#: Memory in kB, since a changed step or size can ask for any amount; and a time in s for runs that
#: wait, which a limit of processor time does not end.
_MEMORY, _WAIT = 6 << 20, 3600.0
#: The plugin of zarr imports all of zarr. Hypothesis tries the same examples each time under CI.
_FIXED = ["-q", "--tb=no", "--no-header", "-p", "no:cacheprovider", "-p", "no:zarr", "-n", "0"]
_ENVIRONMENT = {"CI": "1", "OPENBLAS_NUM_THREADS": "1"}


def copied(root: Path, copy: Path) -> Path:
    """Copy the project without what is built or installed there."""
    without = shutil.ignore_patterns(".*", "__pycache__", "_build", "build", "dist", "report")
    return Path(shutil.copytree(root, copy, ignore=without))


def noticed_by(copy: Path, change: Change, seconds: Mapping[str, float]) -> str:
    """Return the first of some tests that fails with a change, or what else ended the run.

    The tests come with their usual times in seconds. An empty text is returned if all pass.
    """
    tests = list(seconds)
    try:
        _write(copy / change.file, change.after)
        for part in filter(None, (tests[:_FIRST], tests[_FIRST:])):
            limit = str(60 + 3 * round(sum(seconds[test] for test in part)))
            ended = run_tests(copy, part, ["-x"], limit)
            if ended.returncode == 4 and "not found:" in ended.stderr:
                # A number in the name of a case has changed.
                files = sorted({test.partition("::")[0] for test in part})
                ended = run_tests(copy, files, ["-x"], limit)
            if ended.returncode == -15:  # SIGTERM: not by the limits
                raise InterruptedError(f"{change.place}: the tests were ended from outside")
            if ended.returncode:
                failed = re.search(r"(?m)^(?:FAILED|ERROR) (.+?)(?: - |$)", ended.stdout)
                return failed[1] if failed else f"pytest ended with {ended.returncode}"
        return ""
    except subprocess.TimeoutExpired:
        return "no end"
    finally:
        _write(copy / change.file, change.before)


def run_tests(
    copy: Path, tests: Sequence[str], options: Sequence[str], limit: str, lines: str = ""
) -> subprocess.CompletedProcess[str]:
    """Run tests in a copy, with a limit of processor time; ``lines`` is a file for coverage."""
    (copy / "chosen-tests").write_text("\n".join(tests), encoding="utf-8")
    limits = f'ulimit -v {_MEMORY} -t {limit} && exec "$@"'
    command = ["bash", "-c", limits, "bash", sys.executable, "-m", "pytest", *_FIXED, *options]
    path = os.pathsep.join([str(copy), os.environ.get("PYTHONPATH", "")])
    environment = os.environ | _ENVIRONMENT | {"PYTHONPATH": path, "COVERAGE_FILE": lines}
    asked: dict[str, Any] = {"cwd": copy, "env": environment, "timeout": _WAIT, "text": True}
    return subprocess.run([*command, "@chosen-tests"], **asked, capture_output=True, check=False)


def _write(file: Path, text: str) -> None:
    """Write a module; a compiled one of the same size and second would be taken for it."""
    for stale in (file.parent / "__pycache__").glob(f"{file.stem}.*"):
        stale.unlink()
    file.write_text(text, encoding="utf-8")
