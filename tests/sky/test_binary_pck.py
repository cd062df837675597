"""A binary PCK of the rotation of the Moon, opened by jplephem, Skyfield and CSPICE."""

from pathlib import Path

import numpy as np
import pytest
import spiceypy as spice
from jplephem.daf import DAF
from jplephem.pck import PCK
from scipy.spatial.transform import Rotation
from skyfield.api import load
from skyfield.planetarylib import PlanetaryConstants

import earthspin
from earthspin import Body, SceneError
from earthspin.constants import ARCSEC, DAY, J2000_JD

#: Class ID and variables of the frame.
FRAME = {
    "FRAME_MOON_BY_EARTHSPIN": 1900301,
    "FRAME_1900301_CLASS": 2,
    "FRAME_1900301_CLASS_ID": 1900301,
    "FRAME_1900301_CENTER": 301,
}


@pytest.fixture(scope="module")
def moon() -> "earthspin.Dataset":  # type: ignore[name-defined]
    return earthspin.rotation("2026-01-01", "2026-02-10", "6.3 h", body="moon")


@pytest.fixture(scope="module")
def path(moon: "earthspin.Dataset", tmp_path_factory: pytest.TempPathFactory) -> Path:  # type: ignore[name-defined]
    target = tmp_path_factory.mktemp("pck") / "moon.bpc"
    assert moon.earthspin.to_pck(target) == 1900301
    return target


def days(moon: "earthspin.Dataset") -> np.ndarray:  # type: ignore[name-defined,type-arg]
    return np.asarray(
        (moon.time.values - np.datetime64("2000-01-01T12:00")) / np.timedelta64(1, "D")
    )


def apart(moon: "earthspin.Dataset", matrices: np.ndarray) -> float:  # type: ignore[name-defined,type-arg]
    """Largest angle from the attitudes, arcsec; matrices from body to sky."""
    found = Rotation.from_quat(moon.attitude.values, scalar_first=True)
    return float((found.inv() * Rotation.from_matrix(matrices)).magnitude().max() / ARCSEC)


def test_jplephem_reads_the_angles(moon: "earthspin.Dataset", path: Path) -> None:  # type: ignore[name-defined]
    with path.open("rb") as file:
        (segment,) = PCK(DAF(file)).segments
        angles, _ = segment.compute(J2000_JD, days(moon))
    assert segment.body == 1900301
    assert apart(moon, Rotation.from_euler("ZXZ", angles.T).as_matrix()) < 1e-4
    assert path.stat().st_size % 1024 == 0


def test_skyfield_builds_the_frame(moon: "earthspin.Dataset", path: Path) -> None:  # type: ignore[name-defined]
    constants = PlanetaryConstants()
    constants.variables.update(FRAME)
    with path.open("rb") as file:
        constants.read_binary(file)
        frame = constants.build_frame_named("MOON_BY_EARTHSPIN")
        times = load.timescale(builtin=True).tdb_jd(J2000_JD, days(moon))
        matrices = np.moveaxis(frame.rotation_at(times), -1, 0)
    assert apart(moon, np.swapaxes(matrices, 1, 2)) < 1e-4


def test_cspice_reads_the_frame(moon: "earthspin.Dataset", path: Path) -> None:  # type: ignore[name-defined]
    spice.furnsh(str(path))
    spice.lmpool([f"{key} = {value}" for key, value in FRAME.items()])
    spice.lmpool(["FRAME_1900301_NAME = 'MOON_BY_EARTHSPIN'"])
    try:
        matrices = [spice.pxform("MOON_BY_EARTHSPIN", "J2000", day * DAY) for day in days(moon)]
    finally:
        spice.kclear()
    assert apart(moon, np.array(matrices)) < 1e-4


def test_what_a_pck_cannot_hold_is_refused(tmp_path: Path) -> None:
    pole = earthspin.pole("2000-01-01", "2000-02-01", "10 d")
    with pytest.raises(SceneError, match="rotation"):
        pole.earthspin.to_pck(tmp_path / "x.bpc")
    once = earthspin.rotation(times=["2000-01-01"], body="mars", perturbers=[])
    with pytest.raises(SceneError, match="more than one date"):
        once.earthspin.to_pck(tmp_path / "x.bpc")
    unnamed = Body(
        name="x", gm=1e9, radius=1e4, j2=0.1, dynamical_flattening=0.25, pole=(0.0, 1.2),
        spin_period="3 h",
    )  # fmt: skip
    turned = earthspin.rotation("2000-01-01", "2000-01-02", "1 h", body=unnamed, perturbers=[])
    with pytest.raises(SceneError, match="NAIF code"):
        turned.earthspin.to_pck(tmp_path / "x.bpc")
    assert turned.earthspin.to_pck(tmp_path / "x.bpc", frame_id=1999999) == 1999999
    with (tmp_path / "x.bpc").open("rb") as file:
        angles, _ = PCK(DAF(file)).segments[0].compute(J2000_JD, days(turned))
    assert apart(turned, Rotation.from_euler("ZXZ", angles.T).as_matrix()) < 1e-4
