"""What stands around the program: streams, signals, styles, folders that cannot be written."""

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import earthspin
from earthspin import SceneError
from earthspin.engine import store
from earthspin.engine.variables import texts_as_columns
from earthspin.views.tables import TextTable
from earthspin.views.terminal import Terminal

#: Nearly each starts a process or more.
pytestmark = pytest.mark.slow
ROOT = Path(__file__).parents[2]


def earthspin_says(
    *words: str | bytes, shell: str = "", env: dict[str, str] | None = None
) -> subprocess.CompletedProcess[bytes]:
    """Run the command as a process; `shell` follows it on a line of sh."""
    command: list[str | bytes] = [sys.executable, "-m", "earthspin", *words]
    if shell:
        command = ["sh", "-c", f'exec "$@" {shell}', "sh", *command]
    return subprocess.run(
        command, capture_output=True, cwd=ROOT, env=os.environ | (env or {}), timeout=120
    )


def ended(program: str, *words: str, **env: str) -> subprocess.CompletedProcess[bytes]:
    """Run Python code as a process."""
    command = [sys.executable, "-c", program, *words]
    return subprocess.run(command, capture_output=True, cwd=ROOT, env=os.environ | env)


def test_no_style_of_the_readers_own_reaches_a_figure(tmp_path: Path) -> None:
    """No TeX, no colours, and no default of any kind; the figure is the same to the bit."""
    (tmp_path / "matplotlibrc").write_text(
        "text.usetex: True\nfont.size: 30\naxes.facecolor: red\nsvg.fonttype: path\n"
    )
    program = (
        "import earthspin, sys; from earthspin.views.rendering import scene_page\n"
        "sys.stdout.write(scene_page(earthspin.run_tree('torque')))"
    )
    pages = [
        ended(program, SOURCE_DATE_EPOCH="0", **more).stdout
        for more in ({}, {"MATPLOTLIBRC": str(tmp_path / "matplotlibrc")}, {"MPLBACKEND": "none"})
    ]
    pictures = [re.findall(rb"<svg.*?</svg>", page, re.DOTALL) for page in pages]
    assert pictures[0]
    assert pictures[1] == pictures[0]
    assert pictures[2] == pictures[0]


def test_a_home_that_cannot_be_written_is_not_mentioned(tmp_path: Path) -> None:
    """Nor a backend that does not exist."""
    nowhere = dict.fromkeys(("HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"), "/proc/nowhere")
    env = {**nowhere, "MPLBACKEND": "nonsense"}
    for words in (["report", "--out", str(tmp_path / "r")], ["run", "wobble"], ["info"]):
        found = earthspin_says(*words, env=env)
        assert (found.returncode, found.stderr) == (0, b""), words
    assert b"<svg" in (tmp_path / "r" / "index.html").read_bytes()


