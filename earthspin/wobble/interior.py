"""A layered body: its moments, and how it yields to a tide, a load and its own core.

The static elastic-gravitational equations of degree two, in the notation of Takeuchi &
Saito (1972, Methods in Computational Physics 11, eq. 82):

    y1, y3  radial and tangential displacement      y5  potential of the displaced masses
    y2, y4  radial and tangential stress            y6 = dy5/dr - 4 pi G rho y1 + 3 y5/r

and, in the liquid core, where displacement is not defined, the pair y5 and
y7 = y6 + 4 pi G y2/g of Saito (1974, J. Phys. Earth 22, 123). Lengths are in units of the
radius R, densities in mean densities, accelerations in surface gravity g; then 4 pi G = 3.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import G
from earthspin.errors import UndefinedError

Array = NDArray[Any]

_FOUR_PI_G = 3.0
#: Local relative error of the integration; k2 then holds to 1e-9.
_RTOL = 1e-9
#: The integration starts here, not at the centre, where the equations are singular.
_START = 1e-3


@dataclass(frozen=True)
class Layer:
    """One shell; polynomials in x = r/R, constant term first.

    Attributes
    ----------
    top : float
        Outer radius, m.
    density : tuple of float
        kg m-3.
    vp, vs : tuple of float
        Speeds of compressional and shear waves at a period of 1 s, m/s; no `vs` in a liquid.
    shear_q : float
        Quality factor in shear; infinite in a liquid.
    """

    top: float
    density: tuple[float, ...]
    vp: tuple[float, ...]
    vs: tuple[float, ...] = ()
    shear_q: float = np.inf


@dataclass(frozen=True)
class LayeredBody:
    """A body of solid inner core, liquid outer core and solid mantle.

    Attributes
    ----------
    name : str
    layers : tuple of Layer
        From the centre outwards.
    reference : str
    """

    name: str
    layers: tuple[Layer, ...]
    reference: str

    @property
    def radius(self) -> float:
        """Radius R, m."""
        return self.layers[-1].top

    @property
    def core_radius(self) -> float:
        """Radius of the boundary between the liquid core and the mantle, m."""
        return max(layer.top for layer in self.layers[:-1] if not layer.vs)

    @property
    def mass(self) -> float:
        """Mass, kg."""
        return float(4 * np.pi * self._radial_moment(2, self.radius))

    def moment_of_inertia(self, radius: float | None = None) -> float:
        """Moment of inertia of what lies within a radius, kg m2; of all by default."""
        outer = self.radius if radius is None else radius
        return float(8 * np.pi / 3 * self._radial_moment(4, outer))

    @property
    def moment_factor(self) -> float:
        """I/(M R2)."""
        return self.moment_of_inertia() / (self.mass * self.radius**2)

    @property
    def core_fraction(self) -> float:
        """Moment of inertia of the core, inner core included, over that of the whole body."""
        return self.moment_of_inertia(self.core_radius) / self.moment_of_inertia()

    def _radial_moment(self, power: int, radius: float) -> float:
        """Integral of rho r^power from the centre, by the polynomials' primitives."""
        total, below = 0.0, 0.0
        for layer in self.layers:
            primitive = np.polynomial.Polynomial((0.0,) * power + layer.density).integ()
            top = min(layer.top, radius) / self.radius
            total += primitive(top) - primitive(below)
            below = top
        return float(total * self.radius ** (power + 1))


