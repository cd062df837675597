"""Layered bodies from samples along the radius, as in seismological tables."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from earthspin.interior.layers import Layer, LayeredBody


def from_samples(
    name: str,
    radius: Sequence[float],
    density: Sequence[float],
    vp: Sequence[float],
    vs: Sequence[float],
    shear_q: Sequence[float],
    reference: str = "",
) -> LayeredBody:
    """Make a layered body from samples along the radius, linear between the samples.

    Parameters
    ----------
    name : str
    radius : sequence of float
        Radii from the centre outwards, m; a boundary is given by the same radius twice.
    density, vp, vs : sequence of float
        Density, kg m-3, and wave speeds, m/s; `vs` is 0 in a liquid.
    shear_q : sequence of float
        Quality factor of each sample; the value of the upper of two samples applies between them.
        Not used in a liquid.
    reference : str

    Raises
    ------
    ValueError
        If the radii do not begin at 0 or do not increase, or the columns differ in length.
    """
    r, rho, p, s, q = (
        np.asarray(column, dtype=float) for column in (radius, density, vp, vs, shear_q)
    )
    if len({column.shape for column in (r, rho, p, s, q)}) > 1 or r.ndim != 1 or r.size < 2:
        raise ValueError("give columns of equal length, at least two samples")
    if r[0] != 0 or np.any(np.diff(r) < 0) or not np.all(np.isfinite([r, rho, p, s])):
        raise ValueError("radii must begin at 0 and grow outwards, and all samples must be finite")
    whole, layers = r[-1], []
    for i in np.flatnonzero(np.diff(r) > 0):
        x = r[i : i + 2] / whole

        def line(column: Any, x: Any = x, i: int = int(i)) -> tuple[float, ...]:
            slope = (column[i + 1] - column[i]) / (x[1] - x[0])
            return float(column[i] - slope * x[0]), float(slope)

        solid = s[i] > 0 or s[i + 1] > 0
        layers.append(
            Layer(
                float(r[i + 1]),
                line(rho),
                line(p),
                line(s) if solid else (),
                float(q[i + 1]) if solid else np.inf,
            )
        )
    return LayeredBody(name, tuple(layers), reference)
