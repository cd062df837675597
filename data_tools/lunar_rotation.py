r"""How far each effect that `rotation` leaves out moves the attitude of the Moon.

Euler's equations are integrated by SciPy's DOP853 from librations of DE421, with none or one of
the effects of the model of DE421, whose constants stand in its header:

- the lunar field of degree 3 and of degree 4, on which the Earth pulls;
- the flattening of the Earth;
- tides on the Moon: products of inertia that follow the Earth and the spin with a delay;
- a fluid core, coupled to the mantle by friction and by the figure of their boundary.

The attitudes with and without an effect differ by the sizes in `earthspin.bodies.beyond_rigid`.
With all effects the integration comes back to DE421, which tests the sizes.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from earthspin.bodies.beyond_rigid import DAYS
from earthspin.constants import ARCSEC, AU, DAY, J2000_JD
from earthspin.sky.ephemeris import open_ephemeris

FloatArray = NDArray[np.float64]

#: Librations of DE421 at some dates: Folkner, Williams & Boggs 2009, IPN Progress Report 42-178.
LIBRATIONS = Path(__file__).parents[1] / "tests" / "data" / "de421-librations.txt"

EFFECTS = ("degree 3", "degree 4", "Earth's flattening", "tides", "fluid core")
#: Starts, TDB Julian dates, each in the file; and of the long one.
STARTS = tuple(2448545.0 + 500.0 * k for k in range(6))

# --- constants of DE421, by their names in its header ---------------------------------------------
_GMB, _EMRAT, _GMS = 8.997011408268049e-10, 81.3005690699153, 2.959122082855911e-4  # au3 d-2
_SCALE = AU**3 / DAY**2
GM_MOON = _GMB / (1 + _EMRAT) * _SCALE
GM_EARTH, GM_SUN = _EMRAT * GM_MOON, _GMS * _SCALE
RADIUS, RADIUS_EARTH = 1738.0e3, 6378136.3  # AM, AE, m
BETA, GAMMA = 6.310022025364629e-4, 2.277305314199142e-4  # LBET, LGAM
J2_EARTH = 0.001082625305  # J2E
K2, DELAY = 0.02163368386360741, 0.1078586819856588 * DAY  # K2M, TAUM
CORE, OBLATENESS = 0.0007, 3.797712936914387e-4  # IFAC (core over whole), COBLAT
FRICTION = 1.493760249305661e-8 / DAY  # KVC over C
_C22 = 2.238976709652413e-5  # C22M
#: C/(M a2), from B - A = 4 C22 M a2 = gamma C.
POLAR = 4 * _C22 / GAMMA
#: Unnormalised C_nm and S_nm.
FIELD = {
    3: {
        0: (-8.404701525941e-06, 0.0),
        1: (2.8452435e-05, 5.9008e-06),
        2: (4.84638724000903e-06, 1.6841984741476e-06),
        3: (1.674047530039142e-06, -2.485526e-07),
    },
    4: {
        0: (9.642286e-06, 0.0),
        1: (-5.692687e-06, 1.574393e-06),
        2: (-1.5862e-06, -1.517312e-06),
        3: (-8.12041e-08, -8.027907e-07),
        4: (-1.273941e-07, 8.31475e-08),
    },
}
#: A, B, C over C.
MOMENTS = np.array([(1 - BETA * GAMMA) / (1 + BETA), (1 + GAMMA) / (1 + BETA), 1.0])
#: Step of differences, rad and s; and tolerance of the integration.
_TURN, _MOMENT, _TOLERANCE = 1e-4, 60.0, 1e-11
#: Pole of the ecliptic of J2000.0, about which the core turns at the start.
_ECLIPTIC_POLE = np.array([0.0, -np.sin(np.radians(23.4393)), np.cos(np.radians(23.4393))])


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


def attitudes(start: float, days: Iterable[float], effects: Iterable[str] = ()) -> Rotation:
    """Attitudes some days after a start, with some effects.

    Parameters
    ----------
    start : float
        TDB Julian date in the file.
    days : iterable of float
        Ascending.
    effects : iterable of str
        Of `EFFECTS`.
    """
    attitude, omega = librations()[start]
    core = attitude.inv().apply(_ECLIPTIC_POLE) * np.linalg.norm(omega)
    state = np.concatenate([attitude.as_quat(scalar_first=True), omega, core])
    times = np.array(list(days)) * DAY
    path = solve_ivp(
        _rates(start, set(effects)),
        (0.0, float(times[-1])),
        state,
        method="DOP853",
        rtol=_TOLERANCE,
        atol=1e-14,
        t_eval=times,
    )
    return Rotation.from_quat(path.y[:4].T, scalar_first=True)


def _rates(start: float, on: set[str]) -> Callable[[float, FloatArray], FloatArray]:
    sky = open_ephemeris("de421")
    field = {n: FIELD[n] for n in FIELD if f"degree {n}" in on}
    fluid = np.diag([CORE * (1 - OBLATENESS), CORE * (1 - OBLATENESS), CORE])

    def place(time: float, code: int) -> FloatArray:
        day = np.array([start - J2000_JD + time / DAY])
        return np.asarray(sky.positions({"it": code}, 301, day)["it"][0])

    def yielding(time: float, turn: FloatArray, omega: FloatArray) -> FloatArray:
        """Products of inertia by tide and spin, over C."""
        earth = turn.T @ place(time, 399)
        square = earth @ earth
        tide = -GM_EARTH / GM_MOON * (np.outer(earth, earth) / square - np.eye(3) / 3) / square**1.5
        spin = (np.outer(omega, omega) - np.eye(3) * (omega @ omega) / 3) / (3 * GM_MOON)
        return np.asarray(K2 * RADIUS**3 * (tide + spin) / POLAR)

    def rates(time: float, state: FloatArray) -> FloatArray:
        q, omega, core = state[:4] / np.linalg.norm(state[:4]), state[4:7], state[7:]
        turn = Rotation.from_quat(q, scalar_first=True).as_matrix()
        inertia, growth = np.diag(MOMENTS), np.zeros((3, 3))
        if "tides" in on:
            before, after = (
                yielding(
                    time - delay, turn @ Rotation.from_rotvec(-omega * delay).as_matrix(), omega
                )
                for delay in (DELAY + _MOMENT, DELAY - _MOMENT)
            )
            inertia, growth = inertia + (before + after) / 2, (after - before) / (2 * _MOMENT)
        torque = np.zeros(3)
        earth, sun = turn.T @ place(time, 399), turn.T @ place(time, 10)
        for gm, seen in ((GM_EARTH, earth), (GM_SUN, sun)):
            torque += 3 * gm / np.linalg.norm(seen) ** 5 * np.cross(seen, inertia @ seen)
        if field:
            torque += _torque_on_field(field, earth)
        if "Earth's flattening" in on:
            torque += _torque_by_flattening(turn[2], earth, inertia)
        coupling, mantle = np.zeros(3), inertia
        if "fluid core" in on:
            mantle = inertia - fluid
            boundary = np.array([0.0, 0.0, OBLATENESS * CORE * core[2]])
            coupling = FRICTION * (core - omega) + np.cross(boundary, core)
        gyroscopic = np.cross(omega, mantle @ omega) + growth @ omega
        core_rate = np.linalg.solve(fluid, -np.cross(omega, fluid @ core) - coupling)
        w, x, y, z = q
        p, r, s = omega
        q_rate = np.array([
            -x * p - y * r - z * s,
            w * p + y * s - z * r,
            w * r + z * p - x * s,
            w * s + x * r - y * p,
        ]) / 2  # fmt: skip
        return np.concatenate(
            [q_rate, np.linalg.solve(mantle, torque + coupling - gyroscopic), core_rate]
        )

    return rates


def _torque_on_field(
    field: dict[int, dict[int, tuple[float, float]]], earth: FloatArray
) -> FloatArray:
    """Torque of the Earth on harmonics over C, s-2: the potential's change as the Earth turns."""
    turns = Rotation.from_rotvec(_TURN * np.concatenate([np.eye(3), -np.eye(3)]))
    potential = _potential(field, (turns.apply(earth) / RADIUS).T)
    change = (potential[:3] - potential[3:]) / (2 * _TURN)
    return np.asarray(-GM_EARTH / RADIUS**3 / POLAR * change)


