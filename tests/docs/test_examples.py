"""The examples of docs/architecture.md are built and run as they stand there."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import earthspin
from earthspin import cli, scenes

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"


@pytest.fixture
def example(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    spec = importlib.util.spec_from_file_location(
        "surface_gravity", EXAMPLES / "surface_gravity.py"
    )
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "surface_gravity", module)
    spec.loader.exec_module(module)
    question = module.SurfaceGravity
    monkeypatch.setitem(scenes.QUESTIONS, question.word, question)
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
