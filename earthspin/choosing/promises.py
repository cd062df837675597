"""Report on a requested accuracy: asked, estimated and the method chosen, or a refusal."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Self

from earthspin.engine.labels import from_si, si
from earthspin.engine.variables import Value, Variables, number, words
from earthspin.errors import AccuracyError

if TYPE_CHECKING:
    import xarray as xr

#: Of what is asked for, what is given to the method, so that a result never claims more than asked.
MARGIN = 0.99


class Report(Variables):
    """Accuracy: asked, estimated, and the method chosen.

    A class of it names the units of the error, and what it is the error of.
    """

    error_asked: Value = number("1", "error asked for")
    error_estimated: Value = number("1", "error estimated, at its largest")
    method_chosen: Value = words("method and settings chosen for it")
    evaluations: Value = number("1", "evaluations of the sky, or of terms of nutation")

    def __init_subclass__(cls, units: str, error_of: str) -> None:
        """Declare the report on one accuracy."""
        super().__init_subclass__()
        cls.schema = {
            name: replace(variable, units=units, long_name=f"{variable.long_name}, {error_of}")
            if name.startswith("error_")
            else variable
            for name, variable in cls.schema.items()
        }

    def dataset(self) -> xr.Dataset:
        """Lay it out, the error asked for as it was asked for."""
        result = super().dataset()
        # 1 arcsec is 1e6 uas, not a rounding less
        result["error_asked"].values[...] = float(f"{float(result.error_asked):.14g}")
        return result

    @classmethod
    def of_series(cls, asked: float | None, error: xr.DataArray) -> Self:
        """Report the largest error of a series, which names its method."""
        return cls(
            error_asked=asked,
            error_estimated=float(si(error).max()),
            method_chosen=error.attrs["method"],
            evaluations=error.attrs["evaluations"],
        )

    @classmethod
    def closed_form(cls, asked: float | None, bound: float, method: str, evaluations: int) -> Self:
        """Report the accuracy of a method without settings, or refuse.

        Raises
        ------
        AccuracyError
            If more is asked than a float carries.
        """
        refuse_unkept(asked, bound, "1", "no float of 64 bits carries more; ask for less")
        return cls(
            error_asked=asked,
            error_estimated=bound,
            method_chosen=method,
            evaluations=evaluations,
        )


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
    if asked is not None and not best <= asked * (1 + 1e-12):
        factor = from_si(unit)
        raise AccuracyError(
            asked * factor, best * factor, "(relative)" if unit == "1" else unit, remedy
        )
