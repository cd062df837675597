"""Satellites that precess together with their planet's equator.

A satellite inside the Laplace radius, where the planet's bulge and the Sun perturb its orbit
equally, stays near the equator as the equator precesses. Planet and satellites then precess as one
body (Ward 1975, AJ 80, 64; French et al. 1993, Icarus 103, 163):

    J2' = J2 + q,   q = (1/2) sum (m/M) (a/R)^2,
    C'  = C + l,    l = sum (m/M) (a/R)^2 (n/Omega),     C in M R^2.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from earthspin.constants import Constant

JPL = "JPL Solar System Dynamics, mean elements and GM of satellites"
JPL_READ = (
    "tables of ssd.jpl.nasa.gov/?sat_elem (2020) and gm_Horizons.pck in public copies; GM of the "
    "moons of Jupiter: gm_de431.tpc in mockingbirdnest/Principia"
)


@dataclass(frozen=True)
class Satellite:
    """A satellite whose orbit is near the equator of its planet.

    Attributes
    ----------
    name : str
    gm : Constant
        m3 s-2.
    a : Constant
        Semi-major axis, m.
    period : Constant
        Sidereal period, s.
    """

    name: str
    gm: Constant
    a: Constant
    period: Constant


def added_by(
    satellites: Iterable[Satellite], gm: float, radius: float, spin_period: float
) -> tuple[float, float]:
    """Contributions of satellites to J2 and to the polar moment factor C/(M R^2) of their planet.

    Parameters
    ----------
    satellites : iterable of Satellite
    gm, radius, spin_period : float
        GM, equatorial radius and rotation period of the planet, m3 s-2, m and s.
    """
    q = moment = 0.0
    for satellite in satellites:
        spread = satellite.gm.value / gm * (satellite.a.value / radius) ** 2
        q += spread / 2
        moment += spread * abs(spin_period) / satellite.period.value
    return q, moment


def carried(
    planet: dict[str, Constant], polar_moment: Constant, satellites: tuple[Satellite, ...]
) -> dict[str, Constant]:
    """Effective J2 and H of a planet whose satellites precess together with its equator.

    Parameters
    ----------
    planet : dict of str to Constant
        The planet's own `gm`, `radius`, `spin_period` and `j2`.
    polar_moment : Constant
        C/(M R^2) of the planet alone.
    satellites : tuple of Satellite
    """
    q, more = added_by(
        satellites, planet["gm"].value, planet["radius"].value, planet["spin_period"].value
    )
    j2, moment = planet["j2"], polar_moment.value + more
    names = ", ".join(satellite.name for satellite in satellites)
    u = polar_moment.relative_uncertainty * polar_moment.value / moment
    h = (j2.value + q) / moment
    source = f"{j2.source}; with {names} carried along ({JPL})"
    read_in = f"{j2.read_in}; {JPL_READ}"
    return {
        "j2": Constant(j2.value + q, "", j2.uncertainty, source, read_in),
        "dynamical_flattening": Constant(
            h, "", h * u, f"{source}; {polar_moment.source}", f"{read_in}; {polar_moment.read_in}"
        ),
    }
