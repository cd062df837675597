"""The command line: report, play, run, ensemble, plan, scenes, keys, accuracy, stability, ..."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from earthspin._version import __version__
from earthspin.errors import EarthspinError, SceneError, printable
from earthspin.process import CHECK_FAILED, RESULTS, USAGE_ERROR, run_command

if TYPE_CHECKING:
    from earthspin.engine.question import Question


#: Pages to play with.
PAGES = ("precession", "rotor", "top", "wobble")

#: What the command says that is given alone; a line has at most 80 characters.
WELCOME = """\
earthspin: how an oblate, spinning body answers to what pulls on it.

Three to begin with:
  earthspin report --open     the precession of the Earth, with a page to read
  earthspin play top --open   a heavy top, to play with
  earthspin run torque        the pull of Sun and Moon through a year

And then:
  earthspin scenes            what else is there to run
  earthspin keys QUESTION     what can be changed, as in: keys precession
  earthspin --help            all commands
"""


class _Parser(argparse.ArgumentParser):
    """A parser whose complaints are one line."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.add_argument(
            "--traceback", action="store_true", help="show where an error arose, after its line"
        )

    def error(self, message: str) -> NoReturn:
        line = EarthspinError(f"earthspin: {message}; see {self.prog} --help")
        self.exit(USAGE_ERROR, f"{line}\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : sequence of str, optional
        Words after the command's name; those of the process by default.

    Returns
    -------
    int
        Exit status: 0, also if no command is given, which says what to try; 1 if a check fails; 2
        with one line on stderr if something given is wrong; 70 for a defect of earthspin; others as
        `earthspin.process.run_command` has them.
    """
    parser = _parser()
    _complete(parser)

    def command() -> int | None:
        given = parser.parse_args(arguments)
        status: int | None = given.command(given)
        return status

    words = sys.argv[1:] if arguments is None else arguments
    return run_command(command, show_traceback="--traceback" in words)


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="earthspin",
        description="How an oblate, spinning body answers to what pulls on it.",
    )
    parser.add_argument("--version", action="version", version=f"earthspin {__version__}")
    commands = parser.add_subparsers(metavar="COMMAND", parser_class=_Parser)
    parser.set_defaults(command=_welcome)

    report = commands.add_parser("report", help="print and write the precession or wobble report")
    report.add_argument(
        "topic", nargs="?", default="precession", choices=("precession", "wobble"), help="of what"
    )
    report.add_argument("--out", default="report", metavar="DIR", help="folder (default: report)")
    report.add_argument("--no-figures", action="store_true", help="tables alone, much faster")
    report.add_argument("--open", action="store_true", help="open the page in the browser")
    _add_ephemeris(report)
    report.set_defaults(command=_report)

    play = commands.add_parser("play", help="write a page to play with")
    play.add_argument("what", choices=PAGES, help="of what")
    play.add_argument("--out", metavar="FILE", help="default: play-WHAT.html")
    play.add_argument("--open", action="store_true", help="open the page in the browser")
    play.set_defaults(command=_play)

    run = commands.add_parser("run", help="run a scene", add_help=False)
    _add_scene(run)
    run.add_argument(
        "--out", metavar="DIR|FILE", help="folder for a page and the data, or a .nc or .zarr file"
    )
    run.add_argument("--json", action="store_true", help="print the result as JSON")
    _add_sections(run, "default: none on the screen, all with --out")
    run.set_defaults(command=_run)

    many = commands.add_parser(
        "ensemble", help="run a scene for many members whose numbers differ", add_help=False
    )
    _add_scene(many)
    many.add_argument(
        "--members",
        metavar="N|FILE",
        help="how many, or a .csv, .nc or .zarr with their values (default: what the scene says)",
    )
    many.add_argument("--seed", type=int, metavar="N", help="of the random numbers (default: 0)")
    many.add_argument("--out", required=True, metavar="X.zarr", help="store, gone on with if begun")
    cluster = many.add_mutually_exclusive_group()
    cluster.add_argument("--workers", type=int, metavar="N", help="start a cluster of N here")
    cluster.add_argument("--scheduler", metavar="ADDRESS", help="join one, like tcp://host:8786")
    many.add_argument("--block", type=int, metavar="N", help="members that are kept at a time")
    many.add_argument(
        "--drop", action="store_true", help="leave out members that cannot exist, counted"
    )
    many.add_argument("--json", action="store_true", help="print progress as lines of JSON")
    many.set_defaults(command=_ensemble)

    plan = commands.add_parser(
        "plan", help="show what a scene needs, and what it leaves out", add_help=False
    )
    _add_scene(plan)
    _add_sections(plan, "default: none")
    plan.add_argument("--script", action="store_true", help="the parts as a plain script")
    plan.set_defaults(command=_plan)

    accuracy = commands.add_parser("accuracy", help="measure error against run time")
    quantity = accuracy.add_argument(
        "quantity", nargs="?", metavar="QUANTITY", help="all by default"
    )
    quantity.completer = _quantities  # type: ignore[attr-defined]
    accuracy.add_argument("--quick", action="store_true", help="short problems, few settings")
    accuracy.add_argument("--out", metavar="DIR", help="folder for data, figures and a page")
    accuracy.set_defaults(command=_accuracy)

    commands.add_parser("scenes", help="list the shipped scenes").set_defaults(command=_scenes)
    keys = commands.add_parser("keys", help="list what can be asked, question by question")
    question = keys.add_argument("question", nargs="?", help="all by default")
    question.completer = _words  # type: ignore[attr-defined]
    keys.set_defaults(command=_keys)
    info = commands.add_parser("info", help="versions and kernels; or what is known of bodies")
    info.add_argument("what", nargs="?", choices=("bodies",), help="bodies: list them")
    info.add_argument("name", nargs="?", metavar="NAME", help="each number of one, and its source")
    info.set_defaults(command=_info)

    verify = commands.add_parser("verify", help="hold a result on disk to its checksums")
    verify.add_argument("file", metavar="FILE", help="a .nc file or a .zarr folder of ours")
    verify.set_defaults(command=_verify)

    stability = commands.add_parser("stability", help="run the stiff and extreme cases")
    stability.add_argument("--quick", action="store_true", help="only those that take a moment")
    stability.add_argument("--only", metavar="WORD", help="a part, or a word of a case's name")
    stability.add_argument("--long", action="store_true", help="also those that take minutes")
    stability.set_defaults(command=_stability)

    completion = commands.add_parser("completion", help="print what a shell needs to complete")
    completion.add_argument("shell", choices=("bash", "zsh", "fish"))
    completion.set_defaults(command=_completion)
    return parser


class _ShowHelp(argparse.Action):
    """Help of a command, and of the scene's keys where one is named before it."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(nargs=0, **kwargs)

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: object,
        option_string: str | None = None,
    ) -> NoReturn:
        """Print and leave."""
        parser.print_help()
        scene = getattr(namespace, "scene", None)
        if scene is not None:
            try:
                print(f"\n{_keys_of(scene)}")
            except EarthspinError as error:
                parser.error(str(error))
        parser.exit()


