"""`ds.earthspin`: what an answer knows of itself."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
import xarray as xr

import earthspin
from earthspin import EARTH, SceneError
from earthspin.questions.precession import Precession
from earthspin.questions.wobble import Wobble


def test_the_scene_is_the_question(precession_result: xr.Dataset) -> None:
    scene = precession_result.earthspin.scene
    assert isinstance(scene, Precession)
    assert scene.body.dynamical_flattening == EARTH.dynamical_flattening
    assert [one.name for one in scene.perturbers] == ["sun", "moon"]
    assert scene.title == "Precession of the equinoxes"


def test_the_plan_is_a_table_with_its_seconds() -> None:
    answer = earthspin.wobble_ladder(ocean="global")
    plan = answer.earthspin.plan
    text = str(plan)
    assert re.search(r"^  wobble-rungs +free wobble, .* \[\d+\.\d ms\]$", text, re.MULTILINE | re.I)
    assert "ran, in this order" in text
    assert re.search(r"^  sensitivity +its section is not asked for$", text, re.MULTILINE)
    assert repr(plan) == text
    rows = {row.part: row for row in plan.rows}
    assert rows["wobble-rungs"].status == "ran"
    assert rows["wobble-rungs"].seconds is not None
    assert rows["wobble-rungs"].seconds > 0
    assert rows["sensitivity"].seconds is None
    frame = plan.to_frame()
    assert list(frame.columns) == ["part", "status", "reason", "seconds"]
    assert len(frame) == len(Wobble.graph.parts)


def test_an_answer_of_another_process_has_a_plan_without_seconds(tmp_path: Path) -> None:
    path = tmp_path / "answer.nc"
    program = f"import earthspin; earthspin.write(earthspin.run('torque'), {str(path)!r})"
    subprocess.run([sys.executable, "-c", program], check=True)
    program = (
        "import earthspin\n"
        f"answer = earthspin.open({str(path)!r})\n"
        "print(answer.earthspin.plan)\n"
        "print(type(answer.earthspin.scene).__name__)\n"
        "print(len(answer.earthspin.to_frame()))"
    )
    out = subprocess.run(
        [sys.executable, "-W", "error", "-c", program], check=True, capture_output=True, text=True
    ).stdout
    assert "runs, in this order" in out
    assert " ms]" not in out
    assert out.splitlines()[-2:] == ["Torque", "2930"]


def test_an_answer_without_labels_is_one_row() -> None:
    from earthspin.accessor import Answer

    plain = xr.Dataset({"x": ((), 2.0), "x_error": ((), 0.1), "word": ((), "yes")})
    frame = Answer(plain).to_frame()
    assert frame.to_dict("records") == [{"x": 2.0, "x_error": 0.1, "word": "yes"}]


def test_a_dataset_of_another_origin_has_no_scene() -> None:
    with pytest.raises(SceneError, match="does not carry the scene"):
        _ = xr.Dataset().earthspin.scene
    with pytest.raises(SceneError, match="does not carry the scene"):
        _ = xr.Dataset().earthspin.plan
