"""Tables: a result in plain words, for the terminal and for the page alike."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import xarray as xr

from earthspin.constants import DAY, P_A_RATE, TROPICAL_YEAR
from earthspin.scene.parts import PARTS
from earthspin.scene.parts.choices import CHOOSING


@dataclass(frozen=True)
class Table:
    """A table and the words around it.

    Attributes
    ----------
    title : str
    headers : tuple of str
    rows : sequence of tuple of str
    note : str
        A sentence or two below it.
    parts : tuple of str
        The parts that made its numbers.
    words : collection of int
        The columns that hold text; the others are set to the right.
    figure : str
        A picture below it on a page, as SVG.
    """

    title: str
    headers: tuple[str, ...]
    rows: Sequence[tuple[str, ...]]
    note: str = ""
    parts: tuple[str, ...] = field(default=())
    words: Collection[int] = (0,)
    figure: str = ""


def tables_for(result: xr.Dataset) -> list[Table]:
    """Tables of a result, in the order in which they are read.

    Parameters
    ----------
    result : Dataset
        As `run` gives it.
    """
    from earthspin.views import pole_tables, wobble_tables

    makers: dict[str, Callable[[xr.Dataset], Table]] = {
        "error_asked": accuracy_kept,
        "precession_rate": rates,
        "general_precession": sky_and_calendar,
        "period_by_model": models,
        "free_wobble_period": free_wobble,
        "iau_rate": iau,
        "standstill_declination": standstills,
        "torque_magnitude": torque_summary,
        "period_solar": wobble_tables.ladder,
        "days_per_unit": wobble_tables.sensitivity,
        "chandler_period": wobble_tables.observed,
        "chandler_amplitude": wobble_tables.statements,
        "energy": free_rotor,
        "turning_angle": top,
        "potential": spheroid,
        "X": pole_tables.path,
        "psi_rate": pole_tables.budget,
        "residual_rms": pole_tables.residuals,
        "ratio_in_phase": pole_tables.nutation,
        "core_nutation_period": pole_tables.core,
        "angle_coefficient": pole_tables.angles,
        "flattening": pole_tables.flattening,
    }
    tables = [make(_first_of_draws(result)) for name, make in makers.items() if name in result]
    return [table for table in tables if table.rows]


def accuracy_kept(result: xr.Dataset) -> Table:
    """What was asked for, what is claimed, and the settings that it took."""
    unit = result.error_asked.attrs["units"]
    shown = "" if unit == "1" else f", {unit}"
    return Table(
        "Accuracy",
        ("chosen", f"asked{shown}", f"claimed{shown}", "evaluations"),
        [
            (
                str(result.method_chosen.values),
                f"{float(result.error_asked):.3g}",
                f"{float(result.error_estimated):.3g}",
                f"{int(result.evaluations):,}",
            )
        ],
        parts=CHOOSING,
    )


def with_error(value: Any, error: Any, unit: str = "") -> str:
    """Write a value and its half-width to two digits of the half-width.

    Parameters
    ----------
    value, error : float
    unit : str
        Put behind.
    """
    value, error = float(value), float(error)
    if not math.isfinite(value):
        return "none (no motion)"
    if error <= 0 or not math.isfinite(error):
        return f"{value:.6g}{_space(unit)}"
    digits = max(0, 1 - math.floor(math.log10(error)))
    if abs(value) >= 1e9:
        significant = math.floor(math.log10(abs(value))) - math.floor(math.log10(error)) + 1
        return f"{value:.{max(significant, 0)}e} ± {error:.1e}{_space(unit)}".replace("e+", "e")
    return f"{value:.{digits}f} ± {error:.{digits}f}{_space(unit)}"


def _space(unit: str) -> str:
    return f" {unit}" if unit else ""


def _first_of_draws(result: xr.Dataset) -> xr.Dataset:
    """The first of many bodies, where a body has labelled arrays: tables show one."""
    declared = (variable.dims for part in PARTS.values() for variable in part.gives.values())
    known = {"part"}.union(*declared)
    return result.isel({dim: 0 for dim in result.dims if dim not in known})


def _value(result: xr.Dataset, name: str) -> str:
    return with_error(result[name], result[f"{name}_error"])


def _date(time: Any) -> str:
    return str(np.datetime64(time, "D"))


def rates(result: xr.Dataset) -> Table:
    """Rates, periods and torques by perturber."""
    rows = []
    for label in result.perturber.values:
        of = result.sel(perturber=label)
        rows.append(
            (
                str(label),
                _value(of, "precession_rate"),
                _value(of, "precession_period"),
                _value(of, "mean_torque"),
                f"{float(of.rate_ratio):.5f}",
            )
        )
    first = str(result.perturber.values[0])
    epoch = str(np.datetime64(result.reference_epoch.values, "m"))
    return Table(
        "Precession",
        ("pulled by", "rate, arcsec/yr", "period, yr", "mean torque, N m", f"rate / {first}"),
        rows,
        f"In longitude along the fixed orbit, referred to {epoch} TDB; obliquity "
        f"{float(result.obliquity):.6f} deg. Averaged with the "
        f"{result.precession_rate.attrs['window']}. Errors are 95 % half-widths; of the rate's "
        f"last one, averaging has {_mas(result.precession_rate_error_method)} mas/cy, the given "
        f"numbers {_mas(result.precession_rate_error_input)}.",
        ("ephemeris", "torque-samples", "mean-rates"),
    )


def _mas(rate: xr.DataArray) -> str:
    """arcsec/yr of the last perturber in mas per century."""
    return f"{float(rate.isel(perturber=-1)) * 1e5:.2g}"


def sky_and_calendar(result: xr.Dataset) -> Table:
    """What the rate means in the sky and in the calendar."""
    return Table(
        "What it means in the sky",
        ("", "ours", "for comparison"),
        [
            (
                "general precession, arcsec/yr",
                _value(result, "general_precession"),
                f"{P_A_RATE.value:.5f} (IAU 2006)",
            ),
            (
                "once round, yr",
                _value(result, "general_precession_period"),
                "25,800 (I.8)",
            ),
            ("years per degree", f"{float(result.time_per_degree):.3f}", "72 (I.8)"),
            (
                "tropical year, d",
                f"{float(result.tropical_year):.6f}",
                f"{TROPICAL_YEAR.value / DAY:.6f} (Simon et al. 1994)",
            ),
            (
                "years per day of calendar drift",
                f"{float(result.time_per_day_of_drift):.2f}",
                "129.4 (I.8)",
            ),
        ],
        "Ours less the motion of the ecliptic (IAU 2006). A calendar of 365.25 days drifts against "
        "the tropical year, which already holds the precession; the text's 129.4 divides the turn "
        "among the stars by the days of the year.",
        ("seasons",),
    )


def models(result: xr.Dataset) -> Table:
    """Three ways to H."""
    words = {
        "mccullough": "flattening stands for (I3-I1)/I1",
        "homogeneous": "J2, with C = 0.4 M a2",
        "measured": "H as measured",
    }
    rows = []
    for model in result.earth_model.values:
        of = result.sel(earth_model=model)
        rows.append(
            (
                f"{model}: {words[str(model)]}",
                f"{float(of.h_by_model):.7f}",
                f"{float(of.period_by_model):,.0f}",
                f"{float(of.wobble_by_model):.2f}",
            )
        )
    return Table(
        "Three models of the figure",
        ("model", "H = (C-A)/C", "precession, yr", "wobble, d"),
        rows,
        f"C - A = {float(result.moment_difference):.5e} kg m2 from J2 (and back: "
        f"{float(result.j2_from_moment_difference):.7e}); C = "
        f"{float(result.polar_moment_factor):.6f} M a2. Both formulas for an even density fail a "
        "body that is denser inside.",
        ("earth-models",),
    )


def free_wobble(result: xr.Dataset) -> Table:
    """The rigid wobble beside the observed one."""
    rows = [
        (
            "rigid body, A/(C-A)",
            _value(result, "free_wobble_period"),
            f"{float(result.free_wobble_period_sidereal):.4f}",
        )
    ]
    note = "A rigid body; the real one yields, has a fluid core and oceans."
    if "observed_period" in result:
        rows.append(("observed (Nastula & Gross 2015)", _value(result, "observed_period"), ""))
    return Table(
        "Free wobble",
        ("", "days of 86400 s", "sidereal days"),
        rows,
        note,
        ("free-wobble",),
    )


def iau(result: xr.Dataset) -> Table:
    """IAU 2006 beside ours."""
    total = result.isel(perturber=-1)
    rows = [
        ("ours", _value(total, "precession_rate")),
        ("IAU 2006, psi_A", f"{float(result.iau_rate):.8f}"),
        ("difference", _value(result, "difference_from_iau")),
    ]
    rows += [
        (f"  left out: {effect}", f"{float(result.neglected_effect.sel(effect=effect)):+.6f}")
        for effect in result.effect.values
    ]
    rows.append(("difference after the published effects", _value(result, "closure")))
    return Table(
        "Beside IAU 2006",
        (f"rate at {_date(result.reference_epoch.values)}", "arcsec/yr"),
        rows,
        "Published sizes: Capitaine, Wallace & Chapront 2003, table 3. H itself comes from "
        "observed precession, so the closure tests consistency, not the theory: what is left is "
        f"{abs(float(result.closure / result.iau_rate)) * 1e6:.1f} millionths of the rate.",
        ("iau-2006",),
    )


def standstills(result: xr.Dataset) -> Table:
    """Lunar standstills, two to a row of text."""
    text = {"major": "28.58", "minor": "18.30"}
    rows = [
        (
            _date(time),
            str(of.standstill_kind.values),
            f"{float(of.standstill_declination):+.4f}",
            text[str(of.standstill_kind.values)],
        )
        for time, of in ((t, result.sel(standstill=t)) for t in result.standstill.values)
    ]
    return Table(
        "Lunar standstills",
        ("date (TDB)", "kind", "extreme declination, deg", "I.8, deg"),
        rows,
        "Extremes of single months, from the centre of the body. The text adds 5.14 to 23.44 "
        "degrees; the Sun swings the orbit's tilt between 5.0 and 5.3, so the widest month reaches "
        "28.7 and the narrowest stays near 18.1. Errors: at most "
        f"{float(result.standstill_declination_error[0]) if rows else 0:.0e} deg, the kernel's.",
        ("standstills",),
    )


def torque_summary(result: xr.Dataset) -> Table:
    """Extremes of a torque series."""
    rows = []
    for label in result.perturber.values:
        of = result.sel(perturber=label)
        rows.append(
            (
                str(label),
                f"{float(of.declination.min()):+.4f} to {float(of.declination.max()):+.4f}",
                f"{float(of.distance.min()):.6e} to {float(of.distance.max()):.6e}",
                f"{float(of.torque_magnitude.max()):.4e}",
                f"{float(of.torque_magnitude_error.max()):.1e}",
            )
        )
    first, last = result.time.values[0], result.time.values[-1]
    return Table(
        "Torque",
        ("pulled by", "declination, deg", "distance, m", "largest torque, N m", "its error"),
        rows,
        f"{result.time.size} times from {first} to {last} TDB, {result.torque.attrs['frame']}.",
        ("torque-series",),
    )


def free_rotor(result: xr.Dataset) -> Table:
    """Constants of a free rotor's motion."""
    one = result.isel(start=0) if "start" in result.dims else result
    momentum = float(np.linalg.norm(one.angular_momentum_body.isel(time=0)))
    rows = [
        ("kinetic energy, J", f"{float(one.energy.isel(time=0)):.10g}"),
        ("angular momentum, kg m2/s", f"{momentum:.10g}"),
    ]
    if "polhode_period" in one:
        inner, outer = one.herpolhode_radius.values
        rows += [
            ("period of the polhode, s", f"{float(one.polhode_period):.10g}"),
            ("invariable plane, rad/s", f"{float(one.invariable_plane_distance):.10g}"),
            ("herpolhode between, rad/s", f"{inner:.8g} and {outer:.8g}"),
            ("turn of the herpolhode per round, deg", _advance(one)),
            ("growth rate about x, y, z, 1/s", _list(one.growth_rate.values)),
        ]
    return Table(
        "Free rotor",
        ("", "value"),
        rows,
        "Constants of the motion; the growth rate is that of a small tilt off each axis, 0 where "
        "the axis is stable.",
        ("free-rotation", "poinsot"),
    )


