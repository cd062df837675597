"""Three-dimensional pictures for HTML pages.

A solid is plain data: meshes, lines and arrows, fixed in space or carried by the body, and the
body's attitude in time. The page draws it on a canvas with a few lines of script of its
own, so it works offline.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from earthspin.numerics.arrays import FloatArray

GREY, BLACK = "#999999", "#1d1f21"

Item = dict[str, Any]


@dataclass(frozen=True)
class Solid:
    """Three-dimensional picture with title and caption, still or animated.

    Attributes
    ----------
    title, caption : str
    items : sequence of dict
        Parts made by `mesh`, `line`, `arrow` and `moving_arrow`.
    radius : float
        Half the extent that is shown at first.
    times : sequence of float
        Times in `unit`; one entry for a still picture.
    attitude : sequence of quaternions
        w, x, y, z, from body to space, one for each time or one for all; it rotates items with the
        frame "body".
    turn, tilt : float
        The first view: azimuth and elevation, rad.
    height : float
        Height of the middle of the picture along the third axis.
    """

    title: str
    caption: str
    items: Sequence[Item]
    radius: float
    times: ArrayLike = (0.0,)
    unit: str = "s"
    attitude: ArrayLike = ((1.0, 0.0, 0.0, 0.0),)
    turn: float = 0.6
    tilt: float = 0.35
    height: float = 0.0

    def json(self) -> str:
        """Convert the picture to JSON for the page's script, with arrays rounded to five digits.

        Nothing in it can end the element of the page that holds it: ``<`` is written as an escape.
        """
        content = {name: value for name, value in vars(self).items() if name not in _WORDS}
        times = np.asarray(self.times, float)
        attitude = np.broadcast_to(np.asarray(self.attitude, float), (times.size, 4))
        content |= {"times": times, "attitude": attitude}
        text = json.dumps(content, default=_rounded, separators=(",", ":"))
        return text.replace("<", "\\u003c")


def _rounded(points: FloatArray) -> list[Any]:
    """Numbers of an array, rounded to five significant digits."""
    rounded = [float(f"{number:.5g}") for number in points.ravel().tolist()]
    numbers: list[Any] = np.reshape(rounded, points.shape).tolist()
    return numbers


#: Words about a solid, which stand on the page beside it.
_WORDS = ("title", "caption")


def mesh(points: FloatArray, colour: str, *, opacity: float = 0.15, frame: str = "space") -> Item:
    """Surface through a grid of points, shape (m, n, 3), as an item of a 3-D picture."""
    return {"kind": "mesh", "points": points, "colour": colour, "opacity": opacity, "frame": frame}


def line(
    points: FloatArray, colour: str, width: float, *, frame: str = "space", grows: bool = False
) -> Item:
    """Line through points, shape (n, 3), as an item of a 3-D picture.

    A growing line ends at the point of the current time.
    """
    item = {"kind": "line", "points": points, "colour": colour, "width": width, "frame": frame}
    return item | {"grows": grows}


def arrow(tip: FloatArray, colour: str, label: str = "", *, frame: str = "space") -> Item:
    """Arrow from the centre to a point, shape (3,), as an item of a 3-D picture."""
    return _arrow("tip", tip, colour, label) | {"frame": frame}


def moving_arrow(track: FloatArray, colour: str, label: str = "") -> Item:
    """Arrow that moves in an animation; the positions of its tip have the shape (n, 3)."""
    return _arrow("track", track, colour, label) | {"frame": "space"}


def _arrow(name: str, points: FloatArray, colour: str, label: str) -> Item:
    return {"kind": "arrow", name: points, "colour": colour, "label": label, "width": 2.5}


def ellipsoid(semi_axes: Sequence[float], rows: int = 17, columns: int = 33) -> FloatArray:
    """Points on an ellipsoid with semi-axes along x, y and z, shape (rows, columns, 3)."""
    angles = np.linspace(0, np.pi, rows), np.linspace(0, 2 * np.pi, columns)
    polar, azimuth = np.meshgrid(*angles, indexing="ij")
    unit = [np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)]
    return np.stack([a * u for a, u in zip(semi_axes, unit, strict=True)], axis=-1)


def circle(angle: float, points: int = 91) -> FloatArray:
    """Points on the unit sphere at a given angle (rad) from the third axis, shape (points, 3)."""
    turn = np.linspace(0, 2 * np.pi, points)
    level = np.full(points, np.cos(angle))
    return np.stack([np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), level], axis=-1)


def cone(half_angle: float, length: float, columns: int = 41) -> FloatArray:
    """Points on a cone about the third axis, with its tip at the centre, shape (2, columns, 3).

    Parameters
    ----------
    half_angle : float
        rad.
    length : float
        Along the surface.
    """
    rim = length * circle(half_angle, columns)
    return np.stack([np.zeros_like(rim), rim])


def square(half: float, height: float, cells: int = 8) -> FloatArray:
    """Grid points of a horizontal square, shape (cells + 1, cells + 1, 3)."""
    side = np.linspace(-half, half, cells + 1)
    x, y = np.meshgrid(side, side, indexing="ij")
    return np.stack([x, y, np.full_like(x, height)], axis=-1)
