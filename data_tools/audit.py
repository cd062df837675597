"""Check the installed dependencies for known vulnerabilities, with pip-audit."""

from __future__ import annotations

import json
import subprocess
import sys


def main(*options: str) -> int:
    """Run pip-audit, print what it finds, and return 1 if a dependency has a known vulnerability.

    Without a network, a line says so, and the check passes.
    """
    command = [sys.executable, "-m", "pip_audit", "--format=json", "--progress-spinner=off"]
    ended = subprocess.run([*command, *options], capture_output=True, text=True, check=False)
    return judge(ended.stdout, ended.stderr)


def judge(report: str, problem: str) -> int:
    """Print the vulnerabilities in a report of pip-audit (JSON); return 1 if there are any."""
    packages = json.loads(report)["dependencies"] if report else []
    audited = [package for package in packages if "vulns" in package]
    faults = [(package, fault) for package in audited for fault in package["vulns"]]
    for package, fault in faults:
        fixed = ", ".join(fault["fix_versions"]) or "no version"
        print(f"{package['name']} {package['version']}: {fault['id']}, fixed in {fixed}")
    if not audited:
        reason = next((p["skip_reason"] for p in packages), problem.strip().rpartition("\n")[2])
        print(f"dependencies not audited, without a network or an index that knows them: {reason}")
        return int("No module named" in reason)
    print(f"{len(audited)} of {len(packages)} dependencies audited: {len(faults)} vulnerabilities")
    return int(bool(faults))
