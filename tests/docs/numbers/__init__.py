"""Every number of the pages that is measured, and what makes it again; one module a subject.

A page computes its numbers when it is built. Those that take longer are functions in `VALUES` of a
module; `python -m tests.docs.numbers` stores their results, the page reads them, and `make numbers`
compares them with new measurements.

Pages that do not compute their numbers yet have sentences in `MEASURED` and `TOLD`, with `{}` for
each number: a test finds the sentence, reads the numbers and compares.
"""

from pathlib import Path

#: Values that pages read.
STORED = Path(__file__).parents[3] / "docs" / "measured" / "values.json"

PAGES = (
    "pole",
    "iau",
    "nutation",
    "wobble",
    "observed_pole",
    "pole_offsets",
    "trust",
    "rotors",
    "skyfield",
    "frames",
    "long_term",
    "worlds",
    "rotation",
    "course",
    "examples",
    "gallery",
    "paper",
)