def _potential(field: dict[int, dict[int, tuple[float, float]]], place: FloatArray) -> FloatArray:
    """Sum of (C_nm cos m l + S_nm sin m l) P_nm / r^(n+1) at places in radii (Cunningham 1970)."""
    x, y, z = place
    square = x * x + y * y + z * z
    total = np.zeros_like(square)
    sector = 1 / np.sqrt(square) + 0j
    for m in range(5):
        below, harmonic = np.zeros_like(sector), sector
        for n in range(m, 5):
            if m in field.get(n, {}):
                c, s = field[n][m]
                total += c * harmonic.real + s * harmonic.imag
            following = ((2 * n + 1) * z * harmonic - (n + m) * below) / square / (n + 1 - m)
            below, harmonic = harmonic, following
        sector = sector * (2 * m + 1) * (x + 1j * y) / square
    return np.asarray(total)


def _torque_by_flattening(pole: FloatArray, earth: FloatArray, inertia: FloatArray) -> FloatArray:
    """Torque of the Earth's bulge on the Moon's over C, s-2; the Earth's pole is taken as z."""
    moon = -earth
    r = np.linalg.norm(moon)
    up = moon @ pole
    outer, mixed = np.outer(moon, moon), np.outer(pole, moon) + np.outer(moon, pole)
    gradient = (
        6 * np.outer(pole, pole) / r**5
        - 30 * up * mixed / r**7
        - 15 * up**2 * (np.eye(3) / r**7 - 7 * outer / r**9)
        + 3 * np.eye(3) / r**5
        - 15 * outer / r**7
    )
    m = -GM_EARTH * J2_EARTH * RADIUS_EARTH**2 / 2 * gradient @ inertia
    return np.array([m[1, 2] - m[2, 1], m[2, 0] - m[0, 2], m[0, 1] - m[1, 0]])


def main(arguments: argparse.Namespace) -> int:
    """Print how far each effect moves the attitude, arcsec, the largest over all starts."""
    print("days after the start:", *(f"{day:g}" for day in DAYS))
    sizes = {effect: np.zeros(len(DAYS)) for effect in EFFECTS}
    for start in STARTS:
        days = DAYS if start == STARTS[0] else [day for day in DAYS if day <= 1000]
        rigid = attitudes(start, days)
        for effect in EFFECTS:
            apart = (rigid.inv() * attitudes(start, days, [effect])).magnitude() / ARCSEC
            sizes[effect][: len(days)] = np.maximum(sizes[effect][: len(days)], apart)
    for effect, size in sizes.items():
        print(f"{effect}:", *(f"{largest:.3g}" for largest in np.maximum.accumulate(size)))
    return 0
