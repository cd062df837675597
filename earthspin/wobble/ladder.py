"""The free wobble of a body, rung by rung, from a formula of flattening to a body that yields.

Each rung gives the period in turns of the body. The rungs are factors, not steps of
days: they do not commute, the liquid core takes 34 days from a rigid mantle and 51 from
an elastic one. Their order is part of the answer.

Rungs from `elastic` on are roots of one linear system, Liouville's equation of the whole
body and Sasao's of its core (Sasao, Okubo & Saito 1980, IAU Symp. 78, 165; Mathews,
Buffett, Herring & Shapiro 1991, JGR 96, 8219), in units of the spin:

    d/dt (T m + K m + X n) = J (E m - K m - X n)
    d/dt ((1 + gamma) m + (1 + beta) n) = -(1 + e_f) J n

m is the wobble of the mantle, n of the core relative to it, J a quarter turn, T and E the
moments and their differences (three axes), K what the body's products of inertia answer
to a wobble, X = A_f/A + xi the core's share. Its two roots are the wobble and the free
core nutation. Without three axes and ocean it is
[s - e + (1+s) kappa][1 + s (1+beta) + e_f] = (1+s) X s (1+gamma).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAY
from earthspin.errors import UndefinedError
from earthspin.interior.equilibrium import hydrostatic_core
from earthspin.interior.love import elastic, softening
from earthspin.interior.named import ANELASTIC_EXPONENT, Interior
from earthspin.interior.ocean import global_ocean
from earthspin.mass.inertia import ellipticity_from_h, polar_moment_factor

Numeric = Any
Array = NDArray[Any]

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

#: How often inputs are drawn; draws times bodies are kept below the last, for memory.
FEWEST_DRAWS, DRAWS, MOST_DRAWS = 100, 1000, 100_000

#: Period up to which the quality factor does not depend on frequency, s.
ABSORPTION_BAND = 200.0


def turns_from_flattening(flattening: Numeric) -> Numeric:
    """Turns per wobble if the flattening stood for (C - A)/A, McCullough's formula (I.9.52)."""
    return _over(1.0, flattening)


def turns_rigid(h: Numeric) -> Numeric:
    """Turns per wobble of a rigid axisymmetric body, A/(C - A) (I.6.7)."""
    return np.abs(_over(1.0, ellipticity_from_h(h)))


def turns_triaxial(h: Numeric, j2: Numeric, triaxiality: Numeric) -> Numeric:
    """Turns per wobble of a rigid triaxial body at small amplitude.

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
        return turns_rigid(h)
    if np.any(np.equal(h, 0)):
        raise UndefinedError(
            "with H = 0 the polar moment does not follow from J2; set triaxiality to 0"
        )
    e = ellipticity_from_h(h)
    mean_equatorial = polar_moment_factor(j2, h) - j2
    half = triaxiality / mean_equatorial / 2
    if np.any(abs(half) > abs(e)):
        raise UndefinedError(
            "the spin axis is the middle one of the three principal axes: it is not stable, "
            "so there is no wobble about it"
        )
    return np.sqrt(_over(1 - half**2, (e - half) * (e + half)))


def rigid_turns(
    flattening: Numeric, h: Numeric, j2: Numeric, triaxiality: Numeric
) -> dict[str, Numeric]:
    """Turns per wobble on the rungs of a rigid body, by name; arguments as above."""
    return {
        "flattening": turns_from_flattening(flattening),
        "rigid": turns_rigid(h),
        "triaxial": turns_triaxial(h, j2, triaxiality),
    }


def factors(turns: Numeric) -> Numeric:
    """Each rung over the one before it; 1 for the first. Rungs along the first axis."""
    values = np.asarray(turns)
    below, above = values[:-1], values[1:]
    with np.errstate(invalid="ignore"):  # a sphere has every rung at infinity
        steps = np.where(above == below, 1.0, above / below)
    return np.concatenate([np.ones_like(values[:1]), steps])


def _over(numerator: Numeric, denominator: Numeric) -> Numeric:
    """Quotient that is infinite where the denominator vanishes: a sphere does not wobble."""
    with np.errstate(divide="ignore"):
        return np.divide(numerator, denominator)


# --- a body that yields ----------------------------------------------------------------------


@dataclass(frozen=True)
class Inputs:
    """The numbers that the upper rungs stand on; floats or arrays of one shape.

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
        Of the period, in the mantle's loss.
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
class Spin:
    """What scales the inputs: the body's pull, size and spin, in SI.

    Attributes
    ----------
    gm : float
        m3 s-2.
    radius : float
        Equatorial radius, m.
    period : float
        Of one turn, s.
    """

    gm: Numeric
    radius: Numeric
    period: Numeric

    def centrifugal(self, love_radius: Numeric) -> Numeric:
        """Omega2 R5/(3 G M a2): products of inertia over M a2 per radian and unit of k2."""
        rate = 2 * np.pi / self.period
        return rate**2 * love_radius**5 / (3 * self.gm * self.radius**2)


