"""What came of the accuracy that was asked for: asked, estimated, chosen, or refused."""

from __future__ import annotations

from typing import TYPE_CHECKING

from earthspin.engine.labels import Schema, Variable, build, from_si, si

if TYPE_CHECKING:
    import xarray as xr

#: Of what is asked for, what is given to the method, so that a result never claims more than asked.
MARGIN = 0.99


def promise(unit: str, of: str) -> Schema:
    """Declare the report on an accuracy.

    Parameters
    ----------
    unit, of : str
        Of the error, and what it is the error of.
    """
    return {
        "error_asked": Variable((), unit, f"error asked for, {of}"),
        "error_estimated": Variable((), unit, f"error estimated, at its largest, {of}"),
        "method_chosen": Variable((), "", "method and settings chosen for it"),
        "evaluations": Variable((), "1", "evaluations of the sky, or of terms of nutation"),
    }


def report(
    schema: Schema, asked: float | None, estimated: float, method: str, evaluations: int
) -> xr.Dataset:
    """Label what was asked and what is estimated, both SI."""
    values = {
        "error_asked": asked,
        "error_estimated": estimated,
        "method_chosen": method,
        "evaluations": evaluations,
    }
    result = build(schema, values)
    # as it was asked for: 1 arcsec is 1e6 uas, not a rounding less
    result["error_asked"].values[...] = float(f"{float(result.error_asked):.14g}")
    return result


def report_of(schema: Schema, asked: float | None, error: xr.DataArray) -> xr.Dataset:
    """Label what was asked and the largest error of a series, which names its method."""
    by = error.attrs
    return report(schema, asked, float(si(error).max()), by["method"], by["evaluations"])


def closed_form(
    schema: Schema, asked: float | None, bound: float, method: str, evaluations: int
) -> xr.Dataset:
    """Label the accuracy of a method without settings, or refuse.

    Raises
    ------
    AccuracyError
        If more is asked than a float carries.
    """
    refuse_unkept(asked, bound, "1", "no float of 64 bits carries more; ask for less")
    return report(schema, asked, bound, method, evaluations)


def refuse_unkept(asked: float | None, best: float, unit: str, remedy: str) -> None:
    """Refuse an accuracy that is not kept, but for what a change of units rounds away.

    Parameters
    ----------
    asked, best : float
        SI: rad, or relative.
    unit : str
        In which both are shown.
    remedy : str

    Raises
    ------
    AccuracyError
    """
    from earthspin.errors import AccuracyError

    if asked is not None and not best <= asked * (1 + 1e-12):
        factor = from_si(unit)
        raise AccuracyError(
            asked * factor, best * factor, "(relative)" if unit == "1" else unit, remedy
        )
