"""The answers of a layered body by another path: other variables, another method.

The solid is integrated from Hooke's law and the balance of forces as they stand, not from the
matrix that follows from them; the static liquid by Poisson's equation, whose density is that of
the level surfaces (Dahlen 1974); in the logarithm of the radius; each solution by itself. With
another way to carry them, and another kind of number, it makes the stored reference as well.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from earthspin.constants import G
from earthspin.interior.layers import Layer, LayeredBody

Number = Any
Array = NDArray[Any]
Slope = Callable[[Any, Array], Array]
#: Takes dy/dr, y, and the radii where it starts and stops.
Carry = Callable[[Slope, Array, Any, Any], Array]

N = 6  # n (n + 1) of degree two
START = 1e-3
#: Boole's rule, exact for the mass of a layer whose density is a cubic.
BOOLE = np.array([7, 32, 12, 32, 7])


class Inside:
    """Density, its slope, gravity and moduli by plain quadrature, in units of R, M and G."""

    def __init__(self, body: LayeredBody, kind: type[np.floating[Any]] = np.float64) -> None:
        self.body, self.kind, self.pi = body, kind, 4 * np.arctan(kind(1))
        radius = kind(body.radius)
        self.tops = np.array([kind(layer.top) / radius for layer in body.layers])
        self.unit = kind(1)
        self.below = [kind(0)]
        for layer, top, under in zip(body.layers, self.tops, [kind(0), *self.tops], strict=False):
            self.below.append(self.below[-1] + self.shell(layer, under, top))
        self.unit, mass = self.below[-1], self.below[-1] * radius**3
        self.below = [part / self.unit for part in self.below]
        self.pressure = kind(G.value) * mass**2 / radius**4

    def _series(self, coefficients: tuple[float, ...], r: Number) -> Number:
        return np.polyval(np.array(coefficients[::-1], dtype=self.kind), r)

    def shell(self, layer: Layer, below: Number, top: Number) -> Number:
        """Mass of a layer between two radii."""
        r = below + (top - below) * np.arange(5) / self.kind(4)
        values = np.array([self.density(layer, one) * one**2 for one in r])
        return 4 * self.pi * (top - below) * np.sum(BOOLE * values) / 90

    def density(self, layer: Layer, r: Number) -> Number:
        return self._series(layer.density, r) / self.unit

    def slope(self, layer: Layer, r: Number) -> Number:
        rising = tuple(n * c for n, c in enumerate(layer.density))[1:] or (0.0,)
        return self._series(rising, r) / self.unit

    def gravity(self, layer: Layer, r: Number) -> Number:
        """At a radius in a layer."""
        i = self.body.layers.index(layer)
        under = self.tops[i - 1] if i else self.kind(0)
        return (self.below[i] + self.shell(layer, under, r)) / r**2

    def moduli(self, layer: Layer, r: Number) -> tuple[Number, Number]:
        rho = self._series(layer.density, r)
        mu = rho * self._series(layer.vs, r) ** 2 / self.pressure
        return rho * self._series(layer.vp, r) ** 2 / self.pressure - 2 * mu, mu


def carry(slope: Slope, y: Array, start: Number, stop: Number) -> Array:
    """Integrate dy/d(ln r), column by column."""

    def log_slope(t: float, flat: Array) -> Array:
        r = float(np.exp(t))
        return np.asarray(r * slope(r, flat.reshape(y.shape))).ravel()

    found = solve_ivp(log_slope, np.log([start, stop]), y.ravel(), "DOP853", rtol=3e-12, atol=1e-15)
    return np.asarray(found.y[:, -1].reshape(y.shape))


def solid(inside: Inside, layer: Layer) -> Slope:
    """Displacements u, v, tractions p, q, potential f and its flux w."""

    def slope(r: Number, y: Array) -> Array:
        u, p, v, q, f, w = y
        rho, g = inside.density(layer, r), inside.gravity(layer, r)
        lam, mu = inside.moduli(layer, r)
        around = (2 * u - N * v) / r
        du = (p - lam * around) / (lam + 2 * mu)
        dv = q / mu + (v - u) / r
        dilation = du + around
        hoop = lam * dilation + mu * around
        df = w + 4 * inside.pi * rho * u - 3 * f / r
        dp = -2 * (p - hoop) / r + N * q / r - 4 * rho * g * u / r + N * rho * g * v / r
        dp = dp - rho * (df - 4 * inside.pi * rho * u)
        along = lam * dilation + 2 * mu * (u - (N - 1) * v) / r
        dq = -3 * q / r - along / r + rho * (g * u - f) / r
        dw = 12 * inside.pi * rho * u / r - 24 * inside.pi * rho * v / r + w / r
        return np.array([du, dp, dv, dq, df, dw])

    return slope


def liquid(inside: Inside, layer: Layer) -> Slope:
    """Potential and its slope: laplace(f) = 4 pi rho' f/g, rho' the slope of the density."""

    def slope(r: Number, y: Array) -> Array:
        f, df = y
        pull = 4 * inside.pi * inside.slope(layer, r) / inside.gravity(layer, r)
        return np.array([df, 6 * f / r**2 - 2 * df / r + pull * f])

    return slope


def centre(inside: Inside, r: Number) -> Array:
    """Three regular solutions, by the leading powers of Hooke's law near the centre."""
    layer = inside.body.layers[0]
    rho, (lam, mu) = inside.density(layer, r), inside.moduli(layer, r)
    y = np.zeros((6, 3), dtype=inside.kind)
    y[:, 0] = 2 * r, 4 * mu, r, 2 * mu, 0, -8 * inside.pi * rho * r
    y[4, 1], y[5, 1] = r**2, 5 * r
    share = (5 * lam + 7 * mu) / (6 * lam)
    y[:4, 2] = (
        r**3,
        ((5 - 6 * share) * lam + 6 * mu) * r**2,
        share * r**3,
        mu * (2 * share + 1) * r**2,
    )
    return y


