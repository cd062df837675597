"""Errors of non-rigid wobble periods from random inputs, and derivatives of the periods.

The same draws of the inputs are used for every body, so that the error of a body does not depend
on the other bodies of the computation. The ladder is not computed for every draw: the periods are
interpolated by a parabola in each normally distributed input and by a polynomial in the exponent,
which is uniformly distributed. `tests/wobble/test_propagation.py` compares the interpolation with
the computation of every draw.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace

import numpy as np

from earthspin.constants import DAY, NORMAL_95
from earthspin.interior.named import EXPONENT_RANGE, Interior
from earthspin.numerics.arrays import Array, Numeric
from earthspin.numerics.polynomials import lagrange
from earthspin.wobble.ladder import Inputs, RotatingBody, non_rigid

#: How often the inputs of each body are drawn, and from which seed.
DRAWS, SEED = 1000, 1

#: Bodies whose draws are held at once: memory does not grow with their number.
_BODIES_AT_ONCE = 256

#: Where the parabola of a normal input is taken from, in standard deviations: the node of
#: Gauss's rule of three points, by which mean and variance of a parabola are exact.
_STEP = np.sqrt(3.0)

#: Nodes of the polynomial in the exponent.
_EXPONENTS = 5


def draw(
    uncertainty: Mapping[str, float], draws: int = DRAWS, seed: int = SEED
) -> tuple[dict[str, Array], Array]:
    """Draw random values of the inputs from their uncertainties; all bodies use the same values.

    Parameters
    ----------
    uncertainty : mapping
        One standard deviation over value, by name of the input; others are not drawn.
    draws : int
    seed : int

    Returns
    -------
    normal : dict of str to array, shape (draws,)
        Standard deviations from the mean, of each normal input with an uncertainty.
    exponent : array, shape (draws,)
        The anelastic exponent, even over the range of published work.
    """
    generator = np.random.default_rng(seed)
    normal, exponent = {}, np.empty(0)
    for name in (one.name for one in fields(Inputs)):
        if name == "anelastic_exponent":
            exponent = generator.uniform(*EXPONENT_RANGE, draws)
        else:
            drawn = generator.standard_normal(draws)  # for each, so that none shifts the others
            if uncertainty.get(name, 0.0):
                normal[name] = drawn
    return normal, exponent


def sampled_half_widths(
    inputs: Inputs,
    uncertainty: Mapping[str, float],
    body: RotatingBody,
    interior: Interior,
    ocean: str = "real",
) -> dict[str, Numeric]:
    """95 % half-widths of the wobble periods in rotations, from random values of the inputs.

    It is the change of the period that 95 % of the draws do not exceed.

    Parameters
    ----------
    inputs : Inputs
        Floats or arrays of one shape.
    uncertainty : mapping
        One standard deviation over value, by name of the input.
    spin, interior, ocean
        As for `non_rigid`.
    """
    drawn = draw(uncertainty)
    columns = [getattr(record, item.name) for record in (inputs, body) for item in fields(record)]
    values = np.broadcast_arrays(*columns)
    shape, flat = values[0].shape, [np.ravel(v) for v in values]
    inputs_count = len(fields(Inputs))
    widths: dict[str, list[Array]] = {}
    for start in range(0, flat[0].size, _BODIES_AT_ONCE):
        block = [v[start : start + _BODIES_AT_ONCE] for v in flat]
        block_inputs, block_body = (
            Inputs(*block[:inputs_count]),
            RotatingBody(*block[inputs_count:]),
        )
        changes = _sampled(block_inputs, uncertainty, drawn, block_body, interior, ocean)
        for name, change in changes.items():
            # the period is not in the middle of the draws, nor its exponent in that of its range
            widths.setdefault(name, []).append(np.quantile(np.abs(change), 0.95, axis=-1))
    return {name: np.concatenate(parts).reshape(shape) for name, parts in widths.items()}


def _sampled(
    inputs: Inputs,
    uncertainty: Mapping[str, float],
    drawn: tuple[dict[str, Array], Array],
    spin: RotatingBody,
    interior: Interior,
    ocean: str,
) -> dict[str, Array]:
    """Changes of the wobble period, in rotations, due to random inputs, by model name.

    The shape is (bodies, draws). The period is interpolated quadratically.
    """
    normal, exponent = drawn
    # Chebyshev nodes over the published range of the anelastic exponent
    low, high = EXPONENT_RANGE
    nodes = (low + high) / 2 + (high - low) / 2 * np.polynomial.chebyshev.chebpts1(_EXPONENTS)
    points = _points(inputs, list(normal), uncertainty, nodes)
    # basis[i] stands on the turns at points[i]: the mean, each input below and above, the nodes.
    basis = [-sum((z**2 / 3 for z in normal.values()), np.zeros(exponent.size))]
    for z in normal.values():
        basis += [z**2 / 6 - z / (2 * _STEP), z**2 / 6 + z / (2 * _STEP)]
    basis += list(lagrange(nodes, exponent))
    sampled = {}
    for name, turns in non_rigid(points, spin, interior, ocean).rotations.items():
        total = np.zeros((turns.shape[-1], exponent.size))
        # where no input of a rung is uncertain, nothing told its turns apart
        points_turns = np.broadcast_to(turns, (len(basis), total.shape[0]))
        for at, share in zip(points_turns, basis, strict=True):
            total += at[:, None] * share
        sampled[name] = total - points_turns[0][:, None]
    return sampled


def _points(
    inputs: Inputs, names: list[str], uncertainty: Mapping[str, float], exponents: Array
) -> Inputs:
    """Input values at which models are computed; wobble periods are interpolated between these."""
    count = 1 + 2 * len(names) + exponents.size
    exponent = np.concatenate(
        [
            np.broadcast_to(inputs.anelastic_exponent, (count - exponents.size, inputs.k2.size)),
            np.broadcast_to(exponents[:, None], (exponents.size, inputs.k2.size)),
        ]
    )
    changed = {}
    for i, name in enumerate(names):
        factor = np.ones((count, 1))
        factor[1 + 2 * i], factor[2 + 2 * i] = (1 + s * _STEP * uncertainty[name] for s in (-1, 1))
        changed[name] = getattr(inputs, name) * factor
    return replace(inputs, **changed, anelastic_exponent=exponent)


def half_widths(
    inputs: Inputs, uncertainty: Mapping[str, float], anelastic: bool
) -> dict[str, Array]:
    """95 % half-widths of all inputs by name; for the anelastic exponent, half its published range.

    Parameters
    ----------
    inputs : Inputs
    uncertainty : mapping
        One standard deviation over value, by name of the input.
    anelastic : bool
        Whether the ladder reaches the rung where the exponent matters.
    """
    low, high = EXPONENT_RANGE
    widths = {}
    for name in (item.name for item in fields(Inputs)):
        widths[name] = 1.96 * uncertainty.get(name, 0.0) * abs(np.asarray(getattr(inputs, name)))
    return widths | ({"anelastic_exponent": np.asarray((high - low) / 2)} if anelastic else {})


def core_nutation_half_width(
    inputs: Inputs,
    uncertainty: Mapping[str, float],
    body: RotatingBody,
    interior: Interior,
    ocean: str = "real",
) -> Numeric:
    """95 % half-width of the period of the free core nutation, in rotations of the body.

    Each uncertain input is changed up and down by its own half-width; the changes of the period
    are added in quadrature.

    Parameters
    ----------
    inputs : Inputs
        Floats or arrays of one shape.
    uncertainty : mapping
        One standard deviation over value, by name of the input.
    spin, interior, ocean
        As for `non_rigid`.
    """

    def period(name: str, half_width: float) -> Numeric:
        changed = replace(inputs, **{name: (1 + half_width) * getattr(inputs, name)})
        return non_rigid(changed, body, interior, ocean).core_rotations["fluid-core"]

    names = [item.name for item in fields(Inputs)]
    half_widths = {name: NORMAL_95 * uncertainty.get(name, 0.0) for name in names}
    squares = [
        (period(name, half_width) - period(name, -half_width)) ** 2 / 4
        for name, half_width in half_widths.items()
        if half_width
    ]
    return np.sqrt(np.sum(squares, axis=0))


def sensitivities(
    inputs: Inputs, body: RotatingBody, interior: Interior, ocean: str = "real"
) -> dict[str, Numeric]:
    """Derivatives of the most detailed model's wobble period by the inputs, d per unit of input.

    Parameters
    ----------
    inputs : Inputs
        Floats.
    body : RotatingBody
    interior : Interior
    ocean : str
    """

    def last_period(changed: Inputs) -> Numeric:
        return list(non_rigid(changed, body, interior, ocean).rotations.values())[-1]

    derivatives = {}
    for name in (f.name for f in fields(Inputs)):
        value = getattr(inputs, name)
        step = 1e-3 * np.where(np.equal(value, 0), 1.0, value)
        difference = last_period(replace(inputs, **{name: value + step})) - last_period(
            replace(inputs, **{name: value - step})
        )
        derivatives[name] = difference / (2 * step) * abs(body.period) / DAY
    return derivatives
