"""The pins themselves are held to account."""

import json

import pytest

from tests.conftest import REFERENCE, load_pins

TOPICS = sorted(path.stem for path in REFERENCE.glob("*.json"))


@pytest.mark.parametrize("topic", TOPICS)
def test_every_pin_has_a_source_and_a_tolerance_that_can_fail(topic: str) -> None:
    rows = json.loads((REFERENCE / f"{topic}.json").read_text())
    assert len({row["name"] for row in rows}) == len(rows)
    for pin in load_pins(topic).values():
        assert pin.source.strip(), pin
        assert 0 < pin.tolerance <= 10 * pin.measured_error, pin