def _prem(*outermost: Layer) -> tuple[Layer, ...]:
    """Layers of PREM below the uppermost crust, isotropic, and what is put on them."""
    lower = (7956.5, -6476.1, 5528.3, -3080.7)
    lid = ((2691.0, 692.4), (4187.5, 3938.2), (2151.9, 2348.1))
    return (
        Layer(
            1221.5e3, (13088.5, 0.0, -8838.1), (11262.2, 0.0, -6364.0), (3667.8, 0.0, -4447.5), 84.6
        ),
        Layer(
            3480e3,
            (12581.5, -1263.8, -3642.6, -5528.1),
            (11048.7, -4036.2, 4802.3, -13573.2),
        ),
        Layer(
            3630e3,
            lower,
            (15389.1, -5318.1, 5524.2, -2551.4),
            (6925.4, 1467.2, -2083.4, 978.3),
            312.0,
        ),
        Layer(
            5600e3,
            lower,
            (24952.0, -40467.3, 51483.2, -26641.9),
            (11167.1, -13781.8, 17457.5, -9277.7),
            312.0,
        ),
        Layer(
            5701e3,
            lower,
            (29276.6, -23602.7, 5524.2, -2551.4),
            (22345.9, -17247.3, -2083.4, 978.3),
            312.0,
        ),
        Layer(5771e3, (5319.7, -1483.6), (19095.7, -9867.2), (9983.9, -4932.4), 143.0),
        Layer(5971e3, (11249.4, -8029.8), (39702.7, -32616.6), (22351.2, -18585.6), 143.0),
        Layer(6151e3, (7108.9, -3804.5), (20392.6, -12256.9), (8949.6, -4459.7), 143.0),
        Layer(6291e3, *lid, 80.0),
        Layer(6346.6e3, *lid, 600.0),
        Layer(6356e3, (2900.0,), (6800.0,), (3900.0,), 600.0),
        *outermost,
    )


_PREM_SOURCE = "Dziewonski & Anderson 1981, PEPI 25, 297, table I"

#: As published, with three kilometres of ocean all over.
PREM_WITH_OCEAN = LayeredBody(
    "prem-ocean",
    _prem(
        Layer(6368e3, (2600.0,), (5800.0,), (3200.0,), 600.0), Layer(6371e3, (1020.0,), (1450.0,))
    ),
    _PREM_SOURCE,
)

#: The ocean filled by upper crust: its surface is solid, and an ocean can be added on its own.
PREM = LayeredBody(
    "prem",
    _prem(Layer(6371e3, (2600.0,), (5800.0,), (3200.0,), 600.0)),
    _PREM_SOURCE + "; its ocean filled by upper crust",
)


@dataclass(frozen=True)
class Yielding:
    """How a layered body yields in degree two; arrays have the shape of the given `strain`.

    Attributes
    ----------
    k, h, l : array
        Love numbers of a tide.
    k_load, h_load : array
        Load Love numbers.
    core_k : array
        As k, but of the masses of the core alone, at the core's radius.
    k_pressure, core_k_pressure : array
        As `k` and `core_k`, for a potential that acts on the matter of the core alone and
        is 1 when continued to the surface: the pressure of a core that turns about
        another axis than the mantle.
    """

    k: Array
    h: Array
    l: Array  # noqa: E741  (the field's own name)
    k_load: Array
    h_load: Array
    core_k: Array
    k_pressure: Array
    core_k_pressure: Array


def yielding(body: LayeredBody, strain: Any = 0.0) -> Yielding:
    """Love numbers of degree two, of tide, load and core pressure.

    Parameters
    ----------
    body : LayeredBody
    strain : complex or array
        Relative change of the shear modulus at quality factor 1; a layer's modulus is
        multiplied by 1 + strain/shear_q. 0 is the elastic body as seismology has it.

    Raises
    ------
    UndefinedError
        If the surface is liquid or there is no liquid core.
    """
    if not body.layers[-1].vs or all(layer.vs for layer in body.layers):
        raise UndefinedError(
            f"interior '{body.name}': Love numbers need a liquid core and a solid surface"
        )
    strain = np.asarray(strain)
    flat = np.atleast_1d(strain).ravel()
    profile = _Profile(body)
    columns = _through_mantle(profile, flat, _through_core(profile, flat))
    found = _at_surface(profile, columns)
    return Yielding(*(value.reshape(strain.shape) for value in found))


