r"""Precession angles of a pole: psi_A and omega_A on the fixed ecliptic, eps_A, chi_A and p_A.

With the pole u and the pole e of the moving ecliptic in the axes of ecliptic and equinox of
J2000.0,

    u = (sin(omega) sin(psi), sin(omega) cos(psi), cos(omega)),     cos(eps) = u . e

Torques change u only. eps_A, chi_A and p_A also depend on the ecliptic of date, which is an input.
"""

from __future__ import annotations

import numpy as np

from earthspin.numerics.arrays import FloatArray

#: Names of the angles, in the order of `precession_angles`.
ANGLES = ("psi_A", "omega_A", "eps_A", "chi_A", "p_A")


def on_fixed_ecliptic(pole: FloatArray, ecliptic: FloatArray) -> FloatArray:
    """Longitude psi and inclination omega of a pole on the fixed ecliptic, rad, shape (n, 2).

    Parameters
    ----------
    pole : ndarray, shape (n, 3)
        Unit vectors.
    ecliptic : ndarray, shape (3, 3)
        Rotation from the frame of the pole to the ecliptic and equinox of the epoch.
    """
    x, y, z = ecliptic @ pole.T
    return np.stack([np.arctan2(x, y), np.arctan2(np.hypot(x, y), z)], axis=-1)


def followed(psi: FloatArray, guide: FloatArray) -> FloatArray:
    """Add whole turns to longitudes so that each differs least from its guide value, rad."""
    return np.asarray(psi + 2 * np.pi * np.rint((guide - psi) / (2 * np.pi)))


def pole_from(psi: FloatArray, omega: FloatArray) -> FloatArray:
    """Unit vector of a pole from longitude psi and inclination omega, shape (n, 3).

    The axes are those of the fixed ecliptic.
    """
    return np.stack(
        [np.sin(omega) * np.sin(psi), np.sin(omega) * np.cos(psi), np.cos(omega)], axis=-1
    )


def precession_angles(psi: FloatArray, omega: FloatArray, ecliptic_pole: FloatArray) -> FloatArray:
    """Return psi_A, omega_A, eps_A, chi_A and p_A of a mean pole, rad, shape (n, 5).

    Parameters
    ----------
    psi, omega : ndarray, shape (n,)
        Angles of the mean pole on the fixed ecliptic, rad.
    ecliptic_pole : ndarray, shape (n, 3)
        Pole of the moving ecliptic in the frame of the fixed one.
    """
    u, e = pole_from(psi, omega), ecliptic_pole
    across = np.cross(u, e)  # towards the equinox of date
    obliquity = np.arctan2(np.linalg.norm(across, axis=1), np.sum(u * e, axis=1))
    fixed_node = np.cross(u, [0.0, 0.0, 1.0])  # towards the node of the fixed ecliptic
    chi = _angle_about(u, fixed_node, across)
    general = _along_the_moving_ecliptic(across, e)
    return np.stack([psi, omega, obliquity, chi, general], axis=-1)


def general_precession(pole: FloatArray, ecliptic_pole: FloatArray) -> FloatArray:
    """General precession in longitude p_A, computed from a mean pole, rad, shape (...).

    Parameters
    ----------
    pole, ecliptic_pole : ndarray, shape (..., 3)
        Mean pole and pole of the moving ecliptic, in the frame of the fixed one.
    """
    return _along_the_moving_ecliptic(np.cross(pole, ecliptic_pole), ecliptic_pole)


def _along_the_moving_ecliptic(equinox: FloatArray, e: FloatArray) -> FloatArray:
    """Angle along the moving ecliptic from the equinox of date to a non-rotating origin, rad.

    See Lieske 1977.
    """
    x, z = np.eye(3)[[0, 2]]
    origin = x - (e[..., :1] / (1 + e[..., 2:])) * (e + z)
    return _angle_about(e, equinox, origin)


def polynomials(t: FloatArray, angles: FloatArray, degree: int) -> FloatArray:
    """Fit polynomials in time to angles by least squares, and return the coefficients.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Times, in any unit.
    angles : ndarray, shape (n, k)
        rad.
    degree : int

    Returns
    -------
    ndarray, shape (k, degree + 1)
        Coefficients; column j is in rad per (unit of t)^j.
    """
    powers = t[:, np.newaxis] ** np.arange(degree + 1)
    return np.asarray(np.linalg.lstsq(powers, angles, rcond=None)[0].T)


def _angle_about(axis: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Angle from one direction to another, measured about a given axis, rad."""
    across = np.sum(np.cross(start, end) * axis, axis=-1)
    return np.asarray(np.arctan2(across, np.sum(start * end, axis=-1)))
