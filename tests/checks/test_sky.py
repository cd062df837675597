"""The sky of the checks: pieces of Chebyshev series, and the tide that solvers step through."""

import numpy as np

from earthspin.checks.ladders import taylor
from tests.reference.sky import GM, Tide, chebyshev_pieces, positions
from earthspin.constants import DAY
from earthspin.torque.quadrupole import tidal_tensor


def test_pieces_of_a_polynomial_are_its_chebyshev_series() -> None:
    # t = 1 + 2 (k + (x + 1)/2) = 2 + 2 k + x in piece k, and x^2 = (T0 + T2)/2
    found = chebyshev_pieces(lambda t: np.stack([t, t * t], axis=1), 1.0, 2.0, 3, 4)
    for k, series in enumerate(found):
        middle = 2.0 + 2 * k
        assert np.allclose(series[:, 0], [middle, 1, 0, 0], rtol=0, atol=1e-14)
        assert np.allclose(series[:, 1], [middle**2 + 0.5, 2 * middle, 0.5, 0], rtol=0, atol=1e-13)


def test_the_tide_is_that_of_the_kernel_between_its_nodes() -> None:
    tide = Tide(30 * DAY)
    for day in (0.0, 1e-6, 0.37, 1.999, 2.0, 17.3, 30.0):
        place = positions(np.array([day]))
        xx, yy, zz, xy, xz, yz = tidal_tensor([(GM[name], r[0]) for name, r in place.items()])
        true = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        # 7e-16 measured
        assert np.max(np.abs(tide(day * DAY) - true)) < 5e-15 * np.max(np.abs(true)), day
    assert tide.calls == 7


def test_polynomials_of_the_taylor_integrator_give_the_places_of_the_kernel() -> None:
    day, piece = 7.3, 2
    x = 2 * (day - taylor.FIRST_EDGE - taylor.PIECE * piece) / taylor.PIECE - 1
    assert -1 < x < 1
    powers = taylor._pieces(12.0)[piece].reshape(2, 3, taylor.DEGREE + 1)
    place = positions(np.array([day]))
    for name, of_body in zip(GM, powers, strict=True):
        found = of_body @ x ** np.arange(taylor.DEGREE + 1)
        # 2e-15 and 2e-16 measured
        assert np.max(np.abs(found - place[name][0])) < 2e-14 * np.max(np.abs(place[name]))