def _add_scene(parser: argparse.ArgumentParser) -> None:
    """Arguments of every command that takes a scene."""
    scene = parser.add_argument(
        "scene", help="name of a shipped scene, a TOML file, or a file with a result"
    )
    scene.completer = _scenes_and_files  # type: ignore[attr-defined]
    _add_ephemeris(parser)
    settings = parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        dest="settings",
        help="change a key of the scene, e.g. --set step='1 h'",
    )
    settings.completer = _key_words  # type: ignore[attr-defined]
    parser.add_argument(
        "-h", "--help", action=_ShowHelp, help="show this, and the keys of a scene named before"
    )


def _add_sections(parser: argparse.ArgumentParser, default: str) -> None:
    sections = parser.add_argument(
        "--sections", metavar="NAMES|all", help=f"what to tell beside the answer ({default})"
    )
    sections.completer = _section_names  # type: ignore[attr-defined]


def _add_ephemeris(parser: argparse.ArgumentParser) -> None:
    kernel = parser.add_argument(
        "--ephemeris", metavar="NAME|PATH", help="de421, de440, or the path of a .bsp file"
    )
    kernel.completer = _kernels  # type: ignore[attr-defined]


def _report(given: argparse.Namespace) -> None:
    from earthspin.views.of_question import print_tables

    if given.topic == "wobble":
        from earthspin.views.report import write_wobble_report

        if given.ephemeris is not None:
            raise SceneError("--ephemeris", given.ephemeris, "the wobble report needs no kernel")
        results, written = write_wobble_report(given.out, figures=not given.no_figures)
    else:
        from earthspin.views.report import write_report

        kernel = "de421" if given.ephemeris is None else given.ephemeris
        result, written = write_report(
            given.out,
            ephemeris=kernel,
            figures=not given.no_figures,
        )
        results = [result]
    for each in results:
        print_tables(each)
    for path in written:
        print(f"wrote {printable(str(path))}")
    if given.open:
        _open(written[0])


