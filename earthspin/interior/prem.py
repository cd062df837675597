"""Layers of the preliminary reference Earth model (PREM), as data."""

from __future__ import annotations

from earthspin.constants import PREM_READ, Tabulated
from earthspin.interior.layers import Layer, LayeredBody


def _prem(*outermost: Layer) -> tuple[Layer, ...]:
    """Return the isotropic layers of PREM below the upper crust, followed by the given layers."""
    lower = (7956.5, -6476.1, 5528.3, -3080.7)
    lid = ((2691.0, 692.4), (4187.5, 3938.2), (2151.9, 2348.1))
    return (
        Layer(
            1221.5e3, (13088.5, 0.0, -8838.1), (11262.2, 0.0, -6364.0), (3667.8, 0.0, -4447.5), 84.6
        ),
        Layer(
            3480e3,
            (12581.5, -1263.8, -3642.6, -5528.1),
            (11048.7, -4036.2, 4802.3, -13573.2),
        ),
        Layer(
            3630e3,
            lower,
            (15389.1, -5318.1, 5524.2, -2551.4),
            (6925.4, 1467.2, -2083.4, 978.3),
            312.0,
        ),
        Layer(
            5600e3,
            lower,
            (24952.0, -40467.3, 51483.2, -26641.9),
            (11167.1, -13781.8, 17457.5, -9277.7),
            312.0,
        ),
        Layer(
            5701e3,
            lower,
            (29276.6, -23602.7, 5524.2, -2551.4),
            (22345.9, -17247.3, -2083.4, 978.3),
            312.0,
        ),
        Layer(5771e3, (5319.7, -1483.6), (19095.7, -9867.2), (9983.9, -4932.4), 143.0),
        Layer(5971e3, (11249.4, -8029.8), (39702.7, -32616.6), (22351.2, -18585.6), 143.0),
        Layer(6151e3, (7108.9, -3804.5), (20392.6, -12256.9), (8949.6, -4459.7), 143.0),
        Layer(6291e3, *lid, 80.0),
        Layer(6346.6e3, *lid, 600.0),
        Layer(6356e3, (2900.0,), (6800.0,), (3900.0,), 600.0),
        *outermost,
    )


_PREM_SOURCE = "Dziewonski & Anderson 1981, PEPI 25, 297, table I"
LAYERS = Tabulated("layers of PREM", _PREM_SOURCE, PREM_READ)

#: PREM as published, with a global ocean of 3 km.
PREM_WITH_OCEAN = LayeredBody(
    "prem-ocean",
    _prem(
        Layer(6368e3, (2600.0,), (5800.0,), (3200.0,), 600.0), Layer(6371e3, (1020.0,), (1450.0,))
    ),
    _PREM_SOURCE,
)

#: PREM with the ocean replaced by upper crust, so that the surface is solid and an ocean can be
#: added separately.
PREM = LayeredBody(
    "prem",
    _prem(Layer(6371e3, (2600.0,), (5800.0,), (3200.0,), 600.0)),
    _PREM_SOURCE + "; its ocean filled by upper crust",
)
