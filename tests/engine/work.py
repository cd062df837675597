"""Work in blocks for tests: numbers that are known, each of which counts who made it."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path

import numpy as np
import xarray as xr

from earthspin.engine.blocks import Layout


@dataclass
class Squares:
    """The squares of 0 to n - 1, by blocks, with as many words and dates as a store must keep."""

    size: int = 20
    block: int = 3
    question: str = "squares"
    version: str = "1"
    seconds: float = 0.0
    made: list[int] = field(default_factory=list)

    what = "squares"

    @property
    def layout(self) -> Layout:
        return Layout("member", self.size, self.block)

    @property
    def request(self) -> Mapping[str, str]:
        return {"question": self.question, "version": self.version}

    def make(self, number: int) -> xr.Dataset:
        self.made.append(number)
        time.sleep(self.seconds)
        member = np.arange(*self.layout.bounds(number))
        data = {
            "square": (("member", "column"), np.stack([member**2.0, -(member**2.0)], axis=1)),
            "day": ("member", np.datetime64("2000-01-01", "us") + member * np.timedelta64(1, "D")),
            "constant": ((), 3.0, {"units": "deg"}),
        }
        attrs = {} if number else {"title": "squares"}
        return xr.Dataset(data, {"member": member, "column": ["plus", "minus"]}, attrs)


def blocks_in(partial: Path) -> int:
    """How many blocks a store in the making has: each is a chunk of three variables."""
    store = partial / "store"
    numbers = (chunk.name.removesuffix(".0") for chunk in store.glob("square/*.0"))
    return sum((store / "member" / n).exists() and (store / "day" / n).exists() for n in numbers)


def bytes_of(store: Path) -> dict[str, str]:
    """A word for the content of each file of a store."""
    files = (path for path in sorted(store.rglob("*")) if path.is_file())
    return {str(p.relative_to(store)): sha256(p.read_bytes()).hexdigest() for p in files}


def assert_is_alone(
    many: xr.Dataset, place: int, alone: xr.Dataset, rtol: float = 0.0, rtol_of_error: float = 0.0
) -> None:
    """Hold a member to the answer to its own question, bit by bit unless a bound is given."""
    for name, variable in alone.data_vars.items():
        member = many[name]
        member = member.isel(member=place) if "member" in member.dims else member
        bound = rtol_of_error if "error" in str(name) else rtol
        if bound and variable.dtype.kind == "f":
            np.testing.assert_allclose(member, variable, rtol=bound, atol=0, err_msg=str(name))
        else:
            assert np.array_equal(member.values, variable.values), name