# --- the profile -----------------------------------------------------------------------------


class _Profile:
    """Density, moduli and gravity of a body in its own units."""

    def __init__(self, body: LayeredBody) -> None:
        self.layers = body.layers
        self.core = body.core_radius / body.radius
        self.tops = [layer.top / body.radius for layer in body.layers]
        self.density_unit = body.mass / (4 / 3 * np.pi * body.radius**3)
        gravity = G.value * body.mass / body.radius**2
        self.modulus_unit = self.density_unit * gravity * body.radius
        self._mass = [self._primitive(layer) for layer in body.layers]
        self._below = np.zeros(len(self.tops))
        for i in range(1, len(self.tops)):
            edge = self.tops[i - 1]
            step = self._mass[i - 1](edge) - self._mass[i](edge)
            self._below[i] = self._below[i - 1] + step

    def _primitive(self, layer: Layer) -> np.polynomial.Polynomial:
        density = tuple(d / self.density_unit for d in layer.density)
        return _FOUR_PI_G * np.polynomial.Polynomial((0.0, 0.0, *density)).integ()

    def density(self, i: int, r: float) -> float:
        return _horner(self.layers[i].density, r) / self.density_unit

    def gravity(self, i: int, r: float) -> float:
        """G m(r)/r2, with 4 pi G = 3."""
        return float((self._mass[i](r) + self._below[i]) / r**2)

    def moduli(self, i: int, r: float, strain: Array) -> tuple[Array, Array]:
        """Lame's lambda and mu; the bulk modulus stays when mu changes."""
        layer, rho = self.layers[i], _horner(self.layers[i].density, r)
        seismic = rho * _horner(layer.vs, r) ** 2 / self.modulus_unit
        bulk = rho * _horner(layer.vp, r) ** 2 / self.modulus_unit - 4 / 3 * seismic
        mu = seismic * (1 + strain / layer.shear_q)
        return bulk - 2 / 3 * mu, mu


def _horner(coefficients: tuple[float, ...], x: float) -> float:
    total = 0.0
    for c in reversed(coefficients):
        total = total * x + c
    return total


# --- the equations ---------------------------------------------------------------------------


def _solid_matrix(profile: _Profile, i: int, r: float, strain: Array) -> Array:
    """Matrix of dy/dr = M y in a solid, shape (strain, 6, 6); degree two."""
    rho, g = profile.density(i, r), profile.gravity(i, r)
    lam, mu = profile.moduli(i, r, strain)
    p = lam + 2 * mu
    shear = 2 * mu * (3 * lam + 2 * mu) / p / r**2
    m = np.zeros((strain.size, 6, 6), dtype=strain.dtype)
    m[:, 0, 0], m[:, 0, 1], m[:, 0, 2] = -2 * lam / (p * r), 1 / p, 6 * lam / (p * r)
    m[:, 1, 0], m[:, 1, 1] = 2 * shear - 4 * rho * g / r, -4 * mu / (p * r)
    m[:, 1, 2], m[:, 1, 3] = 6 * (rho * g / r - shear), 6 / r
    m[:, 1, 4], m[:, 1, 5] = 3 * rho / r, -rho
    m[:, 2, 0], m[:, 2, 2], m[:, 2, 3] = -1 / r, 1 / r, 1 / mu
    m[:, 3, 0], m[:, 3, 1] = rho * g / r - shear, -lam / (p * r)
    m[:, 3, 2] = 2 * mu / (p * r**2) * (11 * lam + 10 * mu)
    m[:, 3, 3], m[:, 3, 4] = -3 / r, -rho / r
    m[:, 4, 0], m[:, 4, 4], m[:, 4, 5] = _FOUR_PI_G * rho, -3 / r, 1
    m[:, 5, 0], m[:, 5, 2], m[:, 5, 5] = 3 * _FOUR_PI_G * rho / r, -6 * _FOUR_PI_G * rho / r, 1 / r
    return m


