"""Observed polar motion, the free wobble in it, and what excites it."""

from __future__ import annotations

from dataclasses import dataclass
from os import fspath
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import EARTH, Body
from earthspin.constants import ARCSEC, DAY, MAS, NORMAL_95
from earthspin.dates import Span, datetime64, days
from earthspin.engine.asking import ask
from earthspin.engine.labels import Variable, build, si, with_error
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import Question, key, made_of, setting
from earthspin.errors import SceneError, UndefinedError, Where
from earthspin.parts.reasons import no_iau_model
from earthspin.units import Days, FloatArray, Number, Numbers, kind_of

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.wobble.observed import WobbleFit

#: How the free wobble is found.
Method = Literal["burg", "likelihood", "least-squares"]
_SCALE = {"long_name": "time", "standard_name": "time", "comment": "0h UTC in daily tables"}
#: Days that are closer than this are the same, d.
SAME_DAY = 1e-6
#: Day of the modified Julian date 0 from J2000.0.
_MJD = 51544.5


@dataclass(frozen=True)
class TableFile:
    """Kind of a table of polar motion: a known one, or a local file."""

    words, hint = '"c04" or the path of a file', "str | PathLike[str]"

    def read(self, given: object, where: Where) -> str:
        """Take a word or a path."""
        if not isinstance(given, (str, Path)) or not fspath(given).strip():
            raise where.error(given, f"it is {self.words}")
        return fspath(given)

    def write(self, value: str) -> str:
        """Give the word or path."""
        return value


class PolarMotion(Question, word="polar-motion", call="polar_motion", table="polar_motion"):
    """Observed polar motion, and the free wobble in it.

    Returns
    -------
    Dataset
        Over `time`: `x`, `y` (arcsec) with their 95 % half-widths. `earthspin.run_tree` gives what
        `fit_chandler` finds in it as the section `chandler`, over `middle`, the middles of sliding
        windows.

    Raises
    ------
    EarthspinError
        Whatever is wrong with the file or the span, in one line.

    Examples
    --------
    >>> import earthspin
    >>> pole = earthspin.polar_motion(span=("1970-01-01", "2000-01-01"))
    >>> print(pole.x.attrs["references"])
    IERS c04
    """

    body: Body = key(EARTH, doc="whose pole was observed")
    span: Span | None = key(None, doc="first and last date; the whole table if not given")
    file: Annotated[str, TableFile()] = setting(
        "c04", doc="the daily table of the IERS that astropy carries, or a local file"
    )
    kind: Literal["c04", "c01", "finals2000A"] | None = setting(
        None, doc="what sort of table it is; told from the file if not given"
    )
    method: Method = setting(
        "burg", doc="how the free wobble is found; least squares give no quality factor"
    )
    window: Days | None = setting(
        None, doc="length of the sliding windows; one beat of annual and free wobble if not given"
    )


_TIME = ("time",)
OBSERVED = {
    **with_error("x", Variable(_TIME, "arcsec", "pole, towards the prime meridian")),
    **with_error("y", Variable(_TIME, "arcsec", "pole, towards 90 degrees west")),
    "polar_radius": Variable((), "m", "polar radius of the body"),
}


def not_observed(body: Body) -> str | None:
    """Leave out a body whose pole no table holds."""
    return f"no polar motion of {body.name} is kept" if no_iau_model(body) else None


@part(gives=OBSERVED, unless=not_observed)
def observed_pole(body: Body, span: Span | None, file: str, kind: str | None) -> xr.Dataset:
    """Observed polar motion from a table of the IERS."""
    from earthspin.sky.eop import read_polar_motion

    series = read_polar_motion(file, kind)
    if span is not None:
        first, last = span.days
        series = series.between(first + _MJD, last + _MJD)
    result = build(
        OBSERVED,
        {
            "x": series.x,
            "y": series.y,
            "x_error": NORMAL_95 * series.x_error,
            "y_error": NORMAL_95 * series.y_error,
            "polar_radius": body.needed("radius") * (1 - body.needed("flattening")),
        },
        coords={"time": ("time", _stamps(series.mjd - _MJD), _SCALE)},
    )
    for name in ("x", "y"):
        result[name].attrs["references"] = f"IERS {series.name}"
        result[name].attrs["repairs"] = series.repairs or "none"
    return result


