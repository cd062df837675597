r"""Torque of a distant mass on the Stokes coefficients C_nm and S_nm of a body, of any degree.

A mass m at r, along the axes of the body with radius a, has the energy

    E = -(G M m / a) sum Re[(C_nm - i S_nm) Z_nm(r/a)],
    Z_nm = P_nm(sin phi) e^(i m lambda) / r^(n+1)

with the unnormalised P_nm of geodesy (no factor (-1)^m), and feels the torque -r x grad E from the
body. The operator r x grad is i times J, whose components lead from Z_nm to its neighbours only:

    J_z Z_nm = m Z_nm,   J_+ Z_nm = -Z_n(m+1),   J_- Z_nm = -(n + m)(n - m + 1) Z_n(m-1)

with J_+- = J_x +- i J_y and Z_n(-1) = -conj(Z_n1)/(n (n + 1)). The torque is therefore a sum of the
Z_nm of the same degrees with constant weights, without a gradient. The Z_nm follow by recursion
(Cunningham 1970, Celest. Mech. 2, 207).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from earthspin.numerics.arrays import ComplexArray, FloatArray


class HarmonicsTorque:
    """Torque on harmonics of a body by a mass m, in units of G M m / a, along the body's axes.

    Parameters
    ----------
    coefficients : mapping of str to float
        Unnormalised C_nm and S_nm by name, such as "c31".
    """

    def __init__(self, coefficients: Mapping[str, float]) -> None:
        stokes: dict[tuple[int, int], complex] = {}
        for name, value in coefficients.items():
            key = int(name[1]), int(name[2])
            stokes[key] = stokes.get(key, 0j) + (value if name[0] == "c" else -1j * value)
        degrees = sorted({n for n, _ in stokes})
        self._degree = degrees[-1]
        self._names = [(n, m) for n in degrees for m in range(n + 1)]
        row = {name: k for k, name in enumerate(self._names)}
        weights = np.zeros((3, len(row)), dtype=complex)  # torque on the body: Re[c i J Z]
        for (n, m), c in stokes.items():
            weights[2, row[n, m]] += -1j * m * c
            if m < n:
                weights[:2, row[n, m + 1]] += c * np.array([0.5j, 0.5])
            if m:
                weights[:2, row[n, m - 1]] += (n + m) * (n - m + 1) * c * np.array([0.5j, -0.5])
            else:  # Z_n(-1) is given by the conjugate of Z_n1
                weights[:2, row[n, 1]] += np.conj(c * np.array([-0.5j, 0.5]))
        self._weights = np.concatenate([weights.real, -weights.imag], axis=1)

    def at(self, position: FloatArray) -> FloatArray:
        """Torque by a mass at positions (3, ...) along the body's axes, in radii a; (3, ...)."""
        z = solid_harmonics(position.reshape(3, -1), self._degree)
        rows = np.stack([z[name] for name in self._names])
        torque = self._weights @ np.concatenate([rows.real, rows.imag])
        return np.asarray(torque.reshape(position.shape))


def solid_harmonics(position: FloatArray, degree: int) -> dict[tuple[int, int], ComplexArray]:
    """Complex Z_nm by (n, m) at positions (3, t), in units of the reference radius."""
    x, y, z = position
    inverse_square = 1 / (x * x + y * y + z * z)
    across, up = (x + 1j * y) * inverse_square, z * inverse_square
    sectorial = np.sqrt(inverse_square) + 0j
    harmonics = {}
    for m in range(degree + 1):
        below, current = 0.0, sectorial
        for n in range(m, degree + 1):
            harmonics[n, m] = current
            above = ((2 * n + 1) / (n + 1 - m)) * up * current
            if n > m:
                above -= ((n + m) / (n + 1 - m)) * inverse_square * below
            below, current = current, above
        sectorial = (2 * m + 1) * across * sectorial
    return harmonics