def _play(given: argparse.Namespace) -> None:
    from earthspin.views.play import write_page

    path = write_page(given.what, given.out or f"play-{given.what}.html")
    print(f"wrote {printable(str(path))}")
    if given.open:
        _open(path)


def _open(page: Path) -> None:
    """Open a page in the browser that the system prefers, or say that there is none."""
    import webbrowser

    if not webbrowser.open(page.resolve().as_uri()):
        print("no browser could be opened; open the page by hand", file=sys.stderr)


def _welcome(_given: argparse.Namespace) -> None:
    print(WELCOME, end="")


def _run(given: argparse.Namespace) -> None:
    from earthspin.engine import drafts
    from earthspin.parts import times
    from earthspin.scenes import members_of, run_tree, series_length, write_series

    question = _question(given)
    target = None if given.out is None else Path(given.out)
    name = Path(given.scene).stem
    if target is not None:
        is_file = target.suffix in (".nc", ".zarr")
        drafts.check_writable(target.parent if is_file else target)
        if series_length(question) * members_of(question) > times.LONGEST_IN_MEMORY:
            if given.json:
                raise SceneError("--json", "a long series", "leave it out; read the Zarr store")
            place = target if target.suffix == ".zarr" else target / f"{name}.zarr"
            print(f"wrote {printable(str(write_series(question, place)))}")
            return
    wanted = _sections(given)
    everything = target is not None and wanted is None
    tree = run_tree(question, "all" if everything else wanted or ())
    written = [] if target is None else [_store(tree, target, name)]
    with _note_of_results([*written]):
        if target is not None and written != [target]:
            written.insert(0, _write_page(tree, target, name))
        if given.json:
            from earthspin.views.as_json import write_json

            write_json(tree, sys.stdout)
        else:
            from earthspin.views.of_question import print_tables

            print_tables(tree)
            _say_what_else(question, tree)
    for path in written:
        print(f"wrote {printable(str(path))}", file=sys.stderr if given.json else sys.stdout)


def _ensemble(given: argparse.Namespace) -> None:
    import json
    from contextlib import nullcontext

    from earthspin.many import ensemble
    from earthspin.progress import lines_to

    members = given.members
    if members is not None and members.lstrip("+-").isdecimal():
        members = int(members)
    client = given.scheduler if given.workers is None else given.workers
    with lines_to(sys.stdout) if given.json else nullcontext():
        answer = ensemble(
            _question(given),
            members,
            seed=given.seed,
            path=given.out,
            client=client,
            block=given.block,
            impossible="drop" if given.drop else None,
        )
    if given.json:
        print(json.dumps({"wrote": given.out, "members": answer.sizes["member"]}))
        return
    from earthspin.views.of_question import print_tables

    with _note_of_results([Path(given.out)]):
        print_tables(answer)
    print(f"wrote {printable(given.out)}")


