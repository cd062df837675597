"""Check files against the CF conventions: every section of a file of every question.

A checker sees the root of a file alone, so that each section is written as a file of its own.
The date in the history is the only thing about it that a file of ours has besides.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import xarray as xr

import earthspin
from earthspin.engine.store import write_netcdf
from earthspin.scenes import shipped_scenes

STANDARD = "cf:1.11"
#: The checker takes whatever is called `time` for a date, though CF gives names no meaning: that of
#: rotors and tops counts seconds from their start.
TIME_FROM_START = "Coordinate variable 'time' should have standard_name='time', found: 'None'"


def main() -> int:
    """Write and check; print every finding; 1 if one of them is an error."""
    with tempfile.TemporaryDirectory() as folder:
        files = sections(Path(folder))
        problems = {name: findings(path) for name, path in files.items()}
    for name, lines in problems.items():
        for line in lines:
            print(f"{name}: {line}")
    wrong = sum(map(bool, problems.values()))
    scenes = len(shipped_scenes())
    print(f"{len(files)} sections of {scenes} scenes, {wrong} with errors of {STANDARD}")
    return 1 if wrong else 0


def sections(folder: Path) -> dict[str, Path]:
    """Write the answer of each shipped scene, and each section with what it inherits."""
    files: dict[str, Path] = {}
    for scene in shipped_scenes():
        for path, node in earthspin.run_tree(scene).subtree_with_keys:
            name = scene if path == "." else f"{scene}/{path}"
            files[name] = folder / f"{name.replace('/', '-')}.nc"
            write_netcdf(node.to_dataset(), files[name])
    return files


def findings(path: Path) -> list[str]:
    """What a compliance checker holds to be wrong with a file; empty if nothing."""
    from compliance_checker.runner import CheckSuite

    suite = CheckSuite()
    suite.load_all_available_checkers()
    results = suite.run_all(suite.load_dataset(str(path)), [STANDARD])
    problems: list[str] = []
    for checks, failures in results.values():
        problems += [f"the check failed: {name}: {why}" for name, why in failures.items()]
        for check in checks:
            problems += _errors(check)
    with xr.open_dataset(path) as answer:
        from_start = "time" in answer.coords and answer.time.attrs.get("units") == "s"
    return [line for line in problems if not (from_start and TIME_FROM_START in line)]


def _errors(check: Any) -> list[str]:
    """Messages of a check of high priority that did not reach its score."""
    from compliance_checker.base import BaseCheck

    if check.weight < BaseCheck.HIGH or not isinstance(check.value, tuple):
        return [] if check.weight < BaseCheck.HIGH or check.value else [*check.msgs]
    reached, possible = check.value
    return [f"{check.name}: {line}" for line in check.msgs] if reached < possible else []