@dataclass(frozen=True)
class Roots:
    """Roots of the system of mantle and core.

    Attributes
    ----------
    wobble : complex array
        s, turns of the wobble per turn of the body; exp(i s Omega t), so Im s > 0 decays.
    core : complex array
        The same of the free core nutation, near -1.
    """

    wobble: Array
    core: Array

    @property
    def turns(self) -> Array:
        """Period of the wobble in turns."""
        return np.asarray(1 / self.wobble.real)

    @property
    def quality_factor(self) -> Array:
        """Re s/(2 Im s); infinite without loss."""
        loss = np.where(abs(self.wobble.imag) < 1e-12 * abs(self.wobble), 0.0, self.wobble.imag)
        return np.asarray(_over(self.wobble.real, 2 * loss))

    @property
    def core_turns_in_space(self) -> Array:
        """Period of the free core nutation among the stars in turns; negative: retrograde."""
        return np.asarray(1 / (1 + self.core.real))


def roots(
    inputs: Inputs,
    unit: Numeric,
    compliance: tuple[Numeric, Numeric, Numeric, Numeric],
    ocean: Array | None = None,
) -> Roots:
    """Solve the system of mantle and core.

    Parameters
    ----------
    inputs : Inputs
    unit : float
        Omega2 R5/(3 G A).
    compliance : tuple of float or complex
        k2, and in the same unit: of the core alone, of the whole body under the core's
        pressure, of the core under its own (`Yielding`).
    ocean : array, shape (..., 2, 2), optional
        Products of inertia over A per radian of wobble.
    """
    k, core_k, k_pressure, core_k_pressure = compliance
    e = ellipticity_from_h(inputs.dynamical_flattening)
    moment = polar_moment_factor(inputs.j2, inputs.dynamical_flattening) - inputs.j2
    half = inputs.triaxiality / moment / 2
    fraction = inputs.core_fraction
    has_core = np.not_equal(fraction, 0)
    share = np.where(has_core, fraction, 1.0)
    kappa, xi = unit * k, np.where(has_core, unit * k_pressure, 0.0)
    gamma, beta = unit * core_k / share, unit * core_k_pressure / share
    x = fraction + xi
    answer = _system(e, half, kappa, ocean)
    m, n = answer
    shape = np.broadcast_shapes(m.shape[:-2], *(np.shape(v) for v in (x, gamma, beta)))
    left = np.zeros((*shape, 4, 4), dtype=complex)
    right = np.zeros_like(left)
    left[..., :2, :2], right[..., :2, :2] = m, n
    for i in (0, 1):
        left[..., i, 2 + i], left[..., 2 + i, i], left[..., 2 + i, 2 + i] = x, 1 + gamma, 1 + beta
    right[..., 0, 3], right[..., 1, 2] = x, -x
    right[..., 2, 3], right[..., 3, 2] = 1 + inputs.core_ellipticity, -1 - inputs.core_ellipticity
    s = np.linalg.eigvals(np.linalg.solve(left, right)) / 1j
    return Roots(wobble=_pick(s, np.where(s.real > 0, abs(s), np.inf)), core=_pick(s, abs(s + 1)))