def _store(tree: Any, target: Path, name: str) -> Path:
    """Write the results: one file, or the data of a folder."""
    from earthspin.engine import store

    is_file = target.suffix in (".nc", ".zarr")
    return store.write(tree, target if is_file else target / f"{name}.nc")


def _write_page(tree: Any, folder: Path, name: str) -> Path:
    from earthspin.engine import drafts
    from earthspin.views.of_question import scene_page

    page = folder / f"{name}.html"
    with drafts.replacing(page) as draft:
        draft.write_text(scene_page(tree), encoding="utf-8")
    return page


@contextmanager
def _note_of_results(stored: Sequence[Path]) -> Iterator[None]:
    """Add to whatever ends the views where the results are, which are stored before."""
    try:
        yield
    except BaseException as error:
        for path in stored:
            error.add_note(f"{RESULTS} {path}")
        raise


def _say_what_else(question: Question, tree: Any) -> None:
    """Name the sections that were not asked for."""
    others = [name for name in question.graph.sections if name not in tree.children]
    if others and not tree.children.keys() - {"plan"}:
        print(f"More: --sections {','.join(others)}, or all")


def _plan(given: argparse.Namespace) -> None:
    from earthspin.scenes import chosen, plan

    question = _question(given)
    if given.script:
        from earthspin.engine.asking import script_of

        print(script_of(type(question)))
        return
    print(plan(question, _sections(given) or ()))
    accuracy = getattr(question, "accuracy", None)
    if accuracy is not None:
        asked = question.to_table()["accuracy"]
        words = ", ".join(chosen(question)) or "no settings to choose"
        print(
            f"\nchosen for an accuracy of {asked}: {words}\n"
            "(whether the body's numbers and the kernel allow it shows when it runs)"
        )


def _sections(given: argparse.Namespace) -> str | list[str] | None:
    """Names after --sections; None if they are not named."""
    if given.sections is None or given.sections.strip() == "all":
        return None if given.sections is None else "all"
    return [name.strip() for name in given.sections.split(",") if name.strip()]


def _keys(given: argparse.Namespace) -> None:
    from earthspin.engine.question import describe_keys
    from earthspin.scenes import QUESTIONS, question_named

    words = QUESTIONS if given.question is None else [given.question]
    print("\n\n".join(f"compute = {w!r}\n\n{describe_keys(question_named(w))}" for w in words))


def _keys_of(scene: str) -> str:
    """Keys and sections of the question that a scene asks."""
    from earthspin.engine.question import describe_keys
    from earthspin.scenes import load_scene

    question = type(load_scene(scene))
    sections = ", ".join(question.graph.sections)
    return f"keys of {scene}:\n\n{describe_keys(question)}\n\nsections: {sections}"


def _accuracy(given: argparse.Namespace) -> int:
    from earthspin.checks.work_precision import QUANTITIES, accuracy
    from earthspin.engine import drafts
    from earthspin.views.work_precision_views import (
        print_accuracy,
        store_accuracy,
        write_accuracy,
    )

    if given.out is not None:
        drafts.check_writable(given.out)
    results = []
    for quantity in QUANTITIES if given.quantity is None else [given.quantity]:
        results.append(accuracy(quantity, quick=given.quick))
        if given.out is not None:
            store_accuracy(results[-1], given.out)
        print_accuracy(results[-1:])
    if given.out is not None:
        for path in write_accuracy(results, given.out):
            print(f"wrote {printable(str(path))}")
    return int(not all(result.holds.all() for result in results))


def _scenes(given: argparse.Namespace) -> None:
    from earthspin.scenes import shipped_scenes

    scenes = shipped_scenes()
    width = max(map(len, scenes))
    for name, title in scenes.items():
        print(f"{name:<{width}}  {title}")


def _info(given: argparse.Namespace) -> None:
    from importlib.metadata import PackageNotFoundError, version

    if given.what:
        from earthspin.bodies.told import all_in_words, in_words

        print(all_in_words() if given.name is None else in_words(given.name))
        return
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