def solve(m: Array, b: Array) -> Array:
    """Solve m x = b to the digits of the numbers, by refining what float64 gives."""
    rough, x = m.astype(float), np.zeros_like(b)
    for _ in range(10):
        x = x + np.linalg.solve(rough, (b - m @ x).astype(float))
    return x


def other_answers(
    body: LayeredBody,
    carry: Carry = carry,
    kind: type[np.floating[Any]] = np.float64,
    start: float = START,
) -> Array:
    """Answers [i, j] of whole, fluid and inner core, as `DegreeTwoLoveNumbers.response`.

    Of a body with one liquid in one layer or many, under a solid, with or without one in it: an
    Earth, a Mars whose core is liquid to the centre, a moon with an ocean between rock and ice.
    """
    inside = Inside(body, kind)
    liquids = [i for i, layer in enumerate(body.layers) if not layer.vs]
    first, last = liquids[0], liquids[-1] + 1
    y, r = centre(inside, kind(start)), kind(start)
    for i in range(first):
        y, r = carry(solid(inside, body.layers[i]), y, r, inside.tops[i]), inside.tops[i]
    icb, cmb = r, inside.tops[last - 1]
    fluid_layers = body.layers[first:last]
    # From an inner core on both solutions of the liquid count, from the centre the regular one.
    two, at = np.eye(2, dtype=kind) if first else np.array([[r**2], [2 * r]]), icb
    for i in range(first, last):
        if i > first:  # where the density jumps, so does the slope of the potential
            lower, upper = body.layers[i - 1 : i + 1]
            step = inside.density(upper, at) - inside.density(lower, at)
            two[1] += 4 * inside.pi * step * two[0] / inside.gravity(upper, at)
        two = carry(liquid(inside, body.layers[i]), two, at, inside.tops[i])
        at = inside.tops[i]
    rho_top, g_top = inside.density(fluid_layers[-1], cmb), inside.gravity(fluid_layers[-1], cmb)
    six = np.eye(6, dtype=kind)
    for i in range(last, len(body.layers)):
        six = carry(solid(inside, body.layers[i]), six, at, inside.tops[i])
        at = inside.tops[i]
    found = np.zeros((3, 3), dtype=kind)
    acts = np.array([[1.0, 1, 1], [0, 1, 0], [1, 0, 0]])  # in inner core, fluid, mantle
    # Unknown: three of an inner core, those of the liquid, two displacements of the mantle.
    threes = 3 if first else 0
    fluid, u, v = slice(threes, -2), -2, -1
    unknowns = threes + two.shape[1] + 2
    for j, (in_inner, in_fluid, in_mantle) in enumerate(acts):
        m, b = (np.zeros((unknowns, *more), dtype=kind) for more in ((unknowns,), ()))
        if first:
            rho, g = inside.density(fluid_layers[0], icb), inside.gravity(fluid_layers[0], icb)
            jump = in_fluid - in_inner
            m[0, :3] = y[3]
            m[1, :3] = y[1] - rho * (g * y[0] - y[4])
            b[1] = -rho * jump * icb**2
            # f is continuous but for what acts; its slope jumps with the mass that was displaced,
            # whose surface in the liquid is the level one.
            m[2, :3], m[2, 3] = y[4], -1
            b[2] = -jump * icb**2
            m[3, :3] = y[5] + 4 * inside.pi * y[1] / g
            m[3, 3], m[3, 4] = -(3 / icb - 4 * inside.pi * rho / g), -1
            b[3] = -5 * jump * icb
        # Bottom of the mantle: u, v free, w and f from the liquid.
        f_top, df_top = two
        flux = df_top + (3 / cmb - 4 * inside.pi * rho_top / g_top) * f_top
        begin, push = np.zeros((6, unknowns), dtype=kind), np.zeros(6, dtype=kind)
        begin[0, u], begin[2, v] = 1, 1
        begin[1, u], begin[1, fluid] = rho_top * g_top, -rho_top * f_top
        begin[4, fluid] = f_top
        begin[5, fluid] = flux - 4 * inside.pi / g_top * (-rho_top * f_top)
        begin[5, u] = -4 * inside.pi * rho_top
        push[4], push[5] = (in_mantle - in_fluid) * cmb**2, 5 * (in_mantle - in_fluid) * cmb
        top, offset = six @ begin, six @ push
        for row, k in enumerate((1, 3, 5), start=-3):
            m[row] = top[k]
            b[row] = (5 * in_mantle if k == 5 else 0.0) - offset[k]
        x = solve(m, b)
        surface = top @ x + offset
        bottom = begin @ x + push
        found[0, j] = surface[4] - in_mantle
        if first:
            inner = y @ x[:3]
            found[2, j] = icb**3 * (inner[4] - icb * inner[5] / 5)
        found[1, j] = cmb**3 * (bottom[4] - cmb * bottom[5] / 5) - found[2, j]
    return found
