"""Coverage of the errors of `rotation`: random bodies on Kepler orbits, and the Moon of DE421."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

import earthspin
from data_tools.coverage import Row
from earthspin import MOON
from earthspin.constants import ARCSEC, DAY, J2000_JD
from earthspin.dates import datetime64
from earthspin.numerics.arrays import FloatArray
from tests.reference.kepler_rotors import random_case, reference

#: Librations of DE421 at some dates: Folkner, Williams & Boggs 2009, IPN Progress Report 42-178.
LIBRATIONS = Path(__file__).parents[2] / "tests" / "data" / "de421-librations.txt"
#: Starts, TDB Julian dates, each in the file.
STARTS = tuple(2448545.0 + 500.0 * k for k in range(6))
#: Random bodies, and the length of their motions in orbits.
BODIES, ORBITS = 60, 5.0
#: Days after each start at which the Moon is compared.
MOON_DAYS = (1.0, 10.0, 30.0, 100.0, 365.0, 1000.0)


def kepler(count: int = BODIES, orbits: float = ORBITS) -> tuple[FloatArray, FloatArray]:
    """Differences from the reference and claimed errors of attitude (rad) and spin (rad/s).

    Parameters
    ----------
    count : int
        Random bodies.
    orbits : float
        Length of their motions.

    Returns
    -------
    differences, errors : ndarray, shape (2, count)
    """
    cases = [random_case(seed, orbits) for seed in range(count)]
    attitudes, spins = reference(cases)
    differences, errors = np.empty((2, 2, count))
    for n, case in enumerate(cases):
        last = earthspin.rotation(**case.scene).isel(time=-1)
        differences[:, n] = (
            _angle(last.attitude.values, attitudes[n]),
            np.linalg.norm(last.omega.values - spins[n]),
        )
        errors[:, n] = np.radians(last.attitude_error), last.omega_error
    return differences, errors


def _angle(p: FloatArray, q: FloatArray) -> float:
    """Angle between attitudes from the chord, which keeps its digits."""
    chord = min(np.linalg.norm(p - q), np.linalg.norm(p + q))
    return float(4 * np.arcsin(chord / 2))


def librations() -> dict[float, tuple[Rotation, FloatArray]]:
    """Attitude (body to ICRF) and angular velocity along the principal axes, rad/s, by date."""
    table = {}
    for jd, phi, theta, psi, d_phi, d_theta, d_psi in np.loadtxt(LIBRATIONS):
        sine, cosine = np.sin(theta), np.cos(theta)
        omega = [
            d_phi * sine * np.sin(psi) + d_theta * np.cos(psi),
            d_phi * sine * np.cos(psi) - d_theta * np.sin(psi),
            d_phi * cosine + d_psi,
        ]
        attitude = Rotation.from_euler("ZXZ", [phi, theta, psi])
        table[float(jd)] = attitude, np.array(omega) / DAY
    return table


def moon(start: float, days: tuple[float, ...]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Differences from DE421, claimed errors, and sizes of all that is neglected, arcsec.

    Parameters
    ----------
    start : float
        TDB Julian date of an attitude of DE421.
    days : tuple of float
        After it.

    Returns
    -------
    differences, errors, neglected : ndarray, shape (days,)
    """
    table = librations()
    attitude, omega = table[start]
    rows = []
    for day in days:
        tree = earthspin.run_tree(
            earthspin.Scene(
                compute="rotation",
                body=MOON,
                times=datetime64(np.array([start, start + day]) - J2000_JD),
                start_attitude=attitude.as_quat(scalar_first=True),
                start_omega=omega,
            ),
            "neglected",
        )
        last = Rotation.from_quat(tree.attitude.values[-1], scalar_first=True)
        apart = (table[start + day][0].inv() * last).magnitude() / ARCSEC
        sizes = tree["neglected"].neglected_effect.sum()
        rows.append((apart, float(tree.attitude_error[-1]) * 3600, float(sizes)))
    return tuple(np.array(rows).T)


def rows() -> Iterator[Row]:
    """Compare both."""
    differences, errors = kepler()
    span = f"{BODIES} random bodies, {ORBITS:g} Kepler orbits"
    for name, apart, error in zip(("attitude", "omega"), differences, errors, strict=True):
        yield Row.comparing(name, span, "integration in long double", apart, error)
    starts = np.array([moon(start, MOON_DAYS) for start in STARTS])
    for n, day in enumerate(MOON_DAYS):
        apart, error, neglected = starts[:, :, n].T
        span = f"Moon, {day:g} d after {len(STARTS)} starts"
        yield Row.comparing(
            "attitude, error and neglected", span, "DE421", apart, error + neglected
        )
