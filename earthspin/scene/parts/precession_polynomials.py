"""The angles of precession of our mean pole and of the IAU's."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable
from earthspin.scene.part import Part

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene


def angles(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Angles of precession of our mean pole and of the IAU's, as polynomials."""
    import numpy as np

    from earthspin.compare.angles import ANGLES, precession_angles
    from earthspin.compare.nutation import SLOW_DEGREE
    from earthspin.dataset import build
    from earthspin.sky import iau

    done = given["pole-analysis"]
    t = done.days / 36525.0
    psi, omega = done.ours.at(t)
    ours = precession_angles(psi, omega, iau.ecliptic_of_date(done.days))
    powers = t[:, np.newaxis] ** np.arange(SLOW_DEGREE + 1)
    scaled = np.linalg.lstsq(powers, ours, rcond=None)[0].T
    theirs = np.linalg.lstsq(powers, iau.precession_angles(done.days), rcond=None)[0].T
    return build(
        "precession-angles",
        PRECESSION_ANGLES.gives,
        {"angle_coefficient": scaled, "angle_coefficient_iau": theirs},
        coords={"angle": list(ANGLES), "degree": np.arange(SLOW_DEGREE + 1.0)},
    )


PRECESSION_ANGLES = Part(
    name="precession-angles",
    does="psi_A, omega_A, eps_A, chi_A, p_A as polynomials, with the ecliptic of IAU 2006",
    function="earthspin.scene.parts.precession_polynomials:angles",
    needs=("pole-analysis",),
    gives={
        name: Variable(("angle", "degree"), "arcsec", f"coefficient of (t/century)^degree, {whose}")
        for name, whose in (
            ("angle_coefficient", "our pole on the ecliptic of IAU 2006"),
            ("angle_coefficient_iau", "IAU 2006, fitted alike"),
        )
    },
)
