"""Compare models with the observed celestial pole, with and without the free core nutation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from earthspin.constants import DAY, DAYS_PER_CENTURY
from earthspin.dates import Epochs, Span
from earthspin.engine.part import part
from earthspin.engine.variables import Labels, Value, Variables, labels, number
from earthspin.numerics.arrays import FloatArray
from earthspin.parts.pole_table import MJD
from earthspin.parts.times import days_of
from earthspin.sky.eop import PoleSeries, read_pole_offsets

#: First day of comparisons, 1990, in days from J2000.0. The stated errors of earlier offsets are
#: 0.4 to 0.6 mas a day, larger than the error of IAU 2006/2000A.
FIRST_DAY = 47892.0 - MJD
#: Smallest number of dates that are compared.
FEWEST = 10
#: Name of IAU 2006/2000A among the models.
IAU = "iau"


@cache
def observed_series() -> PoleSeries:
    """Observed celestial pole offsets of the IERS series C04."""
    return read_pole_offsets()


def not_observed_then(span: Span, step: float) -> str | None:
    """Return the reason (text) to omit the comparison if too few dates are observed, else None."""
    first, last = span.days
    first, last = max(first, FIRST_DAY), min(last, float(observed_series().mjd[-1]) - MJD)
    if (last - first) * DAY >= FEWEST * step:
        return None
    return f"fewer than {FEWEST} dates lie between 1990 and the last observed offset of C04"


@dataclass(frozen=True)
class ObservedSky:
    """Observed celestial pole offsets, and the free core nutation in them, at given dates.

    Attributes
    ----------
    rows : ndarray, shape (t,), bool
        True for the dates of the series that are compared.
    days : ndarray, shape (n,)
        The compared dates, days from J2000.0.
    offsets : ndarray, shape (n, 2)
        DX and dY, rad: the observed pole minus that of IAU 2006/2000A. To first order in the
        offsets and in the precession since J2000.0 they equal dpsi sin(eps0) and deps.
    core : ndarray, shape (n, 2)
        Free core nutation in the offsets, from sliding windows of three years, rad.
    provenance : dict of str to str
        Checksum of the table.
    """

    rows: NDArray[np.bool_]
    days: FloatArray
    offsets: FloatArray
    core: FloatArray
    provenance: dict[str, str]

    def sizes(self, models: Mapping[str, FloatArray], error: float) -> ObservedSizes:
        """Root mean square differences (sizes) between models and the observed celestial pole.

        Parameters
        ----------
        models : mapping of str to ndarray, shape (t, 2)
            Each model minus IAU 2006/2000A at all dates of the series, as dpsi sin(eps0) and deps.
        error : float
            95 % half-width of a residual of the models.
        """
        from earthspin.nutation.analysis import without_line

        series = {IAU: np.zeros((self.rows.size, 2)), **models}
        residual = np.stack([model[self.rows] - self.offsets for model in series.values()], axis=1)
        without_core = residual + self.core[:, np.newaxis]

        def rms(values: FloatArray, line: bool) -> FloatArray:
            if line:
                flat = values.reshape(self.days.size, -1)
                values = without_line(self.days / DAYS_PER_CENTURY, flat).reshape(values.shape)
            return np.asarray(np.sqrt(np.mean(values**2, axis=0)))

        return ObservedSizes(
            observed_rms=rms(residual, True),
            observed_rms_unfitted=rms(residual, False),
            observed_rms_without_core=rms(without_core, True),
            observed_rms_without_core_unfitted=rms(without_core, False),
            observed_size_error=error,
            observed_dates=self.days.size,
            model=list(series),
        ).with_attributes(observed_rms={"references": "IERS C04, from 1990"})


@part(unless=not_observed_then)
def observed_sky(epochs: Epochs) -> ObservedSky:
    """Interpolate the observed celestial pole offsets and their free core nutation to the dates."""
    from earthspin.nutation import core_nutation

    table = observed_series()
    time = table.mjd - MJD
    days = days_of(epochs)
    rows = (days >= FIRST_DAY) & (days <= time[-1])
    days = days[rows]
    core = core_nutation.fit(time, table.offsets).at(days)
    return ObservedSky(
        rows,
        days,
        np.stack([np.interp(days, time, axis) for axis in (table.x, table.y)], axis=1),
        np.stack([core.real, core.imag], axis=1),
        table.provenance,
    )


_RMS = "root mean square of the model minus the observed celestial pole"
_LINE = "a constant and a rate removed"
_CORE = "the free core nutation, fitted to the observed offsets, removed"
_AS_RETURNED = "nothing removed"


class ObservedSizes(Variables, along=("model", "direction"), error="observed_size_error"):
    """Root mean square of the differences between models and the observed celestial pole."""

    observed_rms: Value = number("mas", f"{_RMS}, {_LINE}", short="rms")
    observed_rms_without_core: Value = number(
        "mas", f"{_RMS}, {_LINE}, {_CORE}", short="rms without FCN"
    )
    observed_rms_unfitted: Value = number(
        "mas", f"{_RMS}, {_AS_RETURNED}", short="rms as returned", no_error=_AS_RETURNED
    )
    observed_rms_without_core_unfitted: Value = number(
        "mas", f"{_RMS}, {_CORE}", short="rms as returned, without FCN", no_error=_AS_RETURNED
    )
    observed_size_error: Value = number(
        "mas",
        "95 % half-width of a residual of the model, from H and integration; the noise of the "
        "observations is in each rms",
        along=(),
    )
    observed_dates: Value = number("1", "dates compared", along=(), no_error="a count")
    model: Labels = labels()
    direction: Labels = labels(default=["dpsi_sineps", "deps"])
