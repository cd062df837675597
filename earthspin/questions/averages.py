"""Torques averaged over orbits, and the resulting precession rates."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from earthspin._lazy import xr
from earthspin._version import version
from earthspin.bodies import Body, Numeric, checks
from earthspin.constants import DAY
from earthspin.engine import part
from earthspin.errors import ApartError
from earthspin.mass.figure import moment_difference
from earthspin.numerics.arrays import Estimate, FloatArray
from earthspin.questions import ellipse_chains as chains
from earthspin.questions.satellites import SatelliteFactors, satellite_factors, with_mean_pole
from earthspin.questions.sky import Interval, Sky
from earthspin.sky.elements import Elements
from earthspin.sky.poles import angle, rotate
from earthspin.torque import average, cassini, rates
from earthspin.torque.average import Window, best_window, precessing_torque, window_mean_and_error
from earthspin.torque.gravity import torque_from_declination

#: Time between samples. One day is enough, since torques have no strong period below four days:
#: with two days the rate is the same to 1e-12, with four days it differs by 3e-6.
SAMPLING = DAY  # s
#: Number of times at which the angular velocity of each perturber is sampled.
ORBIT_SAMPLES = 1000
#: Interval over which an angular velocity is measured, s.
VELOCITY_INTERVAL = 60.0
#: Safety factor for comparing periods: sampled orbital periods have errors of up to 4 %.
PERIOD_MARGIN = 1.1


@dataclass(frozen=True, eq=False)
class Samples:
    """Torques divided by C - A at equally spaced times, and the weight function for mean torques.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times, s from J2000.0 TDB.
    precessing : ndarray, shape (n, perturber)
        Precessing component of the torque per C - A, s-2.
    torque : ndarray, shape (n, perturber, 3)
        Torque per C - A in axes of equator and equinox of date, s-2.
    window : Window
        The window that converges fastest on this span, centred on the epoch.
    obliquity : float
        Obliquity of the axis to the orbit at the epoch, rad.
    inverse_cube : ndarray, shape (perturber,)
        Mean of 1/r3 of each perturber, m-3.
    slow_variation : ndarray, shape (perturber,)
        Relative error of each mean torque that neighbouring windows do not show: its variation on
        times longer than the window, or 1 if the window covers only a part of the orbit.
    unmeasured : tuple of str
        Perturbers whose positions have no measured error.
    no_error : str
        Reason why errors are missing; empty if none is.
    gm_array : DataArray or None
        GM along `perturber` if any is an array, else None; the torques are then for GM = 1.
    are_stored : bool
        Whether the samples are stored for later runs.
    """

    times: FloatArray
    precessing: FloatArray
    torque: FloatArray
    window: Window
    obliquity: float
    inverse_cube: FloatArray
    slow_variation: FloatArray
    unmeasured: tuple[str, ...] = ()
    no_error: str = ""
    gm_array: xr.DataArray | None = None
    are_stored: bool = False


@part(
    unless=chains.exact_means,
    same_for=lambda sky, interval, body, perturbers: sky.unchanged(
        body, *perturbers, also=interval
    ),
)
def torque_samples(
    sky: Sky, interval: Interval, body: Body, perturbers: tuple[Body, ...]
) -> Samples:
    """Compute the torque of each perturber, divided by C - A, at the sample times of the mean."""
    if chains.cases(body, perturbers)[0]:
        raise ApartError("windowed averages are computed for one orbit, pole and set of satellites")
    body = with_mean_pole(body)
    pole, orbit = body.needed("pole"), body.orbit_pole
    cycle = max(map(slowest_cycle, perturbers))
    periods, strongest = _orbital_periods(sky, interval, body, perturbers)
    if periods[strongest] > PERIOD_MARGIN * cycle:
        cycle = float(periods[strongest])
    window = best_window(interval.first * DAY, interval.last * DAY, cycle)
    # over a part of an orbit, the mean torque may have an error as large as itself
    covers_part = periods > PERIOD_MARGIN * window.length / average.FEWEST_CYCLES
    times = window.sample_times(SAMPLING)
    days = times / DAY

    normal = pole.orbit_normal(orbit)
    axis_at_epoch = sky.equator(body, np.array([window.centre / DAY]))[..., 2, :].reshape(3)
    _refuse_locked(sky, body, window.centre, axis_at_epoch)
    coordinates = sky.radec(body, days)
    gm_array = _varying_masses(body, perturbers)
    masses = {p.name: p.gm_on(body) if gm_array is None else 1.0 for p in perturbers}
    torques = [torque_from_declination(gm, 1.0, *coordinates[n]) for n, gm in masses.items()]
    # In axes of the equator of date, the figure axis is z and the orbit normal moves.
    axis = np.array([0.0, 0.0, 1.0])
    normals = rotate(sky.equator(body, days), np.broadcast_to(normal, (days.size, 3)))
    return Samples(
        times=times,
        precessing=np.stack([precessing_torque(t, axis, normals) for t in torques], axis=1),
        torque=np.stack(torques, axis=1),
        window=window,
        obliquity=angle(axis_at_epoch, normal),
        inverse_cube=np.array([np.mean(coordinates[p.name][2] ** -3.0) for p in perturbers]),
        slow_variation=np.where(covers_part, 1.0, [p.slow_swing for p in perturbers]),
        unmeasured=sky.unmeasured,
        no_error=sky.no_error,
        gm_array=gm_array,
        are_stored=sky.unchanged(body, *perturbers) is not None,
    )


def _orbital_periods(
    sky: Sky, interval: Interval, body: Body, perturbers: tuple[Body, ...]
) -> tuple[FloatArray, int]:
    """Period of revolution of perturbers about the body, s; index of the strongest perturber."""
    days = np.linspace(interval.first, interval.last, ORBIT_SAMPLES)[:-1]
    positions, later = sky.positions(days), sky.positions(days + VELOCITY_INTERVAL / DAY)
    periods, strengths = [], []
    for p in perturbers:
        r = positions[p.name]
        square = np.sum(r * r, axis=1)
        rotations = np.cross(r, later[p.name] - r) / square[:, np.newaxis]
        angle = np.linalg.norm(np.mean(rotations, axis=0))
        periods.append(2 * np.pi * VELOCITY_INTERVAL / angle if angle else 0.0)  # 0: it rests
        strengths.append(checks.largest(p.gm_on(body)) * np.mean(square**-1.5))
    return np.array(periods), int(np.argmax(strengths))


def _labels(perturbers: tuple[Body, ...]) -> list[str]:
    """Labels of the dimension `perturber`: the names of the perturbers, followed by "total"."""
    return [*(p.name for p in perturbers), "total"]


def _varying_masses(body: Body, perturbers: tuple[Body, ...]) -> xr.DataArray | None:
    """Values of GM of all perturbers in one array if any GM is an array; otherwise None."""
    if not any(hasattr(p.gm, "dims") for p in perturbers):
        return None
    return xr.concat(xr.broadcast(*(xr.DataArray(p.gm_on(body)) for p in perturbers)), "perturber")


def _cases(gm_array: xr.DataArray | None) -> dict[str, int]:
    """Return the lengths of the dimensions of `gm_array` by name, without `perturber`."""
    if gm_array is None:
        return {}
    return {str(dim): n for dim, n in gm_array.sizes.items() if dim != "perturber"}


def _refuse_locked(sky: Sky, body: Body, epoch: float, axis: FloatArray) -> None:
    """Refuse a body whose spin is locked to an orbit, because orbit averages do not apply."""
    first, last = (DAY * day for day in sky.coverage())
    for spin_period in np.ravel(body.needed("spin_period")):
        if abs(spin_period) < cassini.SLOW:
            continue
        # Enough time for the slowest resonance, as far as the kernel covers it.
        half = cassini.ORBITS * cassini.MOST_HALF_TURNS / 4 * abs(spin_period)
        times = np.linspace(max(epoch - half, first), min(epoch + half, last), 4001)
        spin_axis, spin_rate = np.sign(spin_period) * axis, 2 * np.pi / abs(spin_period)
        for name, position in sky.positions(times / DAY).items():
            turns = cassini.locked_ratio(times, position, spin_axis, spin_rate)
            if turns is not None:
                raise chains.locked_error(body, name, turns)


def slowest_cycle(perturber: Body) -> float:
    """Longest period in the torque of a perturber, s; an average must cover this period."""
    node_period = perturber.orbit is not None and perturber.orbit.node_period
    return float(max(perturber.cycle, abs(node_period or 0.0)))


@dataclass(frozen=True)
class MeanTorques:
    """Torques averaged over orbits and divided by C - A, for each perturber and in total.

    Attributes
    ----------
    labels : list of str
        Names of the perturbers, and "total" if there are several.
    precessing, precessing_error : ndarray, shape (label,) or (label, m)
        Precessing component and its half-width, s-2, for m cases if masses are arrays.
    torque, torque_error : ndarray, shape (label, 3) or (label, 3, m)
        Torque and its half-width in axes of equator and equinox of date, s-2.
    epoch : float
        Reference epoch, s from J2000.0 TDB.
    obliquity : float or DataArray
        Obliquity of the axis to the orbit at the epoch, rad; an array if orbits are arrays.
    inverse_cube : ndarray, shape (perturber,) or (perturber, m)
        Mean of 1/r3 of each perturber, m-3, for m cases if orbits are arrays.
    over, method : str
        Descriptions of the window, and of the window with the step.
    evaluations : int
        Number of epochs at which positions were evaluated.
    no_error : str
        Reason why errors are missing; empty if none is.
    provenance : mapping of str to str
        Attributes of the answer on the sources of the means, besides those of the sky.
    cases : mapping of str to int
        Dimensions of the m cases with their lengths; empty without arrays.
    """

    labels: list[str]
    precessing: FloatArray
    precessing_error: FloatArray
    torque: FloatArray
    torque_error: FloatArray
    epoch: float
    obliquity: Numeric
    inverse_cube: FloatArray
    over: str
    method: str
    evaluations: int
    no_error: str = ""
    provenance: Mapping[str, str] = field(default_factory=dict)
    cases: Mapping[str, int] = field(default_factory=dict)

    def inverse_cubes(self) -> list[Numeric]:
        """Mean of 1/r3 of each perturber, m-3: a number, or an array if orbits are arrays."""
        if self.inverse_cube.ndim == 1:
            return [*self.inverse_cube]
        shape = tuple(self.cases.values())
        return [xr.DataArray(row.reshape(shape), dims=[*self.cases]) for row in self.inverse_cube]


def _stored_samples(torque_samples: Samples, perturbers: tuple[Body, ...]) -> Hashable:
    return torque_samples if torque_samples.are_stored else None


@part(unless=chains.exact_means, same_for=_stored_samples)
def window_means(torque_samples: Samples, perturbers: tuple[Body, ...]) -> MeanTorques:
    """Mean torques, computed as weighted means of samples in a time window, with errors.

    The errors are estimates from neighbouring windows.
    """
    samples = torque_samples
    window, times = samples.window, samples.times
    unmeasured = [p.name in samples.unmeasured for p in perturbers]
    variation, gm_array = np.where(unmeasured, np.nan, samples.slow_variation), samples.gm_array
    gm = None if gm_array is None else gm_array.values.reshape(len(perturbers), -1)
    precessing = window_mean_and_error(window, times, samples.precessing, variation, gm)
    vector = window_mean_and_error(window, times, samples.torque, variation, gm)
    spacing = np.median(np.diff(times)) / DAY
    return MeanTorques(
        labels=_labels(perturbers),
        precessing=precessing[0],
        precessing_error=precessing[1],
        torque=vector[0],
        torque_error=vector[1],
        epoch=window.centre,
        obliquity=samples.obliquity,
        inverse_cube=samples.inverse_cube,
        over=window_words(window),
        method=f"{window_words(window)}, a sample each {spacing:g} d",
        evaluations=times.size,
        no_error=samples.no_error,
        cases=_cases(gm_array),
    )


@part(unless=chains.no_exact_means)
def orbit_means(body: Body, perturbers: tuple[Body, ...]) -> MeanTorques:
    """Exact mean torques of perturbers on precessing ellipses, for the spin axis at J2000.0.

    Each mean is over the orbit and the precession of its node.
    """
    sizes, each = chains.cases(body, perturbers)
    every = [_means_on_ellipses(*bodies) for bodies in each]
    if not sizes:
        return every[0]

    def stacked(name: str) -> FloatArray:
        return np.stack([getattr(means, name) for means in every], axis=-1)

    names = ("precessing", "precessing_error", "torque", "torque_error", "inverse_cube")
    obliquity = xr.DataArray(stacked("obliquity").reshape(*sizes.values()), dims=[*sizes])
    arrays: dict[str, Any] = {name: stacked(name) for name in names} | {"obliquity": obliquity}
    return replace(every[0], cases=sizes, **arrays)


def _means_on_ellipses(body: Body, perturbers: tuple[Body, ...]) -> MeanTorques:
    """Mean torques on a body with one orbit, under perturbers with one orbit each."""
    body = with_mean_pole(body)
    pole, now = body.needed("pole"), np.zeros(1)
    equator = pole.equator(body.orbit_pole, now).reshape(3, 3)
    axis, normal = equator[2], pole.orbit_normal(body.orbit_pole)
    by_name = chains.ellipse_chains(body, perturbers)
    gm_array = _varying_masses(body, perturbers)
    torques, errors, inverse_cube = [], [], []
    for p in perturbers:
        ((ellipse, _),) = by_name[p.name].ellipses
        forward = ellipse.sidereal_motion * float(np.sign(ellipse.normal @ axis))
        for spin_rate in np.ravel(body.spin_rate):
            turns = cassini.locked_turns(float(spin_rate), forward)
            if turns is not None:
                raise chains.locked_error(body, p.name, turns)
        square = (
            average.mean_square_of_normal(ellipse.plane.matrix[2], ellipse.i)
            if ellipse.node_rate
            else np.outer(ellipse.normal, ellipse.normal)
        )
        gm = float(p.gm_on(body)) if gm_array is None else 1.0
        tide = average.mean_tide(gm, ellipse.a, ellipse.e, square)
        torques.append(average.mean_torque(tide, axis))
        mean_orbit = (p if p.orbit is not None else body).needed("orbit").rate_error or 0.0
        errors.append(average.rounding(tide) + mean_orbit * float(np.linalg.norm(torques[-1])))
        inverse_cube.append((ellipse.a**2 * (1 - ellipse.e**2)) ** -1.5)
    vectors, error = np.stack(torques), np.array(errors)
    if gm_array is not None:
        factor = gm_array.values.reshape(len(perturbers), -1)
        vectors = vectors[:, np.newaxis] * factor[..., np.newaxis]
        error = error[:, np.newaxis] * factor
    vectors = average.with_total(vectors[np.newaxis])[0]
    error = average.with_total(error[np.newaxis])[0]
    obliquity = angle(axis, normal)
    return MeanTorques(
        labels=_labels(perturbers),
        precessing=average.precessing_torque(vectors, axis, normal),
        precessing_error=error / math.sin(obliquity),
        torque=np.moveaxis(vectors @ equator.T, -1, 1),
        torque_error=np.repeat(error[:, np.newaxis], 3, axis=1),
        epoch=0.0,
        obliquity=obliquity,
        inverse_cube=np.array(inverse_cube),
        over="all revolutions of each orbit by its elements",
        method="exact means of orbits by their elements",
        evaluations=len(perturbers),
        provenance=Elements().provenance | {"pyerfa_version": version("pyerfa")},
        cases=_cases(gm_array),
    )


@part
def mean_torques(
    window_means: MeanTorques | None = None, orbit_means: MeanTorques | None = None
) -> MeanTorques:
    """Mean torques divided by C - A: exact means for elliptic orbits, otherwise windowed means."""
    return next(filter(None, (window_means, orbit_means)))  # a plan has one of the two


@dataclass(frozen=True)
class MeanRates:
    """Precession rates and mean torques by perturber and in total.

    The numbers are labelled arrays if a body or mass is an array, else plain arrays, which are
    faster.

    Attributes
    ----------
    means : MeanTorques
        Mean torques, with the labels of the perturbers.
    rate : Estimate
        Precession rate, rad/s.
    torque : Estimate
        Magnitude of the mean torque, N m.
    ratio : ndarray or DataArray
        Rate relative to that of the first perturber.
    second_order : float
        Bound on the second-order part of the total rate, which the average neglects, rad/s; the
        largest of an array.
    gm_over_r3 : float or DataArray
        Sum of GM <1/r3> of the perturbers, s-2.
    satellite_factors : SatelliteFactors
        Contribution of the satellites of the body.
    """

    means: MeanTorques
    rate: Estimate
    torque: Estimate
    ratio: Numeric
    second_order: float
    gm_over_r3: Numeric
    satellite_factors: SatelliteFactors

    def total(self) -> tuple[Numeric, Numeric]:
        """Total precession rate due to all perturbers, and error of that rate, rad/s."""
        return of_perturber(self.rate.value), of_perturber(self.rate.error)


def of_perturber(values: Numeric, index: int = -1) -> Numeric:
    """Select the value of one perturber by its index; by default the last value, the total."""
    if hasattr(values, "dims"):
        return values.isel(perturber=index, drop=True)
    return values[index]


@part
def mean_rates(mean_torques: MeanTorques, body: Body, perturbers: tuple[Body, ...]) -> MeanRates:
    """Precession rates and mean torques from averages over orbits, by perturber, with errors.

    With satellites they are those of the body and its satellites together.
    """
    means = mean_torques
    array = _labeller(means) if body.labelled or means.cases else np.asarray
    uncertainties = [p.relative_uncertainty.get("gm", 0.0) for p in perturbers]
    u_gm = array(rates.total_uncertainty(means.precessing, uncertainties))
    pairs = zip(perturbers, means.inverse_cubes(), strict=True)
    gm_over_r3 = sum(p.gm_on(body) * inverse_cube for p, inverse_cube in pairs)
    moons = satellite_factors(body, gm_over_r3, means.obliquity)
    rate = rates.precession_estimate(
        array(means.precessing),
        array(means.precessing_error),
        body.needed("dynamical_flattening") * moons.rate,
        body.spin_rate,
        # H = J2/C: satellites add to C, and their part of it has no uncertainty
        body.relative_uncertainty.get("dynamical_flattening", 0.0) / moons.moment,
        np.hypot(u_gm, moons.uncertainty),
    )
    by_orbit = sum(
        abs(of_perturber(rate.value, index)) / ((body.gm_on(p) + p.gm_on(body)) * inverse) ** 0.5
        for index, (p, inverse) in enumerate(zip(perturbers, means.inverse_cubes(), strict=True))
    )
    total = abs(of_perturber(rate.value))
    by_spin = abs(total / body.spin_rate)
    checks.refuse_fast_axis(by_orbit, by_spin)
    torque = rates.torque_estimate(
        array(np.linalg.norm(means.torque, axis=1)),
        array(np.linalg.norm(means.torque_error, axis=1)),
        moment_difference(body.needed("j2"), body.mass, body.needed("radius")) * moons.bulge,
        body.relative_uncertainty_of_bulge(),
        np.hypot(u_gm, moons.bulge_uncertainty),
    )
    return MeanRates(
        means=means,
        rate=rate,
        torque=torque,
        ratio=array(rates.rate_ratio(means.precessing)),
        second_order=checks.largest(checks.SECOND_ORDER_BOUND * (by_orbit + by_spin) * total),
        gm_over_r3=gm_over_r3,
        satellite_factors=moons,
    )


def _labeller(means: MeanTorques) -> Callable[[FloatArray], xr.DataArray]:
    """Return a function that converts arrays to DataArrays with the dimensions of `means`."""
    dims, shape = ("perturber", *means.cases), (len(means.labels), *means.cases.values())
    labels = {"perturber": means.labels}
    return lambda values: xr.DataArray(np.reshape(values, shape), labels, dims)


#: Parts that compute `mean_rates` from the sky, for questions that use them.
MEANS = (torque_samples, window_means, orbit_means, mean_torques, mean_rates)


def window_words(window: Window) -> str:
    """Describe the time window of an average in words: taper, number of cycles, cycle length."""
    return f"{window.taper} taper over {window.cycles:g} cycles of {window.cycle / DAY:.2f} d"
