"""Statistics of an ensemble: quantiles, and contribution of each input to the variance."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from earthspin.engine.members import MEMBER
from earthspin.errors import SceneError
from earthspin.numerics import sampling
from earthspin.units import real_numbers

_SHARE_ERROR = "95 % half-width, from the number of members, of the share of the variance"


def is_ensemble(answer: xr.Dataset | xr.DataTree) -> bool:
    """Return True if a result is an ensemble, that is, has the dimension `member`."""
    return MEMBER in answer.dims and any("input" in c.attrs for c in answer.coords.values())


def quantiles(answer: xr.Dataset, shares: Sequence[float] = (0.025, 0.5, 0.975)) -> xr.Dataset:
    """Return quantiles over the members of every result in an ensemble.

    Parameters
    ----------
    answer : Dataset
    shares : sequence of float

    Raises
    ------
    SceneError
        If the answer is not an ensemble, or a share is not between 0 and 1.
    """
    try:
        wanted = np.atleast_1d(real_numbers(shares))
    except Exception:  # somebody's class may raise anything
        wanted = np.empty(0)
    if not (wanted.ndim == 1 and wanted.size and ((wanted >= 0) & (wanted <= 1)).all()):
        raise SceneError("quantiles", shares, "give numbers between 0 and 1")
    variables = {}
    for name, array in _members(answer, "quantiles").items():
        values = sampling.quantiles(array.values.astype(float), wanted)
        variables[name] = (("quantile", *array.dims[1:]), values, array.attrs)
    attrs = {"long_name": "share of the members below", "units": "1"}
    labels = {"quantile": ("quantile", wanted, attrs)} | _other_labels(answer)
    return xr.Dataset(variables, labels, dict(answer.attrs))


def sensitivity(answer: xr.Dataset) -> xr.Dataset:
    """Compute how much each ensemble input contributes to the variance of each result.

    Users call it as ``ds.earthspin.sensitivity()``.

    An input that is a name, such as an orbit table, has no slope; its share is that of the variance
    between the means of the members with the same name (eta squared).

    Parameters
    ----------
    answer : Dataset

    Raises
    ------
    SceneError
        If the answer is not an ensemble, or has fewer members than `members_needed`.
    """
    outputs = {
        n: array for n, array in _members(answer, "sensitivity").items() if "_error" not in n
    }
    columns, count, needed = inputs_of(answer), answer.sizes[MEMBER], members_needed(answer)
    if count < needed:
        problem = f"{len(columns)} inputs need at least {needed} members"
        raise SceneError("sensitivity", f"{count} members", problem)
    classes = [array for array in columns.values() if array.dtype.kind == "U"]
    numbers = [array for array in columns.values() if array.dtype.kind != "U"]
    inputs = np.stack(numbers, axis=1) if numbers else np.empty((count, 0))
    no_slope = {"no_slope": "inputs that are names have no slope"} if classes else {}
    variables: dict[str, Any] = {}
    for name, array in outputs.items():
        shares = sampling.shares_of_variance(inputs, array.values.astype(float), classes)
        what, rest = array.attrs.get("long_name", name), array.dims[1:]
        slope_units = f"{array.attrs.get('units', '1')} per unit of the input"
        for ending, values, dims, meaning, units in (
            ("slope", shares.slope, ("input", *rest), "change per unit of the input", slope_units),
            ("share", shares.share, ("input", *rest), "share of the variance", "1"),
            ("share_error", shares.error, ("input", *rest), _SHARE_ERROR, "1"),
            ("unexplained", shares.unexplained, rest, "variance not explained by the fit", "1"),
        ):
            attrs = {"long_name": f"{meaning}, of the {what}", "units": units}
            attrs |= no_slope if ending == "slope" else {}
            variables[f"{name}_{ending}"] = (dims, values, attrs)
    labels = {"input": ("input", [*columns], {"long_name": "input of the members"})}
    return xr.Dataset(variables, labels | _other_labels(answer), dict(answer.attrs))


def inputs_of(answer: xr.Dataset) -> dict[str, NDArray[Any]]:
    """Input values of all members of an ensemble by input name; numbers come before names.

    An input of several numbers has one entry for each number.
    """
    inputs = [array for array in answer.coords.values() if "input" in array.attrs]
    numbers = {
        f"{array.attrs['input']}{'' if array.ndim == 1 else f'.{k}'}": column
        for array in inputs
        if array.dtype.kind in "fiu"
        for k, column in enumerate(array.values.reshape(array.sizes[MEMBER], -1).T)
    }
    texts = {str(array.attrs["input"]): array for array in inputs if array.dtype.kind not in "fiu"}
    return numbers | {name: array.values.astype(str) for name, array in texts.items()}


def members_needed(answer: xr.Dataset) -> int:
    """Smallest number of ensemble members from which `sensitivity` can be computed.

    It is 2, plus 1 for each input that is a number, plus k - 1 for each input with k names.
    """
    columns = inputs_of(answer).values()
    return 2 + sum(
        len(np.unique(column)) - 1 if column.dtype.kind == "U" else 1 for column in columns
    )


def _members(answer: xr.Dataset, what: str) -> dict[str, xr.DataArray]:
    """Select the numerical variables that differ between members, with `member` first."""
    if not is_ensemble(answer):
        problem = "it is not an ensemble; earthspin.ensemble makes one"
        raise SceneError(what, answer.attrs.get("title", "a Dataset"), problem)
    return {
        str(name): array.transpose(MEMBER, ...)
        for name, array in answer.data_vars.items()
        if MEMBER in array.dims and array.dtype.kind in "fiu"
    }


def _other_labels(answer: xr.Dataset) -> dict[Any, Any]:
    return {name: array for name, array in answer.coords.items() if MEMBER not in array.dims}