def _liquid_matrix(profile: _Profile, i: int, r: float) -> Array:
    """Matrix of the pair (y5, y7) in a liquid (Saito 1974, eq. 17)."""
    s = _FOUR_PI_G * profile.density(i, r) / profile.gravity(i, r)
    return np.array([[s - 3 / r, 1.0], [2 * s / r, 1 / r - s]])


def _carry(matrix: Callable[[float], Array], start: float, stop: float, y: Array) -> Array:
    """Integrate dy/dr = M y for all columns at once."""

    def slope(r: float, flat: Array) -> Array:
        return np.asarray(matrix(r) @ flat.reshape(y.shape)).ravel()

    from scipy.integrate import solve_ivp  # late: plans read layers and integrate nothing

    solution = solve_ivp(
        slope, (start, stop), y.ravel(), "DOP853", rtol=_RTOL, atol=1e-12, t_eval=[stop]
    )
    return np.asarray(solution.y[:, -1].reshape(y.shape))


def _centre(profile: _Profile, strain: Array) -> Array:
    """Three regular solutions near the centre to leading order in r, shape (strain, 6, 3)."""
    r = _START
    lam, mu = profile.moduli(0, r, strain)
    rho = profile.density(0, r)
    y = np.zeros((strain.size, 6, 3), dtype=strain.dtype)
    y[:, 0, 0], y[:, 1, 0], y[:, 2, 0], y[:, 3, 0] = 2 * r, 4 * mu, r, 2 * mu
    y[:, 5, 0] = -2 * _FOUR_PI_G * rho * r
    y[:, 4, 1], y[:, 5, 1] = r**2, 5 * r
    ratio = (5 * lam + 7 * mu) / (6 * lam)
    y[:, 0, 2], y[:, 1, 2] = r**3, ((5 - 6 * ratio) * lam + 6 * mu) * r**2
    y[:, 2, 2], y[:, 3, 2] = ratio * r**3, mu * (2 * ratio + 1) * r**2
    return y


def _through_core(profile: _Profile, strain: Array) -> Array:
    """The regular solution (y5, y7) at the top of the liquid core, shape (strain, 2)."""
    pair = np.broadcast_to(_liquid_centre(profile), (strain.size, 2)).astype(strain.dtype)
    i, r = 0, _START
    if profile.layers[0].vs:
        y = _centre(profile, strain)
        while profile.layers[i].vs:
            y = _carry(_solid(profile, i, strain), r, profile.tops[i], y)
            r, i = profile.tops[i], i + 1
        # No shear at the liquid, and the liquid's pressure: two conditions on three columns.
        rho, g = profile.density(i, r), profile.gravity(i, r)
        tangential, normal = y[:, 3], y[:, 1] - rho * (g * y[:, 0] - y[:, 4])
        mix = np.cross(tangential, normal)
        y2, y5, y6 = (np.sum(y[:, row] * mix, axis=1) for row in (1, 4, 5))
        pair[:, 0], pair[:, 1] = y5, y6 + _FOUR_PI_G * y2 / g
    pair = pair / abs(pair[:, :1])
    while not profile.layers[i].vs:
        pair = _carry(_liquid(profile, i), r, profile.tops[i], pair[..., None])[..., 0]
        r, i = profile.tops[i], i + 1
    return pair


def _liquid_centre(profile: _Profile) -> Array:
    """The regular solution (y5, y7) near the centre of a liquid."""
    s = _FOUR_PI_G * profile.density(0, _START) / profile.gravity(0, _START)
    return np.array([_START**2, (5 / _START - s) * _START**2])


def _solid(profile: _Profile, i: int, strain: Array) -> Callable[[float], Array]:
    return lambda r: _solid_matrix(profile, i, r, strain)


