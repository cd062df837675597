"""Orbits from files and frames: layouts, axes, units, and every refusal in one line."""

import contextlib
import tracemalloc
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

import earthspin
from earthspin import SeriesError, read_orbit
from earthspin.constants import JULIAN_YEAR
from earthspin.sky.orbit_files import FRAMES, axes_of
from earthspin.sky.orbit_table import shipped
from tests.refusals import refused

KYR = 1000 * JULIAN_YEAR
TABLE = shipped("earth")
assert TABLE is not None
YEARS = np.arange(-60_000.0, 20_001.0, 400.0)


def elements(frame: str = "ECLIPJ2000", world: str = "earth") -> pd.DataFrame:
    """Elements of a shipped orbit as HNBody would print them: t in days, angles in degrees."""
    of = shipped(world)
    assert of is not None
    n, e, _ = (axes_of(frame) @ vector for vector in of.at(YEARS * JULIAN_YEAR))
    node = np.arctan2(n[0], -n[1])
    along = np.stack([np.cos(node), np.sin(node), 0 * node])
    beside = np.cross(n.T, along.T).T
    argument = np.arctan2(np.sum(e * beside, axis=0), np.sum(e * along, axis=0))
    degrees = np.degrees([np.arccos(n[2]), node + argument, node, argument]) % 360
    return pd.DataFrame(
        {
            "t": YEARS * 365.25,
            "a": 1.0,
            "e": np.linalg.norm(e, axis=0),
            "inc": degrees[0],
            "varpi": degrees[1],
            "Omega": degrees[2],
            "omega": degrees[3],
        }
    )


def la2010(frame: str = "ECLIPJ2000") -> pd.DataFrame:
    """t in kyr, a, l, k, h, q, p."""
    of = elements(frame)
    varpi, node, half = np.radians([of.varpi, of.Omega, of.inc / 2])
    return pd.DataFrame(
        {
            "t": YEARS / 1000,
            "a": 1.0,
            "l": 0.0,
            "k": of.e * np.cos(varpi),
            "h": of.e * np.sin(varpi),
            "q": np.sin(half) * np.cos(node),
            "p": np.sin(half) * np.sin(node),
        }
    )


def assert_same(found: earthspin.sky.orbit_table.OrbitTable, world: str = "earth") -> None:
    of = shipped(world)
    assert of is not None
    at = np.linspace(-59, 19, 313) * KYR
    # few rows in a window are joined by splines, which round off corners between windows
    for one, other, bound in zip(found.at(at)[:2], of.at(at)[:2], (2e-6, 2e-5), strict=True):
        assert np.max(np.linalg.norm(one - other, axis=0)) < bound


def no(*columns: str) -> Callable[[pd.DataFrame], pd.DataFrame]:
    return lambda frame: frame.drop(columns=list(columns))


@pytest.mark.parametrize(
    "form",
    [
        no("omega"),
        no("varpi"),
        lambda f: no("omega")(f)[::-1],
        lambda f: no("omega")(f).rename(columns={"varpi": "lph", "Omega": "lan", "e": "ee"}),
        lambda f: no("omega", "varpi", "a")(f).assign(arp=f.omega),
        lambda f: f.assign(**{c: np.radians(f[c]) for c in ("inc", "varpi", "Omega", "omega")}),
    ],
    ids=["varpi", "argument", "descending", "snvec", "arp", "radians"],
)
def test_elements_in_a_frame(form: Callable[[pd.DataFrame], pd.DataFrame]) -> None:
    assert_same(read_orbit(form(elements())))


@pytest.mark.parametrize("frame", FRAMES)
def test_every_frame_gives_the_same_orbit(frame: str) -> None:
    assert_same(read_orbit(elements(frame), frame=frame))
    assert_same(read_orbit(la2010(frame), frame=frame))
    assert_same(read_orbit(la2010(frame), frame=axes_of(frame)))


