"""Commands of the command line: report, play, run, ensemble, plan, scenes, keys, ...

Commands, options and completions follow from the classes of the questions.
"""

from __future__ import annotations

import os
import sys
import time
from argparse import Action, ArgumentParser, Namespace
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import earthspin
from earthspin._version import __version__
from earthspin.errors import EarthspinError, MissingExtraError, OutputError, SceneError, printable
from earthspin.plug_ins import hide_array_libraries
from earthspin.process import RESULTS, USAGE_ERROR, run_command
from earthspin.views import PLAYS

if TYPE_CHECKING:
    from earthspin.engine.question import Question

    Command = Callable[[Namespace], None]

#: Printed by the command without arguments; a line has at most 80 characters.
WELCOME = """\
earthspin: precession, nutation and wobble of spinning bodies, with errors.

Start with:
  earthspin report --open     the precession of the Earth, with a page to read
  earthspin play top --open   a heavy top with sliders
  earthspin run torque        torques of Sun and Moon in a year

More:
  earthspin scenes            list of the shipped scenes
  earthspin keys QUESTION     inputs of a question, such as: keys precession
  earthspin --help            all commands
"""


class _Parser(ArgumentParser):
    """Argument parser that prints errors on one line."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        words = "show where an error arose, after its line"
        self.add_argument("--traceback", action="store_true", help=words)

    def error(self, message: str) -> NoReturn:
        line = EarthspinError(f"earthspin: {message}; see {self.prog} --help")
        self.exit(USAGE_ERROR, f"{line}\n")


class _ShowHelp(Action):
    """Option `--help` of a command; if a scene is named, its input keys are listed as well."""

    def __call__(self, parser: ArgumentParser, options: Namespace, *_: object) -> NoReturn:
        """Print the help of a command, and exit."""
        parser.print_help()
        if options.scene is not None:
            try:
                print(f"\n{_keys_of(options.scene)}")
            except EarthspinError as error:
                parser.error(str(error))
        parser.exit()


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command of the command line, and return the exit status.

    Parameters
    ----------
    arguments : sequence of str, optional
        Words after the command's name; those of the process by default.

    Returns
    -------
    int
        Exit status: 0, also if no command is given, which says what to try; 2 with
        one line on stderr if something given is wrong; 70 for a defect of earthspin; others as
        `earthspin.process.run_command` has them.
    """
    parser = _parser()
    _complete(parser)

    def command() -> None:
        _check_command(next((word for word in words if not word.startswith("-")), ""), parser)
        options = parser.parse_args(arguments)
        cluster = {"workers", "scheduler"} & {name for name, set_ in vars(options).items() if set_}
        if arguments is None and not cluster:
            hide_array_libraries()
        options.command(options)

    words = sys.argv[1:] if arguments is None else arguments
    return run_command(command, show_traceback="--traceback" in words)


