"""The command `ensemble`: a store and a table, lines for programs, one line for what is wrong."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import earthspin
from earthspin import cli


def test_a_store_and_a_table(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "r.zarr"
    words = ["ensemble", "precession-ensemble", "--members", "70", "--seed", "5"]
    assert cli.main([*words, "--block", "32", "--out", str(path)]) == 0
    told = capsys.readouterr().out
    assert "70 members, which differ in" in told
    assert f"wrote {path}" in told
    answer = earthspin.open(path)
    expected = earthspin.ensemble("precession-ensemble", 70, seed=5)
    assert answer.load().identical(expected)


def test_lines_for_programs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "r.zarr"
    words = ["ensemble", "wobble-ensemble", "--members", "5", "--out", str(path), "--json"]
    assert cli.main(words) == 0
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert lines[-2]["done"] == lines[-2]["of"] == 5
    assert lines[-2]["left"] in (0, None)
    assert lines[-1] == {"wrote": str(path), "members": 5}


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--members", "0"], "between 1 and"),
        (["--members", "nowhere.csv"], "there is no such file"),
        (["--workers", "0"], "give a number of workers"),
        (["--block", "0"], "give a whole number, 1 or more"),
        (["--out", "r.nc"], "does not end in .zarr"),
        (["--set", "body.j2=5"], "is not possible"),
    ],
)
def test_what_is_wrong_is_one_line(
    tmp_path: Path, words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    out = ["--out", str(tmp_path / "r.zarr")]
    assert cli.main(["ensemble", "wobble-ensemble", *out, *words]) == 2
    complaint = capsys.readouterr().err
    assert said in complaint
    assert complaint.count("\n") == 1
    assert not (tmp_path / "r.zarr").exists()


def test_members_must_be_said_by_someone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["ensemble", "wobble", "--out", str(tmp_path / "r.zarr")]) == 2
    assert "say how many members" in capsys.readouterr().err
