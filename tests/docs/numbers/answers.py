"""Answers that several pages take their numbers from; each is made once in a process."""

from __future__ import annotations

from functools import cache

import erfa
import numpy as np
import xarray as xr
from numpy.typing import NDArray

import earthspin
from earthspin.constants import ARCSEC, J2000_JD
from earthspin.sky.iau import Nutation
from tests import shipped

#: Of an arcsecond a year.
MAS_A_CENTURY = 1e5


@cache
def iau(kernel: str = "de421") -> xr.DataTree:
    """The comparison with the IAU by a kernel."""
    if kernel == "de421":
        return shipped.tree("iau")
    return earthspin.run_tree(earthspin.load_scene("iau", {"ephemeris": kernel}))


def value(scene: str, section: str, name: str, **labels: object) -> float:
    """One number of a section of a shipped scene; the answer itself is the section `/`."""
    node = shipped.tree(scene)[section] if section != "/" else shipped.answer(scene)
    return float(node[name].sel(labels))


@cache
def axes(**changes: str) -> dict[str, NDArray[np.float64]]:
    """The three axes under Sun and Moon from 1980 to 2020, mas, shape (t, 3) each."""
    path = earthspin.pole("1980-01-01", "2020-01-01", "5 d", effects=["second-order"], **changes)
    return {
        str(axis): np.stack([path.sel(axis=axis)[c].values for c in "XYZ"], axis=-1) / ARCSEC * 1e3
        for axis in path.axis.values
    }


def apart(one: str, other: str) -> NDArray[np.float64]:
    """One axis less another, mas, shape (t, 3)."""
    return np.asarray(axes()[one] - axes()[other])


@cache
def nutation_between_nodes() -> float:
    """By how much daily nodes of nutation are off at both ends of DE421 and in between, rad."""
    off = 0.0
    for first in (-36000.0, -9000.0, 0.0, 18500.0):
        days = np.arange(first, first + 500.0, 0.73)
        ours = Nutation(days[0], days[-1]).true_equator(days)
        off = max(off, float(np.abs(ours - erfa.pnm06a(J2000_JD, days)).max()))
    return off


@cache
def kernel_of_the_pole() -> list[float]:
    """Least and largest share of the kernel in the error of the pole, by DE421, uas."""
    share = earthspin.pole("1900-01-01", "2053-01-01", "500 d").direction_error_kernel
    return [float(share.min()), float(share.max())]


def input_error_of_the_pole() -> float:
    """Of the pole by H after twenty years, mas."""
    path = earthspin.pole(times=["2020-01-01T12:00"], effects=["second-order"])
    return float(path.direction_error_input.max()) / 1e3


@cache
def observed() -> xr.Dataset:
    """The pole of C04."""
    return earthspin.polar_motion()


def fitted(of: xr.Dataset, method: str) -> list[float]:
    """Period with its error, d, and the quality factor with its ends, if the method gives it."""
    found = earthspin.fit_chandler(of, method=method)
    ends = [
        float(found[f"chandler_quality_factor{end}"])
        for end in ("", "_low", "_high")
        if f"chandler_quality_factor{end}" in found
    ]
    return [float(found.chandler_period), float(found.chandler_period_error), *ends]


@cache
def of_c04(method: str) -> list[float]:
    """The same of C04."""
    return fitted(observed(), method)
