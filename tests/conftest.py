"""What every test may use: pinned numbers, a result, the kernel."""

import json
import os
from dataclasses import dataclass
from pathlib import Path

import pytest
import xarray as xr
from hypothesis import settings

import earthspin
from earthspin.sky.ephemeris import Ephemeris, find_kernel

REFERENCE = Path(__file__).parent / "reference"

settings.register_profile("ci", derandomize=True, deadline=None)
settings.register_profile("here", deadline=None)
settings.load_profile("ci" if os.environ.get("CI") else "here")


@dataclass(frozen=True)
class Pin:
    """A number from an independent source, and how far from it the package may be.

    How a tolerance is chosen stands in docs/testing.md, "Pinned numbers".
    """

    name: str
    value: float
    unit: str
    source: str
    tolerance: float

    def check(self, found: object) -> None:
        """Fail if a number is further from the pinned one than the tolerance."""
        off = abs(float(found) - self.value)  # type: ignore[arg-type]
        assert off <= self.tolerance, (
            f"{self.name}: found {float(found)!r} {self.unit}, "  # type: ignore[arg-type]
            f"{self.source} gives {self.value!r}; off by {off:.3g}, tolerance {self.tolerance:.3g}"
        )


def load_pins(topic: str) -> dict[str, Pin]:
    """Pins of one file of tests/reference, by name."""
    rows = json.loads((REFERENCE / f"{topic}.json").read_text(encoding="utf-8"))
    pins = {row["name"]: Pin(**row) for row in rows}
    assert len(pins) == len(rows), f"{topic}.json names a pin twice"
    return pins


@pytest.fixture(scope="session")
def precession_tree() -> xr.DataTree:
    """The shipped precession scene with all its sections, run once."""
    return earthspin.run_tree("precession")


@pytest.fixture(scope="session")
def precession_result(precession_tree: xr.DataTree) -> xr.Dataset:
    """The answer alone."""
    return precession_tree.to_dataset()


@pytest.fixture(scope="session")
def de421() -> Ephemeris:
    """The kernel that comes with the package."""
    return Ephemeris(find_kernel("de421"), name="de421")