def test_frames_as_spice_defines_them() -> None:
    """SPICE: pxform("J2000", "ECLIPJ2000") holds cos and sin of 84381.448 arcsec; the Sun's equator
    leans 7.25 degrees with its node at 75.77 (Thompson 2006, A&A 449, 791: 7.25, 75.76)."""
    assert np.allclose(
        axes_of("ECLIPJ2000"),
        [[1, 0, 0], [0, 0.917482062069, 0.397777155932], [0, -0.397777155932, 0.917482062069]],
        rtol=0,
        atol=1e-12,
    )
    for frame, tilt, node in (("HCI", 7.25, 75.77), ("HCI-snvec", 7.155, 75.594)):
        x, _, z = axes_of(frame) @ axes_of("ECLIPJ2000").T
        assert np.degrees(np.arccos(z[2])) == pytest.approx(tilt, rel=0, abs=0.005)
        assert np.degrees(np.arctan2(x[1], x[0])) == pytest.approx(node, rel=0, abs=0.01)
        assert x[2] == pytest.approx(0.0, rel=0, abs=1e-15)
    assert np.array_equal(axes_of("ICRF"), np.eye(3))


def text(frame: pd.DataFrame, sep: str = " ", header: bool = False) -> str:
    return frame.to_csv(sep=sep, header=header, index=False, float_format="%.14e")


@pytest.mark.parametrize(
    "content",
    [
        lambda: text(la2010()),
        lambda: text(no("omega")(elements())),
        lambda: text(elements().assign(x=0.0, y=0.0).iloc[:, [0, 1, 2, 3, 4, 5, 6, 7]]),
        lambda: "# made\n# " + text(no("varpi")(elements()), header=True),
        lambda: text(la2010(), ",", header=True),
        lambda: "%t(kyr) a l k h q p\n" + text(la2010()).replace("e-", "D-").replace("e+", "D+"),
    ],
    ids=["La2010", "six", "eight", "named", "csv", "Fortran"],
)
def test_files_of_text(tmp_path: Path, content: Callable[[], str]) -> None:
    path = tmp_path / "orbit.dat"
    path.write_text(content())
    found = read_orbit(str(path))
    assert_same(found)
    assert "orbit.dat" in found.source
    assert "ECLIPJ2000" in found.source


def test_times_in_other_units() -> None:
    assert_same(read_orbit(la2010().assign(t=YEARS), time="yr"))
    assert_same(read_orbit(elements().assign(t=YEARS / 1000), time="kyr"))


def test_an_orbit_of_another_body_may_lean() -> None:
    assert_same(read_orbit(elements(world="mars"), body="mars"), "mars")


def test_written_and_read_again(tmp_path: Path) -> None:
    found = read_orbit(elements())
    found.to_file(tmp_path / "mine.npz")
    again = read_orbit(tmp_path / "mine.npz")
    again.to_file(tmp_path / "again.npz")
    assert np.max(np.abs(again.coefficients - found.coefficients)) <= 0.5e-9
    assert np.array_equal(read_orbit(tmp_path / "again.npz").coefficients, again.coefficients)


@given(st.floats(0, 3.0), st.floats(0, 6.2), st.floats(0, 6.2), st.floats(0, 0.9))
def test_both_layouts_are_the_same_orbit(tilt: float, node: float, varpi: float, e: float) -> None:
    """q + ip and k + ih against elements, for any fixed ellipse."""
    t = np.arange(-40.0, 1.0)
    of = pd.DataFrame({"t": t}).assign(e=e, inc=tilt, varpi=varpi, Omega=node)
    one = read_orbit(of, body="x", time="kyr", angles="rad")
    sines = np.sin(tilt / 2)
    other = read_orbit(
        pd.DataFrame({"t": t}).assign(
            k=e * np.cos(varpi), h=e * np.sin(varpi), q=sines * np.cos(node), p=sines * np.sin(node)
        ),
        body="x",
    )
    at = np.array([-30.5]) * KYR
    for a, b in zip(one.at(at), other.at(at), strict=True):
        assert np.allclose(a, b, rtol=0, atol=1e-12)


# --- refusals ------------------------------------------------------------------------------------


def where(row: int, **values: float) -> Callable[[pd.DataFrame], pd.DataFrame]:
    """Change one row of a table."""
    return lambda frame: frame.assign(
        **{name: frame[name].where(frame.index != row, value) for name, value in values.items()}
    )


