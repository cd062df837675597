"""The command line, as a process would be used: output, files, exit status."""

import errno
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from unittest import mock

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import earthspin
from earthspin import process
from earthspin.cli import _parser, main
from earthspin.engine import store
from earthspin.engine.question import scene_text
from earthspin.scenes import QUESTIONS, shipped_scenes
from earthspin.sky.ephemeris import find_kernel
from earthspin.views import PLAYS
from tests.sky.test_ephemeris import bad_kernels


def run(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    try:
        status = main(words)
    except SystemExit as end:
        status = int(end.code or 0)
    out, err = capsys.readouterr()
    return status, out, err


@pytest.mark.slow
def test_report(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    status, out, err = run(capsys, "report", "--out", str(tmp_path / "r"))
    assert (status, err) == (0, "")
    for word in ("sun", "moon", "total", "25712", "maccullagh", "geodesic", "303.62", "2006-03-22"):
        assert word in out, word
    page = (tmp_path / "r" / "index.html").read_text()
    assert page.count("<figure") == 4
    assert "http" not in page.replace("http://www.w3.org", "").replace(
        "http://purl.org", ""
    ).replace("https://matplotlib.org", "").replace("http://creativecommons.org", "")
    result = store.open(tmp_path / "r" / "precession.nc")
    assert result.precession_period.sizes == {"perturber": 3}
    assert sorted(p.name for p in (tmp_path / "r").iterdir()) == [
        "index.html",
        "precession.nc",
        "rotors.html",
    ]


def test_the_command_alone_says_what_to_try(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(capsys)
    assert (status, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    parser = _parser()
    for line in re.findall(r"^  earthspin (.+?)  ", out, flags=re.MULTILINE):
        words = line.replace("QUESTION", "precession").split()
        if words != ["--help"]:
            assert parser.parse_args(words).command, line


@pytest.mark.parametrize("what", PLAYS)
def test_play_writes_a_page(what: str, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    status, out, err = run(capsys, "play", what, "--out", str(page))
    wrote, time = out.splitlines()
    assert (status, wrote, err) == (0, f"wrote {page}", "")
    assert re.fullmatch(r"\S+ s, of it \S+ s computation", time)
    assert "<canvas" in page.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("play", [*PLAYS]),
        ("run precession --sections all --out p.csv", ["folder", ".nc"]),
        ("run long-term --columns obliqity --out x.csv", ["did you mean 'obliquity'"]),
        ("run long-term --columns obliquity", ["FILE.csv"]),
        ("run long-term --columns all --out x.nc", ["FILE.csv"]),
    ],
)
def test_refusals_name_what_is_allowed(
    words: str,
    said: list[str],
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    status, _, err = run(capsys, *words.split())
    assert (status, err.count("\n")) == (2, 1)
    assert all(word in err for word in said)
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize(("opens", "said"), [(True, ""), (False, "no browser could be opened")])
def test_a_page_is_opened_when_asked(
    *,
    opens: bool,
    said: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", lambda address: opened.append(address) or opens)
    page = tmp_path / "top.html"
    status, _, err = run(capsys, "play", "top", "--out", str(page), "--open")
    assert status == 0
    assert opened == [page.as_uri()]
    assert err.startswith(said)
    status, _, _ = run(capsys, "report", "--no-figures", "--out", str(tmp_path), "--open")
    assert (status, opened[1:]) == (0, [(tmp_path / "index.html").as_uri()])


@pytest.mark.parametrize("command", [["scenes"], ["run", "wobble"]])
def test_a_reader_who_leaves_is_no_error(command: list[str]) -> None:
    writer = subprocess.Popen(
        [sys.executable, "-m", "earthspin", *command],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    assert writer.stdout is not None
    writer.stdout.close()
    _, complaint = writer.communicate()
    assert complaint == b""
    assert writer.returncode == 141


@pytest.mark.parametrize("scene", ["precession", "wobble-ensemble", "spheroid"])
def test_run_without_out_writes_nothing(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, scene: str
) -> None:
    monkeypatch.chdir(tmp_path)
    status, out, err = run(capsys, "run", scene)
    assert (status, err) == (0, "")
    assert out
    assert list(tmp_path.iterdir()) == []


def test_run_with_a_changed_key(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    words = ("run", "torque", "--set", "step=12 h", "--set", 'perturbers=["sun"]')
    status, out, _ = run(capsys, *words, "--out", str(tmp_path))
    assert status == 0
    result = store.open(tmp_path / "torque.nc")
    assert result.sizes["time"] == 2 * 366 + 1
    assert list(result.perturber.values) == ["sun"]
    assert f"wrote {tmp_path / 'torque.nc'}" in out


def test_run_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "run", "precession", "--json")
    assert status == 0
    data = json.loads(out)
    rates = data["data_vars"]["precession_rate"]
    assert rates["attrs"]["units"] == "arcsec/yr"
    assert np.isclose(rates["data"][2], 50.4043, rtol=0, atol=1e-4)


USED = [
    f"{name}{end}"
    for name in ("obliquity", "eccentricity", "longitude_of_perihelion", "climatic_precession")
    for end in ("", "_error")
]


@pytest.mark.parametrize(
    ("scene", "asked", "columns"),
    [
        ("long-term", "", ["epoch", *USED]),
        ("long-term", "all", None),
        ("long-term", "epoch, pole_x,psi_A", ["epoch", "pole_x", "psi_A", "psi_A_error"]),
        ("long-term", "pole", ["epoch", "pole_x", "pole_y", "pole_z", "pole_error"]),
        ("precession", "", None),
        ("torque", "torque_x", ["time", "perturber", "torque_x"]),
        ("love-numbers", "love_number", ["love", "love_number"]),
    ],
)
def test_columns_of_a_csv_file(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    scene: str,
    asked: str,
    columns: list[str] | None,
) -> None:
    """Names carry units, as pandas reads them without options, and come in the order asked for."""
    words = ["--columns", asked] if asked else []
    file = tmp_path / "x.csv"
    status, out, _ = run(capsys, "run", scene, "--out", str(file), *words)
    assert (status, f"wrote {file}" in out) == (0, True)
    read, answer = pd.read_csv(file), earthspin.run(scene)
    frame = answer.earthspin.to_frame()
    for name, header in zip(columns or frame, read, strict=True):
        variable = answer[name if name in answer.variables else name.rpartition("_")[0]]
        unit = variable.attrs.get("units", "1")
        assert header == (name if unit == "1" else f"{name} ({unit})")
        assert read[header].astype(frame[name].dtype).tolist() == frame[name].tolist()


def test_a_series_too_long_for_memory_goes_to_zarr(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from earthspin.questions import time_axes

    monkeypatch.setattr(time_axes, "LONGEST_IN_MEMORY", 100)
    status, _out, _ = run(capsys, "run", "torque", "--out", str(tmp_path))
    assert status == 0
    assert store.open(tmp_path / "torque.zarr").sizes["time"] == 4 * 366 + 1


def test_plan_scenes_info(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "plan", "precession")
    assert status == 0
    assert "standstills" in out.split("left out")[1]
    status, out, _ = run(capsys, "plan", "precession", "--sections", "standstills")
    assert "standstills" in out.split("left out")[0]
    status, out, _ = run(capsys, "plan", "wobble")
    assert "kernel" not in out
    status, out, _ = run(capsys, "scenes")
    assert {line.split()[0] for line in out.splitlines()} == set(shipped_scenes())
    status, out, _ = run(capsys, "info")
    assert "de421" in out
    assert "1899-07-29 to 2053-10-09" in out


def test_sections_are_printed_and_written(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    status, out, _ = run(capsys, "run", "precession")
    assert status == 0
    assert "Lunar standstills" not in out
    assert "--sections" in out
    status, out, _ = run(capsys, "run", "precession", "--sections", "standstills,seasons")
    assert status == 0
    assert "Lunar standstills" in out
    assert "maccullagh" not in out
    status, out, _ = run(capsys, "run", "precession", "--sections", "all")
    assert "maccullagh" in out
    for name in ("p.nc", "p.zarr"):
        file = tmp_path / name
        status, out, _ = run(
            capsys, "run", "precession", "--sections", "seasons", "--out", str(file)
        )
        assert status == 0
        assert f"wrote {file}" in out
        tree = store.open(file)
        assert set(tree.children) == {"seasons", "plan"}
        assert np.all(tree["plan"].run_time[tree["plan"].status == "ran"] >= 0)
    status, out, _ = run(capsys, "run", "wobble", "--out", str(tmp_path / "w"))
    assert set(store.open(tmp_path / "w" / "wobble.nc").children) == {
        *QUESTIONS["wobble"].graph.sections,
        "plan",
    }


def test_sections_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "run", "wobble", "--json", "--sections", "observed")
    assert status == 0
    sections = json.loads(out)["sections"]
    assert list(sections) == ["observed"]
    assert "observed_period" in sections["observed"]["data_vars"]


def test_a_file_runs_again(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    answer = earthspin.run("top-wave")
    answer.to_netcdf(tmp_path / "plain.nc")
    status, _, _ = run(capsys, "run", str(tmp_path / "plain.nc"), "--out", str(tmp_path / "b.nc"))
    assert status == 0
    assert store.open(tmp_path / "b.nc").to_dataset().identical(answer)


def test_keys_and_help_come_from_the_classes(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "keys")
    assert status == 0
    assert all(f"compute = {word!r}" in out for word in QUESTIONS)
    status, out, _ = run(capsys, "run", "top-loop", "--help")
    assert status == 0
    assert "m g r, weight times" in out
    assert "--sections" in out
    status, out, err = run(capsys, "run", "--help")
    assert (status, err) == (0, "")
    status, _, err = run(capsys, "run", "top-lop", "--help")
    assert status == 2
    assert "did you mean 'top-loop'" in err


COMPLETIONS = {
    "earthspin sc": {"scenes"},
    "earthspin run top-l": {"top-loop"},
    "earthspin run top-loop --set top.th": {"top.theta=", "top.theta_rate="},
    "earthspin run precession --set top": set(),
    "earthspin plan precession --sections stand": {"standstills"},
    "earthspin keys polar": {"polar-motion"},
}


@pytest.mark.parametrize("line", COMPLETIONS)
def test_what_a_shell_is_offered(line: str) -> None:
    """As bash asks: the line in the environment, the words on file descriptor 8."""
    asked = {"_ARGCOMPLETE": "1", "_ARGCOMPLETE_IFS": "\n", "COMP_LINE": line}
    found = subprocess.run(
        ["bash", "-c", f"{sys.executable} -m earthspin 8>&1 9>/dev/null >/dev/null"],
        env={**os.environ, **asked, "COMP_POINT": str(len(line))},
        capture_output=True,
        text=True,
        check=False,
    ).stdout
    assert {word.strip() for word in found.split("\n") if word.strip()} == COMPLETIONS[line]


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_for_shells(capsys: pytest.CaptureFixture[str], shell: str) -> None:
    status, out, _ = run(capsys, "completion", shell)
    assert status == 0
    assert "earthspin" in out
    assert "_ARGCOMPLETE" in out


def wrong_commands(folder: Path) -> list[tuple[list[str], str]]:
    kernels = bad_kernels(folder)
    (folder / "scene.toml").write_text("compute = torque")
    (folder / "empty.toml").write_text('title = "no question"')
    (folder / "blocker").write_text("")
    blocked = str(folder / "blocker" / "out")
    return [
        (["run", "torqe"], "torque"),
        (["run", str(folder / "scene.toml")], "scene.toml"),
        (["run", str(folder / "empty.toml")], "compute"),
        (["run", "wobble", "--ephemeris", "de421"], "ephemeris"),
        (["run", "top-loop", "--set", "rotor.moments=1"], "rotor"),
        (["run", "torque", "--set", "nonsense"], "KEY=VALUE"),
        (["run", "torque", "--set", 'span=["1800-01-01", "1801-01-01"]'], "1899-07-29"),
        (["run", "torque", "--out", blocked], "blocker"),
        (["report", "--out", blocked], "blocker"),
        (["report", "--ephemeris", "de999"], "de999"),
        (["frobnicate"], "frobnicate"),
        (["run"], "scene"),
        *((["report", "--ephemeris", str(path), "--out", str(folder / "o")], str(path))
          for path in kernels.values()),
    ]  # fmt: skip


def test_every_mistake_is_one_line_and_status_two(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    for words, offender in wrong_commands(tmp_path):
        status, out, err = run(capsys, *words)
        assert status == 2, words
        assert out == "", words
        assert len(err.splitlines()) == 1, (words, err)
        assert offender in err, (words, err)
        assert "Traceback" not in err
    assert not (tmp_path / "o" / "index.html").exists()


def test_a_kernel_without_the_moon(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """An excerpt that holds the Sun and the Earth alone, made with jplephem's own tool."""
    from earthspin.sky.ephemeris import find_kernel

    path = tmp_path / "no-moon.bsp"
    subprocess.run(
        [
            *(sys.executable, "-m", "jplephem", "excerpt", "--targets", "3,10,399"),
            *("1990/1/1", "2010/1/1", str(find_kernel("de421")), str(path)),
        ],
        check=True,
        capture_output=True,
    )
    status, _, err = run(capsys, "run", "torque", "--ephemeris", str(path))
    assert status == 2
    assert "moon" in err
    assert str(path) in err
    status, _out, _ = run(
        capsys, "run", "torque", "--ephemeris", str(path), "--set", "perturbers=sun"
    )
    assert status == 0
    status, _, err = run(capsys, "report", "--ephemeris", str(path), "--out", str(tmp_path / "o"))
    assert status == 2
    shutil.rmtree(tmp_path / "o", ignore_errors=True)


def test_a_failed_report_leaves_the_old_one(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "index.html").write_text("old")
    status, _, _ = run(capsys, "report", "--out", str(tmp_path), "--ephemeris", "none.bsp")
    assert status == 2
    assert (tmp_path / "index.html").read_text() == "old"


#: Key that names a file, its question, and its word for a file that is shipped.
NAMING = [
    ("ephemeris", "precession", "de421"),
    ("orbit", "long-term", "own"),
    ("file", "polar-motion", "c04"),
]


def stored_naming(folder: Path, key: str, scene: str, word: str, file: object) -> Path:
    """A file with an answer whose scene names a file."""
    question = earthspin.load_scene(scene)
    answer = xr.Dataset(attrs={"scene": scene_text(question).replace(f'"{word}"', f'"{file}"')})
    assert f'{key} = "{file}"' in answer.attrs["scene"]
    return store.write(answer, folder / "stored.nc")


@pytest.mark.parametrize(("key", "scene", "word"), NAMING)
@pytest.mark.parametrize("content", [b"root:x:0:0:root:/root:/bin/sh\n", b"\0" * 999, b""])
def test_a_stored_scene_opens_no_file_of_another_kind(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    key: str,
    scene: str,
    word: str,
    content: bytes,
) -> None:
    (tmp_path / "private").write_bytes(content)
    path = stored_naming(tmp_path, key, scene, word, tmp_path / "private")
    status, out, err = run(capsys, "run", str(path))
    assert (status, out) == (2, "")
    assert str(tmp_path / "private") in err
    assert "stored scene" in err
    assert "root" not in err.replace(str(tmp_path), "")


def test_a_stored_scene_opens_no_file_of_members(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "m.csv").write_text("body.j2\n1.08e-3\n1.09e-3\n")
    text = f'compute = "wobble"\nmembers = "{tmp_path / "m.csv"}"\n'
    path = store.write(xr.Dataset(attrs={"scene": text}), tmp_path / "stored.nc")
    status, _, err = run(capsys, "run", str(path))
    assert status == 2
    assert "stored scene" in err


def test_a_file_that_a_stored_scene_names_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    kernel = tmp_path / "copy.bsp"
    shutil.copy(find_kernel("de421"), kernel)
    path = stored_naming(tmp_path, *NAMING[0], kernel)
    status, _, err = run(capsys, "plan", str(path))
    assert (status, err.count("\n")) == (0, 1)
    assert str(kernel) in err
    assert run(capsys, "plan", str(path), "--ephemeris", "de421")[2] == ""
    assert run(capsys, "plan", str(path), "--ephemeris", str(kernel))[2] == ""


@pytest.mark.parametrize(
    ("word", "answer"),
    [
        ("pole", "try: earthspin run pole\n"),
        ("long_term", "try: earthspin run long-term\n"),
        ("compare_iau", "try: earthspin run iau\n"),
        ("free-rotor", "try: earthspin run free-rotor\n"),
        ("sun-only", "try: earthspin run sun-only\n"),
        ("rum", "did you mean 'run'?"),
    ],
)
def test_a_word_that_is_no_command_is_answered_by_one(
    capsys: pytest.CaptureFixture[str], word: str, answer: str
) -> None:
    status, out, err = run(capsys, word)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert answer in err


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (ImportError("libopenblas.so: failed to map segment"), "libopenblas.so.*ulimit -v"),
        (OSError(errno.ENOMEM, "Cannot allocate memory"), "not enough memory.*ulimit -v"),
    ],
)
def test_a_limit_of_memory_is_no_defect(
    capsys: pytest.CaptureFixture[str], error: Exception, words: str
) -> None:
    status = process.run_command(mock.Mock(side_effect=error))
    assert status == 2
    assert re.search(words, capsys.readouterr().err)
