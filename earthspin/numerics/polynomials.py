"""Interpolation by polynomials."""

from __future__ import annotations

import numpy as np

from earthspin.numerics.arrays import Array


def lagrange(nodes: Array, at: Array) -> Array:
    """Values of the Lagrange polynomials of given nodes at given points, shape (nodes, points)."""
    others = [np.delete(nodes, i) for i in range(nodes.size)]
    return np.array(
        [
            np.prod((at[:, None] - rest) / (node - rest), axis=-1)
            for node, rest in zip(nodes, others, strict=True)
        ]
    )