def _parser() -> ArgumentParser:
    parser = _Parser(prog="earthspin", description=(earthspin.__doc__ or "").split("\n")[0])
    parser.add_argument("--version", action="version", version=f"earthspin {__version__}")
    commands = parser.add_subparsers(metavar="COMMAND", parser_class=_Parser)
    parser.set_defaults(command=_welcome, commands=commands.choices)
    flag: dict[str, Any] = {"action": "store_true"}
    words = "de421, de440, or the path of a .bsp file"
    kernel: dict[str, Any] = {"metavar": "NAME|PATH", "help": words}
    opens = flag | {"help": "open the page in the browser"}
    sections = "sections to compute beside the answer (default: {})".format

    def command(name: str, run: Command, words: str, **settings: Any) -> ArgumentParser:
        added = commands.add_parser(name, help=words, **settings)
        added.set_defaults(command=run)
        return added

    def of_scene(name: str, run: Command, words: str) -> ArgumentParser:
        added = command(name, run, words, add_help=False)
        words = "name of a shipped scene, a TOML file, or a file with a result"
        added.add_argument("scene", help=words)
        added.add_argument("--ephemeris", **kernel)
        several: dict[str, Any] = {"action": "append", "default": [], "dest": "settings"}
        words = "change a key of the scene, e.g. --set step='1 h'"
        added.add_argument("--set", metavar="KEY=VALUE", help=words, **several)
        words = "show this help, and the keys of the scene if one is named"
        added.add_argument("-h", "--help", action=_ShowHelp, nargs=0, help=words)
        return added

    add = command("report", _report, "print and write the precession or wobble report").add_argument
    topics = ("precession", "wobble")
    add("topic", nargs="?", default="precession", choices=topics, help="topic of the report")
    add("--out", default="report", metavar="DIR", help="folder (default: report)")
    add("--no-figures", **flag, help="only tables, without figures; much faster")
    add("--open", **opens)
    add("--ephemeris", **kernel)

    add = command("play", _play, "write an interactive page").add_argument
    add("what", choices=PLAYS, metavar="|".join(PLAYS), help="topic of the page")
    add("--out", metavar="FILE", help="default: play-WHAT.html")
    add("--open", **opens)

    add = of_scene("run", _run, "run a scene").add_argument
    words = "folder for a page and the data, or a .nc, .zarr or .csv file"
    add("--out", metavar="DIR|FILE", help=words)
    add("--plan", **flag, help="print the parts that ran, and their run times")
    add("--json", **flag, help="print the result as JSON")
    words = sections("none on the screen, all with --out")
    add("--sections", metavar="NAMES|all", help=words)
    words = "columns of a .csv file, each with its errors (default: those most used)"
    add("--columns", metavar="NAMES|all", help=words)
    words = "units of columns of a .csv file, e.g. x=mas,epoch='kyr BP'"
    add("--units", metavar="NAME=UNIT,...", default="", help=words)
    words = "angles of a .csv file that are given from 0 to one turn"
    add("--wrap", metavar="NAMES", default="", help=words)

    ensemble = of_scene("ensemble", _ensemble, "run an ensemble of a scene")
    add = ensemble.add_argument
    words = "how many, or a .csv, .nc or .zarr with their values (default: what the scene says)"
    add("--members", metavar="N|FILE", help=words)
    add("--seed", type=int, metavar="N", help="seed of the random numbers (default: 0)")
    add("--out", required=True, metavar="X.zarr", help="store; an unfinished one is resumed")
    cluster = ensemble.add_mutually_exclusive_group().add_argument
    cluster("--workers", type=int, metavar="N", help="start a local cluster of N workers")
    cluster("--scheduler", metavar="ADDRESS", help="a running cluster, like tcp://host:8786")
    add("--block", type=int, metavar="N", help="number of members computed and stored at a time")
    add("--drop", **flag, help="leave out and count members that are not possible")
    add("--json", **flag, help="print progress as lines of JSON")

    words = "show which parts a scene needs, and which it leaves out"
    add = of_scene("plan", _plan, words).add_argument
    add("--sections", metavar="NAMES|all", help=sections("none"))

    command("scenes", _scenes, "list the shipped scenes")

    add = command("keys", _keys, "list the questions and their keys").add_argument
    add("question", nargs="?", help="default: all")

    words = "print versions and kernels, or the numbers of bodies"
    add = command("info", _info, words).add_argument
    add("what", nargs="?", choices=("bodies",), help="bodies: list them")
    add("name", nargs="?", metavar="NAME", help="body whose numbers and sources are printed")

    add = command("verify", _verify, "compare a stored result with its checksums").add_argument
    add("file", metavar="FILE", help="a .nc file or a .zarr folder written by earthspin")

    add = command("completion", _completion, "print the completion script of a shell").add_argument
    add("shell", choices=("bash", "zsh", "fish"))
    return parser


def _check_command(word: str, parser: ArgumentParser) -> None:
    """Raise an error if a word is not a command; the message suggests a scene or a command."""
    commands = parser.get_default("commands")
    if not word or word in commands:
        return
    from earthspin.errors import nearest
    from earthspin.scenes import QUESTIONS, load_scene, shipped_scenes

    question = next((q for q, call in QUESTIONS.calls.items() if word in (q, call)), word)
    scenes = sorted(shipped_scenes(), key=lambda name: name not in (word, question))
    words = (scene for scene in scenes if {scene, load_scene(scene).word} & {word, question})
    scene = next(words, "")
    remedy = f"try: earthspin run {scene}" if scene else nearest(word, commands)
    raise EarthspinError(f"there is no command '{word}'; {remedy}")


# --- commands ------------------------------------------------------------------------------------


def _welcome(_: Namespace) -> None:
    print(WELCOME, end="")


def _report(options: Namespace) -> None:
    """Command `report`: write the report on precession or on the wobble, and print its tables."""
    from earthspin.views import report
    from earthspin.views.closing_line import closing_line
    from earthspin.views.rendering import print_tables

    kernel, figures = options.ephemeris, not options.no_figures
    if options.topic == "wobble":
        if kernel is not None:
            raise SceneError("--ephemeris", kernel, "the wobble report needs no kernel")
        answers, written = report.write_wobble_report(options.out, figures=figures)
    else:
        kernel = "de421" if kernel is None else kernel
        answer, written = report.write_report(options.out, ephemeris=kernel, figures=figures)
        answers = [answer]
    for answer in answers:
        print_tables(answer)
    _print_written(*written)
    for answer in answers:
        print(closing_line(answer))
    if options.open:
        _open(written[0])