def _verify(given: argparse.Namespace) -> None:
    from earthspin.engine.store import verify

    print(f"{printable(str(verify(given.file)))} is what was written")


def _stability(given: argparse.Namespace) -> int:
    from earthspin.checks.case import FAILS
    from earthspin.checks.stability import stability
    from earthspin.views.stability_tables import print_verdicts, tally

    result = stability(quick=given.quick, only=given.only, long=given.long)
    print_verdicts(result)
    return CHECK_FAILED if tally(result)[FAILS] else 0


def _question(given: argparse.Namespace) -> Question:
    """Question of the command line: the scene, then --set, then --ephemeris."""
    from earthspin.scenes import files_of, typed_scene

    changes = dict(_setting(text) for text in given.settings)
    if given.ephemeris is not None:
        changes["ephemeris"] = given.ephemeris
    question = typed_scene(given.scene, changes)
    if Path(given.scene).suffix in (".nc", ".zarr"):
        for key, path, _ in files_of(question, changes):
            words = f"{given.scene} names a file, which is opened: {key} = '{path}'"
            print(f"earthspin: {printable(words)}", file=sys.stderr)
    return question


def _setting(text: str) -> tuple[str, Any]:
    """Read KEY=VALUE; the value as TOML if it is that, as text otherwise."""
    import tomllib

    from earthspin.scenes import toml

    key, equals, value = text.partition("=")
    if not equals or not key.strip():
        raise SceneError("--set", text, "write it as KEY=VALUE", source="command line")
    try:
        return key.strip(), toml(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        return key.strip(), value.strip()
    except (ValueError, RecursionError) as error:  # a number of 5000 digits, lists in lists
        raise SceneError(key.strip(), value, f"it cannot be read: {error}") from None


# --- completion ----------------------------------------------------------------------------------


def _completion(given: argparse.Namespace) -> None:
    """Print the lines that teach a shell to complete; they ask this program for the words."""
    try:
        from argcomplete.shell_integration import shellcode
    except ImportError:
        from earthspin.errors import MissingExtraError

        raise MissingExtraError("argcomplete", "completion", "completion in the shell") from None
    print(shellcode(["earthspin"], shell=given.shell))


def _complete(parser: argparse.ArgumentParser) -> None:
    """Answer a shell that asks for words, and leave; do nothing for anyone else."""
    if "_ARGCOMPLETE" in os.environ:
        import argcomplete

        argcomplete.autocomplete(parser)


def _scenes_and_files(prefix: str, **_: object) -> list[str]:
    from earthspin.scenes import shipped_scenes

    files = Path(prefix).parent.glob("*")
    return [*shipped_scenes(), *(str(p) for p in files if p.suffix in (".toml", ".nc", ".zarr"))]


def _question_of(parsed_args: argparse.Namespace) -> type[Question] | None:
    """Class of the question of the scene that stands on the line so far."""
    from earthspin.scenes import load_scene

    try:
        return type(load_scene(parsed_args.scene))
    except EarthspinError:
        return None


def _key_words(parsed_args: argparse.Namespace, **_: object) -> list[str]:
    from earthspin.engine.question import keys_of

    question = _question_of(parsed_args)
    keys = {} if question is None else keys_of(question)
    return [f"{question.table}.{n}=" if one.setting else f"{n}=" for n, one in keys.items()]  # type: ignore[union-attr]


def _section_names(parsed_args: argparse.Namespace, **_: object) -> list[str]:
    question = _question_of(parsed_args)
    return ["all"] if question is None else [*question.graph.sections, "all"]


def _kernels(prefix: str, **_: object) -> list[str]:
    from earthspin.sky.ephemeris import NAMED_KERNELS

    return [*NAMED_KERNELS, *map(str, Path(prefix).parent.glob("*.bsp"))]


def _words(**_: object) -> list[str]:
    from earthspin.scenes import QUESTIONS

    return list(QUESTIONS)


def _quantities(**_: object) -> list[str]:
    from earthspin.checks.work_precision import QUANTITIES

    return list(QUANTITIES)
