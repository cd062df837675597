"""The command line: report, run, plan, scenes, accuracy, stability, info."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

from earthspin._version import __version__
from earthspin.errors import EarthspinError, SceneError

CHECK_FAILED, USAGE_ERROR = 1, 2


class _Parser(argparse.ArgumentParser):
    """A parser whose complaints are one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(USAGE_ERROR, f"earthspin: {message}; see {self.prog} --help\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : sequence of str, optional
        Words after the command's name; those of the process by default.

    Returns
    -------
    int
        Exit status: 0; 1 if a check fails; 2 with one line on stderr if something given is
        wrong; 130 if interrupted, 141 if whoever read the output has gone.
    """
    given = _parser().parse_args(arguments)
    try:
        status: int | None = given.command(given)
        sys.stdout.flush()
    except EarthspinError as error:
        print(f"earthspin: {error}", file=sys.stderr)
        return USAGE_ERROR
    except KeyboardInterrupt:
        print("earthspin: interrupted; nothing was left half-written", file=sys.stderr)
        return 130
    except BrokenPipeError:
        # Whoever read our output has gone; the interpreter must not try to flush it again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    except OSError as error:
        print(f"earthspin: the output cannot be written: {error.strerror}", file=sys.stderr)
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return USAGE_ERROR
    return status or 0


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="earthspin",
        description="How an oblate, spinning body answers to what pulls on it.",
    )
    parser.add_argument("--version", action="version", version=f"earthspin {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=_Parser)

    report = commands.add_parser("report", help="print and write the precession or wobble report")
    report.add_argument(
        "topic", nargs="?", default="precession", choices=("precession", "wobble"), help="of what"
    )
    report.add_argument("--out", default="report", metavar="DIR", help="folder (default: report)")
    report.add_argument("--no-figures", action="store_true", help="tables alone, much faster")
    _add_ephemeris(report)
    report.set_defaults(command=_report)

    run = commands.add_parser("run", help="run a scene")
    run.add_argument("scene", help="name of a shipped scene, or a TOML file")
    run.add_argument("--out", metavar="DIR", help="folder to write the result to")
    run.add_argument("--json", action="store_true", help="print the result as JSON")
    _add_settings(run)
    run.set_defaults(command=_run)

    plan = commands.add_parser("plan", help="show what a scene needs, and what it leaves out")
    plan.add_argument("scene", help="name of a shipped scene, or a TOML file")
    _add_settings(plan)
    plan.set_defaults(command=_plan)

    accuracy = commands.add_parser("accuracy", help="measure error against run time")
    accuracy.add_argument("quantity", nargs="?", metavar="QUANTITY", help="all by default")
    accuracy.add_argument("--quick", action="store_true", help="short problems, few settings")
    accuracy.add_argument("--out", metavar="DIR", help="folder for data, figures and a page")
    accuracy.set_defaults(command=_accuracy)

    commands.add_parser("scenes", help="list the shipped scenes").set_defaults(command=_scenes)
    info = commands.add_parser("info", help="versions, kernels and their coverage")
    info.set_defaults(command=_info)

    stability = commands.add_parser("stability", help="run the stiff and extreme cases")
    stability.add_argument("--quick", action="store_true", help="only those that take a moment")
    stability.add_argument("--only", metavar="WORD", help="a part, or a word of a case's name")
    stability.add_argument("--long", action="store_true", help="also those that take minutes")
    stability.set_defaults(command=_stability)
    return parser


def _add_ephemeris(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--ephemeris", metavar="NAME|PATH", help="de421, de440, or the path of a .bsp file"
    )


def _add_settings(parser: argparse.ArgumentParser) -> None:
    _add_ephemeris(parser)
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        dest="settings",
        help="change a key of the scene, e.g. --set step='1 h'",
    )


def _report(given: argparse.Namespace) -> None:
    from earthspin.views.tables import print_tables

    if given.topic == "wobble":
        from earthspin.views.wobble_report import write_wobble_report

        results, written = write_wobble_report(given.out, figures=not given.no_figures)
    else:
        from earthspin.views.report import write_report

        result, written = write_report(
            given.out, ephemeris=given.ephemeris or "de421", figures=not given.no_figures
        )
        results = [result]
    for each in results:
        print_tables(each)
    for path in written:
        print(f"wrote {path}")


def _run(given: argparse.Namespace) -> None:
    from earthspin import storage
    from earthspin.calls import write_series
    from earthspin.scene.running import LONGEST_IN_MEMORY, run, series_length

    scene = _scene(given)
    name = Path(given.scene).stem
    if given.out is not None:
        storage.check_writable(given.out)
        if series_length(scene) > LONGEST_IN_MEMORY:
            if given.json:
                raise SceneError("--json", "a long series", "leave it out; read the Zarr store")
            print(f"wrote {write_series(scene, Path(given.out) / f'{name}.zarr')}")
            return
    result = run(scene)
    if given.json:
        print(_json(result))
    else:
        from earthspin.views.tables import print_tables

        print_tables(result)
    if given.out is not None:
        from earthspin.views.report import scene_views

        place = Path(given.out)
        with (
            storage.replacing(place / f"{name}.html") as page,
            storage.replacing(place / f"{name}.nc") as data,
        ):
            page.write_text(scene_views(result), encoding="utf-8")
            storage.write_netcdf(result, data)
        for path in (place / f"{name}.html", place / f"{name}.nc"):
            print(f"wrote {path}", file=sys.stderr if given.json else sys.stdout)


def _plan(given: argparse.Namespace) -> None:
    from earthspin.scene.planning import plan
    from earthspin.scene.running import chosen

    planned = plan(_scene(given))
    print(planned)
    if planned.scene.accuracy is not None:
        words = ", ".join(chosen(planned)) or "no settings to choose"
        print(
            f"\nchosen for an accuracy of {planned.scene.accuracy}: {words}\n"
            "(whether the body's numbers and the kernel allow it shows when it runs)"
        )


def _accuracy(given: argparse.Namespace) -> int:
    from earthspin import storage
    from earthspin.checks.work_precision import QUANTITIES, accuracy
    from earthspin.views.work_precision_views import print_accuracy, write_accuracy

    if given.out is not None:
        storage.check_writable(given.out)
    results = []
    for quantity in QUANTITIES if given.quantity is None else [given.quantity]:
        results.append(accuracy(quantity, quick=given.quick))
        print_accuracy(results[-1:])
    if given.out is not None:
        for path in write_accuracy(results, given.out):
            print(f"wrote {path}")
    return int(not all(result.holds.all() for result in results))


def _scenes(given: argparse.Namespace) -> None:
    from earthspin.scene.spec import shipped_scenes

    scenes = shipped_scenes()
    width = max(map(len, scenes))
    for name, title in scenes.items():
        print(f"{name:<{width}}  {title}")


def _info(given: argparse.Namespace) -> None:
    from importlib.metadata import PackageNotFoundError, version

    print(f"earthspin {__version__}, Python {sys.version.split()[0]}")
    for package in ("numpy", "scipy", "xarray", "astropy", "pyerfa", "skyfield", "jplephem"):
        try:
            print(f"  {package:<10} {version(package)}")
        except PackageNotFoundError:
            print(f"  {package:<10} not installed")
    print("kernels")
    from earthspin.sky.ephemeris import NAMED_KERNELS, describe_kernel

    for name in NAMED_KERNELS:
        print(f"  {name:<10} {describe_kernel(name)}")


def _stability(given: argparse.Namespace) -> int:
    from earthspin.checks.case import FAILS
    from earthspin.checks.gauntlet import stability, tally
    from earthspin.views.gauntlet_views import print_verdicts

    result = stability(quick=given.quick, only=given.only, long=given.long)
    print_verdicts(result)
    return CHECK_FAILED if tally(result)[FAILS] else 0


def _scene(given: argparse.Namespace) -> Any:
    """Scene of the command line: the file, then --set, then --ephemeris."""
    from earthspin.scene.spec import load_scene

    changes = dict(_setting(text) for text in given.settings)
    if given.ephemeris is not None:
        changes["ephemeris"] = given.ephemeris
    return load_scene(given.scene, changes)


def _setting(text: str) -> tuple[str, Any]:
    """Read KEY=VALUE; the value as TOML if it is that, as text otherwise."""
    import tomllib

    key, equals, value = text.partition("=")
    if not equals or not key.strip():
        raise SceneError("--set", text, "write it as KEY=VALUE", source="command line")
    try:
        return key.strip(), tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        return key.strip(), value.strip()


def _json(result: Any) -> str:
    """A result as JSON: dates as text, and infinity as text, for which JSON has no number."""
    import json
    import math

    def plain(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: plain(inner) for key, inner in value.items()}
        if isinstance(value, (list, tuple)):
            return [plain(inner) for inner in value]
        if hasattr(value, "isoformat"):
            return value.isoformat()
        if isinstance(value, float) and not math.isfinite(value):
            return str(value)
        return value

    return json.dumps(plain(result.to_dict()), indent=1)
