"""Free rotation by the textbook, at many digits: the reference of the closed form.

Constants from 2T and G2 by plain subtraction, the modulus k2, Euler's angles with the
elliptic integral of the third kind (Whittaker, Analytical Dynamics, sect. 69). These forms
lose half of a float's digits or all of them; of the eighty digits that they are given here
enough are left. Only mpmath is used.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mpmath as mp

DIGITS = 80


@dataclass(frozen=True)
class Exact:
    """State at one time: omega in the body, attitude matrix, largest |omega| per component."""

    omega: list[Any]
    attitude: Any
    amplitude: list[Any]


def exact_moments(given: Any) -> list[Any]:
    """A, B, C as mpmath numbers, the floats taken as exact."""
    if isinstance(given, dict):
        a = mp.mpf(float(given["A"]))
        return [a, a + mp.mpf(float(given["B-A"])), a + mp.mpf(float(given["C-A"]))]
    return [mp.mpf(float(x)) for x in given]


class Textbook:
    """One free motion; asymmetric or symmetric body, not a rotation about an axis."""

    def __init__(self, given: Any, omega: Sequence[float]) -> None:
        body = exact_moments(given)
        start = [mp.mpf(float(x)) for x in omega]
        twice_energy = sum(i * w * w for i, w in zip(body, start, strict=True))
        g2 = sum((i * w) ** 2 for i, w in zip(body, start, strict=True))
        self.order = sorted(range(3), key=lambda axis: body[axis])
        if (
            g2 - twice_energy * body[self.order[1]] < 0
            or body[self.order[1]] == body[self.order[2]]
        ):
            self.order.reverse()
        even = (self.order[1] - self.order[0]) % 3 == 1
        # Turn about axis 3 or 1 by half a turn where needed, to have omega3 and cn above 0.
        sign = [1 if start[axis] >= 0 else -1 for axis in self.order]
        sign[1] = (1 if even else -1) * sign[0] * sign[2]
        self.sign = sign
        w1, w2, _ = (s * start[axis] for s, axis in zip(sign, self.order, strict=True))
        i1, i2, i3 = (body[axis] for axis in self.order)
        self.moments, self.g = (i1, i2, i3), mp.sqrt(g2)
        low, high = g2 - twice_energy * i1, twice_energy * i3 - g2
        self.a1 = mp.sqrt(high / (i1 * (i3 - i1)))
        self.a2 = mp.sqrt(high / (i2 * (i3 - i2))) * (1 if i3 > i1 else -1)
        self.a3 = mp.sqrt(low / (i3 * (i3 - i1)))
        self.rate = mp.sqrt((i3 - i2) * low / (i1 * i2 * i3))
        self.m = (i2 - i1) * high / ((i3 - i2) * low)
        self.separatrix = self.m == 1
        self.angle0 = mp.atan2(w2 / self.a2, w1 / self.a1)
        if self.separatrix:
            self.u0 = mp.asinh(mp.tan(self.angle0))
        else:
            self.quarter = mp.ellipk(self.m)
            self.u0 = mp.ellipf(self.angle0, self.m)
        # phi' = G (m1 w1 + m2 w2)/(m1^2 + m2^2) = (G/I1)(1 + above sn^2)/(1 - n sn^2)
        above = (i2 * self.a2**2) / (i1 * self.a1**2) - 1
        self.n = 1 - (i2 * self.a2) ** 2 / (i1 * self.a1) ** 2
        self.whole = -above / self.n if self.n else mp.mpf(1)
        if not self.separatrix:
            self.half_turn = 2 * mp.ellippi(self.n, self.m)
        zero = mp.mpf(0)
        self.frame0 = self._frame(zero, self._elliptic(zero))

    @property
    def period(self) -> Any:
        """Of omega in the body, or what a few e-foldings take on the separatrix."""
        return 20 / self.rate if self.separatrix else 4 * self.quarter / self.rate

    def at(self, time: float) -> Exact:
        """State at a time, s."""
        t = mp.mpf(float(time))
        functions = self._elliptic(t)
        frame = self.frame0.T * self._frame(t, functions)  # of axes 1, 2, 3
        omega, amplitude = [mp.mpf(0)] * 3, [mp.mpf(0)] * 3
        attitude = mp.matrix(3, 3)
        for i, (axis, sign, w, a) in enumerate(
            zip(
                self.order,
                self.sign,
                self._omega(functions),
                (self.a1, self.a2, self.a3),
                strict=True,
            )
        ):
            omega[axis], amplitude[axis] = sign * w, abs(a)
            for j, (other, s) in enumerate(zip(self.order, self.sign, strict=True)):
                attitude[axis, other] = sign * s * frame[i, j]
        return Exact(omega, attitude, amplitude)

    def _elliptic(self, t: Any) -> tuple[Any, Any, Any, Any]:
        """sn, cn, dn and the amplitude, which grows without end."""
        u = self.rate * t + self.u0
        if self.separatrix:
            return mp.tanh(u), mp.sech(u), mp.sech(u), mp.atan(mp.sinh(u))
        turns = mp.nint(u / (2 * self.quarter))
        rest, sign = u - 2 * self.quarter * turns, 1 if int(turns) % 2 == 0 else -1
        sn, cn, dn = (mp.ellipfun(name, rest, m=self.m) for name in ("sn", "cn", "dn"))
        return sign * sn, sign * cn, dn, mp.atan2(sn, cn) + mp.pi * turns

    def node(self, t: Any) -> Any:
        """Euler's angle phi, rad, without end; that of the axis which is circled."""
        return self._node(t, self._elliptic(t))

    def _omega(self, functions: Any) -> tuple[Any, Any, Any]:
        sn, cn, dn, _ = functions
        return self.a1 * cn, self.a2 * sn, self.a3 * dn

    def _frame(self, t: Any, functions: Any) -> Any:
        """Matrix from axes 1, 2, 3 to axes with the angular momentum upright."""
        omega = self._omega(functions)
        l1, l2, l3 = (i * w / self.g for i, w in zip(self.moments, omega, strict=True))
        tilt, own = mp.atan2(mp.hypot(l1, l2), l3), mp.atan2(l1, l2)
        return _turn_z(self._node(t, functions)) * _turn_x(tilt) * _turn_z(own)

    def _node(self, t: Any, functions: Any) -> Any:
        u = self.rate * t + self.u0
        integral = self.whole * u + (1 - self.whole) * self._third_kind(u, functions[3])
        return self.g / self.moments[0] / self.rate * integral

    def _third_kind(self, u: Any, angle: Any) -> Any:
        """Integral of du/(1 - n sn^2) from 0, without end."""
        if self.separatrix:  # by partial fractions in tanh u
            root = mp.sqrt(self.n)
            return mp.re((u - root * mp.atanh(root * mp.tanh(u))) / (1 - self.n))
        turns = mp.nint(angle / mp.pi)
        return mp.ellippi(self.n, angle - mp.pi * turns, self.m) + turns * self.half_turn


def _turn_z(angle: Any) -> Any:
    c, s = mp.cos(angle), mp.sin(angle)
    return mp.matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def _turn_x(angle: Any) -> Any:
    c, s = mp.cos(angle), mp.sin(angle)
    return mp.matrix([[1, 0, 0], [0, c, -s], [0, s, c]])
