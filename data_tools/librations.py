"""The table of states of the Moon from which its rotation is integrated, from DE421.

    python -m data_tools librations FOLDER     (pip download --no-deps de421==2008.1, unpacked)

Every 1826.25 d: Euler angles of the principal axes and the angular velocity of the mantle, from the
Chebyshev series of the librations, and the angular velocity of the fluid core. DE421 gives the spin
of the core at one date only, 1969-06-28 (OMGCX, OMGCY, OMGCZ of its header, along the axes of the
mantle). From there it is integrated along the librations in both directions, by the equations of
`earthspin.motion.equations.LiquidCore` in steps of a day (Runge-Kutta of order 4).
"""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np
from numpy.polynomial import chebyshev
from scipy.spatial.transform import Rotation

from earthspin.bodies.librations import SOURCE, TABLE
from earthspin.constants import J2000_JD
from earthspin.motion.equations import LiquidCore
from earthspin.numerics.arrays import FloatArray

#: Files of the package, with SHA-256.
FILES = {
    "jpl-librations.npy": "499127b59b8c6981112aed518806d9776dc7253549a89ed2f93ef70412bd820d",
    "constants.npy": "40b06c798b536dec64e2aff1604973ad5e749a26b5eb22d346123a02528a0865",
}
#: Julian dates that the librations cover, and that of the constants.
FIRST, LAST, EPOCH = 2414992.5, 2524624.5, 2440400.5
#: Rows of the table: interval, d, and numbers of the first and the last row, counted from J2000.0.
INTERVAL, ROWS = 1826.25, range(-18, 9)


class Librations:
    """Librations of DE421 and the constants of its header, from the package de421."""

    def __init__(self, folder: Path) -> None:
        for name, expected in FILES.items():
            digest = hashlib.sha256((folder / name).read_bytes()).hexdigest()
            if digest != expected:
                raise SystemExit(f"{folder / name}: SHA-256 {digest}, expected {expected}")
        names, values = (np.load(folder / "constants.npy")[f] for f in ("name", "value"))
        self.constants = {n.decode().strip(): float(v) for n, v in zip(names, values, strict=True)}
        self._series = np.load(folder / "jpl-librations.npy")
        self._step = (LAST - FIRST) / len(self._series)

    def at(self, jd: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Euler angles, rad, and their rates, rad/d, shape (t, 3) each."""
        row = np.clip(((jd - FIRST) // self._step).astype(int), 0, len(self._series) - 1)
        place = (2 * (jd - FIRST - row * self._step) / self._step - 1)[:, np.newaxis]
        series = np.moveaxis(self._series[row], -1, 0)
        angles = chebyshev.chebval(place, series, tensor=False)
        rates = chebyshev.chebval(place, chebyshev.chebder(series), tensor=False)
        return angles, rates * 2 / self._step

    def states(self, jd: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Euler angles, rad; angular velocity in the body, rad/d; matrices from body to sky."""
        angles, rates = self.at(jd)
        (_, theta, psi), (phi_rate, theta_rate, psi_rate) = angles.T, rates.T
        omega = np.stack(
            [
                phi_rate * np.sin(theta) * np.sin(psi) + theta_rate * np.cos(psi),
                phi_rate * np.sin(theta) * np.cos(psi) - theta_rate * np.sin(psi),
                phi_rate * np.cos(theta) + psi_rate,
            ],
            axis=1,
        )
        return angles, omega, Rotation.from_euler("ZXZ", angles).as_matrix()


def core_spins(librations: Librations, jd: FloatArray) -> FloatArray:
    """Angular velocities of the core along the ICRF at dates, rad/d, shape (t, 3)."""
    header = librations.constants
    core = LiquidCore(
        moment=header["IFAC"], flattening=header["COBLAT"], friction=header["KVC"], spin=None
    )
    moments = core.moments[:, 0]
    matrix = librations.states(np.array([EPOCH]))[2][0]
    first = matrix @ (moments * np.array([header[f"OMGC{axis}"] for axis in "XYZ"]))
    spins = np.zeros((len(jd), 3))
    for later in (True, False):
        momentum, now = first, EPOCH
        order = sorted(np.flatnonzero((jd >= EPOCH) == later), key=lambda k: abs(jd[k] - EPOCH))
        for k in order:
            momentum = _followed(librations, core, momentum, now, jd[k])
            now = jd[k]
            matrix = librations.states(np.array([now]))[2][0]
            spins[k] = matrix @ ((matrix.T @ momentum) / moments)
    return spins


def _followed(
    librations: Librations, core: LiquidCore, momentum: FloatArray, begin: float, end: float
) -> FloatArray:
    """Angular momentum of the core along the sky at another date, by RK4 in steps of a day."""
    steps = max(1, round(abs(end - begin)))
    step = (end - begin) / steps
    nodes = np.asarray(begin + step / 2 * np.arange(2 * steps + 1), dtype=float)
    _, omega, matrices = librations.states(nodes)

    def rate(node: int, momentum: FloatArray) -> FloatArray:
        spin = (matrices[node].T @ momentum) / core.moments[:, 0]
        return np.asarray(-matrices[node] @ core.torque(spin, omega[node]))

    for k in range(0, 2 * steps, 2):
        first = rate(k, momentum)
        second = rate(k + 1, momentum + step / 2 * first)
        third = rate(k + 1, momentum + step / 2 * second)
        fourth = rate(k + 2, momentum + step * third)
        momentum = momentum + step / 6 * (first + 2 * second + 2 * third + fourth)
    return momentum


def main(folder: str) -> int:
    """Write the table."""
    librations = Librations(Path(folder))
    jd = J2000_JD + INTERVAL * np.array(ROWS)
    angles, omega, _ = librations.states(jd)
    angles[:, 2] %= 2 * np.pi
    rows = np.column_stack([jd, angles, omega, core_spins(librations, jd)])
    head = f"""{SOURCE.content}: {SOURCE.source}
Made by python -m data_tools librations from the {SOURCE.read_in}; SHA-256:
{chr(10).join(f"{digest}  {name}" for name, digest in FILES.items())}
TDB Julian date; phi, theta, psi of Rz(phi) Rx(theta) Rz(psi), principal axes to ICRF, rad; angular
velocity of the mantle along its principal axes, and of the core along the ICRF, rad/d"""
    np.savetxt(
        TABLE, rows, fmt=["%.2f"] + ["%.12f"] * 3 + ["%.14f"] * 3 + ["%.10f"] * 3, header=head
    )
    print(f"{TABLE}: {len(rows)} rows")
    return 0
