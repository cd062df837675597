"""Ensembles whose members differ in words: orbits, kernels, models, bodies by name."""

from __future__ import annotations

import hashlib
import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import earthspin
from earthspin import EarthspinError, OutputError, SceneError
from earthspin.engine.ensemble import LARGEST_NUMBER_OF_RUNS, ROW, Ensemble
from earthspin.scenes import QUESTIONS, VersionWarning
from earthspin.sky.eop import file_of
from earthspin.sky.ephemeris import open_ephemeris
from earthspin.sky.orbit_table import shipped
from tests.engine.test_ensemble import asked, differ
from tests.engine.work import assert_is_alone, bytes_of
from tests.refusals import refused

OWN, ROUND, COPY = "own", "round.dat", "earth.npz"


def write_orbit(path: str, eccentricity: float) -> None:
    """A table in the manner of La2010: in the ecliptic, its perihelion going round."""
    t = np.arange(-60.0, 61.0)
    sines = {"k": np.cos(t / 15), "h": np.sin(t / 15), "q": 0 * t, "p": 0 * t}
    rows = {name: eccentricity * sine for name, sine in sines.items()}
    pd.DataFrame({"t": t} | rows).to_csv(path, sep=" ", index=False)


@pytest.fixture
def orbits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with two tables of an orbit, and work in it."""
    monkeypatch.chdir(tmp_path)
    write_orbit(ROUND, 0.01)
    own = shipped("earth")
    assert own is not None
    own.to_file(COPY)
    return tmp_path


def long_term(members: object = None, **keys: Any) -> Any:
    """Twenty thousand years, with members."""
    span = {"span": ("-20 kyr", "0 kyr"), "step": "10 kyr"}
    return QUESTIONS["long-term"](members=members, **(span | keys))


# --- orbits --------------------------------------------------------------------------------------


@pytest.mark.parametrize("given", ["names", "paths"])
def test_orbits_and_numbers_make_a_grid(orbits: Path, given: str) -> None:
    tables = [OWN, ROUND, COPY] if given == "names" else [OWN, Path(ROUND), Path(COPY)]
    grid = {"orbit": {"grid": tables}, "tides": {"grid": [0.5, 1.0]}}
    question = long_term(grid)
    assert Ensemble(question).width > 1
    many = earthspin.run(question)
    assert many.orbit.values.tolist() == [OWN, ROUND, COPY] * 2
    assert many.orbit.attrs == {"long_name": "orbit of the member", "input": "orbit"}
    assert many.tides.values.tolist() == [0.5] * 3 + [1.0] * 3
    for place in range(6):
        keys = {"orbit": str(many.orbit.values[place]), "tides": float(many.tides[place])}
        assert_is_alone(many, place, earthspin.run(long_term(**keys)))


def mixed(n: int, **settings: Any) -> Any:
    """Members of which each has one of three orbits, and tides of its own."""
    drawn = {"orbit": {"choice": [OWN, ROUND, COPY]}, "tides": {"uniform": [0.9, 1.1]}}
    return long_term({"n": n, **drawn, **settings}, span=("-2 kyr", "0 kyr"), step="1 kyr")


@pytest.mark.slow
def test_a_member_is_the_same_alone_and_in_any_block(orbits: Path) -> None:
    many = earthspin.run(mixed(ROW + 6))
    assert len(np.unique(many.orbit)) == 3
    for number in (17, ROW + 2):
        alone = earthspin.run(mixed(ROW + 6, only=[number]))
        assert differ(alone, many.isel(member=[number])) == []
    for block in (7, 45):
        assert differ(earthspin.ensemble(mixed(ROW + 6), block=block), many) == []
    again = earthspin.ensemble(mixed(1).replace(members=None), many.isel(member=[2, 3]))
    assert differ(again.drop_vars("member"), many.isel(member=[2, 3]).drop_vars("member")) == []


@pytest.mark.slow
def test_more_orbits_than_are_kept_at_a_time(orbits: Path) -> None:
    names = [f"{number}.dat" for number in range(LARGEST_NUMBER_OF_RUNS + 2)]
    for number, name in enumerate(names):
        write_orbit(name, 0.01 + 0.001 * number)
    grid = {"orbit": {"grid": names}, "tides": {"grid": [1.0, 1.0]}}
    many = earthspin.run(long_term(grid, span=("-2 kyr", "0 kyr"), step="1 kyr"))
    expected = 2 * [0.01 + 0.001 * number for number in range(LARGEST_NUMBER_OF_RUNS + 2)]
    np.testing.assert_allclose(many.eccentricity[:, 0], expected, rtol=1e-9, atol=0)


@pytest.mark.slow
def test_files_and_stores_keep_the_words(orbits: Path) -> None:
    answer = earthspin.run(mixed(9))
    assert earthspin.run(answer).identical(answer)
    assert earthspin.open(earthspin.write(answer, "r.nc")).identical(answer)
    stored = earthspin.ensemble(mixed(9), path="r.zarr", block=2)
    assert stored.load().identical(answer)
    assert earthspin.verify("r.zarr")
    again = earthspin.ensemble(mixed(1).replace(members=None), answer)
    assert earthspin.run(again).identical(again)


@pytest.mark.slow
def test_a_store_by_two_workers_is_the_same(orbits: Path) -> None:
    # workers see the same files, not from the same folder
    chosen = [OWN, str(orbits / ROUND), str(orbits / COPY)]
    question = mixed(30, orbit={"choice": chosen})
    earthspin.ensemble(question, path="plain.zarr", block=7)
    earthspin.ensemble(question, path="two.zarr", block=7, client=2)
    assert bytes_of(orbits / "plain.zarr") == bytes_of(orbits / "two.zarr")


def test_what_differs_between_orbits_is_told_with_its_name(orbits: Path) -> None:
    many = earthspin.run(long_term({"orbit": {"grid": [ROUND, COPY]}}))
    sums = [hashlib.sha256(Path(name).read_bytes()).hexdigest() for name in (ROUND, COPY)]
    assert many.attrs["orbit_sha256"] == f"{ROUND}: {sums[0]}; {COPY}: {sums[1]}"
    assert many.obliquity.attrs["orbit"].startswith(f"{ROUND}: {ROUND}, ECLIPJ2000; {COPY}: ")
    assert many.obliquity.attrs["orbit_of"] == "earth"
    for name in (ROUND, COPY):
        assert f"{name}: Newton's method" not in many.pole_error.attrs["method"]
    alone = earthspin.run(long_term({"orbit": {"grid": [ROUND]}}))
    assert alone.attrs["orbit_sha256"] == sums[0]


# --- what a store was made of --------------------------------------------------------------------


def test_a_file_that_changed_is_noticed(orbits: Path) -> None:
    """By a complete store, by one that was begun, and when an answer is run again."""
    complete, begun = Path("complete.zarr"), Path("begun.zarr.partial")
    answer = earthspin.ensemble(mixed(9), path=complete, block=2)
    before = bytes_of(complete)
    begun.mkdir()
    work = Ensemble(mixed(9), block=2)
    record = dict(work.request) | {"size": "9 along member by 2", "format of files": "2"}
    (begun / "asked.json").write_text(json.dumps(record))
    write_orbit(ROUND, 0.02)
    with pytest.raises(OutputError, match="another question"):
        earthspin.ensemble(mixed(9), path=complete, block=2)
    assert bytes_of(complete) == before
    with pytest.raises(OutputError, match=r"orbit sha256 of round\.dat"):
        earthspin.ensemble(mixed(9), path="begun.zarr", block=2)
    with pytest.warns(VersionWarning, match="orbit_sha256"):
        earthspin.run(answer)


@pytest.mark.parametrize("word", ["precession", "torque", "pole", "long-term", "rotation"])
def test_stores_know_their_kernel(word: str) -> None:
    """Whatever differs among the members: numbers of a body change what is read from it."""
    path = open_ephemeris("de421").path
    record = Ensemble(asked(word)).request
    assert record["ephemeris_sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()


def test_a_kernel_that_changed_is_noticed(orbits: Path) -> None:
    """Alone and among others, though the numbers of a body are all that members differ in."""
    mine = Path(shutil.copy(open_ephemeris("de421").path, "mine.bsp"))
    inputs = {"n": 3, "body.j2": {"normal": [earthspin.EARTH.j2, 1e-10]}}
    alone = QUESTIONS["precession"](ephemeris=mine, members=inputs)
    both = {**inputs, "n": 4, "ephemeris": {"grid": ["de421", "mine.bsp"]}}
    among = QUESTIONS["precession"](members=both)
    many = earthspin.run(among)
    second = earthspin.run(among.replace(members={**both, "only": [1]}))
    assert_is_alone(many, 1, second.isel(member=0))
    assert ";" not in many.attrs["ephemeris_sha256"]
    assert many.attrs["ephemeris"] == "de421: de421; mine.bsp: mine.bsp"
    before = [Ensemble(question).request for question in (alone, among)]
    with mine.open("r+b") as file:
        file.seek(16)  # the name that a DAF file gives itself
        file.write(b"another")
    after = [Ensemble(question).request for question in (alone, among)]
    for old, new, where in zip(before, after, ("", " of mine.bsp"), strict=True):
        assert [name for name in old if old[name] != new[name]] == [f"ephemeris_sha256{where}"]


def test_answers_know_the_tables_that_they_were_read_from(orbits: Path) -> None:
    text = earthspin.run(long_term(orbit=ROUND))
    digest = hashlib.sha256(Path(ROUND).read_bytes()).hexdigest()
    assert text.attrs["orbit_sha256"] == digest
    table = earthspin.read_orbit(COPY)
    from_table = earthspin.run(long_term(orbit=table))
    assert from_table.attrs["orbit_sha256"] == table.sha256
    assert earthspin.run(from_table).identical(from_table)
    from_frame = earthspin.read_orbit(pd.read_csv(ROUND, sep=" "))
    assert "orbit_sha256" not in earthspin.run(long_term(orbit=from_frame)).attrs
    pole = earthspin.polar_motion(span=("2000-01-01", "2001-01-01"))
    assert pole.attrs["table_sha256"] == hashlib.sha256(file_of("c04").read_bytes()).hexdigest()


# --- other questions -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("word", "key", "words"),
    [
        ("precession", "source", ["jplephem", "skyfield"]),
        ("torque", "equator", ["true", "mean"]),
        ("wobble", "ocean", ["global", "real"]),
        ("spheroid", "body", ["mars", "earth"]),
        ("polar-motion", "method", ["burg", "likelihood"]),
        ("polar-motion", "file", ["c04"]),
        ("love-numbers", "interior", ["prem"]),
    ],
)
def test_words_of_other_questions(word: str, key: str, words: list[str]) -> None:
    question = asked(word).replace(members=None)
    many = earthspin.ensemble(question, {key: {"grid": words}})
    assert many[key].values.tolist() == words
    for place, choice in enumerate(words):
        assert_is_alone(many, place, earthspin.run(question.replace(**{key: choice})))


def test_members_that_are_computed_one_by_one_have_their_own_words() -> None:
    """The mass of a perturber is no array in a torque, so that each member runs alone."""
    times, mass = ["2000-01-01", "2001-01-01"], earthspin.MOON.gm
    changes = {"moon.gm": {"grid": [mass, 1.001 * mass]}, "equator": {"grid": ["mean", "true"]}}
    many = earthspin.ensemble(QUESTIONS["torque"](times=times), changes)
    assert many.sizes["member"] == 4
    for index in range(4):
        member = many.isel(member=index)
        alone = earthspin.torque_series(
            times=times,
            perturbers=["sun", earthspin.MOON.replace(gm=float(member.moon_gm.item()))],
            equator=member.equator.item(),
        )
        assert np.array_equal(member.torque, alone.torque)


def test_words_that_do_not_go_with_the_question_are_left_out() -> None:
    """The Moon does not pull on itself."""
    question = QUESTIONS["precession"](perturbers=["sun", "moon"])
    grid = {"body": {"grid": ["earth", "moon", "earth"]}}
    with pytest.raises(SceneError, match=r"'1'.*cannot exist"):
        earthspin.ensemble(question, grid)
    kept = earthspin.ensemble(question, grid, impossible="drop")
    assert kept.member.values.tolist() == [0, 2]
    assert kept.attrs["members_dropped"] == "1 that cannot exist: 1"


def test_words_that_change_the_labels_are_refused() -> None:
    with pytest.raises(SceneError, match=r"member 1 .*'perturber'"):
        earthspin.ensemble("precession", {"body": {"grid": ["earth", "mars"]}})


# --- what they tell ------------------------------------------------------------------------------


def test_the_share_of_words_is_eta_squared(orbits: Path) -> None:
    """The variance between the means of classes over the whole."""
    many = earthspin.run(mixed(40))
    shares = many.earthspin.sensitivity()
    assert shares.input.values.tolist() == ["tides", "orbit"]
    y, orbit = many.obliquity.isel(epoch=0).values, many.orbit.values
    between = sum((orbit == o).mean() * (y[orbit == o].mean() - y.mean()) ** 2 for o in {*orbit})
    share = float(shares.obliquity_share.isel(epoch=0).sel(input="orbit"))
    # tides are drawn, and lean a little on the orbits: they have 1e-9 of the variance (measured)
    assert share == pytest.approx(between / y.var(), rel=0, abs=1e-6)
    assert np.isnan(shares.obliquity_slope.sel(input="orbit")).all()
    assert np.isfinite(shares.obliquity_slope.sel(input="tides")).all()
    assert shares.obliquity_slope.attrs["no_slope"] == "inputs that are names have no slope"
    middle = many.earthspin.quantiles([0.5])
    median = many.obliquity.median("member")
    np.testing.assert_allclose(middle.obliquity[0], median, rtol=1e-15, atol=0)


def test_words_ask_for_as_many_members_as_there_are(orbits: Path) -> None:
    three = earthspin.run(long_term({"orbit": {"grid": [OWN, ROUND, COPY]}}))
    with pytest.raises(SceneError, match="at least 4 members"):
        three.earthspin.sensitivity()


# --- what cannot be ------------------------------------------------------------------------------


test_bad_words_are_refused = pytest.mark.usefixtures("orbits")(
    refused(
        ({"n": 3, "orbit": {"normal": [OWN, ROUND]}}, "numbers; .* give choice or"),
        ({"n": 3, "orbit": {"uniform": [OWN, ROUND]}}, "numbers; .* give choice or"),
        ({"n": 3, "orbit": {"choice": []}}, "one value or more"),
        ({"n": 3, "orbit": {"choice": [OWN, 3]}}, 'members.orbit = 3: it is "own"'),
        ({"n": 3, "orbit": {"choice": [OWN, " "]}}, "the path of a table"),
        ({"n": 3, "orbit": {"choice": [OWN, "nowhere.dat"]}}, "'nowhere.dat': it cannot be read"),
        ({"n": 3, "orbit": OWN}, "a table like normal"),
        ({"n": 3, "source": {"choice": ["skyfeld"]}}, "did you mean 'skyfield'"),
        ({"n": 3, "body": {"grid": ["mrs"]}}, "did you mean 'mars'"),
        ({"body": {"grid": ["earth"]}, "body.j2": {"grid": [1e-3]}}, "differ in 'body' itself"),
        ({"n": 3, "perturbers": {"choice": ["sun"]}}, "allowed: body"),
        ({"n": 3, "title": {"choice": ["a"]}}, "allowed|did you mean"),
        (xr.Dataset({"orbit": ("member", np.array([OWN, None]))}), "'member 1'.*a name for each"),
        (xr.Dataset({"orbit": ("member", np.array([OWN, np.nan], "O"))}), "'member 1'"),
        (xr.Dataset({"orbit": ("member", [OWN, ""])}), "orbit = ''"),
        (xr.Dataset({"orbit": ("member", [1.0, 2.0])}), 'orbit = 1.0: it is "own"'),
        (xr.Dataset({"tides": ("member", [OWN, ROUND])}), "tides = 'own': give finite numbers"),
        (xr.Dataset({"orbit": (("member", "x"), [[OWN, ROUND]])}), "one name for each member"),
        ({"values": {"orbit": [OWN, 3]}}, "'member 1'"),
        ({"values": {"orbit": []}}, "one name for each member"),
        ({"values": {"orbit": OWN}}, "one name for each member"),
        ({"values": [OWN]}, "a table of inputs"),
        ({"n": 3, "orbit": {"choice": [[OWN], {}]}}, "the path of a table"),
        call=lambda members: earthspin.ensemble(long_term(), members),
    )
)


def test_a_table_that_is_no_text_is_refused(orbits: Path) -> None:
    table = earthspin.read_orbit(ROUND)
    with pytest.raises(SceneError, match="'OrbitTable'"):
        earthspin.ensemble(long_term(), {"orbit": {"grid": [OWN, table]}})


def test_files_of_members(orbits: Path) -> None:
    Path("m.csv").write_text(f"member, orbit, tides\n0, {OWN}, 1\n1, {ROUND}, 0.9\n")
    by_table = earthspin.ensemble(long_term(), "m.csv")
    members = xr.Dataset({"orbit": ("member", [OWN, ROUND]), "tides": ("member", [1.0, 0.9])})
    members.to_netcdf("m.nc")
    assert differ(by_table, earthspin.ensemble(long_term(), "m.nc")) == []
    assert by_table.orbit.values.tolist() == [OWN, ROUND]
    Path("gap.csv").write_text(f"orbit,tides\n{OWN},1\n,0.9\n")
    Path("long.csv").write_text(f"orbit,tides\n{OWN},1,0.0025\n{OWN},0.9,0.0025\n")
    Path("bad.csv").write_bytes(b"\x00\xff")
    Path("m.txt").write_text("")
    for name, words in (
        ("gap.csv", "'member 1'.*a name for each member"),
        ("long.csv", r"long\.csv.*it cannot be read"),
        ("bad.csv", "it cannot be read"),
        ("m.txt", r"must end in \.csv"),
    ):
        with pytest.raises(EarthspinError, match=words):
            earthspin.ensemble(long_term(), name)


def test_a_body_whose_orbit_is_not_shipped_has_those_of_its_members(orbits: Path) -> None:
    """The question by itself has no answer; that of each member has one."""
    write_orbit("wide.dat", 0.02)
    saturn = long_term({"orbit": {"grid": [ROUND, "wide.dat"]}}, body="saturn", perturbers=["sun"])
    with pytest.raises(EarthspinError, match=r"no orbit .*shipped"):
        earthspin.run(saturn.replace(members=None))
    tree = earthspin.run_tree(saturn)
    np.testing.assert_allclose(tree.eccentricity[:, 0], [0.01, 0.02], rtol=1e-9, atol=0)
    assert "neglected" in tree.children
