"""The answers of a layered body by another path: other variables, another method.

The solid is integrated from Hooke's law and the balance of forces as they stand, not from the
matrix that follows from them; the static liquid by Poisson's equation, whose density is that of
the level surfaces (Dahlen 1974); in the logarithm of the radius; each solution by itself.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from earthspin.constants import G
from earthspin.interior.layers import Layer, LayeredBody

Array = NDArray[np.float64]
N = 6.0  # n (n + 1) of degree two
START = 1e-3


class Inside:
    """Density, its slope, gravity and moduli by plain quadrature, in units of R, M and G."""

    def __init__(self, body: LayeredBody) -> None:
        self.body = body
        self.tops = np.array([layer.top / body.radius for layer in body.layers])
        self.unit = body.mass / body.radius**3
        self.pressure = G.value * body.mass**2 / body.radius**4

    def density(self, layer: Layer, r: float) -> float:
        return float(np.polyval(layer.density[::-1], r)) / self.unit

    def slope(self, layer: Layer, r: float) -> float:
        return float(np.polyval(np.polyder(layer.density[::-1]), r)) / self.unit

    def gravity(self, r: float) -> float:
        mass, below = 0.0, 0.0
        x, w = np.polynomial.legendre.leggauss(8)  # exact for a cubic density
        for layer, top in zip(self.body.layers, self.tops, strict=True):
            high = min(top, r)
            if high > below:
                s = below + (high - below) * (x + 1) / 2
                rho = np.array([self.density(layer, one) for one in s])
                mass += 4 * np.pi * np.sum(w * rho * s**2) * (high - below) / 2
            below = top
        return float(mass / r**2)

    def moduli(self, layer: Layer, r: float) -> tuple[float, float]:
        rho = np.polyval(layer.density[::-1], r)
        mu = rho * np.polyval(layer.vs[::-1], r) ** 2 / self.pressure
        return float(rho * np.polyval(layer.vp[::-1], r) ** 2 / self.pressure - 2 * mu), float(mu)


def carry(slope, y: Array, start: float, stop: float) -> Array:  # type: ignore[no-untyped-def]
    """Integrate dy/d(ln r), column by column."""

    def log_slope(t: float, flat: Array) -> Array:
        r = float(np.exp(t))
        return np.asarray(r * slope(r, flat.reshape(y.shape))).ravel()

    found = solve_ivp(log_slope, np.log([start, stop]), y.ravel(), "DOP853", rtol=3e-12, atol=1e-15)
    return np.asarray(found.y[:, -1].reshape(y.shape))


def solid(inside: Inside, layer: Layer):  # type: ignore[no-untyped-def]
    """Displacements u, v, tractions p, q, potential f and its flux w."""

    def slope(r: float, y: Array) -> Array:
        u, p, v, q, f, w = y
        rho, g = inside.density(layer, r), inside.gravity(r)
        lam, mu = inside.moduli(layer, r)
        around = (2 * u - N * v) / r
        du = (p - lam * around) / (lam + 2 * mu)
        dv = q / mu + (v - u) / r
        dilation = du + around
        hoop = lam * dilation + mu * around
        df = w + 4 * np.pi * rho * u - 3 * f / r
        dp = -2 * (p - hoop) / r + N * q / r - 4 * rho * g * u / r + N * rho * g * v / r
        dp = dp - rho * (df - 4 * np.pi * rho * u)
        along = lam * dilation + 2 * mu * (u - (N - 1) * v) / r
        dq = -3 * q / r - along / r + rho * (g * u - f) / r
        dw = 12 * np.pi * rho * u / r - 24 * np.pi * rho * v / r + w / r
        return np.array([du, dp, dv, dq, df, dw])

    return slope


def liquid(inside: Inside, layer: Layer):  # type: ignore[no-untyped-def]
    """Potential and its slope: laplace(f) = 4 pi rho' f/g, rho' the slope of the density."""

    def slope(r: float, y: Array) -> Array:
        f, df = y
        pull = 4 * np.pi * inside.slope(layer, r) / inside.gravity(r)
        return np.array([df, 6 * f / r**2 - 2 * df / r + pull * f])

    return slope


def centre(inside: Inside) -> Array:
    """Three regular solutions, by the leading powers of Hooke's law near the centre."""
    r, layer = START, inside.body.layers[0]
    rho, (lam, mu) = inside.density(layer, r), inside.moduli(layer, r)
    y = np.zeros((6, 3))
    y[:, 0] = 2 * r, 4 * mu, r, 2 * mu, 0, -8 * np.pi * rho * r
    y[4, 1], y[5, 1] = r**2, 5 * r
    share = (5 * lam + 7 * mu) / (6 * lam)
    y[:4, 2] = (
        r**3,
        ((5 - 6 * share) * lam + 6 * mu) * r**2,
        share * r**3,
        mu * (2 * share + 1) * r**2,
    )
    return y


