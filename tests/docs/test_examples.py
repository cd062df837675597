"""The examples of the pages are built and run as they stand there."""

import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import earthspin
from earthspin import cli
from earthspin.questions import MODULES
from tests.docs.lessons import DOCS, built
from tests.processes import ROOT

EXAMPLES = DOCS / "examples"


@pytest.fixture
def example(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    module = built(EXAMPLES / "plugin" / "surface_gravity.py", monkeypatch)
    monkeypatch.setitem(MODULES, "surface_gravity", "surface_gravity")
    return module


def test_a_new_question_answers(example: ModuleType) -> None:
    """Clairaut and Somigliana: gravity of a spheroid in equilibrium; ours is nearly one."""
    found = example.surface_gravity()
    assert found.gravity.dims == ("latitude",)
    # GRS80's normal gravity is 9.7803 and 9.8322 m/s2; an even density moves it by less than 0.3 %
    assert np.allclose(found.gravity[[0, -1]], [9.7803, 9.8322], rtol=3e-3, atol=0)


def test_a_sphere_that_does_not_turn_has_gm_over_r2(example: ModuleType) -> None:
    ball = earthspin.EARTH.replace(flattening=0.0, spin_period=1e20)
    found = example.surface_gravity(body=ball, points=3).gravity.values
    assert np.allclose(found, ball.gm / ball.radius**2, rtol=2e-15, atol=0)


def test_it_is_a_scene_like_any_other(
    example: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = tmp_path / "mars.toml"
    scene.write_text('compute = "surface-gravity"\nbody = "mars"\npoints = 5\n')
    answer = earthspin.run(scene)
    assert answer.sizes == {"latitude": 5}
    assert earthspin.run(answer).identical(answer)
    assert "surface" in str(earthspin.plan(scene))
    with pytest.raises(earthspin.SceneError, match="no such key"):
        earthspin.load_scene(scene, {"perturbers": "sun"})
    assert cli.main(["run", str(scene), "--out", str(tmp_path / "out")]) == 0
    assert "gravity, m/s2" in capsys.readouterr().out
    assert "gravity, m/s2" in (tmp_path / "out" / "mars.html").read_text()
    assert cli.main(["keys", "surface-gravity"]) == 0
    assert "from equator to pole" in capsys.readouterr().out
    assert "latitudes" in example.surface_gravity.__doc__


def test_the_method_in_plain_skyfield(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rates from plain Skyfield: another length of the taper, so 1e-7 apart."""
    module = built(EXAMPLES / "method_in_skyfield.py", monkeypatch)
    answer = module.with_earthspin()
    for name, rate in module.plain_skyfield().items():
        ours = answer.sel(perturber=name)
        assert abs(rate - ours.precession_rate) <= ours.precession_rate_error
        assert rate == pytest.approx(ours.precession_rate.item(), rel=3e-7, abs=0)


def test_a_comet_and_vectors_of_skyfield(monkeypatch: pytest.MonkeyPatch) -> None:
    module = built(EXAMPLES / "skyfield_bodies.py", monkeypatch)
    found = module.series()
    assert found.perturber.values.tolist() == ["sun", "moon", "comet"]
    t = module.ts.utc(2026, 1, 1)
    away = (module.comet.position - module.kernel["earth"]).at(t).distance().m
    assert np.isclose(found.distance.sel(perturber="comet")[0], away, rtol=1e-12, atol=0)
    assert np.isnan(found.torque_magnitude_error.sel(perturber="comet")).all()
    module.kernel.close()


def test_a_source_of_positions(monkeypatch: pytest.MonkeyPatch) -> None:
    """Angular momentum that a straight passage gives, against its integral in closed form."""
    found = built(EXAMPLES / "passage.py", monkeypatch).passing_moon().sel(perturber="moon")
    nearest, speed, half = 2e8, 2e4, 43200.0  # m, m/s, s
    assert np.isclose(found.distance.min(), nearest, rtol=1e-12, atol=0)
    # 3 GM (C - A) sin 45 cos 45 b2 r^-5 along y; what lies along the path cancels out
    u = speed * half / np.hypot(nearest, speed * half)
    earth = earthspin.EARTH
    c_minus_a = earth.j2 * earth.gm / earthspin.constants.G.value * earth.radius**2
    given = -3 * earthspin.MOON.gm * c_minus_a * (u - u**3 / 3) / (nearest**2 * speed)
    # 4.9e-8 measured, of sums over minutes
    gained = np.trapezoid(found.torque.sel(component="y"), dx=60)
    assert np.isclose(gained, given, rtol=2e-7, atol=0)


def test_the_flyby_of_the_page_on_orbits() -> None:
    """Energy and angular momentum of two bodies, and the deflection 2 asin(1/e), hold."""
    page = (DOCS / "howto" / "orbits.md").read_text(encoding="utf-8")
    cells = re.findall(r"```\{code-cell\} ipython3\n(.*?)```", page, flags=re.DOTALL)
    names: dict[str, Any] = {"earthspin": earthspin, "MOON": earthspin.MOON, "__name__": __name__}
    exec(next(cell for cell in cells if "class Hyperbola" in cell), names)
    path, gm = names["path"], names["both"]
    days = np.array([-30.0, -0.5, 0.0, 1e-3, 0.5, 30.0])
    r, step = path.positions(days), 1e-5
    v = (path.positions(days + step) - path.positions(days - step)) / (2 * step * 86400)
    energy = np.sum(v * v, axis=1) / 2 - gm / np.linalg.norm(r, axis=1)
    assert np.allclose(energy, path.speed**2 / 2, rtol=1e-6, atol=0)
    momenta = np.cross(r, v)
    assert np.allclose(momenta, momenta[2], rtol=1e-6, atol=1e-3 * np.abs(momenta).max())
    assert np.linalg.norm(r, axis=1).min() == pytest.approx(2e8, rel=1e-12, abs=0)
    turned = np.arccos(v[0] @ v[-1] / np.linalg.norm(v[0]) / np.linalg.norm(v[-1]))
    e = 1 + path.nearest * path.speed**2 / gm
    assert turned == pytest.approx(2 * np.arcsin(1 / e), rel=0.02, abs=0)
    passing = names["day"].distance.sel(perturber="passing")
    assert passing.min() == pytest.approx(2e8, rel=1e-9, abs=0)


def test_the_scenes_of_the_page_on_skyfield(tmp_path: Path) -> None:
    page = (EXAMPLES.parent / "skyfield.md").read_text(encoding="utf-8")
    scenes_there = re.findall(r"```toml\n(.*?)```", page, flags=re.DOTALL)
    assert len(scenes_there) == 2
    for text in scenes_there:
        scene = tmp_path / "scene.toml"
        scene.write_text(text)
        found = earthspin.run(earthspin.load_scene(scene, {"step": "30 d"}))
        assert "position" in found.attrs["scene"] or "skyfield" in found.attrs["scene"]


#: Runs a question and an effect of the example, by Python and by commands, in an environment that
#: has it installed.
PLUGGED = """
import sys
from pathlib import Path
import earthspin
from earthspin import cli
folder, modules = Path(sys.argv[1]), {"tidal_tilt", "surface_gravity"}
earthspin.run("wobble")
assert not modules & {*sys.modules}
for name, keys in {
    "gravity": 'compute = "surface-gravity"',
    "tilted": 'compute = "pole"\\neffects = ["known", "tidal-tilt"]\\n'
    'span = ["2000-01-01", "2000-03-01"]\\nstep = "10 d"',
}.items():
    scene, data = folder / f"{name}.toml", folder / f"{name}.nc"
    scene.write_text(keys)
    assert cli.main(["run", str(scene), "--out", str(data)]) == 0
    answer = earthspin.run(data)
    assert earthspin.run(answer).identical(answer)
    assert cli.main(["plan", str(scene)]) == 0
    assert cli.main(["run", str(scene), "--out", str(folder / f"{name}.csv")]) == 0
    members = {"n": 2, "body.j2": {"normal": [1.0826e-3, 1e-9]}}
    if name == "gravity":
        members = {"n": 2, "body.flattening": {"normal": [1 / 298.257, 1e-6]}}
    assert earthspin.ensemble(scene, members).sizes["member"] == 2
assert answer.earthspin.plot()
assert "tidal-tilt" in earthspin.load_scene(answer).effects
assert cli.main(["keys", "surface-gravity"]) == 0
assert cli.main(["run", str(folder / "gravity.toml"), "--set", "points=3"]) == 0
assert modules <= {*sys.modules}
"""


@pytest.mark.slow
def test_a_plug_in_works_where_it_is_installed(tmp_path: Path) -> None:
    """In an environment of its own, as any user's package."""
    place = tmp_path / "venv"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", place], check=True)
    python = place / "bin" / "python"
    folders = subprocess.check_output(
        [python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"], text=True
    )
    # the libraries of this environment, which may itself be one without system packages
    site = sysconfig.get_path("purelib")
    Path(folders.strip(), "libraries.pth").write_text(f"{site}\n{ROOT}\n")
    copied = shutil.copytree(EXAMPLES / "plugin", tmp_path / "plugin")
    options = ["--no-deps", "--no-build-isolation", "--quiet", "--disable-pip-version-check"]
    if subprocess.run([python, "-m", "pip", "install", *options, copied]).returncode:
        pytest.skip("pip cannot install here")
    subprocess.run([python, "-c", PLUGGED, tmp_path], check=True, cwd=tmp_path)
