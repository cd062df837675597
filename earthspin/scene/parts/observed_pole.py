"""Observed polar motion, the free wobble in it, and what excites it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.bodies import IAU_2006
from earthspin.dataset import Variable, with_error
from earthspin.errors import SceneError, nearest
from earthspin.scene.part import Part

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene
    from earthspin.wobble.observed import WobbleFit

#: The table [polar_motion] and what it holds by default.
SETTINGS: dict[str, Any] = {"file": "c04", "kind": None, "method": "burg", "window": None}
_SCALE = {"long_name": "time", "comment": "0h UTC in daily tables"}


def observed_pole(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Coordinates of the pole from a table of the IERS."""
    from earthspin.constants import NORMAL_95
    from earthspin.dataset import build
    from earthspin.sky.eop import read_polar_motion

    settings = _settings(scene)
    series = read_polar_motion(settings["file"], settings["kind"])
    if scene.span is not None:
        from earthspin.units import span_days

        first, last = span_days(scene.span, scene.source) + 51544.5
        series = series.between(float(first), float(last))
    body = scene.body
    result = build(
        "polar-motion",
        POLAR_MOTION.gives,
        {
            "x": series.x,
            "y": series.y,
            "x_error": NORMAL_95 * series.x_error,
            "y_error": NORMAL_95 * series.y_error,
            "polar_radius": body.needed("radius") * (1 - body.needed("flattening")),
        },
        coords={"time": ("time", _stamps(series.mjd), _SCALE)},
    )
    for name in ("x", "y"):
        result[name].attrs["references"] = f"IERS {series.name}"
        result[name].attrs["repairs"] = series.repairs or "none"
    return result


