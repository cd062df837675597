"""Report on a requested accuracy: the request, the estimated error and the chosen method."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Self

from earthspin.engine.labels import from_si, si
from earthspin.engine.variables import Value, Variables, number, words
from earthspin.errors import AccuracyError

if TYPE_CHECKING:
    import xarray as xr

#: Fraction of the requested error that a method may use, as a margin for rounding.
MARGIN = 0.99


class Report(Variables):
    """Report on accuracy: requested error, estimated error, and the chosen method.

    A subclass defines the unit of the errors and the quantity to which they apply.
    """

    error_asked: Value = number("1", "requested error")
    error_estimated: Value = number("1", "largest estimated error")
    method_chosen: Value = words("chosen method and settings")
    evaluations: Value = number("1", "evaluations of positions, or of terms of nutation")

    def __init_subclass__(cls, units: str, error_of: str) -> None:
        """Set unit and quantity of the errors that a subclass of `Report` describes."""
        super().__init_subclass__()
        cls.schema = {
            name: replace(variable, units=units, long_name=f"{variable.long_name}, {error_of}")
            if name.startswith("error_")
            else variable
            for name, variable in cls.schema.items()
        }

    def dataset(self) -> xr.Dataset:
        """Convert the report to a Dataset, with the requested error as the user wrote it."""
        result = super().dataset()
        # The conversion of units must not change 1e6 uas in the last digit.
        result["error_asked"].values[...] = float(f"{float(result.error_asked):.14g}")
        return result

    @classmethod
    def of_series(cls, asked: float | None, error: xr.DataArray) -> Self:
        """Report the accuracy of a time series: requested error, largest error, and method.

        The attributes of the error name the method.
        """
        return cls(
            error_asked=asked,
            error_estimated=float(si(error).max()),
            method_chosen=error.attrs["method"],
            evaluations=error.attrs["evaluations"],
        )

    @classmethod
    def closed_form(cls, asked: float | None, bound: float, method: str, evaluations: int) -> Self:
        """Report the accuracy of a closed form, whose error has a fixed bound.

        Raises
        ------
        AccuracyError
            If the requested error is below the bound.
        """
        refuse_unkept(asked, bound, "1", "64-bit floats allow no more; request a larger error")
        return cls(
            error_asked=asked,
            error_estimated=bound,
            method_chosen=method,
            evaluations=evaluations,
        )


def refuse_unkept(asked: float | None, best: float, unit: str, remedy: str) -> None:
    """Raise an error if the estimated error of a result exceeds the requested error.

    Parameters
    ----------
    asked, best : float
        Requested and estimated error, in rad or relative.
    unit : str
        Unit of both errors in the message.
    remedy : str
        Advice for the message.

    Raises
    ------
    AccuracyError
        If `best` exceeds `asked` by more than the rounding error of a change of units.
    """
    if asked is not None and not best <= asked * (1 + 1e-12):
        factor = from_si(unit)
        raise AccuracyError(
            asked * factor, best * factor, "(relative)" if unit == "1" else unit, remedy
        )