_MIDDLE = ("middle",)
CHANDLER = {
    **with_error("chandler_period", Variable((), "d", "period of the free wobble")),
    **with_error(
        "chandler_amplitude",
        Variable(
            _MIDDLE,
            "mas",
            "amplitude of the free wobble",
            (("cell_methods", "middle: mean (one beat of the wobbles)"),),
        ),
    ),
    "chandler_phase": Variable(
        _MIDDLE, "deg", "phase of the free wobble against a steady one of its period"
    ),
    "annual_amplitude": Variable(_MIDDLE, "mas", "amplitude of the annual wobble, prograde"),
    "annual_retrograde_amplitude": Variable(
        _MIDDLE, "mas", "amplitude of the annual wobble, retrograde"
    ),
    "mean_pole": Variable((*_MIDDLE, "axis"), "mas", "mean position of the pole"),
}
QUALITY = {
    "chandler_quality_factor": Variable((), "1", "quality factor of the free wobble"),
    "chandler_quality_factor_low": Variable((), "1", "lower end of its 95 % interval"),
    "chandler_quality_factor_high": Variable(
        (), "1", "upper end of its 95 % interval", (("comment", "infinite if open"),)
    ),
}


@part(gives=CHANDLER)
def chandler(observed_pole: xr.Dataset, method: str, window: float | None) -> xr.Dataset:
    """Period, quality factor and amplitude of the free wobble in the observed pole."""
    from earthspin.wobble import observed

    time, p = complex_pole(observed_pole)
    if np.ptp(p.real) == 0 and np.ptp(p.imag) == 0:
        raise UndefinedError("the pole stands still: there is no wobble in it")
    found = observed.fit(time, p, method)
    seen = observed.envelope(time, p, found.period, window)
    values = {
        "chandler_period": found.period * DAY,
        "chandler_period_error": found.period_error * DAY,
        "chandler_amplitude": abs(seen.chandler) * MAS,
        "chandler_amplitude_error": seen.error * MAS,
        "chandler_phase": np.unwrap(np.angle(seen.chandler)),
        "annual_amplitude": abs(seen.annual) * MAS,
        "annual_retrograde_amplitude": abs(seen.annual_retrograde) * MAS,
        "mean_pole": np.column_stack([seen.drift.real, -seen.drift.imag]) * MAS,
    }
    result = build(
        CHANDLER | (QUALITY if found.gives_quality else {}),
        values | (_quality(found) if found.gives_quality else {}),
        coords={
            "middle": ("middle", _stamps(seen.time), {"long_name": "middle of a window"}),
            "axis": ("axis", ["x", "y"]),
        },
    )
    result.chandler_period.attrs["method"] = method
    if not found.gives_quality:
        result.chandler_period.attrs["quality_factor"] = "refused: a sinusoid cannot give it"
    return result


def _quality(found: WobbleFit) -> dict[str, float]:
    low, high = found.quality_bounds
    return {
        "chandler_quality_factor": found.quality_factor,
        "chandler_quality_factor_low": low,
        "chandler_quality_factor_high": high,
    }


def complex_pole(pole: xr.Dataset) -> tuple[FloatArray, NDArray[np.complex128]]:
    """Days from J2000.0 and x - i y in mas of labelled polar motion, whole and in order.

    Raises
    ------
    SceneError
        If it has no x and y with units along time, or its days repeat or go back.
    """
    _need_series(pole, ("x", "y"), ("arcsec", "mas"))
    time = _days_in_order(pole)
    for name in ("x", "y"):
        largest = float(abs(si(pole[name])).max())
        if largest > 2 * ARCSEC:
            raise SceneError(
                f"largest {name}",
                f"{largest / ARCSEC:.3g} arcsec",
                "polar motion stays below one; is the unit right?",
            )
    return time, (si(pole.x).values - 1j * si(pole.y).values) / MAS