def chandler(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Period, quality factor and amplitude of the free wobble in what was read."""
    settings = _settings(scene)
    window = settings["window"]
    if window is not None:
        from earthspin.constants import DAY
        from earthspin.units import seconds

        window = seconds(window, f"{scene.source}: polar_motion.window") / DAY
    return chandler_in(given["polar-motion"], settings["method"], window)


def chandler_in(pole: xr.Dataset, method: str, window: float | None) -> xr.Dataset:
    """Find the free wobble in labelled polar motion.

    Parameters
    ----------
    pole : Dataset
        `x`, `y` along `time`.
    method : str
    window : float or None
        Of the amplitude, d.
    """
    import numpy as np

    from earthspin.constants import DAY, MAS
    from earthspin.dataset import build
    from earthspin.wobble import observed

    if method not in observed.METHODS:
        raise SceneError("method", method, nearest(method, observed.METHODS))
    time, p = complex_pole(pole)
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
    schema = dict(CHANDLER.gives)
    if found.gives_quality:
        schema |= QUALITY
        values |= _quality(found)
    result = build(
        "chandler",
        schema,
        values,
        coords={
            "middle": ("middle", _stamps(seen.time + 51544.5), {"long_name": "middle of a window"}),
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


def complex_pole(pole: xr.Dataset) -> tuple[Any, Any]:
    """Days from J2000.0 and x - i y in mas of labelled polar motion, whole and even."""
    import numpy as np

    from earthspin.constants import ARCSEC, MAS
    from earthspin.dataset import si
    from earthspin.units import days

    for name in ("x", "y"):
        if name not in pole or pole[name].dims != ("time",):
            raise SceneError(
                "polar motion", list(map(str, pole.data_vars)), f"'{name}' along 'time' is needed"
            )
        if pole[name].attrs.get("units") not in ("arcsec", "mas"):
            raise SceneError(
                f"units of {name}",
                pole[name].attrs.get("units"),
                "say in attrs whether it is in 'arcsec' or 'mas'",
            )
        largest = float(abs(si(pole[name])).max())
        if largest > 2 * ARCSEC:
            raise SceneError(
                f"largest {name}",
                f"{largest / ARCSEC:.3g} arcsec",
                "polar motion stays below one; is the unit right?",
            )
    time = days(pole.time)
    if np.any(np.diff(time) <= 0):
        bad = pole.time.values[1:][np.diff(time) <= 0][0]
        raise SceneError(
            "time",
            str(bad),
            "days repeat or go back; sort them with ds.sortby('time') and drop "
            "copies with ds.drop_duplicates('time')",
        )
    return time, (si(pole.x).values - 1j * si(pole.y).values) / MAS


def _stamps(mjd: Any) -> Any:
    from earthspin.units import datetime64

    return datetime64(mjd - 51544.5)


def _settings(scene: Scene) -> dict[str, Any]:
    table = dict((scene.tables or {}).get("polar_motion", {}))
    for key, value in table.items():
        if key not in SETTINGS:
            raise SceneError(
                f"polar_motion.{key}", value, nearest(key, SETTINGS), source=scene.source
            )
    return SETTINGS | table


def _not_observed(scene: Scene) -> str | None:
    known = scene.body.pole == IAU_2006
    return None if known else f"no polar motion of {scene.body.name} is kept"


_TIME = ("time",)
_MIDDLE = ("middle",)

POLAR_MOTION = Part(
    name="polar-motion",
    does="observed polar motion from a table of the IERS",
    function="earthspin.scene.parts.observed_pole:observed_pole",
    keys=("body", "span", "tables"),
    left_out=_not_observed,
    gives={
        **with_error("x", Variable(_TIME, "arcsec", "pole, towards the prime meridian")),
        **with_error("y", Variable(_TIME, "arcsec", "pole, towards 90 degrees west")),
        "polar_radius": Variable((), "m", "polar radius of the body"),
    },
)

CHANDLER = Part(
    name="chandler",
    does="period, quality factor and amplitude of the free wobble in the observed pole",
    function="earthspin.scene.parts.observed_pole:chandler",
    needs=("polar-motion",),
    keys=("tables",),
    gives={
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
    },
)

QUALITY = {
    "chandler_quality_factor": Variable((), "1", "quality factor of the free wobble"),
    "chandler_quality_factor_low": Variable((), "1", "lower end of its 95 % interval"),
    "chandler_quality_factor_high": Variable(
        (), "1", "upper end of its 95 % interval", (("comment", "infinite if open"),)
    ),
}

CHI = {
    "chi1": Variable(_TIME, "mas", "excitation, towards the prime meridian"),
    "chi2": Variable(_TIME, "mas", "excitation, towards 90 degrees east"),
}

POLE = {
    "x": Variable(_TIME, "arcsec", "pole, towards the prime meridian"),
    "y": Variable(_TIME, "arcsec", "pole, towards 90 degrees west"),
}


def excitation_of(pole: xr.Dataset, period: float, quality_factor: float) -> xr.Dataset:
    """Mean excitation between labelled positions of the pole."""
    from earthspin.constants import MAS
    from earthspin.dataset import build
    from earthspin.wobble import resonance as ex

    time, p = complex_pole(pole)
    step = _even_step(time)
    chi = ex.excitation(p, step, ex.chandler_frequency(period, quality_factor))
    result = build(
        "excitation",
        CHI,
        {"chi1": chi.real * MAS, "chi2": chi.imag * MAS},
        coords={"time": ("time", _stamps(time[:-1] + step / 2 + 51544.5), _SCALE)},
    )
    result.attrs |= {
        "chandler_period": float(period),
        "chandler_quality_factor": float(quality_factor),
        "start_x": float(p[0].real),
        "start_y": float(-p[0].imag),
        "comment": "means over the step around each time; start of the pole in mas",
    }
    return result


def pole_from(
    chi: xr.Dataset,
    period: float | None,
    quality_factor: float | None,
    start: tuple[float, float] | None,
) -> xr.Dataset:
    """Polar motion that labelled excitation drives."""
    import numpy as np

    from earthspin.constants import MAS
    from earthspin.dataset import build, si
    from earthspin.units import days
    from earthspin.wobble import resonance as ex

    known = chi.attrs
    for name in ("chi1", "chi2"):
        if name not in chi or chi[name].attrs.get("units") != "mas":
            raise SceneError(
                "excitation", list(map(str, chi.data_vars)), f"'{name}' in mas, please"
            )
    period = known.get("chandler_period") if period is None else period
    quality_factor = (
        known.get("chandler_quality_factor") if quality_factor is None else quality_factor
    )
    if period is None or quality_factor is None:
        raise SceneError("period", period, "give period (d) and quality_factor of the free wobble")
    x, y = start or (known.get("start_x", 0.0), known.get("start_y", 0.0))
    time = days(chi.time)
    step = _even_step(time)
    driving = (si(chi.chi1).values + 1j * si(chi.chi2).values) / MAS
    s = ex.chandler_frequency(period, quality_factor)
    p = ex.polar_motion_from(driving, step, s, complex(x, -y))
    ends = time[0] - step / 2 + step * np.arange(p.size)
    return build(
        "polar-motion-from",
        POLE,
        {"x": p.real * MAS, "y": -p.imag * MAS},
        coords={"time": ("time", _stamps(ends + 51544.5), _SCALE)},
    )


def excitation_from_file(path: Any) -> xr.Dataset:
    """Labelled excitation from a file of effective angular momentum functions."""
    from earthspin.dataset import build
    from earthspin.sky.eop import read_angular_momentum

    read = read_angular_momentum(path)
    return build(
        "read-excitation",
        CHI,
        {"chi1": read.chi.real, "chi2": read.chi.imag},
        coords={"time": ("time", _stamps(read.mjd), _SCALE)},
    )


def _even_step(time: Any) -> float:
    import numpy as np

    steps = np.diff(time)
    if steps.size == 0 or np.any(abs(steps - steps[0]) > 1e-6):
        raise SceneError(
            "time", "uneven steps", "fill the gaps first: the exact pair needs even ones"
        )
    return float((time[-1] - time[0]) / steps.size)
