"""Errors of non-rigid wobble periods from random inputs, and derivatives of the periods.

The same draws of the inputs are used for every body, so that the error of a body does not depend
on the other bodies of the computation. The periods are interpolated by a parabola in each normally
distributed input and by a polynomial in the exponent, which is uniformly distributed.
`tests/wobble/test_propagation.py` compares the interpolation with the computation of every draw.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace

import numpy as np

from earthspin.constants import DAY, NORMAL_95
from earthspin.interior.named import EXPONENT_RANGE, Interior
from earthspin.numerics.arrays import Array, Numeric
from earthspin.numerics.varied_inputs import half_width, one_at_a_time
from earthspin.wobble.ladder import Inputs, Rotator, non_rigid

#: How often the inputs of each body are drawn, and from which seed.
DRAWS, SEED = 1000, 1

#: Bodies whose draws are held at once: memory does not grow with their number.
_BODIES_AT_ONCE = 256

#: Input that is evenly distributed, over the range of published work.
EXPONENT = "anelastic_exponent"

#: Nodes of the polynomial in the exponent.
_EXPONENTS = 5


def draw(uncertainty: Mapping[str, float]) -> dict[str, Array]:
    """Draw random values of the inputs from their uncertainties; all bodies use the same values.

    Parameters
    ----------
    uncertainty : mapping
        One standard deviation over value, by name of the input; others are not drawn.

    Returns
    -------
    dict of str to array, shape (DRAWS,)
        Deviations of each normal input with an uncertainty, in standard deviations from the mean;
        values of the anelastic exponent, evenly distributed over the range of published work.
    """
    generator = np.random.default_rng(SEED)
    # drawn for each input, so that none shifts the others
    names = [field.name for field in fields(Inputs) if field.name != EXPONENT]
    normal = {name: generator.standard_normal(DRAWS) for name in names}
    samples = {name: values for name, values in normal.items() if uncertainty.get(name, 0.0)}
    return samples | {EXPONENT: generator.uniform(*EXPONENT_RANGE, DRAWS)}


def sampled_half_widths(
    inputs: Inputs,
    uncertainty: Mapping[str, float],
    body: Rotator,
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
    body, interior, ocean
        As for `non_rigid`.
    """
    samples = draw(uncertainty)
    columns = [getattr(record, item.name) for record in (inputs, body) for item in fields(record)]
    values = np.broadcast_arrays(*columns)
    shape, flat = values[0].shape, [np.ravel(v) for v in values]
    count = len(fields(Inputs))
    widths: dict[str, list[Array]] = {}
    for start in range(0, flat[0].size, _BODIES_AT_ONCE):
        block = [v[start : start + _BODIES_AT_ONCE] for v in flat]
        block_inputs, block_body = Inputs(*block[:count]), Rotator(*block[count:])
        changes = _sampled(block_inputs, uncertainty, samples, block_body, interior, ocean)
        for name, change in changes.items():
            # the period is not in the middle of the draws, nor its exponent in that of its range
            widths.setdefault(name, []).append(half_width(change, axis=-1))
    return {name: np.concatenate(parts).reshape(shape) for name, parts in widths.items()}


def _sampled(
    inputs: Inputs,
    uncertainty: Mapping[str, float],
    samples: Mapping[str, Array],
    body: Rotator,
    interior: Interior,
    ocean: str,
) -> dict[str, Array]:
    """Changes of the wobble period, in rotations, due to random inputs, by model name.

    The shape is (bodies, draws). The period is interpolated quadratically.
    """
    # Chebyshev nodes over the published range of the anelastic exponent
    low, high = EXPONENT_RANGE
    nodes = (low + high) / 2 + (high - low) / 2 * np.polynomial.chebyshev.chebpts1(_EXPONENTS)
    cases = list(one_at_a_time(samples, {EXPONENT: nodes}))
    values = {name: np.tile(getattr(inputs, name), (1 + len(cases), 1)) for name in samples}
    for row, (name, node, _) in enumerate(cases, start=1):
        factor = 1 + node * uncertainty.get(name, 0.0)
        values[name][row] = node if name == EXPONENT else factor * values[name][row]
    sampled = {}
    models = non_rigid(replace(inputs, **values), body, interior, ocean)
    for name, rotations in models.rotations.items():
        # a model that depends on none of the changed inputs has a single row
        rows = np.broadcast_to(rotations, (1 + len(cases), inputs.k2.size))
        changes = zip(rows[1:] - rows[0], cases, strict=True)
        sampled[name] = sum(change[:, None] * weight for change, (_, _, weight) in changes)
    return sampled


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
    for name, value in vars(inputs).items():
        widths[name] = NORMAL_95 * uncertainty.get(name, 0.0) * abs(np.asarray(value))
    return widths | ({EXPONENT: np.asarray((high - low) / 2)} if anelastic else {})


def core_nutation_half_width(
    inputs: Inputs,
    uncertainty: Mapping[str, float],
    body: Rotator,
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
    body, interior, ocean
        As for `non_rigid`.
    """

    def period(name: str, width: float) -> Numeric:
        changed = replace(inputs, **{name: (1 + width) * getattr(inputs, name)})
        return non_rigid(changed, body, interior, ocean).core_rotations["fluid-core"]

    widths = {name: NORMAL_95 * uncertainty.get(name, 0.0) for name in vars(inputs)}
    squares = [(period(n, w) - period(n, -w)) ** 2 / 4 for n, w in widths.items() if w]
    return np.sqrt(np.sum(squares, axis=0))


def sensitivities(
    inputs: Inputs, body: Rotator, interior: Interior, ocean: str = "real"
) -> dict[str, Numeric]:
    """Derivatives of the most detailed model's wobble period by the inputs, d per unit of input.

    Parameters
    ----------
    inputs : Inputs
        Floats.
    body : Rotator
    interior : Interior
    ocean : str
    """

    def last_period(changed: Inputs) -> Numeric:
        return list(non_rigid(changed, body, interior, ocean).rotations.values())[-1]

    derivatives = {}
    for name, value in vars(inputs).items():
        step = 1e-3 * np.where(np.equal(value, 0), 1.0, value)
        difference = last_period(replace(inputs, **{name: value + step})) - last_period(
            replace(inputs, **{name: value - step})
        )
        derivatives[name] = difference / (2 * step) * abs(body.period) / DAY
    return derivatives
