"""What became of the planted errors, as text and as a page of the documentation."""

from collections import Counter
from collections.abc import Sequence

from tests.mutants.runner import Finding

HEADERS = ("mutant", "kind", "file", "caught by", "s")


def table(findings: Sequence[Finding]) -> str:
    """Columns of plain text."""
    rows = [HEADERS, *(_row(finding) for finding in findings)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(HEADERS) - 1)]
    return "\n".join(
        "  ".join([*(f"{cell:{w}}" for cell, w in zip(row, widths, strict=False)), f"{row[-1]:>5}"])
        for row in rows
    )


def tally(findings: Sequence[Finding], seconds: float) -> str:
    """How many were caught, and what survived."""
    caught = sum(finding.caught for finding in findings)
    lines = [
        f"{caught} of {len(findings)} planted errors caught in {seconds / 60:.1f} minutes",
        *(
            f"survived: {f.mutant.name} ({f.mutant.file}) {f.trouble}"
            for f in findings
            if not f.caught
        ),
    ]
    return "\n".join(lines)


def page(findings: Sequence[Finding], seconds: float) -> str:
    """A page in Markdown."""
    planted = Counter(package(finding.mutant.file) for finding in findings)
    caught = Counter(package(finding.mutant.file) for finding in findings if finding.caught)
    lines = [
        "# Planted errors, as measured",
        "",
        "Written by `make mutants`. Each error was planted alone in a copy of the package; the",
        "test named is the first that failed, and it passes without the error.",
        "",
        f"**{sum(caught.values())} of {len(findings)} caught**, in {seconds / 60:.0f} minutes.",
        "",
        "| package | planted | caught |",
        "|---|---|---|",
        *(f"| `{name}` | {count} | {caught[name]} |" for name, count in sorted(planted.items())),
        "",
        "| planted error | kind | file | caught by | s |",
        "|---|---|---|---|---|",
        *("| " + " | ".join(_marked(_row(finding))) + " |" for finding in findings),
        "",
    ]
    return "\n".join(lines)


def package(file: str) -> str:
    """Package, or module beside the packages, that a file belongs to."""
    return file.split("/")[1]


def _row(finding: Finding) -> tuple[str, ...]:
    mutant = finding.mutant
    witness = finding.witness.removeprefix("tests/") if finding.caught else "SURVIVED"
    witness = " ".join(witness.split())  # names of cases may run over lines
    return (
        mutant.name,
        mutant.kind,
        mutant.file.removeprefix("earthspin/"),
        witness + (" (whole suite)" if finding.whole_suite and finding.caught else ""),
        f"{finding.seconds:.1f}",
    )


def _marked(row: tuple[str, ...]) -> list[str]:
    name, kind, file, witness, seconds = (cell.replace("|", "\\|") for cell in row)
    return [name, kind, f"`{file}`", f"`{witness}`", seconds]