def _system(e: Numeric, half: Numeric, kappa: Numeric, ocean: Array | None) -> tuple[Array, Array]:
    """The mantle's block on either side: T + K and J (E - K)."""
    e, half, kappa = np.broadcast_arrays(e, half, kappa)
    answers = np.zeros((*e.shape, 2, 2), dtype=complex)
    moments, differences = np.zeros_like(answers), np.zeros_like(answers)
    for i, sign in ((0, -1.0), (1, 1.0)):
        answers[..., i, i] = kappa
        moments[..., i, i] = 1 + sign * half
        differences[..., i, i] = e - sign * half
    if ocean is not None:
        answers = answers + ocean
        moments, differences = np.broadcast_arrays(moments, differences, answers)[:2]
    quarter = np.array([[0.0, -1.0], [1.0, 0.0]])
    return moments + answers, quarter @ (differences - answers)


def _pick(s: Array, badness: Array) -> Array:
    """The root of least badness."""
    return np.take_along_axis(s, np.argmin(badness, axis=-1)[..., None], axis=-1)[..., 0]


def anelastic_strain(period: Numeric, exponent: Numeric) -> Numeric:
    """Relative change of the shear modulus at quality factor 1, from 1 s to a long period.

    Up to 200 s the loss does not depend on the period, beyond it grows with its power:

        -(2/pi) ln(200) + cot(alpha pi/2) (1 - (P/200 s)^alpha) + i (P/200 s)^alpha

    (Liu, Anderson & Kanamori 1976, Geophys. J. R. astr. Soc. 47, 41; Smith & Dahlen 1981;
    Wahr & Bergen 1986, Geophys. J. R. astr. Soc. 87, 633), for exp(+i omega t). Seismic
    moduli stand at 1 s. As alpha tends to 0 the second term becomes -(2/pi) ln(P/200 s).

    Parameters
    ----------
    period : float
        s, 200 or more.
    exponent : float
        alpha, zero or more.
    """
    log = np.log(np.asarray(period) / ABSORPTION_BAND)
    grown = np.exp(exponent * log)
    # cot(alpha pi/2) (1 - x^alpha), of which both factors fail at alpha = 0.
    angle = np.asarray(exponent) * np.pi / 2
    growth = np.where(angle == 0, log, _expm1_over(exponent, log))
    cosine = np.cos(angle) / np.sinc(angle / np.pi)
    return -2 / np.pi * (np.log(ABSORPTION_BAND) + cosine * growth) + 1j * grown


def _expm1_over(exponent: Numeric, log: Numeric) -> Numeric:
    """(x^alpha - 1)/alpha with a harmless alpha in the place of 0."""
    safe = np.where(np.equal(exponent, 0), 1.0, exponent)
    return np.expm1(safe * log) / safe


@dataclass(frozen=True)
class Ladder:
    """The rungs that a body has.

    Attributes
    ----------
    turns : dict of str to array
        Period of each rung in turns of the body.
    quality_factor : dict of str to array
        Infinite where nothing is lost.
    core_turns : dict of str to array
        Free core nutation among the stars, of each rung that has a core.
    left_out : dict of str to str
        Why the other rungs are missing.
    """

    turns: dict[str, Array]
    quality_factor: dict[str, Array]
    core_turns: dict[str, Array]
    left_out: dict[str, str]


