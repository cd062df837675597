"""Torques sampled over a window, and averaged over orbits to rates of precession."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable, with_error
from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import refuse_unkept

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

    from earthspin.scene.choosing import AverageChoice
    from earthspin.scene.spec import Scene
    from earthspin.torque.average import Window
    from earthspin.torque.rates import Estimate

#: A day apart is dense enough: torques have no strong period under four days (two days give
#: the same rate to 1e-12, four days are off by 3e-6).
SAMPLING = 86400.0  # s


@dataclass(frozen=True)
class Samples:
    """Torques per unit of C - A, evenly sampled about the reference epoch.

    Attributes
    ----------
    times : ndarray, shape (n,)
        s from J2000.0 TDB.
    labels : list of str
        The perturbers, and their total if there are several.
    push : ndarray, shape (n, perturber)
        Share of the torque per C - A that makes the axis precess, s-2.
    torque : ndarray, shape (n, perturber, 3)
        Torque per C - A, along equator and equinox of date, s-2.
    window : Window
        The window that converges fastest on this span; its centre is the epoch.
    obliquity : float
        Of the axis to the orbit at the epoch, rad.
    """

    times: NDArray[np.float64]
    labels: list[str]
    push: NDArray[np.float64]
    torque: NDArray[np.float64]
    window: Window
    obliquity: float


def sample_torques(scene: Scene, given: Mapping[str, Any]) -> Samples:
    """Sample the torque of each perturber over the widest window about the epoch."""
    import numpy as np

    from earthspin.constants import DAY
    from earthspin.sky.equator import angle, equator_of_date, orbit_normal, rotate
    from earthspin.torque.average import best_window, precessing_push
    from earthspin.torque.gravity import torque_from_position

    sky, body = given["ephemeris"], scene.body
    pole, orbit = body.needed("pole"), body.orbit_pole
    cycle = max(p.cycle for p in scene.perturbers)
    window, step = best_window(sky.span[0] * DAY, sky.span[1] * DAY, cycle), SAMPLING
    choice = given.get("chosen-average")
    if choice is not None:
        window, step = replace(window, cycles=choice.settings["cycles"]), choice.settings["step"]
    times = window.sample_times(step)
    days = times / DAY

    equator, normal = equator_of_date(pole, orbit, days), orbit_normal(pole, orbit)
    axis = equator[..., 2, :]
    axis_at_epoch = equator_of_date(pole, orbit, np.array([window.centre / DAY]))[..., 2, :]
    positions = sky.positions(days)
    torques = [torque_from_position(p.gm, 1.0, positions[p.name], axis) for p in scene.perturbers]
    names = [p.name for p in scene.perturbers]
    return Samples(
        times=times,
        labels=names + ["total"] * (len(names) > 1),
        push=np.stack([precessing_push(t, axis, normal) for t in torques], axis=1),
        torque=np.stack([rotate(equator, t) for t in torques], axis=1),
        window=window,
        obliquity=angle(axis_at_epoch.reshape(3), normal),
    )


def mean_rates(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Average, and turn the averages into rates, periods and torques, each with its error."""
    import numpy as np
    import xarray as xr

    from earthspin.constants import DAY
    from earthspin.dataset import build
    from earthspin.mass.inertia import moment_difference
    from earthspin.torque import rates
    from earthspin.torque.average import window_mean_and_error
    from earthspin.units import datetime64

    samples, body = given["torque-samples"], scene.body
    window, times = samples.window, samples.times

    def along(values: Any) -> xr.DataArray:
        return xr.DataArray(values, {"perturber": samples.labels}, ("perturber",))

    swing = np.array([p.slow_swing for p in scene.perturbers])
    of_push, of_torque = _measured_errors(scene, given.get("chosen-average"))
    push, push_error = window_mean_and_error(window, times, samples.push, swing, of_push)
    if of_push is not None and times[1] - times[0] == SAMPLING:
        # daily samples: what the neighbours say counts as well, where it is less
        _, by_neighbours = window_mean_and_error(window, times, samples.push, swing)
        push_error = np.minimum(push_error, by_neighbours)
    vector, vector_error = window_mean_and_error(window, times, samples.torque, swing, of_torque)
    u_each = [p.relative_uncertainty.get("gm", 0.0) for p in scene.perturbers]
    u_gm = along(rates.total_uncertainty(push, u_each))
    rate = rates.precession_estimate(
        along(push),
        along(push_error),
        body.needed("dynamical_flattening"),
        body.spin_rate,
        body.relative_uncertainty.get("dynamical_flattening", 0.0),
        u_gm,
    )
    _check_accuracy(scene, rate)
    torque = rates.torque_estimate(
        along(np.linalg.norm(vector, axis=-1)),
        along(np.linalg.norm(vector_error, axis=-1)),
        moment_difference(body.needed("j2"), body.mass, body.needed("radius")),
        body.relative_uncertainty_of_bulge(),
        u_gm,
    )
    result = build(
        "mean-rates",
        MEAN_RATES.gives,
        {
            "precession_rate": rate.value,
            "precession_rate_error": rate.error,
            "precession_rate_error_method": rate.method,
            "precession_rate_error_input": rate.given,
            "precession_period": rates.period(rate.value),
            "precession_period_error": rates.period_error(rate.value, rate.error),
            "rate_ratio": rates.rate_ratio(push),
            "mean_torque": torque.value,
            "mean_torque_error": torque.error,
            "obliquity": samples.obliquity,
            "reference_epoch": datetime64(np.array(window.centre / DAY)),
        },
    )
    taken = f"{window.taper} taper over {window.cycles:g} cycles of {window.cycle / DAY:.2f} d"
    result["precession_rate"].attrs["window"] = taken
    result["precession_rate_error"].attrs |= {
        "method": f"{taken}, a sample each {np.median(np.diff(times)) / DAY:g} d",
        "evaluations": times.size,
    }
    return result


