"""Sizes that no machine has, files without an end, and what is repeated in a message."""

import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from astropy import units as u

import earthspin
from earthspin import (
    EarthspinError,
    KernelError,
    OutputError,
    SceneError,
    SeriesError,
    UndefinedError,
)
from earthspin.errors import in_bytes
from tests.blocks import run_blocks

ROOT = Path(__file__).parents[2]


def one_line(error: BaseException) -> str:
    line = str(error)
    assert line.isprintable()
    assert len(line) <= 1100
    return line


# --- sizes ---------------------------------------------------------------------------------------


def members(count: int) -> earthspin.Body:
    radius = xr.DataArray(np.linspace(6.3e6, 6.4e6, count), dims="member")
    return earthspin.EARTH.replace(radius=radius)


def test_members_count_as_well_as_times() -> None:
    """Forty thousand times of a thousand bodies are as many numbers as forty million times."""
    scene = {"start": "2000-01-01", "stop": "2027-01-01", "step": "6 h"}
    with pytest.raises(SceneError, match=r"39449 times of 1000 members .*5\.05 GB"):
        earthspin.torque_series(**scene, body=members(1000))


def test_blocks_of_many_members_are_shorter(tmp_path: Path) -> None:
    scene = earthspin.Scene(
        compute="torque", span=("2000-01-01", "2000-01-03"), step="1 h", body=members(20_000)
    )
    lengths = [block.sizes["time"] for block in run_blocks(scene)]
    assert lengths == [6] * 8 + [1]


def test_a_microsecond_through_a_century_is_refused_with_its_size(tmp_path: Path) -> None:
    scene = earthspin.load_scene("torque", {"span": ["1900-01-01", "2050-01-01"], "step": "1 us"})
    begun = time.perf_counter()
    with pytest.raises(SceneError, match=r"4733596800000001 times .*606 PB"):
        earthspin.run(scene)
    with pytest.raises(OutputError, match=r"4733596800000001 times .* [PE]B"):
        earthspin.write_series(scene, tmp_path / "r.zarr")
    assert list(tmp_path.iterdir()) == []
    assert time.perf_counter() - begun < 10


@pytest.mark.parametrize(
    ("count", "words"),
    [(0, "0 B"), (999, "999 B"), (1500, "1.5 kB"), (999_600, "1 MB"), (6e17, "600 PB")],
)
def test_sizes_in_words(count: float, words: str) -> None:
    assert in_bytes(count) == words


#: Peak of memory (MB) and seconds of `--json` for so many times.
JSON = """
import sys, time
from earthspin import cli
begun = time.perf_counter()
span = f'span=["2000-01-01", "{sys.argv[1]}"]'
assert cli.main(["run", "torque", "--json", "--set", span, "--set", "step=10 min"]) == 0
with open("/proc/self/status") as status:
    peak = next(int(line.split()[1]) / 1024 for line in status if "VmHWM" in line)
print(peak, time.perf_counter() - begun, file=sys.stderr)
"""


@pytest.mark.slow
def test_json_of_a_long_series_is_written_as_it_is_made(tmp_path: Path) -> None:
    """Text and lists of it would take 5 kB for each time; measured: 0.3 kB, the answer itself."""

    def run(end: str) -> tuple[float, int]:
        with (tmp_path / "out.json").open("w") as out:
            done = subprocess.run(
                [sys.executable, "-c", JSON, end], stdout=out, stderr=subprocess.PIPE, cwd=ROOT
            )
        assert done.returncode == 0
        data = json.loads((tmp_path / "out.json").read_text())
        return float(done.stderr.splitlines()[-1].split()[0]), len(data["coords"]["time"]["data"])

    (small, few), (large, many) = run("2000-01-02"), run("2002-01-01")
    assert many - few > 100_000
    assert (large - small) * 1024 / (many - few) < 1.0


# --- files without an end ------------------------------------------------------------------------


@pytest.fixture
def pipe(tmp_path: Path) -> Path:
    os.mkfifo(tmp_path / "pipe")
    return tmp_path / "pipe"


def test_devices_and_pipes_are_no_files(pipe: Path, tmp_path: Path) -> None:
    """They have no end, and a pipe would be waited for."""
    for path in (Path("/dev/zero"), pipe):
        for call, kind in (
            (lambda p: earthspin.load_scene(p), SceneError),
            (lambda p: earthspin.polar_motion(file=p), SeriesError),
            (lambda p: earthspin.read_excitation(p), SeriesError),
            (lambda p: earthspin.precession(ephemeris=p), KernelError),
        ):
            with pytest.raises(kind, match="a pipe") as error:
                call(path)
            one_line(error.value)
    for path in (tmp_path, Path("/")):
        with pytest.raises(SceneError, match="a folder, not a file"):
            earthspin.load_scene(path)


def test_a_result_replaces_no_pipe(pipe: Path) -> None:
    """What is moved to the name of a pipe or a device would take its place."""
    with pytest.raises(OutputError, match="a pipe"):
        earthspin.wobble_ladder().earthspin.to_csv(pipe)
    assert pipe.is_fifo()


# --- nonsense ------------------------------------------------------------------------------------


def test_one_path_with_a_unit_is_no_list_of_paths() -> None:
    for given in (3 * u.kg, np.array(3.0)):
        with pytest.raises(SceneError, match="it is the path of a file"):
            earthspin.read_excitation(given)


def test_a_file_that_is_a_number() -> None:
    with pytest.raises(SceneError, match=r"polar_motion\.file = 1"):
        earthspin.load_scene("polar-motion", {"polar_motion.file": 1})


def test_a_body_by_position() -> None:
    with pytest.raises(TypeError, match="by name"):
        earthspin.Body("earth", 4e14)  # type: ignore[misc]


def test_numbers_that_overflow_are_an_error_and_no_warning() -> None:
    with pytest.raises(UndefinedError, match="too large") as error:
        earthspin.wobble_ladder(body={"from": "earth", "spin_period": 1e30})
    one_line(error.value)


# --- what is repeated ----------------------------------------------------------------------------


def test_what_is_given_is_cut_and_does_nothing_to_the_terminal() -> None:
    evil = "\x1b[2J\x07\u202e\n" + "x" * 5000
    for call in (
        lambda: earthspin.torque_series(times=evil),
        lambda: earthspin.load_scene(evil),
        lambda: earthspin.load_scene("torque", {evil: 1}),
        lambda: earthspin.load_scene("torque", {"body": {"name": evil}}),
        lambda: earthspin.precession(ephemeris=evil + ".bsp"),
        lambda: earthspin.polar_motion(file=evil + "/"),
        lambda: earthspin.open(evil),
        lambda: earthspin.Scene(compute=evil),
    ):
        with pytest.raises(EarthspinError) as error:
            call()
        line = one_line(error.value)
        assert "\\x1b[2J" in line or "..." in line
        assert max(map(len, re.findall("x+", line))) <= 260


def test_a_message_is_the_same_for_what_is_short() -> None:
    with pytest.raises(SceneError, match=r"^perturbers = 'mooon': did you mean 'moon'\?"):
        earthspin.precession(perturbers="mooon")
