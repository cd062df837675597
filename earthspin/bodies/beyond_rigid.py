"""Sizes of effects on the attitude that the rigid-body model neglects, for each body."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from earthspin.constants import ARCSEC

#: Days after the start at which the sizes were measured.
DAYS = (1.0, 10.0, 30.0, 100.0, 365.0, 1000.0, 3650.0, 14000.0)


@dataclass(frozen=True)
class BeyondRigid:
    """Sizes of the effects on the attitude of a body that the rigid-body model neglects.

    Attributes
    ----------
    sizes : mapping of str to tuple of float
        Largest change of the attitude up to each of `DAYS`, arcsec, by effect.
    source : str
        Where the sizes come from.
    """

    sizes: Mapping[str, tuple[float, ...]]
    source: str

    def after(self, days: float) -> dict[str, float]:
        """Size of each neglected effect after a number of days from the initial epoch, rad.

        Parameters
        ----------
        days : float
            Time since the start. Before the first of `DAYS` a size grows with the square of the
            time, as for an unmodelled torque; beyond the last it is constant.
        """
        early = min(days / DAYS[0], 1.0) ** 2
        place = np.log(np.clip(days, DAYS[0], DAYS[-1]))
        return {
            name: float(early * np.exp(np.interp(place, np.log(DAYS), np.log(size)))) * ARCSEC
            for name, size in self.sizes.items()
        }


#: Sizes by name of the body.
BEYOND_RIGID = {
    "moon": BeyondRigid(
        {
            "lunar field of degree 3": (0.0092, 0.77, 2.1, 15.0, 120.0, 140.0, 200.0, 275.0),
            "lunar field of degree 4": (3.7e-5, 0.0034, 0.018, 0.17, 1.5, 1.7, 1.8, 1.8),
            "fluid core": (9.2e-4, 0.074, 0.14, 0.52, 1.6, 4.1, 11.0, 12.0),
            "tides on the Moon": (3.7e-4, 0.023, 0.054, 0.21, 0.64, 1.2, 3.1, 3.3),
            "flattening of the Earth": (7e-6, 5e-4, 6e-4, 0.0022, 0.013, 0.025, 0.064, 0.15),
        },
        "the model of DE421 (Folkner et al. 2009, IPN Progress Report 42-178), integrated by "
        "DOP853 with and without each effect from its librations at 6 dates: largest differences",
    ),
    "earth": BeyondRigid(
        {
            "changes of the length of day": (0.061, 0.56, 1.6, 5.2, 17.0, 44.0, 144.0, 347.0),
            "polar motion": (0.0056, 0.053, 0.14, 0.4, 0.6, 0.6, 0.6, 0.6),
            "response of the inside to nutation": (0.0575,) * 8,
        },
        "finals2000A of the IERS, 1973 to 2025, largest changes of UT1 (less the mean spin) and of "
        "the pole over intervals of each length; response: python -m data_tools neglected",
    ),
}
