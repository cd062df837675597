"""`python -m data_tools VERB`."""

from __future__ import annotations

import argparse
import sys

from data_tools import (
    accuracy_pages,
    cf,
    constants_page,
    core_resonance,
    coverage,
    driven_wobble,
    earth_rotation,
    forecast,
    free_wobble,
    hashes,
    kernels,
    long_term,
    lunar_rotation,
    neglected,
    pole_offsets,
    readme_picture,
    references,
    secular_orbits,
    signatures,
    windows,
    worlds,
)
from earthspin.checks.work_precision import QUANTITIES
from earthspin.errors import EarthspinError

VERBS = {
    "verify": (hashes.main, "check the hashes of the kernels that are found"),
    "cf": (cf.main, "check files of every question against the CF conventions"),
    "kernels": (kernels.main, "measure how far two kernels are apart, body by body"),
    "neglected": (neglected.main, "measure how far each effect moves the axis of the Earth"),
    "earth-rotation": (
        earth_rotation.main,
        "measure how far the Earth departs from an even spin about its figure axis",
    ),
    "lunar-rotation": (
        lunar_rotation.main,
        "measure how far effects that a rigid body leaves out turn the Moon",
    ),
    "windows": (windows.main, "measure how far averages about many epochs scatter"),
    "accuracy-pages": (
        accuracy_pages.main,
        "measure error against run time, for docs/work_precision.md",
    ),
    "constants": (constants_page.main, "list every cited number and where it was read"),
    "coverage": (
        coverage.main,
        "measure how often claimed errors contain independent results, for docs/coverage.md",
    ),
    "free-wobble": (
        free_wobble.main,
        "measure how often the intervals of the free wobble hold the truth, for docs/wobble.md",
    ),
    "driven-wobble": (
        driven_wobble.main,
        "fit the free wobble with the excitation in files, for docs/wobble.md",
    ),
    "forecast": (
        forecast.main,
        "measure the skill of the forecast of the pole, for docs/forecast.md",
    ),
    "core-resonance": (
        core_resonance.main,
        "measure on what the resonance of the core rests, for docs/pole.md and docs/nutation.md",
    ),
    "long-term": (long_term.main, "measure what docs/long_term.md says in its tables"),
    "orbits": (secular_orbits.main, "make the tables of orbits over ten million years again"),
    "readme-picture": (readme_picture.main, "draw the picture of the README"),
    "references": (references.main, "make the stored references of the checks again"),
    "signatures": (signatures.main, "write the signatures of the public calls for editors"),
    "pole-offsets": (
        pole_offsets.main,
        "measure predictions of the celestial pole offsets, for docs/pole_offsets.md",
    ),
    "worlds": (worlds.main, "measure the precession of every world, for docs/worlds.md"),
}
#: Verbs that compare with a kernel.
WITH_KERNEL = ("kernels", "windows", "orbits")
#: Verbs that read files of angular momentum.
WITH_EXCITATION = ("driven-wobble", "forecast")
#: Verbs that do several things, of which some may be named.
OF_SEVERAL = {
    "accuracy-pages": tuple(QUANTITIES),
    "references": tuple(references.MAKERS),
    "coverage": coverage.TOPICS,
}


def main(words: list[str] | None = None) -> int:
    """Run a verb; 0 if all is well, 1 if a check fails, 2 if something given is wrong."""
    parser = argparse.ArgumentParser(prog="python -m data_tools", description=__doc__)
    verbs = parser.add_subparsers(dest="verb", required=True)
    for verb, (_, words_of) in VERBS.items():
        command = verbs.add_parser(verb, help=words_of)
        if verb in WITH_KERNEL:
            command.add_argument("--kernel", default="de440", help="name or path (default: de440)")
        if verb in OF_SEVERAL:
            command.add_argument(
                "--only", choices=OF_SEVERAL[verb], help="one of them (default: all)"
            )
        if verb == "long-term":
            command.add_argument(
                "--solutions", nargs="+", help="files of other solutions to compare"
            )
        if verb in WITH_EXCITATION:
            command.add_argument(
                "--excitation",
                nargs="+",
                metavar="FOLDER",
                required=verb == "driven-wobble",
                help="folders of files of angular momentum; forecast: score hindcasts with them",
            )
        if verb == "orbits":
            command.add_argument(
                "--left-out", action="store_true", help="measure what the tables leave out instead"
            )
    arguments = parser.parse_args(words)
    try:
        return VERBS[arguments.verb][0](arguments)
    except EarthspinError as error:
        print(f"data_tools: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
