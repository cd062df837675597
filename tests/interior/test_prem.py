"""PREM beside what was published of it."""

import numpy as np
from numpy.polynomial.polynomial import polyval

from earthspin.constants import PREM_RADIUS
from earthspin.interior.layers import PREM
from tests.conftest import load_pins
from tests.interior.prem import PREM_WITH_OCEAN

PINS = load_pins("wobble")


def test_moments_of_prem() -> None:
    PINS["prem moment"].check(PREM_WITH_OCEAN.moment_factor)
    PINS["prem core fraction"].check(PREM_WITH_OCEAN.core_fraction)
    PINS["prem moment, ocean filled"].check(PREM.moment_factor)
    PINS["prem core fraction, ocean filled"].check(PREM.core_fraction)


#: Radius, km, density, g cm-3, speeds of P and S waves, km/s, in each layer (Dziewonski & Anderson
#: 1981, table III: isotropic, at a period of 1 s). The low-velocity zone and the lid, which share
#: their coefficients, are at the one end where the isotropic mean is linear.
TABLE = """
0 13.08850 11.26220 3.66780, 600 13.01009 11.20576 3.62835, 1221.5 12.76360 11.02827 3.50432
1221.5 12.16634 10.35568 0, 1600 11.94682 10.12291 0, 2200 11.48311 9.66865 0, 3480 9.90349 8.06482 0
3480 5.56645 13.71660 7.26466, 3500 5.55641 13.71168 7.26486, 3630 5.49145 13.68041 7.26597
3630 5.49145 13.68041 7.26597, 4200 5.20713 13.01579 7.01053, 5600 4.44317 11.06557 6.24046
5600 4.44317 11.06557 6.24046, 5650 4.41241 10.91005 6.09418, 5701 4.38071 10.75131 5.94508
5701 3.99214 10.26622 5.57020, 5736 3.98399 10.21203 5.54311, 5771 3.97584 10.15782 5.51602
5771 3.97584 10.15782 5.51602, 5871 3.84980 9.64588 5.22428, 5971 3.72378 9.13397 4.93259
5971 3.54325 8.90522 4.76989, 6061 3.48951 8.73209 4.70690, 6151 3.43578 8.55896 4.64391
6151 3.35950 7.98970 4.41885
6346.6 3.38076 8.11061 4.49094
6346.6 2.90000 6.80000 3.90000
6371 2.60000 5.80000 3.20000
"""  # noqa: E501
#: Outer radii, km, and quality factors in shear of the same layers (table I).
TOPS = [1221.5, 3480, 3630, 5600, 5701, 5771, 5971, 6151, 6291, 6346.6, 6356, 6371]
QUALITY = [84.6, np.inf, 312.0, 312.0, 312.0, 143.0, 143.0, 143.0, 80.0, 600.0, 600.0, 600.0]


def test_profiles_of_prem() -> None:
    """Table III has five decimals; table I, with four, gives it within 0.1 m/s or kg m-3."""
    assert [layer.top / 1000 for layer in PREM.layers] == TOPS
    assert [layer.shear_q for layer in PREM.layers] == QUALITY
    for layer, row in zip(PREM.layers, TABLE.strip().splitlines(), strict=True):
        published = np.array([point.split() for point in row.split(",")], dtype=float)
        radius, *columns = 1000 * published.T
        profiles = (layer.density, layer.vp, layer.vs or (0.0,))
        for profile, values in zip(profiles, columns, strict=True):
            found = polyval(radius / PREM_RADIUS.value, profile)
            np.testing.assert_allclose(found, values, rtol=0, atol=0.105)  # 0.103 measured