def inputs_of(
    interior: Interior,
    spin: Spin,
    figure: Mapping[str, Numeric],
    ocean: str = "real",
    exponent: Numeric = ANELASTIC_EXPONENT.value,
) -> Inputs:
    """Collect the inputs of the upper rungs from an interior.

    Parameters
    ----------
    interior : Interior
    spin : Spin
    figure : mapping
        `dynamical_flattening`, `j2` and `triaxiality`.
    ocean : str
        ``"real"`` as published, ``"global"`` all over, ``"none"``.
    exponent : float
        Of the mantle's loss.
    """
    k2, fraction, flat = interior.values()
    if flat is None:
        assert interior.layers is not None
        flat = hydrostatic_core(interior.layers, 2 * np.pi / spin.period)
    if ocean == "global" and interior.ocean is not None and interior.layers is not None:
        added = global_ocean(interior.layers)
    elif ocean == "real" and interior.ocean is not None:
        mean = (interior.ocean[0][0] + interior.ocean[1][1]) / 2
        added = mean / spin.centrifugal(love_radius(interior, spin))
    else:
        added = 0.0
    return Inputs(
        **figure,
        k2=k2,
        core_fraction=fraction,
        core_ellipticity=flat,
        ocean=added,
        anelastic_exponent=exponent,
    )


def love_radius(interior: Interior, spin: Spin) -> Numeric:
    """Radius that k2 refers to: that of the layered sphere, else the equatorial one, m."""
    return spin.radius if interior.layers is None else interior.layers.radius


def climb(inputs: Inputs, spin: Spin, interior: Interior, ocean: str = "real") -> Ladder:
    """Climb the rungs above the rigid ones.

    Parameters
    ----------
    inputs : Inputs
        Floats or arrays.
    spin : Spin
    interior : Interior
    ocean : str
        As of `inputs_of`; the shape of the real ocean's response is kept and its size set
        by `inputs.ocean`.

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
    unit = spin.centrifugal(love_radius(interior, spin)) / moment
    compliance = _compliance(interior, inputs)
    if np.any(unit * inputs.k2 >= ellipticity_from_h(inputs.dynamical_flattening)):
        raise UndefinedError(
            f"interior '{interior.name}' yields by more than the body's bulge: it would not "
            "wobble forwards; take a body with a larger H, or set its interior to 'none'"
        )
    water = _water(interior, inputs, unit, ocean)
    found = {
        "elastic": roots(replace(inputs, core_fraction=0.0), unit, compliance),
        "fluid-core": roots(inputs, unit, compliance),
    }
    left_out = {}
    if water is None:
        left_out["ocean"] = f"interior '{interior.name}' has no ocean"
    else:
        found["ocean"] = roots(inputs, unit, compliance, water)
    if interior.layers is None:
        left_out["anelastic"] = (
            f"interior '{interior.name}' has no layers; its k2, as observed, has anelasticity in it"
        )
    else:
        elastic_turns = list(found.values())[-1].turns
        found["anelastic"] = _soften(inputs, spin, interior, unit, water, elastic_turns)
    return Ladder(
        turns={name: root.turns for name, root in found.items()},
        quality_factor={name: root.quality_factor for name, root in found.items()},
        core_turns={
            name: root.core_turns_in_space for name, root in found.items() if name != "elastic"
        },
        left_out=left_out,
    )


def _soften(
    inputs: Inputs, spin: Spin, interior: Interior, unit: Numeric, water: Any, turns: Array
) -> Roots:
    """The anelastic rung: the modulus depends on the period that it sets."""
    assert interior.layers is not None
    compliance = _compliance(interior, inputs)
    for _ in range(3):  # each pass shrinks the error by a factor of a thousand
        strain = anelastic_strain(turns * abs(spin.period), inputs.anelastic_exponent)
        softer = tuple(
            value * ratio(strain)
            for value, ratio in zip(compliance, softening(interior.layers), strict=True)
        )
        root = roots(inputs, unit, softer, water)
        turns = root.turns
    return root


def _compliance(interior: Interior, inputs: Inputs) -> tuple[Numeric, ...]:
    """k2 and its three companions, all scaled with the given k2."""
    if interior.layers is None:
        return inputs.k2, 0.0, 0.0, 0.0
    love = elastic(interior.layers)
    scale = inputs.k2 / float(love.k)
    return tuple(
        scale * float(v) for v in (love.k, love.core_k, love.k_pressure, love.core_k_pressure)
    )


def _water(interior: Interior, inputs: Inputs, unit: Numeric, ocean: str) -> Array | None:
    """The ocean's response over A, shape (..., 2, 2)."""
    if interior.ocean is None or ocean == "none":
        return None
    shape = np.eye(2)
    if ocean == "real":
        shape = np.asarray(interior.ocean)
        shape = shape / np.trace(shape) * 2
    return np.asarray(inputs.ocean * unit)[..., None, None] * shape


