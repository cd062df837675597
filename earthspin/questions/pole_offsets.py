"""Observed celestial pole offsets, and the free core nutation in them."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np

from earthspin.constants import DAY, DAYS_PER_YEAR, NORMAL_95
from earthspin.dates import Span, datetime64
from earthspin.engine import Neglected, part, public_call, setting
from earthspin.engine.variables import Variables, labels, measured, number
from earthspin.errors import UndefinedError
from earthspin.interior.named import OBSERVED_CORE_NUTATION
from earthspin.nutation import core_nutation as core
from earthspin.questions import observed_pole as tables
from earthspin.sky.eop import MJD, PoleSeries, PoleTable, read_pole_offsets
from earthspin.units import Days
from earthspin.wobble.record import shortest_span

#: The period is fitted from 1984 on: the offsets before are noisier by a factor of four.
FIRST_MJD = 45700.0


class PoleOffsets(tables.OfTable, word="pole-offsets", call="pole_offsets", table="pole_offsets"):
    """Observed celestial pole offsets, and the free core nutation in them.

    The offsets dX, dY are X, Y observed by very long baseline interferometry minus those of IAU
    2006/2000A. Predicted rows, and rows before the first observation, are left out.

    Raises
    ------
    SeriesError
        If the file is no known table, or fails its checks; CoverageError if it does not cover the
        span.

    Examples
    --------
    >>> import earthspin
    >>> offsets = earthspin.pole_offsets(span=("2000-01-01", "2020-01-01"))
    >>> print(offsets.dX.attrs["units"], offsets.time.size)
    mas 7306
    """

    page, headline = "pole_offsets", "dX"

    file: Annotated[PoleTable, tables.PoleInput(("dX", "dY"))] = setting(
        tables.C04, doc=tables.FILE_DOC
    )
    window: Days | None = setting(
        None, doc="length of the sliding windows; three years if not given"
    )


class ObservedOffsets(tables.Daily):
    """Observed celestial pole offsets."""

    dX = measured("mas", "observed X of the celestial pole minus that of IAU 2006/2000A")
    dY = measured("mas", "observed Y of the celestial pole minus that of IAU 2006/2000A")


@part(unless=tables.no_observed_pole)
def offset_table(
    file: PoleTable, kind: str | None, columns: str | None, span: Span | None
) -> PoleSeries:
    """Read the celestial pole offsets of a table of the IERS, within the requested span."""
    table = read_pole_offsets(file, kind, columns, tables.mjd_span(span))
    return tables.within(table, span)


@part(unless=tables.no_observed_pole)
def observed_offsets(offset_table: PoleSeries) -> ObservedOffsets:
    """Return the observed celestial pole offsets of a table of the IERS, with errors."""
    series = offset_table
    source = {"references": series.source, "repairs": series.repairs or "none"}
    return ObservedOffsets(
        time=datetime64(series.mjd - MJD),
        dX=(series.x, NORMAL_95 * series.x_error),
        dY=(series.y, NORMAL_95 * series.y_error),
    ).with_attributes(no_error=tables.NO_ERRORS, dX=source, dY=source)


class ObservedCoreNutation(
    Variables,
    along=("middle",),
    no_error="a test that noise alone passes in 1 % of the windows",
):
    """Amplitude and phase of the free core nutation in sliding windows."""

    core_nutation_amplitude = measured(
        "uas",
        "amplitude of the free core nutation",
        cell_methods="middle: mean (one window)",
        short="amplitude",
        comment="a constant, a line and a retrograde circle of the published period are fitted in "
        "each window; half-widths from the noise at the opposite frequency",
    )
    core_nutation_phase = measured(
        "deg", "phase of the free core nutation relative to a circle of its published period"
    )
    detection_limit = number("uas", "amplitude that noise alone exceeds in 1 % of the windows")
    detected = number("1", "1 where the amplitude is above the detection limit, else 0")
    window_length = number("d", "length of a window", along=(), no_error="an input")
    middle = labels("middle of a window")


def shorter_than_a_window(span: Span | None, window: float | None) -> str | None:
    """Return the reason (text) to omit core nutation in spans shorter than a window, else None."""
    if _length(span) >= (core.WINDOW if window is None else window):
        return None
    return "the span is shorter than a window, which is three years if not given"


def too_short_for_a_period(span: Span | None) -> str | None:
    """Return the reason (text) to omit the core nutation period in short spans, else None."""
    needed = 2 * shortest_span()
    years = f"{needed / DAYS_PER_YEAR:.0f} years, which the fit of a period needs"
    return f"the span is shorter than {years}" if _length(span) < needed else None


def _length(span: Span | None) -> float:
    """Length of a time span, d; infinite if no span is given."""
    return math.inf if span is None else span.days[1] - span.days[0]


@part(unless=shorter_than_a_window)
def core_nutation(offset_table: PoleSeries, window: float | None) -> ObservedCoreNutation:
    """Fit amplitude and phase of the free core nutation to offsets in sliding time windows."""
    time, eta = offset_table.mjd - MJD, offset_table.offsets
    length = core.WINDOW if window is None else window
    fit = core.fit(time, eta, length)
    return ObservedCoreNutation(
        core_nutation_amplitude=(np.abs(fit.amplitude), fit.error),
        core_nutation_phase=(np.unwrap(np.angle(fit.amplitude)), fit.phase_error),
        detection_limit=fit.limit,
        detected=fit.detected.astype(int),
        window_length=length * DAY,
        middle=datetime64(fit.time),
    )


class CorePeriod(Variables):
    """Period of the free core nutation, from the observed offsets since 1984."""

    core_nutation_period = measured(
        "d",
        "period of the free core nutation in space, negative because retrograde",
        comment="maximum likelihood of an oscillator driven at random, beside seasonal terms, "
        "a cubic drift and red noise; random excitation limits how well the period is known",
        short="period",
    )
    core_nutation_period_published = measured(
        "d",
        "published period of the free core nutation",
        references=OBSERVED_CORE_NUTATION.source,
        short="published period",
        comment="from the resonance in the forced nutations and in the tides",
    )


@part(unless=too_short_for_a_period, loads=("earthspin.wobble.observed",))
def period(offset_table: PoleSeries) -> CorePeriod:
    """Fit the free core nutation, as a noise-driven oscillator, to the offsets since 1984."""
    from earthspin.wobble.observed import fit

    good = offset_table.mjd >= FIRST_MJD
    time, eta = offset_table.mjd[good] - MJD, offset_table.offsets[good]
    try:
        # The conjugate turns forwards, with nearly the period of the free wobble of polar motion.
        mode = fit(time, np.conj(eta), "likelihood")
    except UndefinedError as error:
        problem = f"the method of the free wobble finds no free core nutation: {error}"
        raise UndefinedError(problem) from None
    published = OBSERVED_CORE_NUTATION
    half_width = NORMAL_95 * published.relative_uncertainty * published.value * DAY
    return CorePeriod(
        core_nutation_period=(-mode.period * DAY, mode.period_error * DAY),
        core_nutation_period_published=(published.value * DAY, half_width),
    )


@part
def neglected() -> Neglected:
    """Effects that the fit of the free core nutation neglects."""
    return Neglected(
        unknown="retrograde annual terms that IAU 2006/2000A lacks, which three years do not "
        "separate from the free core nutation"
    )


pole_offsets = public_call(
    PoleOffsets,
    answer=observed_offsets,
    sections=(core_nutation, period, neglected),
    parts=(offset_table,),
)
