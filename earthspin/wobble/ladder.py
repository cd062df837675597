"""Free wobble period from a ladder of models, from rigid to deformable.

Each rung (step) gives the period in rotations of the body. The effects of the rungs are factors
and do not commute: the fluid core shortens the period by 34 days with a rigid mantle, and by 51
days with an elastic mantle. The result for each rung depends on the order of the rungs.

Rungs from `elastic` on are roots of the system of mantle and core.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from earthspin.errors import UndefinedError
from earthspin.interior.equilibrium import hydrostatic_core
from earthspin.interior.love import elastic, softening
from earthspin.interior.named import ANELASTIC_EXPONENT, Interior
from earthspin.interior.ocean_and_anelasticity import global_ocean, shear_modulus_change
from earthspin.mass.figure import ellipticity_from_h, polar_moment_factor
from earthspin.numerics.arrays import Array, Numeric

# --- elastic mantle with a fluid core -------------------------------------------------------------
# Liouville's equation of the whole body and Sasao's of its core (Sasao, Okubo & Saito 1980, IAU
# Symp. 78, 165; Mathews, Buffett, Herring & Shapiro 1991, JGR 96, 8219), in units of the spin, in
# all three axes:
#
#     d/dt (M m + X n) = J (D m - X n)                  M = T + K,  D = E - K
#     d/dt (a m + b n) = -f J n                         a = 1 + gamma,  b = 1 + beta,  f = 1 + e_f
#
# m is the wobble of the mantle, n of the core relative to it, J a quarter turn, T and E the moments
# and their differences, K what the body's products of inertia answer to a wobble, X = A_f/A + xi
# the core's share. It is the system of `earthspin.interior.modes` with the inner core counted with
# the fluid, and with three axes. Without three axes and ocean the roots are those of [s - e + (1+s)
# kappa][1 + s b + e_f] = (1+s) X s a.
#
# In closed form: with n from the second equation, and because M + D is a multiple of 1, the odd
# powers of s cancel, and y = s^2 are the roots of
#
#     (f^2 - b^2 y)(|D| - y |M|) + X a y [(f - b y) tr M + (f - b) tr D] - X^2 a^2 y (1 - y) = 0.
#
# Fifty products a body, in the place of a matrix of four by four and its eigenvalues.


def quotient(numerator: Numeric, denominator: Numeric) -> Numeric:
    """Quotient of two numbers; infinite if the denominator is zero."""
    with np.errstate(divide="ignore"):
        return np.divide(numerator, denominator)


@dataclass(frozen=True)
class Roots:
    """Complex frequencies of free wobble and free core nutation, in cycles per rotation.

    Attributes
    ----------
    wobble : float or complex array
        s, turns of the wobble per turn of the body; exp(i s Omega t), so Im s > 0 decays.
    core : float or complex array
        The same of the free core nutation, near -1.
    """

    wobble: Array
    core: Array

    @property
    def rotations(self) -> Array:
        """Period of the free wobble in rotations of the body."""
        return np.asarray(1 / self.wobble.real)

    @property
    def quality_factor(self) -> Array:
        """Quality factor of the free wobble; infinite without dissipation."""
        loss = self.wobble.imag
        return np.asarray(quotient(self.wobble.real, 2 * loss))

    @property
    def core_rotations(self) -> Array:
        """Period of the free core nutation in space, in rotations; negative if retrograde."""
        return np.asarray(1 / (1 + self.core.real))


@dataclass(frozen=True)
class Mantle:
    """Coefficients of the mantle's equation of motion; floats or arrays of one shape.

    Attributes
    ----------
    ellipticity : float
        e = (C - (A + B)/2)/((A + B)/2).
    equatorial_ellipticity : float
        (B - A)/(A + B).
    kappa : float or complex
        Products of inertia over (A + B)/2 per radian of wobble.
    ocean : array, shape (..., 2, 2), optional
        The same of the ocean, symmetric.
    """

    ellipticity: Numeric
    equatorial_ellipticity: Numeric
    kappa: Numeric
    ocean: Array | None = None

    def traces_and_determinants(self) -> tuple[Numeric, Numeric, Numeric, Numeric]:
        """Return the traces and determinants of the matrices M and D in the mantle's equation.

        The order is tr M, |M|, tr D, |D|.
        """
        ocean = np.zeros((2, 2)) if self.ocean is None else self.ocean
        water_11, water_22, off_diagonal = ocean[..., 0, 0], ocean[..., 1, 1], ocean[..., 0, 1]
        m1 = 1 - self.equatorial_ellipticity + self.kappa + water_11
        m2 = 1 + self.equatorial_ellipticity + self.kappa + water_22
        d1 = self.ellipticity + self.equatorial_ellipticity - self.kappa - water_11
        d2 = self.ellipticity - self.equatorial_ellipticity - self.kappa - water_22
        return m1 + m2, m1 * m2 - off_diagonal**2, d1 + d2, d1 * d2 - off_diagonal**2


@dataclass(frozen=True)
class FluidCore:
    """Coefficients of the core's equation of motion; floats or arrays of one shape.

    Attributes
    ----------
    fraction : float
        A_f/A; zero for a body without a core.
    ellipticity : float
        (C_f - A_f)/A_f.
    gamma, beta : float or complex
        Deformation of the core by the wobble of the mantle and by its own wobble, over A_f.
    xi : float or complex
        Deformation of the body by the wobble of the core, over A.
    """

    fraction: Numeric
    ellipticity: Numeric
    gamma: Numeric = 0.0
    beta: Numeric = 0.0
    xi: Numeric = 0.0


def solve(mantle: Mantle, core: FluidCore) -> Roots:
    """Solve the equations of mantle and core for the wobble and core nutation frequencies.

    Raises
    ------
    UndefinedError
        If one of the bodies would turn over in the place of wobbling.
    """
    trace_m, det_m, trace_d, det_d = mantle.traces_and_determinants()
    a, b, f = 1 + core.gamma, 1 + core.beta, 1 + core.ellipticity
    x_a = (core.fraction + core.xi) * a  # X a
    constant = f**2 * det_d
    linear = x_a * (f * trace_m + (f - b) * trace_d - x_a) - f**2 * det_m - b**2 * det_d
    square = b**2 * det_m - x_a * (b * trace_m - x_a)
    # The sum of the larger root first: the smaller one then follows without cancellation.
    larger = -linear + np.sqrt(linear**2 - 4 * constant * square)
    wobble, nutation = 2 * constant / larger, larger / (2 * square)
    if np.any(wobble.real < 0):
        raise UndefinedError(
            "the body yields by more than its bulge about one of its axes: it would turn over, "
            "not wobble; take a body with a larger H or a smaller triaxiality"
        )
    return Roots(wobble=np.asarray(np.sqrt(wobble)), core=np.asarray(-np.sqrt(nutation)))


# --- the rungs ------------------------------------------------------------------------------------

RUNGS = ("flattening", "rigid", "triaxial", "elastic", "fluid-core", "ocean", "anelastic")

#: What each rung is, and where its formula stands.
FORMULAS = {
    "flattening": "1/f, the flattening in the place of (C - A)/A (I.9.52)",
    "rigid": "A/(C - A) (Euler; I.6.7)",
    "triaxial": "sqrt(A B/((C - A)(C - B))) (I.4.4)",
    "elastic": "(1 + kappa)/(e - kappa), kappa = k2 Omega2 R5/(3 G A) (Love 1909; Larmor 1909)",
    "fluid-core": "root of mantle and core (Sasao, Okubo & Saito 1980; Mathews et al. 1991)",
    "ocean": "the same, with the products of inertia of an ocean in equilibrium",
    "anelastic": "the same, with a complex shear modulus (Wahr & Bergen 1986; Smith & Dahlen 1981)",
}


def rigid_period(h: Numeric) -> Numeric:
    """Wobble period of a rigid axisymmetric body, in rotations: A/(C - A) (I.6.7)."""
    return np.abs(quotient(1.0, ellipticity_from_h(h)))


def triaxial_period(h: Numeric, j2: Numeric, triaxiality: Numeric) -> Numeric:
    """Wobble period of a rigid triaxial body, in rotations, for small wobbles.

    sqrt(A B/((C - A)(C - B))), linearised Euler equations (I.4.4), from differences only.

    Parameters
    ----------
    h : float
        (C - (A + B)/2)/C.
    j2 : float
        (C - (A + B)/2)/(M a2).
    triaxiality : float
        (B - A)/(M a2).

    Raises
    ------
    UndefinedError
        If the polar moment does not follow from J2 and H, or is not an extreme one.
    """
    if not np.any(triaxiality):
        return rigid_period(h)
    if np.any(np.equal(h, 0)):
        raise UndefinedError(
            "with H = 0 the polar moment does not follow from J2; set triaxiality to 0"
        )
    e = ellipticity_from_h(h)
    mean_equatorial = polar_moment_factor(j2, h) - j2
    asymmetry = triaxiality / mean_equatorial / 2
    if np.any(abs(asymmetry) > abs(e)):
        raise UndefinedError(
            "the spin axis is the middle one of the three principal axes: it is not stable, "
            "so there is no wobble about it"
        )
    return np.sqrt(quotient(1 - asymmetry**2, (e - asymmetry) * (e + asymmetry)))


def rigid_periods(
    flattening: Numeric, h: Numeric, j2: Numeric, triaxiality: Numeric
) -> dict[str, Numeric]:
    """Wobble periods, in rotations, from the three rigid models of the ladder, by model name."""
    return {
        "flattening": quotient(1.0, flattening),  # MacCullagh's formula (I.9.52)
        "rigid": rigid_period(h),
        "triaxial": triaxial_period(h, j2, triaxiality),
    }


def factors(periods: Numeric) -> Numeric:
    """Ratio of each model's wobble period to the previous model's; 1 for the first model."""
    values = np.asarray(periods)
    below, above = values[:-1], values[1:]
    with np.errstate(invalid="ignore"):  # a sphere has every rung at infinity
        ratios = np.where(above == below, 1.0, above / below)
    return np.concatenate([np.ones_like(values[:1]), ratios])


# --- a body that yields ----------------------------------------------------------------------


@dataclass(frozen=True)
class Inputs:
    """Parameters of figure and interior for the non-rigid models; floats or arrays of one shape.

    Attributes
    ----------
    dynamical_flattening, j2, triaxiality : float
        As of a body.
    k2 : float
        Elastic Love number, for a sphere of the radius of `love_radius`.
    core_fraction : float
        A_f/A.
    core_ellipticity : float
        (C_f - A_f)/A_f.
    ocean : float
        Love number that the ocean adds, the mean over the meridians.
    anelastic_exponent : float
        Exponent of the period in the dissipation of the mantle.
    """

    dynamical_flattening: Numeric
    j2: Numeric
    triaxiality: Numeric
    k2: Numeric
    core_fraction: Numeric
    core_ellipticity: Numeric
    ocean: Numeric = 0.0
    anelastic_exponent: Numeric = ANELASTIC_EXPONENT.value


@dataclass(frozen=True)
class Rotator:
    """GM, equatorial radius and rotation period of a body, in SI units.

    Attributes
    ----------
    gm : float
        m3 s-2.
    radius : float
        Equatorial radius, m.
    period : float
        Period of one rotation, s.
    """

    gm: Numeric
    radius: Numeric
    period: Numeric

    def centrifugal(self, love_radius: Numeric) -> Numeric:
        """Product of inertia over M a2 per radian of wobble if k2 is 1: Omega2 R5/(3 G M a2)."""
        rate = 2 * np.pi / self.period
        return rate**2 * love_radius**5 / (3 * self.gm * self.radius**2)


def roots(
    inputs: Inputs,
    unit: Numeric,
    compliance: tuple[Numeric, Numeric, Numeric, Numeric],
    ocean: Array | None = None,
) -> Roots:
    """Compute wobble and core nutation frequencies from figure, core and compliances.

    Parameters
    ----------
    inputs : Inputs
    unit : float
        Omega2 R5/(3 G A).
    compliance : tuple of float or complex
        k2, and in the same unit: of the core alone, of the whole body under the core's
        pressure, of the core under its own (`DegreeTwoLoveNumbers`).
    ocean : array, shape (..., 2, 2), optional
        Products of inertia over A per radian of wobble, symmetric.
    """
    k, core_k, k_pressure, core_k_pressure = compliance
    moment = polar_moment_factor(inputs.j2, inputs.dynamical_flattening) - inputs.j2
    mantle = Mantle(
        ellipticity=ellipticity_from_h(inputs.dynamical_flattening),
        equatorial_ellipticity=inputs.triaxiality / moment / 2,
        kappa=unit * k,
        ocean=ocean,
    )
    has_core = np.not_equal(inputs.core_fraction, 0)
    fraction = np.where(has_core, inputs.core_fraction, 1.0)
    core = FluidCore(
        fraction=inputs.core_fraction,
        ellipticity=inputs.core_ellipticity,
        gamma=unit * core_k / fraction,
        beta=unit * core_k_pressure / fraction,
        xi=np.where(has_core, unit * k_pressure, 0.0),
    )
    return solve(mantle, core)


@dataclass(frozen=True)
class Ladder:
    """Wobble periods, quality factors and core nutation periods from the non-rigid models.

    Attributes
    ----------
    rotations : dict of str to array
        Wobble period of each rung in rotations of the body.
    quality_factor : dict of str to array
        Infinite where nothing is lost.
    core_rotations : dict of str to array
        Free core nutation among the stars, of each rung that has a core.
    left_out : dict of str to str
        Why the other rungs are missing.
    """

    rotations: dict[str, Array]
    quality_factor: dict[str, Array]
    core_rotations: dict[str, Array]
    left_out: dict[str, str]


def inputs_of(
    interior: Interior, body: Rotator, figure: Mapping[str, Numeric], ocean: str = "real"
) -> Inputs:
    """Collect the inputs of the non-rigid models: the figure of a body, its interior and ocean.

    Parameters
    ----------
    interior : Interior
    body : Rotator
    figure : mapping
        `dynamical_flattening`, `j2` and `triaxiality`.
    ocean : str
        ``"real"`` as published, ``"global"`` all over, ``"none"``.
    """
    k2, fraction, e_f = interior.values()
    if e_f is None:
        assert interior.layers is not None
        e_f = hydrostatic_core(interior.layers, 2 * np.pi / body.period)
    if ocean == "global" and interior.ocean is not None and interior.layers is not None:
        ocean_k2 = global_ocean(interior.layers)
    elif ocean == "real" and interior.ocean is not None:
        mean = (interior.ocean[0][0] + interior.ocean[1][1]) / 2
        ocean_k2 = mean / body.centrifugal(love_radius(interior, body))
    else:
        ocean_k2 = 0.0
    return Inputs(**figure, k2=k2, core_fraction=fraction, core_ellipticity=e_f, ocean=ocean_k2)


def love_radius(interior: Interior, body: Rotator) -> Numeric:
    """Reference radius of k2, m: outer radius of the layered model, else equatorial radius."""
    return body.radius if interior.layers is None else interior.layers.radius


def non_rigid(inputs: Inputs, body: Rotator, interior: Interior, ocean: str = "real") -> Ladder:
    """Compute wobble periods and quality factors from all non-rigid models that an interior allows.

    Parameters
    ----------
    inputs : Inputs
        Floats or arrays.
    body : Rotator
    interior : Interior
    ocean : str
        See `inputs_of`; the response of the real ocean is scaled to `inputs.ocean`.

    Returns
    -------
    Ladder
        Of the rungs ``elastic`` to ``anelastic`` that the interior has.

    Raises
    ------
    UndefinedError
        If the body yields by more than its bulge.
    """
    moment = polar_moment_factor(inputs.j2, inputs.dynamical_flattening) - inputs.j2
    unit = body.centrifugal(love_radius(interior, body)) / moment
    compliance = _compliance(interior, inputs)
    deformation = unit * (inputs.k2 + inputs.ocean)
    if np.any(deformation >= ellipticity_from_h(inputs.dynamical_flattening)):
        raise UndefinedError(
            f"interior '{interior.name}' yields by more than the body's bulge: it would not "
            "wobble forwards; take a body with a larger H, or set its interior to 'none'"
        )
    water = _ocean_products(interior, inputs, unit, ocean)
    models = {
        "elastic": roots(replace(inputs, core_fraction=0.0), unit, compliance),
        "fluid-core": roots(inputs, unit, compliance),
    }
    left_out = {}
    if water is None:
        left_out["ocean"] = f"interior '{interior.name}' has no ocean"
    else:
        models["ocean"] = roots(inputs, unit, compliance, water)
    if interior.layers is None:
        left_out["anelastic"] = (
            f"interior '{interior.name}' has no layers; its k2, as observed, has anelasticity in it"
        )
    else:
        elastic_period = list(models.values())[-1].rotations
        models["anelastic"] = _softened(inputs, body, interior, unit, water, elastic_period)
    return Ladder(
        rotations={name: root.rotations for name, root in models.items()},
        quality_factor={name: root.quality_factor for name, root in models.items()},
        core_rotations={
            name: root.core_rotations for name, root in models.items() if name != "elastic"
        },
        left_out=left_out,
    )


def _softened(
    inputs: Inputs, body: Rotator, interior: Interior, unit: Numeric, water: Any, period: Array
) -> Roots:
    """Compute the wobble of the anelastic model by iteration, as rigidity depends on the period."""
    assert interior.layers is not None
    compliance = _compliance(interior, inputs)
    for _ in range(3):  # each pass shrinks the error by a factor of a thousand
        mu_change = shear_modulus_change(period * abs(body.period), inputs.anelastic_exponent)
        softened = tuple(
            value * ratio(mu_change)
            for value, ratio in zip(compliance, softening(interior.layers), strict=True)
        )
        root = roots(inputs, unit, softened, water)
        period = root.rotations
    return root


def _compliance(interior: Interior, inputs: Inputs) -> tuple[Numeric, ...]:
    """Love numbers k of body and core, for tides and for core pressure, scaled to the given k2."""
    if interior.layers is None:
        return inputs.k2, 0.0, 0.0, 0.0
    love = elastic(interior.layers)
    scale = inputs.k2 / float(love.k)
    return tuple(
        scale * float(v) for v in (love.k, love.core_k, love.k_pressure, love.core_k_pressure)
    )


def _ocean_products(interior: Interior, inputs: Inputs, unit: Numeric, ocean: str) -> Array | None:
    """Products of inertia of the ocean per radian of wobble, over A, (..., 2, 2), or None."""
    if interior.ocean is None or ocean == "none":
        return None
    matrix = np.eye(2)
    if ocean == "real":
        matrix = np.asarray(interior.ocean)
        matrix = matrix / np.trace(matrix) * 2
    return np.asarray(inputs.ocean * unit)[..., None, None] * matrix