def _days_in_order(series: xr.Dataset) -> FloatArray:
    """Days from J2000.0 of a series, which may not go back.

    Raises
    ------
    SceneError
        If days repeat or go back, or there are fewer than two.
    """
    if series.time.size < 2:
        raise SceneError("time", f"{series.time.size} days", "give two or more")
    time = days(series.time, Where("time"))
    if np.any(np.diff(time) <= 0):
        bad = series.time.values[1:][np.diff(time) <= 0][0]
        raise SceneError(
            "time",
            str(bad),
            "days repeat or go back; sort them with ds.sortby('time') and drop "
            "copies with ds.drop_duplicates('time')",
        )
    return time


def _need_series(given: Any, names: tuple[str, str], units: tuple[str, ...]) -> None:
    """Refuse what is no Dataset with two series along time that say their units."""
    if not hasattr(given, "data_vars"):
        raise SceneError(
            "series", type(given).__name__, f"give a Dataset with {' and '.join(names)}"
        )
    for name in names:
        if name not in given or given[name].dims != ("time",):
            raise SceneError(
                "series", list(map(str, given.data_vars)), f"'{name}' along 'time' is needed"
            )
        unit = given[name].attrs.get("units")
        if given[name].dtype.kind != "f" or given["time"].dtype.kind != "M":
            raise SceneError(
                name, str(given[name].dtype), "give numbers along dates without a zone"
            )
        if unit not in units:
            allowed = " or ".join(f"'{u}'" for u in units)
            raise SceneError(f"units of {name}", unit, f"say in attrs whether it is in {allowed}")


def _stamps(days: FloatArray) -> NDArray[np.datetime64]:

    return datetime64(days)


@part
def neglected() -> Neglected:
    """What observations leave out."""
    return Neglected(what="nothing: the pole as it was observed")


made_of(
    PolarMotion,
    answer=observed_pole,
    sections={"chandler": chandler, "neglected": neglected},
)

polar_motion = ask(PolarMotion)


# --- calls on labelled series --------------------------------------------------------------------

_DAYS = Number("d", "433 d", above=0.0)
_PURE = Number("", "100", above=0.0)


def fit_chandler(ds: xr.Dataset, *, method: str = "burg", window: Any = None) -> xr.Dataset:
    """Period, quality factor and amplitude of the free wobble in polar motion.

    Parameters
    ----------
    ds : Dataset
        `x` and `y` over `time`, evenly spaced, with units ("arcsec" or "mas").
    method : str
        ``"burg"``, ``"likelihood"``, or ``"least-squares"``, which gives no quality factor.
    window : duration, optional
        Length of the sliding windows (a number is in days); one beat of annual and free wobble by
        default.

    Returns
    -------
    Dataset
        `chandler_period` (d) and `chandler_quality_factor`, `..._low`, `..._high` with 95 %
        intervals; over `time`, the middles of the windows, `chandler_amplitude` (mas) and
        its phase, the annual amplitudes and the mean pole.

    Raises
    ------
    EarthspinError
        If the series is uneven, has no numbers, or is too short; it says how long is needed.
    """
    word = kind_of(Method).read(method, Where("method"))
    length = None if window is None else _DAYS.read(window, Where("window"))
    return chandler(ds, word, length).rename(middle="time")


CHI = {
    "chi1": Variable(_TIME, "mas", "excitation, towards the prime meridian"),
    "chi2": Variable(_TIME, "mas", "excitation, towards 90 degrees east"),
}
POLE = {
    "x": Variable(_TIME, "arcsec", "pole, towards the prime meridian"),
    "y": Variable(_TIME, "arcsec", "pole, towards 90 degrees west"),
}


