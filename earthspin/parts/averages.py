"""Torques averaged over orbits, and the rates of precession that follow from them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import Body, in_a_sentence
from earthspin.constants import DAY
from earthspin.engine.part import part
from earthspin.errors import UndefinedError
from earthspin.parts.sky import Sky, Stretch

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.choosing.averages import Averaging
    from earthspin.choosing.choice import Choice
    from earthspin.torque.average import Window
    from earthspin.torque.rates import Estimate

#: A day apart is dense enough: torques have no strong period under four days (two days give
#: the same rate to 1e-12, four days are off by 3e-6).
SAMPLING = DAY  # s


@dataclass(frozen=True)
class Samples:
    """Torques per unit of C - A, evenly sampled about the reference epoch.

    Attributes
    ----------
    times : ndarray, shape (n,)
        s from J2000.0 TDB.
    labels : list of str
        The perturbers, and their total if there are several.
    precessing : ndarray, shape (n, perturber)
        Share of the torque per C - A that makes the axis precess, s-2.
    torque : ndarray, shape (n, perturber, 3)
        Torque per C - A, along equator and equinox of date, s-2.
    window : Window
        The window that converges fastest on this span; its centre is the epoch.
    obliquity : float
        Of the axis to the orbit at the epoch, rad.
    unmeasured : tuple of str
        Perturbers of whose positions no error was ever measured.
    no_error : str
        That, in words; empty if there are none.
    """

    times: NDArray[np.float64]
    labels: list[str]
    precessing: NDArray[np.float64]
    torque: NDArray[np.float64]
    window: Window
    obliquity: float
    unmeasured: tuple[str, ...] = ()
    no_error: str = ""


@part
def torque_samples(
    sky: Sky,
    stretch: Stretch,
    body: Body,
    perturbers: tuple[Body, ...],
    chosen_average: Choice[Averaging] | None = None,
) -> Samples:
    """Torque of each perturber through the window that converges fastest."""
    from earthspin.sky.equator import angle, rotate
    from earthspin.torque.average import best_window, precessing_torque
    from earthspin.torque.gravity import torque_from_position

    pole, orbit = body.needed("pole"), body.orbit_pole
    cycle = max(p.cycle for p in perturbers)
    window, step = best_window(stretch.first * DAY, stretch.last * DAY, cycle), SAMPLING
    if chosen_average is not None:
        chosen = chosen_average.settings
        window, step = replace(window, cycles=chosen.cycles), chosen.step
    times = window.sample_times(step)
    days = times / DAY

    equator, normal = sky.equator(body, days), pole.orbit_normal(orbit)
    axis = equator[..., 2, :]
    axis_at_epoch = sky.equator(body, np.array([window.centre / DAY]))[..., 2, :]
    _refuse_locked(sky, body, window.centre, axis_at_epoch.reshape(3))
    positions = sky.positions(days)
    torques = [torque_from_position(p.gm, 1.0, positions[p.name], axis) for p in perturbers]
    names = [p.name for p in perturbers]
    return Samples(
        times=times,
        labels=names + ["total"] * (len(names) > 1),
        precessing=np.stack([precessing_torque(t, axis, normal) for t in torques], axis=1),
        torque=np.stack([rotate(equator, t) for t in torques], axis=1),
        window=window,
        obliquity=angle(axis_at_epoch.reshape(3), normal),
        unmeasured=sky.unmeasured,
        no_error=sky.no_error,
    )


def _refuse_locked(sky: Sky, body: Body, epoch: float, axis: NDArray[np.float64]) -> None:
    """Refuse a spin that is locked to the orbit about a perturber: its average is another."""
    from earthspin.torque import locking

    first, last = (DAY * day for day in sky.coverage())
    for spin_period in np.ravel(body.needed("spin_period")):
        if abs(spin_period) < locking.SLOW:
            continue
        # so many orbits of the slowest lock, as far as the kernel covers them
        half = locking.ORBITS * locking.MOST_HALF_TURNS / 4 * abs(spin_period)
        times = np.linspace(max(epoch - half, first), min(epoch + half, last), 4001)
        spin_axis, spin_rate = np.sign(spin_period) * axis, 2 * np.pi / abs(spin_period)
        for name, position in sky.positions(times / DAY).items():
            turns = locking.locked_ratio(times, position, spin_axis, spin_rate)
            if turns is not None:
                raise UndefinedError(
                    f"{in_a_sentence(body.name)} turns {turns:g} times in each orbit with "
                    f"'{name}': an average over orbits does not hold for a spin that is locked"
                )


@dataclass(frozen=True)
class MeanRates:
    """Averages over orbits, along `perturber`; the last one is of all.

    Attributes
    ----------
    rate : Estimate
        Of precession, rad/s.
    torque : Estimate
        Magnitude of the mean torque, N m.
    ratio : ndarray
        Rate over that of the first perturber.
    method : str
        Window and sampling in words.
    evaluations : int
        Epochs at which the sky was evaluated.
    no_error : str
        Why errors are not given; empty if they are.
    """

    rate: Estimate
    torque: Estimate
    ratio: NDArray[np.float64]
    method: str
    evaluations: int
    no_error: str

    def total(self) -> tuple[xr.DataArray, xr.DataArray]:
        """Rate by all perturbers and its error, rad/s."""
        value, error = (
            of.isel(perturber=-1, drop=True) for of in (self.rate.value, self.rate.error)
        )
        return value, error


@part
def mean_rates(
    torque_samples: Samples,
    body: Body,
    perturbers: tuple[Body, ...],
    chosen_average: Choice[Averaging] | None = None,
) -> MeanRates:
    """Averages over orbits: rate, period, mean torque, with errors."""
    import xarray as xr

    from earthspin.mass.inertia import moment_difference
    from earthspin.torque import rates
    from earthspin.torque.average import window_mean_and_error

    samples = torque_samples
    window, times = samples.window, samples.times

    def along(values: NDArray[np.float64]) -> xr.DataArray:
        return xr.DataArray(values, {"perturber": samples.labels}, ("perturber",))

    swing = np.array([np.nan if p.name in samples.unmeasured else p.slow_swing for p in perturbers])
    of_precessing, of_torque = _measured_errors(perturbers, chosen_average)
    precessing, precessing_error = window_mean_and_error(
        window, times, samples.precessing, swing, of_precessing
    )
    if of_precessing is not None and times[1] - times[0] == SAMPLING:
        # daily samples: what the neighbours say counts as well, where it is less
        _, by_neighbours = window_mean_and_error(window, times, samples.precessing, swing)
        precessing_error = np.minimum(precessing_error, by_neighbours)
    vector, vector_error = window_mean_and_error(window, times, samples.torque, swing, of_torque)
    u_each = [p.relative_uncertainty.get("gm", 0.0) for p in perturbers]
    u_gm = along(rates.total_uncertainty(precessing, u_each))
    rate = rates.precession_estimate(
        along(precessing),
        along(precessing_error),
        body.needed("dynamical_flattening"),
        body.spin_rate,
        body.relative_uncertainty.get("dynamical_flattening", 0.0),
        u_gm,
    )
    torque = rates.torque_estimate(
        along(np.linalg.norm(vector, axis=-1)),
        along(np.linalg.norm(vector_error, axis=-1)),
        moment_difference(body.needed("j2"), body.mass, body.needed("radius")),
        body.relative_uncertainty_of_bulge(),
        u_gm,
    )
    spacing = np.median(np.diff(times)) / DAY
    return MeanRates(
        rate=rate,
        torque=torque,
        ratio=rates.rate_ratio(precessing),
        method=f"{taken(window)}, a sample each {spacing:g} d",
        evaluations=times.size,
        no_error=samples.no_error,
    )


def taken(window: Window) -> str:
    """A window in words."""
    return f"{window.taper} taper over {window.cycles:g} cycles of {window.cycle / DAY:.2f} d"


def _measured_errors(
    perturbers: tuple[Body, ...], choice: Choice[Averaging] | None
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | tuple[None, None]:
    """Errors of the precessing torque and of all torque, as measured for a choice, s-2."""
    if choice is None:
        return None, None
    of_precessing = [choice.settings.precessing_errors[p.name] for p in perturbers]
    return np.array(of_precessing), np.array(
        [choice.settings.torque_errors[p.name] for p in perturbers]
    )