def _liquid(profile: _Profile, i: int) -> Callable[[float], Array]:
    return lambda r: _liquid_matrix(profile, i, r)


def _through_mantle(profile: _Profile, strain: Array, pair: Array) -> Array:
    """Columns at the core's top and at the surface, shape (2, strain, 6, 4).

    The columns: one of the core's own potential, the two displacements of its boundary,
    which the liquid leaves free, and the pressure of a potential r2 in the core alone.
    """
    b = profile.core
    i = next(n for n, top in enumerate(profile.tops) if top > b)
    rho, g = profile.density(i - 1, b), profile.gravity(i - 1, b)
    y = np.zeros((strain.size, 6, 4), dtype=strain.dtype)
    y[:, 1, 0], y[:, 4, 0] = -rho * pair[:, 0], pair[:, 0]
    y[:, 5, 0] = pair[:, 1] + _FOUR_PI_G * rho * pair[:, 0] / g
    y[:, 0, 1], y[:, 1, 1], y[:, 5, 1] = 1, rho * g, -_FOUR_PI_G * rho
    y[:, 2, 2] = 1
    # The pair carries the potential that the liquid feels; gravity has r2 less.
    y[:, 4, 3], y[:, 5, 3] = -(b**2), -5 * b
    bottom, r = y, b
    for n in range(i, len(profile.tops)):
        y = _carry(_solid(profile, n, strain), r, profile.tops[n], y)
        r = profile.tops[n]
    return np.stack([bottom, y])


def _at_surface(profile: _Profile, columns: Array) -> tuple[Array, ...]:
    """Meet the three conditions at the surface for tide, load and core pressure."""
    bottom, top = columns
    conditions = top[:, [1, 3, 5], :3]
    pressure = -top[:, [1, 3, 5], 3]
    given = np.stack(
        [
            np.broadcast_to([0.0, 0.0, 5.0], pressure.shape),  # a tide of potential 1
            np.broadcast_to([-5 / 3, 0.0, 5.0], pressure.shape),  # the weight of a load
            pressure,
        ],
        axis=-1,
    )
    mix = np.linalg.solve(conditions, given)
    surface = top[..., :3] @ mix
    surface[..., 2] += top[..., 3]
    core = bottom[..., :3] @ mix
    core[..., 2] += bottom[..., 3]
    k, h = surface[:, 4], surface[:, 0]
    # What the masses inside b add to the potential there, b3 (y5 - b y6/5), as a k.
    b = profile.core
    inside = b**3 * (core[:, 4] - b * core[:, 5] / 5)
    return (
        k[:, 0] - 1,
        h[:, 0],
        surface[:, 2, 0],
        k[:, 1] - 1,
        h[:, 1],
        inside[:, 0],
        k[:, 2],
        inside[:, 2],
    )


# --- a body at rest in itself ----------------------------------------------------------------


@dataclass(frozen=True)
class Equilibrium:
    """How a body of the same densities would be shaped if it were liquid throughout.

    Attributes
    ----------
    k : float
        Love number of the liquid body.
    core_k : float
        Of the masses of its core, as `Yielding.core_k`.
    """

    k: float
    core_k: float


@lru_cache(maxsize=8)
def equilibrium(body: LayeredBody) -> Equilibrium:
    """Clairaut's hydrostatic figure to first order, by the equations of a liquid."""
    profile = _Profile(body)
    pair = _liquid_centre(profile)[:, None]
    r, at_core = _START, pair
    for i, top in enumerate(profile.tops):
        pair = _carry(_liquid(profile, i), r, top, pair)
        r = top
        if top == profile.core:
            at_core = pair
    # The equation of a free liquid surface: the potential of degree two comes from outside.
    scale = 5 / pair[1, 0]
    b = profile.core
    y5, y7 = scale * at_core[:, 0]
    return Equilibrium(k=float(scale * pair[0, 0] - 1), core_k=float(b**3 * (y5 - b * y7 / 5)))