def excitation(ds: xr.Dataset, *, period: Any = 433.0, quality_factor: Any = 100.0) -> xr.Dataset:
    """Excitation that polar motion asks for: exact means over each step.

    Parameters
    ----------
    ds : Dataset
        `x` and `y` over `time`, evenly spaced.
    period : duration
        Of the free wobble; a number is in days.
    quality_factor : float

    Returns
    -------
    Dataset
        `chi1`, `chi2` (mas) over `time`, the middles of the steps.

    Raises
    ------
    EarthspinError
        If the series is uneven or has no numbers.
    """
    from earthspin.wobble import resonance as ex

    days, q = _DAYS.read(period, Where("period")), _PURE.read(quality_factor, _Q)
    time, p = complex_pole(ds)
    step = _even_step(time)
    chi = ex.excitation(p, step, ex.chandler_frequency(days, q))
    result = build(
        CHI,
        {"chi1": chi.real * MAS, "chi2": chi.imag * MAS},
        coords={"time": ("time", _stamps(time[:-1] + step / 2), _SCALE)},
    )
    result.attrs |= {
        "chandler_period": days,
        "chandler_quality_factor": q,
        "start_x": float(p[0].real),
        "start_y": float(-p[0].imag),
        "start_day": float(time[0]),
        "step": step,
        "comment": "means over the step (d) around each time; start of the pole in mas and in days "
        "from J2000.0",
    }
    return result


_Q = Where("quality_factor")


def polar_motion_from(
    chi: xr.Dataset, *, period: Any = None, quality_factor: Any = None, start: Any = None
) -> xr.Dataset:
    """Polar motion that an excitation drives: the inverse of `excitation`.

    Parameters
    ----------
    chi : Dataset
        `chi1`, `chi2` (mas) over `time`, means over even steps.
    period, quality_factor : duration, float, optional
        Of the free wobble (a number is in days); those that `excitation` noted by default.
    start : pair of angles, optional
        x and y at the start (a number is in mas); as noted, or zero.

    Returns
    -------
    Dataset
        `x`, `y` (arcsec) over `time`, the ends of the steps.

    Raises
    ------
    EarthspinError
        If the series is uneven or has no numbers, or the free wobble is not known.
    """
    from earthspin.wobble import resonance as ex

    _need_series(chi, ("chi1", "chi2"), ("mas",))
    known = chi.attrs
    period = known.get("chandler_period") if period is None else period
    q = known.get("chandler_quality_factor") if quality_factor is None else quality_factor
    if period is None or q is None:
        raise SceneError("period", period, "give period and quality_factor of the free wobble")
    time = _days_in_order(chi)
    step = _even_step(time)
    if abs(known.get("step", step) - step) > SAME_DAY:
        raise SceneError("time", f"steps of {step:g} d", f"the means are over {known['step']:g} d")
    if start is None:
        noted = known.get("start_day")
        if noted is not None and abs(noted - (time[0] - step / 2)) > SAME_DAY:
            raise SceneError(
                "start", None, "the series begins at another day than was noted; give it"
            )
        start = (known.get("start_x", 0.0), known.get("start_y", 0.0))
    x, y = Numbers("mas", "50 mas", (2,)).read(start, Where("start"))
    s = ex.chandler_frequency(_DAYS.read(period, Where("period")), _PURE.read(q, _Q))
    driving = (si(chi.chi1).values + 1j * si(chi.chi2).values) / MAS
    p = ex.polar_motion_from(driving, step, s, complex(x, -y))
    ends = time[0] - step / 2 + step * np.arange(p.size)
    return build(
        POLE,
        {"x": p.real * MAS, "y": -p.imag * MAS},
        coords={"time": ("time", _stamps(ends), _SCALE)},
    )


def read_excitation(path: str | Path) -> xr.Dataset:
    """Read effective angular momentum functions in the common ASCII layout.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Dataset
        `chi1`, `chi2` (mas) over `time`: mass and motion terms together.

    Raises
    ------
    SeriesError
        If the file cannot be used; it names the line.
    """
    from earthspin.sky.eop import read_angular_momentum

    read = read_angular_momentum(path)
    return build(
        CHI,
        {"chi1": read.chi.real, "chi2": read.chi.imag},
        coords={"time": ("time", _stamps(read.mjd - _MJD), _SCALE)},
    )


def _even_step(time: FloatArray) -> float:
    """Spacing of even times, d."""
    steps = np.diff(time)
    if steps.size == 0 or np.any(abs(steps - steps[0]) > SAME_DAY):
        raise SceneError(
            "time", "uneven steps", "fill the gaps first: the exact pair needs even ones"
        )
    return float((time[-1] - time[0]) / steps.size)
