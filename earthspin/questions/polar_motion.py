"""Observed polar motion, the free wobble in it, and the excitation of polar motion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import Body
from earthspin.constants import DAY, DAYS_PER_YEAR, MAS, NORMAL_95
from earthspin.dates import Span, datetime64
from earthspin.engine import Neglected, in_range, part, public_call, setting
from earthspin.engine.variables import Variables, labels, measured, number
from earthspin.errors import SceneError, SeriesError, Where, nearest
from earthspin.mass.figure import polar_radius
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.questions import observed_pole as tables
from earthspin.questions.observed_pole import complex_pole, labelled_series
from earthspin.sky.angular_momentum import TERMS, AngularMomentum, read_angular_momentum
from earthspin.sky.eop import MJD, PoleSeries, PoleTable, read_polar_motion
from earthspin.tables import Meaning, declared, typed
from earthspin.tables.layouts import ANGULAR_MOMENTUM
from earthspin.units import Days, FileName, Number, Numbers, Several, Text, Word, kind_of
from earthspin.wobble import excitation as ex
from earthspin.wobble import record

if TYPE_CHECKING:
    import pandas as pd

#: How the free wobble is found.
Method = Literal["burg", "likelihood"]
#: Days that are closer than this are the same, d.
SAME_DAY = 1e-6
#: Cycles per day up to which a spectrum is given: three in a year.
FASTEST = 3 / DAYS_PER_YEAR
#: Sum of the amplitudes of the tidal terms of x, mas: Q1, O1, P1, K1, N2, M2, S2, K2.
OCEAN_TIDES = 0.027 + 0.142 + 0.056 + 0.171 + 0.058 + 0.331 + 0.158 + 0.040


class PolarMotion(tables.OfTable, word="polar-motion", call="polar_motion", table="polar_motion"):
    """Observed polar motion, and the free wobble in it.

    The section `chandler` is the result of `fit_chandler`, over the middles of sliding windows.

    Raises
    ------
    SeriesError
        If the file is no known table, or has gaps; CoverageError if it does not cover the span.

    Examples
    --------
    >>> import earthspin
    >>> pole = earthspin.polar_motion(span=("1970-01-01", "2000-01-01"))
    >>> print(pole.x.attrs["references"])
    IERS c04
    """

    page, headline = "wobble", "x"

    method: Method = setting("burg", doc="method that fits the free wobble")
    window: Days | None = setting(
        None, doc="length of the sliding windows; one beat of annual and free wobble if not given"
    )


class ObservedPole(tables.DailyPole):
    """Observed coordinates x and y of the pole in time, with errors."""

    polar_radius = number(
        "m", "polar radius of the body", along=(), no_error="a given number of the body"
    )


@part(unless=tables.no_observed_pole)
def pole_table(
    file: PoleTable, kind: str | None, columns: str | None, span: Span | None
) -> PoleSeries:
    """Read the polar motion of a table, for all its dates, or those of the part with the span."""
    return read_polar_motion(file, kind, columns, tables.mjd_span(span))


@part(unless=tables.no_observed_pole)
def observed_pole(pole_table: PoleSeries, body: Body, span: Span | None) -> ObservedPole:
    """Return the observed polar motion of a table of the IERS within the requested span."""
    series = tables.within(pole_table, span)
    source = {"references": series.source, "repairs": series.repairs or "none"}
    return ObservedPole(
        time=datetime64(series.mjd - MJD),
        x=(series.x, NORMAL_95 * series.x_error),
        y=(series.y, NORMAL_95 * series.y_error),
        polar_radius=polar_radius(body.needed("radius"), body.needed("flattening")),
    ).with_attributes(no_error=tables.NO_ERRORS, x=source, y=source)


_END = "an end of an interval of 95 %"


class ObservedFreeWobble(Variables, along=("middle",)):
    """Period and amplitude of the free wobble, amplitudes of the annual wobble, and mean pole."""

    chandler_period = measured("d", "period of the free wobble", along=(), short="period")
    chandler_amplitude = measured(
        "mas",
        "amplitude of the free wobble",
        cell_methods="middle: mean (one beat of the wobbles)",
        comment="mean over one beat of the free and the annual wobble, as is its error; within a "
        "beat the amplitude changes by more",
    )
    chandler_phase = measured(
        "deg", "phase of the free wobble relative to a sinusoid of its period"
    )
    annual_amplitude = measured("mas", "amplitude of the annual wobble, prograde")
    annual_retrograde_amplitude = number(
        "mas", "amplitude of the annual wobble, retrograde", error="chandler_amplitude_error"
    )
    mean_pole = number(
        "mas",
        "mean position of the pole",
        along=("middle", "axis"),
        no_error="a mean of observed positions; errors of the table were not propagated",
    )
    chandler_quality_factor = number(
        "1",
        "quality factor of the free wobble",
        along=(),
        error="chandler_quality_factor_low chandler_quality_factor_high",
    )
    chandler_quality_factor_low = number(
        "1", "lower end of its 95 % interval", along=(), no_error=_END
    )
    chandler_quality_factor_high = number(
        "1", "upper end of its 95 % interval", along=(), no_error=_END, comment="infinite if open"
    )
    middle = labels("middle of a window")
    axis = labels(default=["x", "y"])


@part(loads=("earthspin.wobble.observed",))
def chandler(observed_pole: xr.Dataset, method: str, window: float | None) -> ObservedFreeWobble:
    """Period, quality factor and amplitude of the free wobble in the observed pole."""
    from earthspin.wobble import observed

    time, p = complex_pole(observed_pole)
    return _free_wobble(time, p, observed.fit(time, p, method), window)


#: Condition of the errors of period and quality factor; docs/wobble.md has its figures and papers.
_CONDITION = "white or red excitation near the wobble's frequency, not a narrow band"


def _free_wobble(
    time: FloatArray, p: ComplexArray, fit: record.WobbleFit, window: float | None
) -> ObservedFreeWobble:
    """Return the fitted period and quality factor, and wobble amplitudes in sliding windows."""
    wobbles = record.envelope(time, p, fit.period, window)
    low, high = fit.quality_bounds
    phase_error = np.minimum(wobbles.error / abs(wobbles.chandler), np.pi)
    return ObservedFreeWobble(
        chandler_period=(fit.period * DAY, fit.period_error * DAY),
        chandler_amplitude=(abs(wobbles.chandler) * MAS, wobbles.error * MAS),
        chandler_phase=(np.unwrap(np.angle(wobbles.chandler)), phase_error),
        annual_amplitude=(abs(wobbles.annual) * MAS, wobbles.annual_error * MAS),
        annual_retrograde_amplitude=abs(wobbles.annual_retrograde) * MAS,
        mean_pole=np.column_stack(ex.coordinates_of(wobbles.drift)) * MAS,
        chandler_quality_factor=fit.quality_factor,
        chandler_quality_factor_low=low,
        chandler_quality_factor_high=high,
        middle=datetime64(wobbles.time),
    ).with_attributes(
        chandler_period={"method": fit.method},
        chandler_period_error={"condition": _CONDITION},
        chandler_quality_factor_low={"condition": _CONDITION},
        chandler_quality_factor_high={"condition": _CONDITION},
    )


class Spectrum(
    Variables,
    along=("frequency",),
    no_error="the scatter of an amplitude at one frequency is as large as the amplitude",
):
    """Prograde and retrograde amplitude spectrum of polar motion."""

    spectral_amplitude = number(
        "mas", "amplitude of a sinusoid, prograde if the frequency is positive"
    )
    frequency = labels("cycles per day, negative if retrograde", "1/d")


@part
def spectrum(observed_pole: xr.Dataset) -> Spectrum:
    """Compute the amplitude spectrum of the observed pole, at frequencies up to `FASTEST`."""
    frequency, size = record.spectrum(*complex_pole(observed_pole))
    slow = abs(frequency) <= FASTEST
    return Spectrum(spectral_amplitude=size[slow] * MAS, frequency=frequency[slow])


@part
def neglected() -> Neglected:
    """Effects that tables of the pole leave out by convention."""
    return Neglected(
        sizes={"tides of a day and of half a day": OCEAN_TIDES * MAS},
        unit="mas",
        what="sum of the amplitudes of its terms in x, which tables leave out by convention",
        source="IERS Conventions (1996), ch. 8: eight terms, as listed by the Paris Observatory",
    )


polar_motion = public_call(
    PolarMotion, answer=observed_pole, sections=(chandler, spectrum, neglected), parts=(pole_table,)
)


# --- calls on labelled series --------------------------------------------------------------------

_DAYS = Number("d", "433 d", above=0.0)
_PURE = Number("", "100", above=0.0)


@in_range("fit_chandler")
def fit_chandler(
    ds: xr.Dataset | pd.DataFrame | str | PathLike[str],
    *,
    method: str | None = None,
    window: Any = None,
    excitation: xr.Dataset | pd.DataFrame | None = None,
    columns: str | None = None,
) -> xr.Dataset:
    """Fit period, quality factor and amplitude of the free wobble to polar motion.

    Parameters
    ----------
    ds : Dataset, DataFrame, str or Path
        `x` and `y` over `time`, evenly spaced, with units ("arcsec" or "mas"). A table of pandas or
        polars has dates as its index or in a column such as `MJD`, and the unit in
        ``attrs["units"]`` or in the names, like ``x (mas)``. A path is that of a file that
        `polar_motion` reads. Small gaps are filled as by ``polar_motion(file=ds)``, and described
        in the attribute ``repairs``.
    method : str, optional
        ``"burg"`` (the default) or ``"likelihood"``.
    window : duration, optional
        Length of the sliding windows (a number is in days); one beat of annual and free wobble by
        default.
    excitation : Dataset, optional
        `chi1`, `chi2` (mas) over `time`, means over the steps of the pole. The motion that it
        drives, for the same period and quality factor, is subtracted before the likelihood is
        computed. Only the common span is used.
    columns : str, optional
        Columns of a file, as for `polar_motion`.

    Returns
    -------
    Dataset
        `chandler_period` (d) and `chandler_quality_factor`, `..._low`, `..._high` with 95 %
        intervals, whose attribute ``condition`` says for which excitation they hold; over `time`,
        the middles of the windows, `chandler_amplitude` (mas) and its phase, the annual amplitudes
        and the mean pole.

    Raises
    ------
    EarthspinError
        If the series has a long gap or no numbers, is too short (the message names the needed
        length), or contains no wobble.

    Examples
    --------
    >>> import earthspin
    >>> seen = earthspin.polar_motion(span=("1990-01-01", "2005-01-01"))
    >>> wobble = earthspin.fit_chandler(seen)
    >>> print(f"{wobble.chandler_period:.0f} ± {wobble.chandler_period_error:.0f} d")
    434 ± 6 d
    """
    from earthspin.wobble import observed

    length = None if window is None else _DAYS.read(window, Where("window"))
    if excitation is None:
        word = kind_of(Method).read("burg" if method is None else method, Where("method"))
        time, p, repairs = _given_pole(ds, columns)
        fit = observed.fit(time, p, word)
    else:
        if not (method is None or (isinstance(method, str) and method == "likelihood")):  # type: ignore[redundant-expr]
            raise SceneError("method", method, "with an excitation it is 'likelihood'")
        time, p, chi, repairs = _together(ds, excitation, columns)
        fit = observed.fit_with_excitation(time, p, chi)
    attributes = getattr(ds, "attrs", {})
    source = {"source": attributes["source"]} if "source" in attributes else {}
    wobble = _free_wobble(time, p, fit, length).dataset()
    return wobble.rename(middle="time").assign_attrs(source | repairs)


def _given_pole(
    pole: xr.Dataset | pd.DataFrame | str | PathLike[str], columns: str | None = None
) -> tuple[FloatArray, ComplexArray, dict[str, str]]:
    """Days from J2000.0, polar motion in mas, and an attribute that describes repairs, if any.

    Small gaps and rows without numbers are repaired as in tables of the pole.
    """
    if columns is None and not isinstance(pole, (str, PathLike)):
        time, p = complex_pole(pole)
        steps = np.diff(time)
        if np.isfinite(p).all() and np.all(abs(steps - steps[0]) <= SAME_DAY):
            return time, p, {}
    table = read_polar_motion(tables.PoleInput().read(pole, Where("ds")), columns=columns)
    return table.mjd - MJD, table.pole, {"repairs": table.repairs} if table.repairs else {}


def _together(
    pole: xr.Dataset | pd.DataFrame | str | PathLike[str],
    chi: xr.Dataset,
    columns: str | None = None,
) -> tuple[FloatArray, ComplexArray, ComplexArray, dict[str, str]]:
    """Return dates, pole, mean excitation and repairs for the days that both series cover.

    The excitation is the mean over each step between dates; pole and excitation are in mas.
    """
    time, p, repairs = _given_pole(pole, columns)
    middles, driving = _complex_excitation(chi)
    ends = ex.ends_of_steps(middles, _even_step(middles))
    step = _even_step(time)
    first = np.searchsorted(ends, time[0] - SAME_DAY)
    start = np.searchsorted(time, ends[first] - SAME_DAY) if first < ends.size else time.size
    count = min(ends.size - first, time.size - start)
    if count < 2:
        raise SceneError("excitation", "its dates", "it has no span in common with the pole")
    if np.max(abs(ends[first : first + count] - time[start : start + count])) > SAME_DAY:
        given = f"means about day {middles[0]:.3f}, each {middles[1] - middles[0]:.3g} d"
        means = f"means over the steps of the pole, each {step:.3g} d: those between its days"
        remedy = "read_excitation(..., daily=True) makes them from 0h to 0h"
        raise SceneError("excitation", given, f"give {means}; {remedy}")
    common = slice(start, start + count)
    time, p, driving = time[common], p[common], driving[first : first + count - 1]
    tables.refuse_other_excitation(time, p, driving)
    return time, p, driving, repairs


def _complex_excitation(chi: xr.Dataset) -> tuple[FloatArray, ComplexArray]:
    """Return the times of an excitation series, days from J2000.0, and chi1 + i chi2, mas."""
    time, chi1, chi2 = labelled_series(chi, ("chi1", "chi2"), ("mas",))
    return time, ex.excitation_of(chi1, chi2) / MAS


#: Units in which files may hold angular momentum.
_UNITS = ("rad", "arcsec", "mas", "uas", "deg")


class Excitation(tables.Daily, no_error="the files give no errors"):
    """Excitation of polar motion."""

    chi1 = number("mas", "excitation, towards the prime meridian")
    chi2 = number("mas", "excitation, towards 90 degrees east")
    chi3 = number(
        "ms",
        "axial excitation: change of the length of day, 86400 s times chi3",
        default=None,
    )


_FROM_POLE = "errors of x and y, whose correlation between days is unknown, were not propagated"


class DrivenPole(tables.Daily, no_error="excitation and free wobble are given without errors"):
    """Polar motion that results from a given excitation."""

    x = number("arcsec", "pole, towards the prime meridian")
    y = number("arcsec", "pole, towards 90 degrees west")


@in_range("excitation")
def excitation(
    ds: xr.Dataset | pd.DataFrame | str | PathLike[str],
    *,
    period: Any = 433.0,
    quality_factor: Any = 100.0,
    columns: str | None = None,
) -> xr.Dataset:
    """Excitation that produces a given polar motion, as exact means over each time step.

    Parameters
    ----------
    ds : Dataset, DataFrame, str or Path
        `x` and `y` over `time`, as for `fit_chandler`.
    period : duration
        Period of the free wobble; plain numbers are in days.
    quality_factor : float
        Quality factor of the free wobble.
    columns : str, optional
        Columns of a file, as for `polar_motion`.

    Returns
    -------
    Dataset
        `chi1`, `chi2` (mas) over `time`, the middles of the steps.

    Raises
    ------
    EarthspinError
        If the series has a long gap or no numbers.

    Examples
    --------
    >>> import earthspin
    >>> seen = earthspin.polar_motion(span=("2000-01-01", "2005-01-01"))
    >>> chi = earthspin.excitation(seen, period="433 d", quality_factor=100)
    >>> print(seen.time.size, chi.time.size)
    1828 1827
    """
    days, q = _DAYS.read(period, Where("period")), _PURE.read(quality_factor, _Q)
    time, p, repairs = _given_pole(ds, columns)
    step = _even_step(time)
    chi = ex.excitation(p, step, ex.chandler_frequency(days, q))
    start_x, start_y = ex.coordinates_of(p[0])
    middles = datetime64(ex.middles_of_steps(time))
    result = Excitation(time=middles, chi1=chi.real * MAS, chi2=chi.imag * MAS)
    result.with_attributes(chi1={"no_error": _FROM_POLE}, chi2={"no_error": _FROM_POLE})
    start = "start of the pole in mas and in days from J2000.0"
    return result.dataset().assign_attrs(
        chandler_period=days,
        chandler_quality_factor=q,
        start_x=float(start_x),
        start_y=float(start_y),
        start_day=float(time[0]),
        step=step,
        comment=f"means over the step (d) around each time; {start}",
        **repairs,
    )


_Q = Where("quality_factor")


@in_range("polar_motion_from")
def polar_motion_from(
    chi: xr.Dataset,
    *,
    period: Any = None,
    quality_factor: Any = None,
    start: Any = None,
    fitted_to: xr.Dataset | None = None,
) -> xr.Dataset:
    """Polar motion driven by an excitation: the inverse of `excitation`.

    Parameters
    ----------
    chi : Dataset
        `chi1`, `chi2` (mas) over `time`, means over even steps.
    period, quality_factor : duration, float, optional
        Period (plain numbers in days) and quality factor of the free wobble; by default those
        stored by `excitation`.
    start : pair of angles, optional
        x and y at the start (plain numbers in mas); by default those stored by `excitation`, or
        zero.
    fitted_to : Dataset, optional
        Observed `x` and `y`; the start is then fitted to them together with drift and seasonal
        terms, over the common span.

    Returns
    -------
    Dataset
        `x`, `y` (arcsec) over `time`, the ends of the steps.

    Raises
    ------
    EarthspinError
        If the series is uneven or has no numbers, or the free wobble is not known.

    Examples
    --------
    >>> import earthspin
    >>> seen = earthspin.polar_motion(span=("2000-01-01", "2005-01-01"))
    >>> again = earthspin.polar_motion_from(earthspin.excitation(seen))
    >>> print(abs(again.x - seen.x).max().values < 1e-12)
    True
    """
    time, driving = _complex_excitation(chi)
    known = chi.attrs
    period = known.get("chandler_period") if period is None else period
    q = known.get("chandler_quality_factor") if quality_factor is None else quality_factor
    if period is None or q is None:
        raise SceneError("period", period, "give period and quality_factor of the free wobble")
    step = _even_step(time)
    noted = _DAYS.read(known.get("step", step), Where("step"))
    if abs(noted - step) > SAME_DAY:
        raise SceneError("time", f"steps of {step:g} d", f"the means are over {noted:g} d")
    s = ex.chandler_frequency(_DAYS.read(period, Where("period")), _PURE.read(q, _Q))
    ends = ex.ends_of_steps(time, step)
    if fitted_to is not None:
        if start is not None:
            raise SceneError("start", start, "fitted_to determines it; remove one of them")
        ends, observed, driving, _ = _together(fitted_to, chi)
        begin = ex.fitted_start(ends, observed, driving, s)
    else:
        begin = complex(ex.pole_of(*_given_start(chi, start, ends[0])))
    x, y = ex.coordinates_of(ex.polar_motion_from(driving, step, s, begin))
    result = DrivenPole(time=datetime64(ends), x=x * MAS, y=y * MAS).dataset()
    return result.assign_attrs(source=f"driven by {known.get('source', 'a given excitation')}")


def _given_start(chi: xr.Dataset, start: Any, first: float) -> tuple[float, float]:
    """Return x and y of the pole at the start of a series, mas.

    They are taken from the argument, or else from the attributes of the excitation, or are zero.
    """
    if start is None:
        noted = Number("d", "9131.5 d").read(chi.attrs.get("start_day", first), Where("start_day"))
        if abs(noted - first) > SAME_DAY:
            problem = "the series does not begin on its start_day; give start=(x, y) in mas"
            raise SceneError("start", None, problem)
        start = (chi.attrs.get("start_x", 0.0), chi.attrs.get("start_y", 0.0))
    x, y = Numbers("mas", "50 mas", (2,)).read(start, Where("start"))
    return x, y


def read_excitation(
    path: str | Path | Sequence[str | Path],
    *,
    components: Sequence[str] | None = None,
    terms: Sequence[str] = ("mass", "motion"),
    daily: bool = False,
    columns: str | None = None,
) -> xr.Dataset:
    r"""Read effective angular momentum functions in the common ASCII layout.

    Parameters
    ----------
    path : str, Path or sequence of them
        Files, or folders of them: yearly files of a component are joined, and repeated epochs count
        once.
    components : sequence of str, optional
        Any of ``"AAM"``, ``"OAM"``, ``"HAM"``, ``"SLAM"``, as in the names of files; by default all
        are added.
    terms : sequence of str
        ``"mass"``, ``"motion"``, or both.
    daily : bool
        Average over days from 0h to 0h, as in the `excitation` of daily polar motion.
    columns : str, optional
        Columns of the files if these are of another layout, like ``"mjd, mass1, mass2, ..."``.

    Returns
    -------
    Dataset
        `chi1`, `chi2` (mas) over `time`; and `chi3`, the change of the length of day (ms), if all
        files have the axial part.

    Raises
    ------
    SeriesError
        If a file cannot be used; it names the line.

    Examples
    --------
    >>> from pathlib import Path
    >>> import earthspin
    >>> rows = [
    ...     f"2000 1 {day + 1} 0 {51544 + day} 1e-7 2e-7 0 1e-8 -2e-8 0" for day in range(3)
    ... ]
    >>> _ = Path("AAM_2000.asc").write_text("\n".join(rows))
    >>> chi = earthspin.read_excitation("AAM_2000.asc")
    >>> print(chi.chi1.round(2).values)
    [22.69 22.69 22.69]
    """
    if not isinstance(daily, bool):
        raise SceneError("daily", daily, "give True or False")
    terms = Several(Word(tuple(TERMS))).read(terms, Where("terms"))
    if components is not None:
        components = Several(Text()).read(components, Where("components"))
    if not terms:
        raise SceneError("terms", terms, nearest("", TERMS))
    paths = [Path(name) for name in Several(FileName()).read(path, Where("path"))]
    if columns is not None:
        columns = Text().read(columns, Where("columns"))
    table = read_angular_momentum(paths, components, daily=daily, columns=columns)
    chi = sum(getattr(table, term) for term in set(terms))
    axial = DAY * sum(getattr(table, f"{term}3") for term in set(terms))
    _refuse_other_columns(table, chi, columns)
    result = Excitation(
        time=datetime64(table.mjd - MJD),
        chi1=chi.real,
        chi2=chi.imag,
        chi3=axial if np.isfinite(axial).all() else None,
    ).dataset()
    names = " + ".join(components or ("all components",))
    return result.assign_attrs(source=f"{names} ({', '.join(terms)})")


def _refuse_other_columns(table: AngularMomentum, chi: ComplexArray, columns: str | None) -> None:
    """Refuse columns of files that agree with the pole of C04 only in another meaning."""
    if table.mjd[-1] - table.mjd[0] < ex.FEWEST:
        return
    pole, daily = read_polar_motion(), replace(table, mass=chi, motion=chi).daily()
    _, noons, days = np.intersect1d(daily.mjd, pole.mjd[:-1] + 0.5, return_indices=True)
    days = np.append(days, days[-1:] + 1)
    other = ex.other_meaning(pole.mjd[days], pole.pole[days], daily.mass[noons] / MAS)
    if other:
        given = declared(columns or ANGULAR_MOMENTUM[0 if np.any(table.motion) else 1].columns)
        meant = [_meant(column, *other) for column in given]
        problem = f"with {typed(given)} its numbers do not move the pole of C04"
        raise SeriesError("excitation", problem, f"they do with {typed(meant)}; give what is right")


def _meant(column: Meaning, words: dict[str, str], ratio: float) -> Meaning:
    """Meaning of a column of angular momentum after chi1 and chi2 are exchanged or reversed."""
    if column.quantity[:-1] not in TERMS:
        return column
    word, unit = words.get(f"chi{column.quantity[-1]}", "chi3"), column.unit or "rad"
    if not 1 / ex.OTHER_UNIT < ratio < ex.OTHER_UNIT:
        sizes = {other: Meaning("", other).conversion("rad")[0] for other in (unit, *_UNITS)}
        unit = min(_UNITS, key=lambda other: abs(math.log(ratio * sizes[other] / sizes[unit])))
    sign = column.sign * (-1.0 if word[0] == "-" else 1.0)
    return Meaning(column.quantity[:-1] + word[-1], unit, sign)


def _even_step(time: FloatArray) -> float:
    """Time step of an evenly spaced series, d."""
    steps = np.diff(time)
    if steps.size == 0 or np.any(abs(steps - steps[0]) > SAME_DAY):
        problem = "fill the gaps first; an even step is needed"
        raise SceneError("time", "uneven steps", problem)
    return float((time[-1] - time[0]) / steps.size)
