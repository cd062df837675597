"""`python -m data_tools VERB ...`: make data that the package ships, and the tables of its pages.

Each verb is a module with a function `main`, which takes the other words of the command line.
"""

from __future__ import annotations

import importlib
import sys

from earthspin.errors import EarthspinError

VERBS = {
    "verify": "check the hashes of the kernels that are installed",
    "audit": "check the installed dependencies for known vulnerabilities",
    "cf": "check files of every question against the CF conventions",
    "constants": "list every cited number and where it was read, for docs/measured/constants.md",
    "signatures": "write the signatures of the public calls, and the index of the reference",
    "coverage": "measure how often claimed errors contain independent results; names of topics",
    "neglected": "measure how far the response of the interior moves the axis of the Earth",
    "orbits": "make the tables of orbits over ten million years from a kernel (de440)",
    "nutation": "make the table of nutation by IAU 2000A that is analysed",
    "librations": "make the table of states of the Moon from DE421's librations; folder of de421",
    "moon": "measure how far the rotation of the Moon is from DE421; folder of de421",
    "forecast": "measure the skill of forecasts of pole and UT1; folder of releases, if not of pip",
    "free-wobble": "measure how often the intervals of the free wobble contain the truth",
    "pole-offsets": "measure predictions of the celestial pole offsets",
    "worlds": "compare the precession of every world with published rates",
    "readme-picture": "draw the picture of the README",
}


def main(words: list[str] | None = None) -> int:
    """Run a verb; return 0 if all is well, 1 if a check fails, 2 if the input is wrong."""
    verb, *others = words or sys.argv[1:] or [""]
    if verb not in VERBS:
        print(__doc__, *(f"{name:15} {text}" for name, text in VERBS.items()), sep="\n")
        return 2
    tool = importlib.import_module(f"data_tools.{verb.replace('-', '_')}")
    try:
        return int(tool.main(*others))
    except EarthspinError as error:
        print(f"data_tools: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