def radians(frame: pd.DataFrame) -> pd.DataFrame:
    """Angles in radians, the node within a turn about its middle."""
    node = np.radians((frame.Omega - frame.Omega[100]) % 360)
    return frame.assign(inc=np.radians(frame.inc), varpi=np.radians(frame.varpi), Omega=node)


test_each_mistake_is_one_clear_line = refused(
    (lambda f: f.drop(index=[50, 51]), {}, "row 50: a gap between times"),
    (lambda f: f.iloc[[*range(20), 30, *range(20, 201)]], {}, "comes after .*; sort the rows"),
    (lambda f: f.iloc[[*range(21), *range(20, 201)]], {}, "row 21: time .* stands twice"),
    (where(7, e=np.nan), {}, "row 7: e is not a number"),
    (where(7, e=1.0), {}, "row 7: an eccentricity of 1; it lies between"),
    (lambda f: la2010().assign(k=1.0), {}, "an eccentricity of 1"),
    (
        lambda f: f.assign(e=0.6),
        {},
        "an eccentricity of 0.6, where that of earth stays below 0.061; is it another body",
    ),
    (
        lambda f: elements(world="mars").assign(e=0.3),
        {"body": "mars"},
        "that of mars stays below 0.1",
    ),
    (lambda f: f.iloc[150:160], {}, "10 rows are too few"),
    (lambda f: pd.DataFrame({"x": [1.0]}), {}, "no column t and none e"),
    (lambda f: f.assign(inc="steep"), {}, "column 'inc' holds more than numbers"),
    (lambda f: la2010(), {"time": "d"}, "rows are 0.0011 yr apart.*time = 'yr' or 'kyr'"),
    (lambda f: f, {"time": "kyr"}, "apart, where 1 to 5000 yr"),
    (lambda f: f, {"angles": "rad"}, "these are degrees, not radians; give angles = 'deg'"),
    (radians, {"angles": "deg"}, "radians, not degrees|leans"),
    (lambda f: la2010().assign(q=2.0), {}, "sin\\(inc/2\\) is 1 or more"),
    (lambda f: elements("HCI"), {}, "leans 7.3 deg on the ecliptic.*frame = 'HCI'"),
    (lambda f: elements("HCI-snvec"), {"frame": "HCI"}, "leans 0.097 deg .*frame = 'HCI-snvec'"),
    (lambda f: elements(world="mars"), {}, "or another body: body ="),
    (lambda f: f.iloc[:100], {}, "J2000.0, from which the axis starts"),
    (lambda f: f.assign(varpi=f.varpi + 3600, inc=1.0), {}, "say which: angles"),
    (where(9, inc=90.0), {"body": "x"}, "plane jumps by"),
    (lambda f: f.assign(inc=-1.0), {"angles": "deg"}, "lies between 0 and 180"),
    (lambda f: f, {"frame": "HCJ"}, "did you mean 'HCI'"),
    (lambda f: f, {"frame": np.ones((3, 3))}, "unit vectors"),
    (lambda f: f, {"time": "ky"}, "allowed: d, kyr, yr"),
    (lambda f: f, {"angles": "grad"}, "allowed: deg, rad"),
    (lambda f: 3, {}, "give the path of a file, or a DataFrame"),
    (lambda f: "nowhere.dat", {}, "cannot be read"),
    (lambda f: "nowhere.npz", {}, "cannot be read"),
    call=lambda change, keys: read_orbit(change(elements()), **keys),
)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("", "holds no rows"),
        ("nothing but words\n", "holds no rows"),
        ("1 2 3\n2 3 4\n", "3 columns without names are no known layout"),
        ("0 1 0 0 0 0 0\n1 1 0 0\n", "line 2: 4 columns; 7 are expected; is the file cut off"),
        ("0 1 0 0 0 0 0\n1 1 0 x 0 0 0\n", "line 2: could not convert"),
    ],
)
def test_files_that_hold_something_else(tmp_path: Path, content: str, words: str) -> None:
    path = tmp_path / "orbit.dat"
    path.write_text(content)
    with pytest.raises(SeriesError, match=words):
        read_orbit(path)