def other_answers(body: LayeredBody) -> Array:
    """Answers [i, j] of whole, fluid and inner core, as `Yielding.answers`."""
    inside = Inside(body)
    bounds = [
        i
        for i in range(1, len(body.layers))
        if (not body.layers[i].vs) != (not body.layers[i - 1].vs)
    ]
    first, last = bounds
    y, r = centre(inside), START
    for i in range(first):
        y, r = carry(solid(inside, body.layers[i]), y, r, inside.tops[i]), inside.tops[i]
    icb, fluid_top = float(r), inside.tops[last - 1]
    fluid_layers = body.layers[first:last]
    rho, g = inside.density(fluid_layers[0], icb), inside.gravity(icb)
    cmb = float(fluid_top)
    # The two solutions in the liquid, from the inner core's boundary to the mantle's.
    two, at = np.eye(2), icb
    for i in range(first, last):
        two = carry(liquid(inside, body.layers[i]), two, at, inside.tops[i])
        at = inside.tops[i]
    rho_top, g_top = inside.density(fluid_layers[-1], cmb), inside.gravity(cmb)
    six = np.eye(6)
    for i in range(last, len(body.layers)):
        six = carry(solid(inside, body.layers[i]), six, at, inside.tops[i])
        at = inside.tops[i]
    found = np.zeros((3, 3))
    acts = np.array([[1.0, 1, 1], [0, 1, 0], [1, 0, 0]])  # in inner core, fluid, mantle
    for j, (in_inner, in_fluid, in_mantle) in enumerate(acts):
        # Unknown: three of the inner core, two of the liquid, two displacements of the mantle.
        m, b = np.zeros((9, 9)), np.zeros(9)
        jump = in_fluid - in_inner
        m[0, :3] = y[3]
        m[1, :3] = y[1] - rho * (g * y[0] - y[4])
        b[1] = -rho * jump * icb**2
        # f is continuous but for what acts; its slope jumps with the mass that was displaced,
        # whose surface in the liquid is the level one.
        m[2, :3], m[2, 3] = y[4], -1
        b[2] = -jump * icb**2
        m[3, :3] = y[5] + 4 * np.pi * y[1] / g
        m[3, 3], m[3, 4] = -(3 / icb - 4 * np.pi * rho / g), -1
        b[3] = -5 * jump * icb
        # Bottom of the mantle: u, v free (5, 6), w and f from the liquid.
        f_top, df_top = two
        flux = df_top + (3 / cmb - 4 * np.pi * rho_top / g_top) * f_top
        start, push = np.zeros((6, 9)), np.zeros(6)
        start[0, 5], start[2, 6] = 1, 1
        start[1, 5], start[1, 3:5] = rho_top * g_top, -rho_top * f_top
        start[4, 3:5] = f_top
        start[5, 3:5] = flux - 4 * np.pi / g_top * (-rho_top * f_top)
        start[5, 5] = -4 * np.pi * rho_top
        push[4], push[5] = (in_mantle - in_fluid) * cmb**2, 5 * (in_mantle - in_fluid) * cmb
        top, offset = six @ start, six @ push
        for row, k in enumerate((1, 3, 5)):
            m[4 + row] = top[k]
            b[4 + row] = (5 * in_mantle if k == 5 else 0.0) - offset[k]
        x = np.linalg.solve(m[:7, :7], b[:7])
        surface = top[:, :7] @ x + offset
        bottom = start[:, :7] @ x + push
        inner = y @ x[:3]
        found[0, j] = surface[4] - in_mantle
        found[2, j] = icb**3 * (inner[4] - icb * inner[5] / 5)
        found[1, j] = cmb**3 * (bottom[4] - cmb * bottom[5] / 5) - found[2, j]
    return found
