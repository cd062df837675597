"""Bodies of a few even shells."""

import numpy as np

from earthspin.interior.layers import Layer, LayeredBody


def sphere(*shells: tuple[float, float, float], stiff: float = 1e5) -> LayeredBody:
    """Shells of (top, density, shear modulus), nearly incompressible."""
    layers = []
    for top, density, mu in shells:
        vs = (float(np.sqrt(mu / density)),) if mu else ()
        vp = (float(np.sqrt(stiff * 1e11 / density)),)
        layers.append(Layer(top, (density,), vp, vs, 1.0))
    return LayeredBody("test", tuple(layers), "")
