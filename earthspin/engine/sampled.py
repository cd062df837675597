"""An answer whose linear errors stand beside those of a sample of the bodies' numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from earthspin.engine.ensemble import Ensemble
from earthspin.engine.given import MEMBER
from earthspin.engine.members import Members
from earthspin.engine.question import Question

if TYPE_CHECKING:
    import xarray as xr

#: How many members are drawn if nothing says it.
MEMBERS = 1000
#: Ends of the central 95 %.
_ENDS = (0.025, 0.975)


def with_sample(question: Question, answer: xr.Dataset) -> xr.Dataset:
    """Give beside each linear error of an answer that of a sample.

    Parameters
    ----------
    question : Question
        With ``uncertainty = "sample"``.
    answer : Dataset

    Returns
    -------
    Dataset
        The answer; for each ``<name>_error`` there is ``<name>_error_sampled``, the half-width of
        the central 95 % of the members, whose attributes say how far the linear error of the same
        numbers is from it, at most, and by how much the middle of the sample is off.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.
    """
    plain = question.replace(uncertainty=None, n=None)
    count = MEMBERS if question.n is None else question.n
    sample = Ensemble(plain.replace(members=Members(n=count, published=True))).hold()
    beside: dict[str, Any] = {}
    for name in map(str, answer.data_vars):
        linear = answer.get(f"{name}_error_input", answer.get(f"{name}_error"))
        if linear is None or answer[name].dtype.kind != "f" or linear.dims != answer[name].dims:
            continue
        values = sample[name]
        if MEMBER not in values.dims:
            width, shift = np.zeros(answer[name].shape), 0.0
        else:
            low, middle, high = np.quantile(values.values, (_ENDS[0], 0.5, _ENDS[1]), axis=0)
            width = (high - low) / 2
            shift = float(np.max(np.abs(middle - answer[name].values)))
        units = answer[name].attrs.get("units", "1")
        difference = float(np.max(np.abs(linear.values - width), initial=0.0))
        attrs = {
            "long_name": f"95 % half-width of the {answer[name].attrs['long_name']} from "
            f"{count} members",
            "units": units,
            "members": count,
            "difference_from_linear": f"{difference:.3g} {units} at most from {linear.name}",
            "middle_of_the_sample": f"{shift:.3g} {units} at most from {name}",
        }
        beside[f"{name}_error_sampled"] = (answer[name].dims, width, attrs)
    inputs = ", ".join(str(c.attrs["input"]) for c in sample.coords.values() if "input" in c.attrs)
    summary = {"sampled": f"{count} members in {inputs}"}
    return answer.assign(beside).assign_attrs(summary)
