"""Blocks of a long series, as `write_series` makes them."""

from collections.abc import Iterator
from typing import Any

import xarray as xr

from earthspin import scenes


def run_blocks(scene: Any) -> Iterator[xr.Dataset]:
    series = scenes._series(scenes.load_scene(scene))
    return map(series.make, range(series.layout.count))