def test_the_line_of_a_file_is_named(tmp_path: Path) -> None:
    lines = text(la2010()).splitlines()
    del lines[30]
    path = tmp_path / "orbit.dat"
    path.write_text("# head\n" + "\n".join(lines))
    with pytest.raises(SeriesError, match=r"orbit.dat', line 32: a gap between times") as told:
        read_orbit(path)
    assert told.value.line == 32


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04 and no more", b"no archive"])
def test_an_archive_that_is_none(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "orbit.npz"
    path.write_bytes(content)
    with pytest.raises(SeriesError, match="to_file"):
        read_orbit(path)
    np.savez(path, x=np.ones(3))
    with pytest.raises(SeriesError, match="to_file"):
        read_orbit(path)
    (tmp_path / "a.npz").mkdir()
    with pytest.raises(SeriesError, match="folder"):
        read_orbit(tmp_path / "a.npz")


def test_the_obliquity_on_an_orbit_from_a_file_is_that_on_our_own() -> None:
    times = ["-50 kyr", "-10 kyr", "0 kyr", "10 kyr"]
    ours = earthspin.long_term(times=times)
    read = earthspin.long_term(times=times, orbit=read_orbit(elements()))
    off = np.abs(read.obliquity - ours.obliquity) * 3600
    assert float(off.max()) < 0.5
    assert "DataFrame" in read.obliquity.attrs["orbit"]


def test_a_line_of_text_after_the_rows_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "orbit.txt"
    lines = text(la2010()).splitlines()
    path.write_text("\n".join([*lines, "# made by hand", ""]))
    read_orbit(path)
    path.write_text("\n".join([*lines[:-1], "x" + lines[-1]]))
    with pytest.raises(SeriesError) as error:
        read_orbit(path)
    assert error.value.line == len(lines)


def _arrays(file: Path) -> dict[str, np.ndarray]:
    with np.load(file) as archive:
        return dict(archive)


@pytest.fixture
def stored(tmp_path: Path) -> Path:
    file = tmp_path / "mine.npz"
    read_orbit(elements()).to_file(file)
    return file


def test_a_damaged_archive_is_refused_or_read_as_it_was(stored: Path) -> None:
    """One flipped bit of a file: what is read is the table, or one line says that it is none."""
    content, whole = stored.read_bytes(), read_orbit(stored)
    flips = np.random.default_rng(1).integers(0, 8 * len(content), 300)
    for flip in flips.tolist():
        damaged = bytearray(content)
        damaged[flip // 8] ^= 1 << (flip % 8)
        stored.write_bytes(damaged)
        with contextlib.suppress(SeriesError):
            table = read_orbit(stored)
            assert np.array_equal(table.coefficients, whole.coefficients)
            assert np.array_equal(table.edges, whole.edges)


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("name", lambda of: np.array(["a", "b"])),
        ("name", lambda of: np.array(1 + 1j)),
        ("edges", lambda of: of[:-1]),
        ("edges", lambda of: of[::-1]),
        ("edges", lambda of: of * np.nan),
        ("edges", lambda of: of[:, np.newaxis]),
        ("axes", lambda of: of[:2]),
        ("axes", lambda of: 2 * of),
        ("errors", lambda of: of[:1]),
        ("errors", lambda of: -1 - of),
        ("coefficients", lambda of: of[:3]),
        ("coefficients", lambda of: of[:, :, :0]),
        ("coefficients", lambda of: of + 2_000_000_000),
        ("coefficients", lambda of: of.astype("M8[s]")),
    ],
)
def test_arrays_of_no_table_are_refused(
    stored: Path, name: str, change: Callable[[np.ndarray], np.ndarray]
) -> None:
    arrays = _arrays(stored)
    np.savez_compressed(stored, **(arrays | {name: change(arrays[name])}))
    with pytest.raises(SeriesError):
        read_orbit(stored)


def test_an_archive_that_unpacks_to_too_much_is_refused_before(stored: Path) -> None:
    arrays = _arrays(stored)
    np.savez_compressed(stored, **(arrays | {"more": np.zeros(50_000_000)}))
    assert stored.stat().st_size < 2_000_000
    tracemalloc.start()
    with pytest.raises(SeriesError):
        read_orbit(stored)
    assert tracemalloc.get_traced_memory()[1] < 10_000_000
    tracemalloc.stop()
