"""``python -m tests.mutants [NAME ...] [--page FILE]``: plant errors, demand that tests fail."""

import argparse
import sys
from pathlib import Path

from tests.mutants.catalogue import load
from tests.mutants.runner import hunt
from tests.mutants.tables import page, table, tally


def main() -> int:
    """Plant the errors; 0 if every one was caught, else 1."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="only these; all by default")
    parser.add_argument("--page", type=Path, metavar="FILE", help="write the table as Markdown")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="how many at a time")
    given = parser.parse_args()
    mutants = load()
    unknown = set(given.names) - {mutant.name for mutant in mutants}
    if unknown:
        parser.error(f"no such mutant: {', '.join(sorted(unknown))}")
    chosen = [mutant for mutant in mutants if not given.names or mutant.name in given.names]

    findings, seconds = hunt(chosen, jobs=given.jobs)
    print(f"\n{table(findings)}\n\n{tally(findings, seconds)}")
    if given.page:
        given.page.parent.mkdir(parents=True, exist_ok=True)
        given.page.write_text(page(findings, seconds), encoding="utf-8")
    return 0 if all(finding.caught for finding in findings) else 1


if __name__ == "__main__":
    sys.exit(main())
