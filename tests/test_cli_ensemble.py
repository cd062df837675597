"""The command `ensemble`: a store and a table, lines for programs, one line for what is wrong."""

import json
from pathlib import Path

import pytest

import earthspin
from earthspin import cli, process
from earthspin.views import rendering


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
        (["--members", "0"], "give a whole number, 1 or more"),
        (["--members", "nowhere.csv"], "there is no such file"),
        (["--workers", "0"], "(of workers)"),
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
    assert "give the number of members" in capsys.readouterr().err


#: Ensembles in which no number differs among the members, and one in which some differ.
ALIKE = [
    ("love-numbers", '{interior={grid=["prem"]}}'),
    ("love-numbers", '{n=3,"anelastic_exponent"={uniform=[0.1,0.2]}}'),
    ("precession", '{"body.dynamical_flattening"={grid=[3.27e-3,3.27e-3]}}'),
    ("wobble", '{n=6,"body.j3"={normal=[-2.5e-6,1e-9]}}'),
    ("wobble", '{n=6,"anelastic_exponent"={uniform=[0.1,0.2]}}'),
]


@pytest.mark.parametrize(("scene", "members"), ALIKE)
def test_members_that_hardly_differ(
    tmp_path: Path, scene: str, members: str, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["run", scene, "--set", f"members={members}"]
    assert cli.main([*words, "--out", str(tmp_path)]) == 0, capsys.readouterr().err
    earthspin.verify(tmp_path / f"{scene}.nc")
    assert (tmp_path / f"{scene}.html").exists()
    assert "members" in capsys.readouterr().out


@pytest.mark.parametrize("scene", ["wobble", "wobble-ensemble"])
@pytest.mark.parametrize("fails", ["print_tables", "scene_page"])
def test_results_are_stored_before_they_are_shown(
    tmp_path: Path,
    scene: str,
    fails: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def failing(*_: object) -> None:
        raise StopIteration

    monkeypatch.setattr(rendering, fails, failing)
    assert cli.main(["run", scene, "--out", str(tmp_path)]) == process.DEFECT
    complaint = capsys.readouterr().err
    data = tmp_path / f"{scene}.nc"
    assert complaint.count("\n") == 1
    assert str(data) in complaint
    assert earthspin.verify(data) == data
