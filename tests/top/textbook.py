"""The textbook's closed form (I.7.9 to I.7.17), at so many digits that its losses do not matter.

Roots of the cubic in powers of u by Viete's formula, sn by its theta functions, phi and
psi by Legendre's third kind, time counted from the lower turning point: nothing here is in the
form that the package uses.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import mpmath as mp

DIGITS = 80


class State(NamedTuple):
    """The top at one time; phi and psi not reduced to one turn."""

    theta: Any
    phi: Any
    psi: Any
    theta_rate: Any
    phi_rate: Any

    @property
    def attitude(self) -> Any:
        """Matrix Rz(phi) Rx(theta) Rz(psi)."""
        return _rz(self.phi) * _rx(self.theta) * _rz(self.psi)

    @property
    def transverse(self) -> Any:
        """omega1 + i omega2."""
        across = self.theta_rate + 1j * self.phi_rate * mp.sin(self.theta)
        return across * mp.expj(-self.psi)


class Textbook:
    """One top's motion from exact values of its fields."""

    def __init__(self, start: Mapping[str, Any]) -> None:
        u, theta_rate = self._read(start)
        part = (u - self.low) / (self.high - self.low)
        if self.sense < 0:
            part = 1 - part
        amplitude = mp.asin(mp.sqrt(min(max(part, mp.mpf(0)), mp.mpf(1))))
        rising = -self.sense * theta_rate
        self.phase = mp.ellipf(amplitude, self.m) * (-1 if rising < 0 else 1)
        self.quarter = mp.ellipk(self.m)
        self.full = [mp.ellippi(n, self.m) if c else 0 for n, c, _ in self._third_kinds()]
        self.begin = self._turned(self.phase)

    @classmethod
    def with_roots_only(cls, start: Mapping[str, Any]) -> Textbook:
        """Constants and roots, without the integrals."""
        book = cls.__new__(cls)
        book._read(start)
        return book

    def _read(self, start: Mapping[str, Any]) -> tuple[Any, Any]:
        """Set constants and roots; give u and theta' at the start."""
        get = {name: mp.mpf(value) for name, value in start.items()}
        i1, i3 = get["transverse_moment"], get["axial_moment"]
        self.spin = get["spin"]
        self.phi_0, self.psi_0 = get.get("phi", mp.mpf(0)), get.get("psi", mp.mpf(0))
        theta_rate, phi_rate = get.get("theta_rate", mp.mpf(0)), get.get("phi_rate", mp.mpf(0))
        u, sine2 = mp.cos(get["theta"]), mp.sin(get["theta"]) ** 2
        self.a = i3 * self.spin / i1
        self.beta = 2 * get["weight_moment"] / i1
        self.b = phi_rate * sine2 + self.a * u
        self.alpha = theta_rate**2 + phi_rate**2 * sine2 + self.beta * u
        self.sense = -1 if self.beta < 0 else 1  # sn counts from the end of u far from u3
        self._find_turning_points()
        return u, theta_rate

    @property
    def period(self) -> Any:
        """Of the nutation."""
        return 2 * self.quarter / self.rate

    def at(self, time: Any) -> State:
        """State at a time."""
        time = mp.mpf(time)
        z = self.phase + self.rate * time
        turns = mp.nint(z / (2 * self.quarter))
        rest = z - 2 * turns * self.quarter
        sn, cn, dn = (mp.ellipfun(kind, rest, m=self.m) for kind in ("sn", "cn", "dn"))
        swing = self.high - self.low
        u = self.low + swing * sn**2 if self.sense > 0 else self.high - swing * sn**2
        u_rate = self.sense * 2 * swing * sn * cn * dn * self.rate
        sigma, delta = (x - y for x, y in zip(self._turned(z), self.begin, strict=True))
        sine2 = (1 - u) * (1 + u)
        return State(
            2 * mp.atan2(mp.sqrt(1 - u), mp.sqrt(1 + u)),
            self.phi_0 + sigma + delta,
            self.psi_0 + sigma - delta + (self.spin - self.a) * time,
            -u_rate / mp.sqrt(sine2),
            (self.b - self.a * u) / sine2,
        )

    def _find_turning_points(self) -> None:
        a, b, alpha, beta = self.a, self.b, self.alpha, self.beta
        c2, c1, c0 = -(alpha + a * a), 2 * a * b - beta, alpha - b * b
        if beta == 0:
            self.low, self.high = sorted(_quadratic(c2, c1, c0))
            self.rate, self.m = mp.sqrt(alpha + a * a) / 2, mp.mpf(0)
            return
        roots = sorted(_cubic(c2 / beta, c1 / beta, c0 / beta))
        if beta > 0:
            self.low, self.high, beyond = roots
            self.rate = mp.sqrt(beta * (beyond - self.low)) / 2
            self.m = (self.high - self.low) / (beyond - self.low)
        else:
            beyond, self.low, self.high = roots
            self.rate = mp.sqrt(beta * (beyond - self.high)) / 2
            self.m = (self.high - self.low) / (self.high - beyond)

    def _third_kinds(self) -> list[tuple[Any, Any, Any]]:
        """Characteristic, factor and distance from the pole, for sigma and for delta."""
        swing = self.high - self.low
        end = self.low if self.sense > 0 else self.high
        up, down = 1 + end, 1 - end
        return [
            (-self.sense * swing / up, (self.a + self.b) / 2, up),
            (self.sense * swing / down, (self.b - self.a) / 2, down),
        ]

    def _turned(self, z: Any) -> list[Any]:
        """Half the sum and half the difference of phi and psi, for I1 = I3."""
        turns = mp.nint(z / (2 * self.quarter))
        sn = mp.ellipfun("sn", z - 2 * turns * self.quarter, m=self.m)
        return [
            c / (pole * self.rate) * (2 * turns * full + mp.ellippi(n, mp.asin(sn), self.m))
            if c
            else mp.mpf(0)
            for full, (n, c, pole) in zip(self.full, self._third_kinds(), strict=True)
        ]


def _quadratic(c2: Any, c1: Any, c0: Any) -> list[Any]:
    root = mp.sqrt(max(c1 * c1 - 4 * c2 * c0, mp.mpf(0)))
    return [(-c1 + sign * root) / (2 * c2) for sign in (-1, 1)]


def _cubic(c2: Any, c1: Any, c0: Any) -> list[Any]:
    """Viete's trigonometric solution for three real roots."""
    q, r = (c2**2 - 3 * c1) / 9, (2 * c2**3 - 9 * c2 * c1 + 27 * c0) / 54
    third = mp.acos(max(min(r / q ** mp.mpf(1.5), mp.mpf(1)), mp.mpf(-1))) / 3
    return [-2 * mp.sqrt(q) * mp.cos(third + 2 * mp.pi * k / 3) - c2 / 3 for k in range(3)]


def _rz(angle: Any) -> Any:
    c, s = mp.cos(angle), mp.sin(angle)
    return mp.matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def _rx(angle: Any) -> Any:
    c, s = mp.cos(angle), mp.sin(angle)
    return mp.matrix([[1, 0, 0], [0, c, -s], [0, s, c]])