def _play(options: Namespace) -> None:
    """Command `play`: write an interactive HTML page about the chosen topic."""
    from earthspin.views.closing_line import run_time
    from earthspin.views.play import write_page

    begun = time.perf_counter()
    page = write_page(options.what, options.out or f"play-{options.what}.html")
    computation_time = time.perf_counter() - begun
    _print_written(page)
    print(run_time(computation_time))
    if options.open:
        _open(page)


def _run(options: Namespace) -> None:
    """Command `run`: run a scene, print its tables, and write its results."""
    from earthspin.engine import atomic_writes, store
    from earthspin.questions import time_axes
    from earthspin.scenes import members_of, run_tree, series_length, write_series
    from earthspin.views.closing_line import closing_line

    question, sections = _question(options), _listed(options.sections)
    data = page = None
    for name in ("columns", "units", "wrap"):
        if (value := getattr(options, name)) and Path(options.out or "").suffix != ".csv":
            raise SceneError(f"--{name}", value, "give a file, --out FILE.csv")
    if options.out is not None:
        data, name = Path(options.out), Path(options.scene).stem
        if data.suffix not in ("", ".nc", ".zarr", ".csv") and not data.is_dir():
            raise OutputError(data, "unknown suffix", "give a folder, or a .nc, .zarr or .csv file")
        if data.suffix == ".csv" and (sections == "all" or len(sections or ()) > 1):
            problem = "a .csv has one table: give one section, or a folder or .nc"
            raise SceneError("--sections", options.sections, problem)
        long = data if data.suffix == ".zarr" else data / f"{name}.zarr"
        if data.suffix not in (".nc", ".zarr", ".csv"):
            data, page = data / f"{name}.nc", data / f"{name}.html"
        atomic_writes.check_writable(Path(options.out) if page else data.parent)
        if series_length(question) * members_of(question) > time_axes.LONGEST_IN_MEMORY:
            if options.json:
                raise SceneError("--json", "a long series", "leave it out; read the Zarr store")
            begun = time.perf_counter()
            _print_written(write_series(question, long))
            print(closing_line(store.open(long), time.perf_counter() - begun))
            return
        if sections is None and data.suffix != ".csv":
            sections = "all"
    tree = run_tree(question, sections or ())
    if data is not None and data.suffix == ".csv":
        pairs = (pair.partition("=") for pair in _listed(options.units) or ())
        units = {name: unit for name, _, unit in pairs}
        tree.earthspin.to_csv(
            data,
            _listed(options.columns),
            section="".join(sections or ()),
            units=units,
            wrap=_listed(options.wrap) or (),
        )
    elif data is not None:
        store.write(tree, data)
    with _note_of_results(data):
        from earthspin.views import rendering

        if page is not None:
            with atomic_writes.replacing(page) as draft:
                draft.write_text(rendering.scene_page(tree), encoding="utf-8")
        if options.json:
            rendering.write_json(tree, sys.stdout)
        else:
            rendering.print_tables(tree, with_plan=options.plan)
            others = [name for name in question.graph.sections if name not in tree.children]
            if others and not tree.children.keys() - {"plan"}:
                print(f"More: --sections {','.join(others)}, or all")
    stream = sys.stderr if options.json else sys.stdout
    _print_written(*filter(None, (page, data)), file=stream)
    print(closing_line(tree), file=stream)


def _ensemble(options: Namespace) -> None:
    """Command `ensemble`: run a scene many times with different inputs."""
    import json

    from earthspin.progress import lines_to
    from earthspin.scenes import ensemble

    members = options.members
    if members is not None and members.lstrip("+-").isdecimal():
        members = int(members)
    client = options.scheduler if options.workers is None else options.workers
    begun = time.perf_counter()
    with lines_to(sys.stdout) if options.json else nullcontext():
        answer = ensemble(
            _question(options),
            members,
            seed=options.seed,
            path=options.out,
            client=client,
            block=options.block,
            impossible="drop" if options.drop else None,
        )
    computation_time = time.perf_counter() - begun
    if options.json:
        print(json.dumps({"wrote": options.out, "members": answer.sizes["member"]}))
        return
    with _note_of_results(options.out):
        from earthspin.views.closing_line import closing_line
        from earthspin.views.rendering import print_tables

        print_tables(answer)
        line = closing_line(answer, computation_time)
    _print_written(options.out)
    print(line)


def _plan(options: Namespace) -> None:
    """Command `plan`: print the computations that a scene runs, and those that are left out."""
    from earthspin.scenes import plan

    print(plan(_question(options), _listed(options.sections) or ()))


def _scenes(_: Namespace) -> None:
    """Command `scenes`: list the scenes that are part of the package."""
    from earthspin.scenes import shipped_scenes

    scenes = shipped_scenes()
    width = max(map(len, scenes))
    for name, title in scenes.items():
        print(f"{name:<{width}}  {title}")


