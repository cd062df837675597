"""Tables of the free wobble: the ladder, what it depends on, and what is observed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr

from earthspin.constants import MAS
from earthspin.views.tables import Table, with_error


def ladder(result: xr.Dataset) -> Table:
    """The wobble ladder."""
    rows = []
    for name in result.rung.values:
        of = result.sel(rung=name)
        q = float(of.quality_factor)
        rows.append(
            (
                str(name),
                with_error(of.period_solar, of.period_solar_error),
                f"{float(of.period_sidereal):.3f}",
                f"{float(of.factor):.6f}",
                "" if math.isinf(q) else f"{q:.0f}",
            )
        )
    notes = ["Each factor is over the rung before; the steps do not commute."]
    if "anelastic" in result.rung.values:
        notes.append(
            "The exponent of the loss is a free choice: the last rung is a check of consistency, "
            "not a prediction."
        )
    left_out = result.rung.attrs.get("left_out", "none")
    if left_out != "none":
        notes.append(f"Left out: {left_out}.")
    if "observed_period" in result:
        rows.append(
            (
                "observed",
                with_error(result.observed_period, result.observed_period_error),
                "",
                "",
                "",
            )
        )
        notes.append(f"{result.observed_period.attrs.get('references', '')}.")
    return Table(
        "Free wobble, rung by rung",
        ("rung", "days of 86400 s", "sidereal days", "factor", "Q"),
        rows,
        " ".join(notes),
        ("wobble-ladder",),
    )


def sensitivity(result: xr.Dataset) -> Table:
    """What the last rung depends on."""
    rows = [
        (
            str(name).replace("_", " "),
            with_error(of.input_value, of.input_half_width),
            f"{float(of.days_per_unit):.4g}",
            f"{float(of.days_from_input):.2g}",
        )
        for name, of in ((n, result.sel(input=n)) for n in result.input.values)
        if float(of.input_value) != 0
    ]
    nutation = ", ".join(
        f"{float(result.free_core_nutation.sel(core_shape=shape)):.1f} d ({shape} core)"
        for shape in result.core_shape.values
    )
    return Table(
        "What the last rung depends on",
        ("input", "value", "days per unit", "days from its error"),
        rows,
        f"The system's other root is the free core nutation; among the stars: {nutation}.",
        ("wobble-sensitivity",),
    )


def observed(result: xr.Dataset) -> Table:
    """Period, quality factor and present amplitude of the observed wobble."""
    rows = [
        ("period, d", with_error(result.chandler_period, result.chandler_period_error)),
    ]
    if "chandler_quality_factor" in result:
        low, high = (float(result[f"chandler_quality_factor_{end}"]) for end in ("low", "high"))
        ends = f"{low:.0f} to {high:.0f}" if math.isfinite(high) else f"{low:.0f} or more"
        rows.append(("quality factor", f"{float(result.chandler_quality_factor):.0f} ({ends})"))
    size = result.chandler_amplitude.values
    for words, at in (("largest", size.argmax()), ("smallest", size.argmin()), ("last", -1)):
        of = result.isel({_axis(result): at})
        rows.append(
            (
                f"{words} amplitude, mas, {_year(of[_axis(result)])}",
                with_error(of.chandler_amplitude, of.chandler_amplitude_error),
            )
        )
    rows.append(
        ("annual, prograde, mas (median)", f"{float(result.annual_amplitude.median()):.1f}")
    )
    return Table(
        "The observed wobble",
        ("", "value"),
        rows,
        f"By {result.chandler_period.attrs['method']}; 95 % intervals. Amplitudes in windows of "
        "one beat of the free and the annual wobble, by the year of the window's middle.",
        ("polar-motion", "chandler"),
    )


def statements(result: xr.Dataset) -> Table:
    """What the source text says of the wobble, and when it was true."""
    amplitude = result.chandler_amplitude
    metres = float(result.polar_radius) * MAS if "polar_radius" in result else None
    period, error = float(result.chandler_period), float(result.chandler_period_error)
    rows = [
        (
            "cone of 0.2 arcsec",
            f"{float(amplitude.min()) / 1e3:.3f} to {float(amplitude.max()) / 1e3:.3f}",
            _years_near(amplitude, 200.0),
        ),
        (
            "period of 434 days",
            with_error(period, error),
            "within the error" if abs(434 - period) <= error else "outside the error",
        ),
    ]
    if metres is not None:
        rows.insert(
            0,
            (
                "circle of 6 m",
                f"{float(amplitude.min()) * metres:.1f} to {float(amplitude.max()) * metres:.1f}",
                _years_near(amplitude, 6.0 / metres),
            ),
        )
    return Table(
        "The text's statements (I.6)",
        ("statement", "observed", "true (within a quarter)"),
        rows,
        "The free wobble alone; the annual one comes on top of it.",
        ("chandler",),
    )


def _years_near(amplitude: xr.DataArray, size: float) -> str:
    """First and last year in which an amplitude is within a quarter of a size."""
    near = abs(amplitude.values / size - 1) <= 0.25
    if not near.any():
        return "never"
    times = amplitude[amplitude.dims[0]].values[near]
    return f"{_year(times[0])} to {_year(times[-1])}, {near.mean():.0%} of the time"


def _axis(result: xr.Dataset) -> str:
    return str(result.chandler_amplitude.dims[0])


def _year(time: Any) -> str:
    return str(np.datetime64(getattr(time, "values", time), "Y"))