def test_a_terminal_that_has_ascii_alone(tmp_path: Path) -> None:
    env = {"PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    for words in (["run", "wobble"], ["plan", "iau"]):
        found = earthspin_says(*words, env=env)
        assert (found.returncode, found.stderr) == (0, b"")
        assert found.stdout.isascii()


def test_a_closed_stdout_is_told(tmp_path: Path) -> None:
    found = earthspin_says("run", "top-loop", shell=">&-")
    assert found.returncode == 2
    assert found.stderr == b"earthspin: the output cannot be written: Bad file descriptor\n"
    # What is written to a file must not have the number of stdout.
    path = tmp_path / "r.nc"
    found = earthspin_says("run", "top-loop", "--out", str(path), shell=">&-")
    assert found.returncode == 2
    assert earthspin.verify(path) == path


def test_a_full_disk_behind_stdout_is_told() -> None:
    found = earthspin_says("run", "top-loop", "--json", shell=">/dev/full")
    assert found.returncode == 2
    assert found.stderr == b"earthspin: the output cannot be written: No space left on device\n"


def test_a_closed_stderr_leaves_the_status_and_stdout_alone() -> None:
    found = earthspin_says("run", "no-such-scene", shell="2>&-")
    assert (found.returncode, found.stdout) == (2, b"")
    found = earthspin_says("run", "top-loop", shell="2>&- <&-")
    assert found.returncode == 0
    assert b"top" in found.stdout


def test_a_name_that_is_not_text(tmp_path: Path) -> None:
    """It can be written to, or is refused in one line."""
    for kind in (b"nc", b"zarr"):
        path = os.fsencode(tmp_path) + b"/\xff." + kind
        found = earthspin_says("run", "top-loop", "--out", path)
        assert found.returncode in (0, 2)
        assert len(found.stderr.splitlines()) == (1 if found.returncode else 0)
        assert found.returncode == 2 or os.path.exists(path)
        assert len(os.listdir(os.fsencode(tmp_path))) <= 1


@pytest.mark.parametrize(
    ("number", "status", "said"),
    [
        (signal.SIGINT, 130, b"interrupted"),
        (signal.SIGTERM, 143, b"ended by SIGTERM"),
        (signal.SIGHUP, 129, b"ended by SIGHUP"),
    ],
)
def test_signals_end_in_one_line_that_says_how_to_go_on(
    tmp_path: Path, number: signal.Signals, status: int, said: bytes
) -> None:
    # whoever runs the tests may ignore it, as nohup and shells in the background do
    program = """if True:
        import signal, sys, time
        signal.signal(int(sys.argv[2]), signal.SIG_DFL)
        if int(sys.argv[2]) == signal.SIGINT:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        from earthspin import cli, scenes
        from earthspin.engine.blocks import BlockSeries
        def slow(series, number):
            while number == 2:
                print("half-way", flush=True)
                time.sleep(60)
            return real(series, number)
        real, BlockSeries.make = BlockSeries.make, slow
        from earthspin.questions import time_axes
        time_axes.LONGEST_IN_MEMORY, scenes.BLOCK = 100, 500
        sys.exit(cli.main(["run", "torque", "--out", sys.argv[1]]))
    """
    path = store.write(earthspin.run("top-loop"), tmp_path / "r.zarr")
    process = subprocess.Popen(
        [sys.executable, "-c", program, str(path), str(int(number))],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        cwd=ROOT,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == b"half-way\n"
    assert len(list(tmp_path.iterdir())) == 2
    process.send_signal(number)
    out, complaint = process.communicate(timeout=60)
    assert (out, process.returncode) == (b"", status)
    kept = b"1000 of 1465 are stored in r.zarr.partial; run the same command to continue"
    assert complaint == b"earthspin: " + said + b"; " + kept + b"\n"
    assert sorted(tmp_path.iterdir()) == [path, tmp_path / "r.zarr.partial"]
    assert "top" in store.open(path).attrs["compute"]


def test_a_program_under_nohup_goes_on() -> None:
    program = """if True:
        import os, signal, sys
        signal.signal(signal.SIGHUP, signal.SIG_IGN)
        from earthspin import cli
        real = cli._scenes
        cli._scenes = lambda given: (os.kill(os.getpid(), signal.SIGHUP), real(given))[1]
        sys.exit(cli.main(["scenes"]))
    """
    found = ended(program)
    assert (found.returncode, found.stderr) == (0, b"")


def test_an_empty_kernel_is_no_kernel(tmp_path: Path) -> None:
    found = earthspin_says("report", "--ephemeris", "", "--out", str(tmp_path / "r"))
    assert found.returncode == 2
    assert b"kernel" in found.stderr
    assert not (tmp_path / "r").exists()


def test_a_defect_is_told_as_one(tmp_path: Path) -> None:
    program = """if True:
        import sys, warnings
        from earthspin import cli
        def broken(given):
            warnings.warn("on the way")
            raise ZeroDivisionError("of\\nours \\x1b[2J")
        cli._scenes = broken
        sys.exit(cli.main(["scenes", *sys.argv[1:]]))
    """

    def run(*words: str, **env: str) -> tuple[int, list[str]]:
        found = ended(program, *words, **env)
        return found.returncode, found.stderr.decode().splitlines()

    status, lines = run()
    assert (status, len(lines)) == (70, 1)
    assert lines[0].startswith("earthspin: a defect of earthspin")
    assert "ZeroDivisionError: of ours \\x1b[2J; please report it" in lines[0]
    for told in (run("--traceback"), run(EARTHSPIN_TRACEBACK="1")):
        assert told[0] == 70
        assert told[1][:2] == [lines[0], "Traceback (most recent call last):"]
    assert len(run(EARTHSPIN_TRACEBACK="0")[1]) == 1


def test_a_warning_comes_after_success_and_never_before_a_message() -> None:
    program = """if True:
        import sys, warnings
        from earthspin import cli, errors
        real = cli._scenes
        def warned(given):
            warnings.warn("on the way")
            real(given)
            if len(sys.argv) > 1:
                raise errors.UndefinedError("no value")
        cli._scenes = warned
        sys.exit(cli.main(["scenes"]))
    """
    for words, said, status in (([], b"on the way", 0), (["x"], b"no value", 2)):
        found = ended(program, *words)
        assert (found.returncode, found.stderr) == (status, b"earthspin: " + said + b"\n")


def test_verify_on_the_command_line(tmp_path: Path) -> None:
    path = store.write(earthspin.run("top-loop"), tmp_path / "r.zarr")
    found = earthspin_says("verify", str(path))
    assert (found.returncode, found.stderr) == (0, b"")
    assert found.stdout.startswith(f"{path} is complete".encode())
    (path / "psi" / "0").unlink()
    found = earthspin_says("verify", str(path))
    assert found.returncode == 2
    assert b"'psi/0' is missing" in found.stderr
    assert found.stdout == b""


def test_titles_do_nothing_to_the_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    for title in ("\x1b[2Jgone", "two\nlines", "a\rb", "\u202ereversed"):
        with pytest.raises(SceneError, match="title"):
            earthspin.load_scene("torque", {"title": title})
    odd = "[/red] [bold]b[/bold] \x1b[2J"
    Terminal().print_table(TextTable(odd, (odd, "n"), [(odd, "1")], note=f"{odd}\nsecond"))
    shown = capsys.readouterr().out
    assert shown.count("[/red] [bold]b[/bold] \\x1b[2J") == 4
    assert "\x1b" not in shown
    assert "\nsecond" in shown


def test_json_is_what_it_was(tmp_path: Path) -> None:
    """As xarray has it, dates in ISO 8601, infinity as text."""
    import datetime as dt
    import math

    def plain(value: object) -> object:
        if isinstance(value, dict):
            return {key: plain(inner) for key, inner in value.items()}
        if isinstance(value, (list, tuple)):
            return [plain(inner) for inner in value]
        if isinstance(value, (dt.datetime, dt.date)):
            return value.isoformat()
        return str(value) if isinstance(value, float) and not math.isfinite(value) else value

    for scene in ("sun-only", "poinsot"):
        found = earthspin_says("run", scene, "--json", "--sections", "all")
        tree = earthspin.run_tree(scene)
        sections = {}
        for name, node in tree.children.items():
            if name != "plan":
                own = node.to_dataset(inherit=False)
                labels = {n: c for n, c in tree.coords.items() if {*c.dims} & {*own.sizes}}
                sections[name] = texts_as_columns(own.assign_coords(labels)).to_dict()
        expected = plain(texts_as_columns(tree.to_dataset()).to_dict() | {"sections": sections})
        assert json.loads(found.stdout) == expected


@pytest.mark.parametrize(
    ("scene", "share"), [("wobble", 0.0), ("torque", 0.3), ("torque", 0.7), ("wobble", 1.0)]
)
def test_a_file_larger_than_the_system_allows_is_an_output_error(
    tmp_path: Path, scene: str, share: float
) -> None:
    """As on a full disk: netCDF says "HDF error", whatever the system said."""
    path = tmp_path / "r.nc"
    words = ["run", scene, "--out", str(path)]
    before = store.write(earthspin.run(scene), path).read_bytes()
    blocks = int(share * (len(before) - 1)) // 512
    limited = ["sh", "-c", f'ulimit -f {blocks}; exec "$@"', "sh", sys.executable, "-m"]
    found = subprocess.run(
        [*limited, "earthspin", *words], capture_output=True, cwd=ROOT, timeout=120
    )
    complaint = found.stderr.decode()
    assert found.returncode == 2, complaint
    assert complaint.count("\n") == 1
    assert f"output '{path}': it cannot be written" in complaint
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]