def _keys(options: Namespace) -> None:
    """Command `keys`: print all inputs of one type of computation (question), or of every type."""
    from earthspin.engine.question import describe_keys
    from earthspin.scenes import QUESTIONS, question_named

    words = QUESTIONS if options.question is None else [options.question]
    print("\n\n".join(f"compute = {w!r}\n\n{describe_keys(question_named(w))}" for w in words))


def _info(options: Namespace) -> None:
    """Command `info`: print versions and kernels, or the properties of bodies."""
    from importlib.metadata import PackageNotFoundError, version

    if options.what:
        from earthspin.bodies.planets import all_in_words, in_words

        print(all_in_words() if options.name is None else in_words(options.name))
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


def _verify(options: Namespace) -> None:
    """Command `verify`: compare a stored result with its checksums."""
    from earthspin.engine.store import verify

    print(f"{printable(str(verify(options.file)))} is complete and matches its checksums")


def _completion(options: Namespace) -> None:
    """Command `completion`: print the script by which a shell completes commands."""
    try:
        from argcomplete.shell_integration import shellcode
    except ImportError:
        raise MissingExtraError("argcomplete", "completion", "completion in the shell") from None
    print(shellcode(["earthspin"], shell=options.shell))  # a name, no command  # nosec B604


# --- what commands share -------------------------------------------------------------------------


def _print_written(*paths: str | Path, file: Any = None) -> None:
    for path in paths:
        print(f"wrote {printable(str(path))}", file=file)


def _open(page: Path) -> None:
    """Open an HTML page in the default browser; print a message if there is no browser."""
    import webbrowser

    if not webbrowser.open(page.resolve().as_uri()):
        print("no browser could be opened; open the page by hand", file=sys.stderr)


@contextmanager
def _note_of_results(data: str | Path | None) -> Iterator[None]:
    """Add the path of stored results to any error that is raised inside a `with` block."""
    try:
        yield
    except BaseException as error:
        if data is not None:
            error.add_note(f"{RESULTS} {data}")
        raise


def _listed(names: str | None) -> str | list[str] | None:
    """Split the comma-separated names of an option into a list; "all" and None stay unchanged."""
    if names is None or names.strip() == "all":
        return names and "all"
    return [name.strip() for name in names.split(",") if name.strip()]


def _keys_of(scene: str) -> str:
    """Text that lists the inputs of a scene, and the optional sections of the result."""
    from earthspin.engine.question import describe_keys
    from earthspin.scenes import load_scene

    question = type(load_scene(scene))
    sections = ", ".join(question.graph.sections)
    return f"keys of {scene}:\n\n{describe_keys(question)}\n\nsections: {sections}"


def _question(options: Namespace) -> Question:
    """Read the inputs of a computation from a scene, with changes by --set and --ephemeris."""
    from earthspin.scenes import files_of, typed_scene

    changes = dict(_setting(text) for text in options.settings)
    if options.ephemeris is not None:
        changes["ephemeris"] = options.ephemeris
    question = typed_scene(options.scene, changes)
    if Path(options.scene).suffix in (".nc", ".zarr"):
        for key, path, _ in files_of(question, changes):
            words = f"{options.scene} names a file, which is opened: {key} = '{path}'"
            print(f"earthspin: {printable(words)}", file=sys.stderr)
    return question


def _setting(text: str) -> tuple[str, Any]:
    """Split KEY=VALUE into key and value; parse the value as TOML, or return text if not TOML."""
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


def _complete(parser: ArgumentParser) -> None:
    """If a shell asks for completions, print them and exit; otherwise do nothing."""
    if "_ARGCOMPLETE" in os.environ:
        import argcomplete

        argcomplete.autocomplete(parser, default_completer=_offer)  # type: ignore[arg-type]


def _offer(prefix: str, action: Action, parsed_args: Namespace, **_: object) -> list[str]:
    """Return the possible completions of an argument: scenes, kernels, keys, sections or files."""
    from argcomplete.completers import FilesCompleter

    from earthspin.engine.question import keys_of
    from earthspin.scenes import QUESTIONS, load_scene, shipped_scenes
    from earthspin.sky.ephemeris import NAMED_KERNELS

    files = [*Path(prefix).parent.glob("*")]
    match action.dest:
        case "scene":
            ours = [str(path) for path in files if path.suffix in (".toml", ".nc", ".zarr")]
            return [*shipped_scenes(), *ours]
        case "ephemeris":
            return [*NAMED_KERNELS, *(str(path) for path in files if path.suffix == ".bsp")]
        case "settings" | "sections":
            with suppress(EarthspinError):
                question = type(load_scene(parsed_args.scene))
                if action.dest == "sections":
                    return [*question.graph.sections, "all"]
                keys = keys_of(question).items()
                return [f"{question.table}.{n}=" if key.setting else f"{n}=" for n, key in keys]
            return []
        case "question":
            return list(QUESTIONS)
    return list(FilesCompleter()(prefix))