# --- what the rungs depend on ----------------------------------------------------------------

#: Range of the exponent that published work allows (Smith & Dahlen 1981).
EXPONENT_RANGE = (0.04, 0.19)


def draw(inputs: Inputs, uncertainty: Mapping[str, float], draws: int, seed: int = 1) -> Inputs:
    """Inputs at random within their uncertainties, along a new first axis.

    Normal, save the anelastic exponent: that is even over the range of published work.

    Parameters
    ----------
    inputs : Inputs
    uncertainty : mapping
        One standard deviation over value, by name of the input.
    draws : int
    seed : int
    """
    generator = np.random.default_rng(seed)
    names = [f.name for f in fields(Inputs)]
    values = np.broadcast_arrays(*(getattr(inputs, name) for name in names))
    changed: dict[str, Array] = {}
    for name, value in zip(names, values, strict=True):
        size = (draws,) + (1,) * value.ndim
        if name == "anelastic_exponent":
            changed[name] = generator.uniform(*EXPONENT_RANGE, size)
        else:
            spread = uncertainty.get(name, 0.0) * generator.standard_normal(size)
            changed[name] = value * (1 + spread)
    return Inputs(**changed)


def sampled_half_widths(
    inputs: Inputs,
    uncertainty: Mapping[str, float],
    spin: Spin,
    interior: Interior,
    ocean: str = "real",
) -> dict[str, Numeric]:
    """95 % half-widths of the turns on the upper rungs, by sampling the inputs.

    Parameters
    ----------
    inputs : Inputs
    uncertainty : mapping
        One standard deviation over value, by name of the input.
    spin, interior, ocean
        As for `climb`.
    """
    draws = max(FEWEST_DRAWS, min(DRAWS, MOST_DRAWS // np.asarray(spin.gm).size))
    sampled = climb(draw(inputs, uncertainty, draws), spin, interior, ocean)
    ends = {name: np.percentile(v, [2.5, 97.5], axis=0) for name, v in sampled.turns.items()}
    return {name: (high - low) / 2 for name, (low, high) in ends.items()}


def half_widths(
    inputs: Inputs, uncertainty: Mapping[str, float], anelastic: bool
) -> dict[str, Array]:
    """95 % half-widths of the inputs; that of the exponent is half the range of published work.

    Parameters
    ----------
    inputs : Inputs
    uncertainty : mapping
        One standard deviation over value, by name of the input.
    anelastic : bool
        Whether the ladder reaches the rung where the exponent matters.
    """
    low, high = EXPONENT_RANGE
    found = {
        one.name: 1.96 * uncertainty.get(one.name, 0.0) * abs(np.asarray(getattr(inputs, one.name)))
        for one in fields(Inputs)
    }
    return found | ({"anelastic_exponent": np.asarray((high - low) / 2)} if anelastic else {})


def sensitivities(
    inputs: Inputs, spin: Spin, interior: Interior, ocean: str = "real"
) -> dict[str, Numeric]:
    """Days of the last rung per unit of each input, by central differences.

    Parameters
    ----------
    inputs : Inputs
        Floats.
    spin : Spin
    interior : Interior
    ocean : str
    """

    def last(changed: Inputs) -> Numeric:
        return list(climb(changed, spin, interior, ocean).turns.values())[-1]

    found = {}
    for name in (f.name for f in fields(Inputs)):
        value = getattr(inputs, name)
        step = 1e-3 * np.where(np.equal(value, 0), 1.0, value)
        difference = last(replace(inputs, **{name: value + step})) - last(
            replace(inputs, **{name: value - step})
        )
        found[name] = difference / (2 * step) * abs(spin.period) / DAY
    return found