def _advance(one: xr.Dataset) -> str:
    if "herpolhode_advance" not in one:
        return "none (no round ends)"
    return f"{float(np.degrees(one.herpolhode_advance)):.8f}"


def top(result: xr.Dataset) -> Table:
    """What a heavy top does."""
    upper, lower = np.degrees(result.turning_angle.values)
    return Table(
        "Heavy top",
        ("", "value"),
        [
            ("pattern", str(result.pattern.values)),
            ("turning angles, deg", f"{upper:.8f} and {lower:.8f}"),
            ("period of nutation, s", f"{float(result.nutation_period):.10g}"),
            ("mean precession, rad/s", f"{float(result.mean_precession_rate):.10g}"),
        ],
        "",
        ("heavy-top",),
    )


def spheroid(result: xr.Dataset) -> Table:
    """Field of a spheroid at each point."""
    rows = [
        (
            _list(of.position.values),
            f"{float(of.potential):.10e}",
            _list(of.attraction.values),
            f"{float(np.linalg.norm(of.torque)):.6e}",
        )
        for of in (result.isel(point=n) for n in range(result.sizes["point"]))
    ]
    return Table(
        "Field of the spheroid",
        ("position, m", "potential, J/kg", "attraction, m/s2", "torque, N m"),
        rows,
        "Homogeneous, with the mass, radius and flattening of the body.",
        ("spheroid-field",),
    )


def _list(values: Any) -> str:
    return ", ".join(f"{float(v):.6g}" for v in values)


def run_times(result: xr.Dataset, parts: tuple[str, ...]) -> str:
    """Say which parts made something, and how long each took."""
    known = [p for p in parts if p in result.part.values]
    return ", ".join(
        f"{name} {float(result.part_run_time.sel(part=name)) * 1e3:.0f} ms" for name in known
    )


def print_tables(result: xr.Dataset) -> None:
    """Print the tables of a result, and what each cost, to the terminal."""
    from earthspin.views.terminal import Terminal

    console = Terminal()
    for table in tables_for(result):
        console.print_table(table)
        console.print(f"[{run_times(result, table.parts)}]\n", style="dim", markup=False)