def _measured_errors(
    scene: Scene, choice: AverageChoice | None
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | tuple[None, None]:
    """Errors of push and torque of each perturber as measured for a choice, s-2."""
    import numpy as np

    if choice is None:
        return None, None
    names = [p.name for p in scene.perturbers]
    of_push = [choice.push_errors[name] for name in names]
    return np.array(of_push), np.array([choice.torque_errors[name] for name in names])


def convergence(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Averaged rate of all perturbers against the length of the window, for each taper."""
    import numpy as np
    import xarray as xr

    from earthspin.dataset import build
    from earthspin.torque import rates
    from earthspin.torque.average import convergence_curve

    samples, body = given["torque-samples"], scene.body
    window = samples.window
    cycles = np.linspace(1.0, window.cycles, CURVE_POINTS)
    curves = convergence_curve(window, samples.times, samples.push.sum(axis=1), cycles)
    push = xr.DataArray(
        np.stack(list(curves.values())),
        {"window": list(curves), "window_cycles": cycles},
        ("window", "window_cycles"),
    )
    rate = rates.precession_rate(push, body.needed("dynamical_flattening"), body.spin_rate)
    length = xr.DataArray(cycles * window.cycle, {"window_cycles": cycles}, ("window_cycles",))
    return build(
        "convergence", CONVERGENCE.gives, {"rate_by_window": rate, "window_length": length}
    )


def _check_accuracy(scene: Scene, rate: Estimate) -> None:
    """Refuse a relative accuracy that the total does not reach, and say what takes most of it."""
    from earthspin.errors import UndefinedError

    if scene.accuracy is None:
        return
    if not (rate.value.isel(perturber=-1) != 0).all():
        raise UndefinedError("the rate is zero and has no relative error; leave accuracy out")
    method, given, best = (
        float((share / abs(rate.value)).isel(perturber=-1).max())
        for share in (rate.method, rate.given, rate.error)
    )
    remedy = (
        f"the given numbers are known to {given:.2g}: give the body a better known H"
        if given > method
        else f"the average is known to {method:.2g}: give a longer span"
    )
    refuse_unkept(scene.accuracy, best, "(relative)", remedy)


_PERTURBER = ("perturber",)
_OVER_WINDOW = (("cell_methods", "time: mean (weighted by the taper)"),)

TORQUE_SAMPLES = Part(
    name="torque-samples",
    does="torque of each perturber through the window that converges fastest",
    function="earthspin.scene.parts.averaging:sample_torques",
    needs=("ephemeris",),
    uses=("chosen-average",),
    keys=("body", "perturbers", "ephemeris", "span"),
)

MEAN_RATES = Part(
    name="mean-rates",
    does="averages over orbits: rate, period, mean torque, with errors",
    function="earthspin.scene.parts.averaging:mean_rates",
    needs=("torque-samples",),
    uses=("chosen-average",),
    keys=("accuracy",),
    gives={
        **with_error(
            "precession_rate",
            Variable(
                _PERTURBER,
                "arcsec/yr",
                "rate of precession in longitude along the fixed orbit",
                _OVER_WINDOW,
            ),
            split=True,
        ),
        **with_error(
            "precession_period", Variable(_PERTURBER, "yr", "time for one turn of precession")
        ),
        "rate_ratio": Variable(_PERTURBER, "1", "rate over that of the first perturber"),
        **with_error(
            "mean_torque",
            Variable(_PERTURBER, "N m", "magnitude of the mean torque vector", _OVER_WINDOW),
        ),
        "obliquity": Variable((), "deg", "angle between spin axis and orbit normal at the epoch"),
        "reference_epoch": Variable((), "", "epoch that the averages refer to (TDB)"),
    },
)

CURVE_POINTS = 81

CONVERGENCE = Part(
    name="convergence",
    does="averaged rate against the length of the window, plain mean and tapers",
    function="earthspin.scene.parts.averaging:convergence",
    needs=("torque-samples",),
    gives={
        "rate_by_window": Variable(
            ("window", "window_cycles"), "arcsec/yr", "rate of precession of all perturbers"
        ),
        "window_length": Variable(("window_cycles",), "yr", "length of the averaging window"),
    },
)
