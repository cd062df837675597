"""Bright stars near the celestial pole, from an answer of `long_term`."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from earthspin.bodies import in_a_sentence
from earthspin.constants import JULIAN_YEAR, MAS, NORMAL_95
from earthspin.engine import Variables, labels, measured, number, si, words
from earthspin.errors import SceneError, Where
from earthspin.progress import progress
from earthspin.sky.stars import STARS, directions
from earthspin.units import Whole, in_order


class NearestStars(Variables, along=("nearest", "epoch")):
    """Variables of the result of `pole_stars`: the nearest listed stars at each epoch."""

    star = words("star")
    separation = measured(
        "deg",
        "distance from the celestial pole",
        comment="the error contains that of the pole and the catalogue's errors of the proper "
        "motions",
    )
    magnitude = number("1", "visual magnitude", no_error="a number of the catalogue")
    nearest = labels()
    epoch = labels()


@progress("stars near the pole")
def pole_stars(result: xr.Dataset, count: int = 1) -> xr.Dataset:
    """Bright stars nearest to the celestial pole, at each epoch of a result of `long_term`.

    The stars are those of magnitude 4 or brighter near the circle of the pole (Hipparcos catalogue,
    ESA 1997), moved by their proper motions.

    Parameters
    ----------
    result : Dataset
        An answer of `long_term` for the Earth.
    count : int
        Number of stars at each epoch, the nearest first.

    Returns
    -------
    Dataset
        Along `epoch` and `nearest`: `star`, `separation` (deg) with its 95 % half-width, and the
        visual `magnitude`. Parallax, radial velocity and changes of magnitude are neglected.

    Raises
    ------
    SceneError
        If `result` is no such answer or is for another body than the Earth, or `count` exceeds the
        number of listed stars.

    Examples
    --------
    >>> import earthspin
    >>> past = earthspin.long_term(times=["-12000-01-01", "-3000-01-01", "2000-01-01"])
    >>> stars = earthspin.pole_stars(past)
    >>> print(stars.star.squeeze().values, stars.separation.squeeze().round(1).values)
    ['Vega' 'Thuban' 'Polaris'] [3.5 1.2 0.7]
    """
    pole: Any = getattr(result, "pole", None)
    if "epoch" not in getattr(pole, "dims", ()) or pole.attrs.get("frame") != "GCRS":
        raise SceneError("result", type(result).__name__, "give an answer of long_term")
    if set(pole.dims) != {"epoch", "component"}:
        raise SceneError("result", "an answer for several bodies", "give that for one of them")
    body = result.earthspin.scene.body if "scene" in result.attrs else None
    if body is not None and not body.needed("pole").of_the_iau:
        problem = "its pole is not that of IAU 2006, near which the stars of the list are"
        raise SceneError("result", f"an answer for {in_a_sentence(body.name)}", problem)
    count = Whole(1, len(STARS)).read(count, Where("count"))
    axis = in_order(pole, Where("result.pole")).values
    seconds = np.asarray(result["epoch"].values * JULIAN_YEAR)
    stars = directions(seconds)
    sine = np.linalg.norm(np.cross(stars, axis), axis=-1)
    separation = np.arctan2(sine, np.sum(stars * axis, axis=-1))
    order = np.argsort(separation, axis=0)[:count]
    columns = np.arange(seconds.size)
    motion_error = NORMAL_95 * MAS / JULIAN_YEAR * np.array([s.proper_motion_error for s in STARS])
    error = np.hypot(motion_error[order] * np.abs(seconds), si(result["pole_error"]).values)
    near = NearestStars(
        star=np.array([star.name for star in STARS])[order],
        separation=(separation[order, columns], error),
        magnitude=np.array([star.magnitude for star in STARS])[order],
        nearest=np.arange(1, count + 1),
        epoch=result["epoch"],
    )
    source = "ESA 1997, The Hipparcos and Tycho Catalogues, SP-1200"
    return near.dataset().assign_attrs(references=source)
