"""Answers that several pages take their numbers from; each is made once in a process."""

from __future__ import annotations

from functools import cache

import erfa
import numpy as np
import xarray as xr
from numpy.typing import NDArray

import earthspin
from earthspin.constants import ARCSEC, J2000_JD
from earthspin.motion.effects import EFFECTS
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
    return [float(share.min()) * 1e6, float(share.max()) * 1e6]


def input_error_of_the_pole() -> float:
    """Of the pole by H after twenty years, mas."""
    path = earthspin.pole(times=["2020-01-01T12:00"], effects=["second-order"])
    return float(path.direction_error_input.max()) * 1e3


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


@cache
def from_the_iau(*effects: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Distance of the pole from IAU 2006/2000A, mas, and its claimed error, 1950 to 2050."""
    days = np.arange(-18262.0, 18262.0 + 1, 10.0)
    times = np.datetime64("2000-01-01T12:00") + (days * 86400).astype("timedelta64[s]")
    path = earthspin.pole(times=times, effects=effects)
    axis = path.sel(axis="figure")
    vectors = np.stack([axis.X, axis.Y, axis.Z], axis=-1)
    off = (vectors - erfa.pnm06a(J2000_JD, days)[:, 2]) / ARCSEC * 1e3
    return np.linalg.norm(off, axis=1), path.direction_error.values * 1e3


def at_j2000_with_response() -> float:
    """Distance of the pole with all effects from IAU 2006/2000A at J2000.0, mas."""
    path = earthspin.pole(times=["2000-01-01T12:00"], effects=tuple(EFFECTS)).sel(axis="figure")
    off = np.stack([path.X, path.Y, path.Z], axis=-1) - erfa.pnm06a(J2000_JD, 0.0)[2]
    return float(np.linalg.norm(off)) / ARCSEC * 1e3
