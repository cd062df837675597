"""Paths of angular momentum, rotation and figure axes, with errors and comparison to the IAU."""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import BODIES, PLANETS, Body, planets
from earthspin.constants import ARCSEC, ARCSEC_PER_YEAR, DAY, EPSILON_0, JULIAN_YEAR, NORMAL_95
from earthspin.dates import Epochs, Span, Step
from earthspin.engine import key, part
from earthspin.engine.variables import Variables, amplitude, labels, number, words
from earthspin.errors import UndefinedError
from earthspin.motion import axes
from earthspin.motion.axes import AxisPath
from earthspin.motion.effects import GEODESIC, NONRIGID, TRIAXIALITY
from earthspin.motion.forces import fastest_sweep
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation import analysis, rate_budget
from earthspin.nutation.analysis import Circles, PoleAnalysis, Secular
from earthspin.progress import progress
from earthspin.questions import satellites, time_axes
from earthspin.questions.effects_and_torques import Attractors, AxisMotion, forces_of, kernel_file
from earthspin.questions.interior_response import CHOSEN, Prediction, no_layers, prediction
from earthspin.questions.reasons import no_iau_model, not_the_iaus_earth
from earthspin.sky import iau_models
from earthspin.sky.kernel import DRIFT_FROM, growth

if TYPE_CHECKING:
    from earthspin.nutation.response import Response


#: Shortest span that is analysed. Paths with the fitted response differ from IAU 2006/2000A by 0.7
#: mas with 50 years of DE421, 1 to 3 mas with 45, 9 to 11 with 40 and 150 with 35.
SHORTEST_SPAN = 45 * JULIAN_YEAR / DAY  # d
#: Reason why periods of terms have no error.
ARGUMENTS = "it follows from the adopted arguments of IERS 2003"
_SHARE = "share of the neighbour in the amplitude of IAU 2000A"
_SERIES = "coefficients of the adopted series"


@part
def axis_path(
    attractors: Attractors,
    epochs: Epochs,
    effects: tuple[str, ...],
    interior_shift: Shift | None = None,
) -> AxisPath:
    """Integrate the motion of the body's axes from J2000.0 to all dates, by Picard iteration.

    With the response of the interior, the rigid axes start such that their mean pole agrees with
    that of the IAU.
    """
    attractors.sky.check_times(epochs.span(), attractors.targets)
    epoch = attractors.epoch
    axis = attractors.start if interior_shift is None else interior_shift.start
    first, last = epochs.span()
    span = first * DAY, last * DAY
    forces = forces_of(attractors, effects)
    with progress("pole", axes.window_count(epoch, span, axes.WINDOW)) as advance:
        return axes.axis_path(forces, axis, epoch, span, limits=attractors.limits, advance=advance)


def direction_errors(
    path: AxisPath,
    figure: FloatArray,
    days: FloatArray,
    epochs: Epochs,
    attractors: Attractors,
    shift: Shift | None,
) -> dict[str, FloatArray]:
    """95 % half-widths of the axis directions along a path, rad: total, and by error source.

    Parameters
    ----------
    path : AxisPath
    figure : ndarray, shape (t, 3)
        Figure axes.
    days : ndarray, shape (t,)
        Their times, days from J2000.0.
    epochs : TimeGrid or TimeList
        All times of the series; the error of the positions depends on the most distant ones.
    attractors : Attractors
    shift : Shift or None
        Response of the interior; None for a rigid body.

    Returns
    -------
    dict of str to ndarray, shape (t,)
        By variable, rad. The total also holds the errors from the response of the interior and from
        the nodes of the body's satellites, which stay at their mean.
    """
    body, epoch = attractors.body, attractors.epoch
    positions = attractors.sky.positions(np.array([epoch / DAY]))
    distance = {name: float(np.linalg.norm(position)) for name, position in positions.items()}
    drift = max(attractors.sky.drift(name, r) for name, r in distance.items())
    nearest = [(attractors.gm[name], r) for name, r in distance.items()]
    speed = fastest_sweep(body.number("dynamical_flattening"), float(body.spin_rate), nearest)
    sky_error = axes.error_of_sky(path, figure, drift, speed, DRIFT_FROM)
    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    method = np.nan if attractors.sky.unmeasured else path.error
    causes = {
        "direction_error_method": np.full(days.size, method),
        "direction_error_input": axes.error_of_input(path, figure, u_h),
        "direction_error_kernel": max(map(growth, epochs.span())) * sky_error,
    }
    response = np.zeros(days.size) if shift is None else shift.half_width(days)
    errors = (*causes.values(), response, displacement_bound(attractors, days * DAY - epoch))
    return {"direction_error": np.sqrt(sum(error**2 for error in errors)), **causes}


def displacement_bound(attractors: Attractors, elapsed: FloatArray) -> FloatArray:
    """Largest displacement of the axis by satellite nodes and neglected or uncertain rates, rad.

    Satellites displace it by their nodes, and by the uncertainty of the rate that they add. The
    published effects on the rate that are not modelled are added. Zero without satellites.

    Parameters
    ----------
    attractors : Attractors
    elapsed : ndarray, shape (t,)
        Times from the start, s.
    """
    body = attractors.body
    obliquity = satellites.obliquity_of(body) if body.satellites else None
    if obliquity is None:
        return np.zeros(elapsed.size)
    gm_over_r3 = attractors.mean_gm_over_r3()
    nutations = satellites.node_nutations(body, gm_over_r3, obliquity)
    by_node = satellites.displacements(nutations, elapsed).values()
    total = np.sum([*by_node, np.zeros(elapsed.size)], axis=0)
    published = planets.LEFT_OUT_OF_RATES.get(body.known_as, {}) if body.is_as_named else {}
    rate = sum(abs(rate.value) * ARCSEC_PER_YEAR for rate in published.values())
    common = satellites.common_precession(body, gm_over_r3)
    rate += common[1] if common else 0.0
    return np.asarray(total + rate * math.sin(obliquity) * np.abs(elapsed))


def continuous_longitude(
    path: AxisPath, first: float, ecliptic: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Start times of integration windows, s, and continuous longitude of angular momentum, rad.

    The longitude is continuous, and equals the principal value at the time `first`, s.
    """
    psi = np.unwrap(analysis.on_fixed_ecliptic(path.at_starts(), ecliptic)[:, 0])
    times = path.windows.edges[:-1]
    axis = path.at(np.array([first]))["angular_momentum"]
    principal = analysis.on_fixed_ecliptic(axis, ecliptic)[0, 0]
    difference = np.interp(first, times, psi) - principal
    return times, psi - 2 * np.pi * np.rint(difference / (2 * np.pi))


# --- comparison with the IAU ---------------------------------------------------------------------


class WithInterior(AxisMotion):
    """Base class of computations that can include the response of the Earth's interior."""

    def known_effects(self) -> tuple[str, ...]:
        """Names of effects on a rigid body, plus the interior's response if the body is the Earth.

        These are the effects that can be computed. The response requires that Sun and Moon are the
        perturbers, and that none of the three bodies has an orbit of its own, or a mass, figure or
        spin that differs from that of the built-in body by more than 1 %. After smaller changes the
        error includes the difference of the pole from that of the IAU.
        """
        known = super().known_effects()
        usual = all(p.is_as_named and p.orbit is p.position is None for p in self.perturbers)
        if not usual or self.body.orbit or not_the_iaus_earth(self.body, self.perturbers):
            return known
        kernel = kernel_file(self.ephemeris)
        members = (self.body, *self.perturbers, *(BODIES[name] for name in PLANETS))
        if kernel is not None and kernel.holds(member.naif for member in members):
            codes = [kernel.code(member.naif, member.name) for member in members]
            first, last = analysed_span(kernel.coverage(codes))
            if last - first < SHORTEST_SPAN:
                return known
        return (*known, NONRIGID.name)


class Comparison(WithInterior):
    """Base class of comparisons of the computed pole with the IAU pole over time."""

    span: Span = key(
        ("1980-01-01T12:00:00", "2020-01-01T12:00:00"),
        doc="first and last date of the residuals, TDB",
    )
    step: Step = key("5 d", doc="interval between residuals")


@dataclass(frozen=True)
class PoleComparison:
    """Computed pole and pole of IAU 2006/2000A, each separated into precession and nutation.

    Attributes
    ----------
    days : ndarray, shape (t,)
        Days from J2000.0.
    start : ndarray, shape (3,)
        Initial axis, for which the computed mean pole agrees with that of the IAU at the epoch.
    epoch : float
        J2000.0, or the nearest time with positions, s from J2000.0 TDB.
    path : AxisPath
        Rigid path with all effects that are switched on.
    analysis : PoleAnalysis
    computed, iau : Secular
        Secular motion of the computed pole, and of that of the IAU.
    computed_circles, iau_circles : Circles
        Circular nutations of the computed pole, and of that of the IAU.
    difference : ndarray, shape (t,), complex
        The computed rigid pole minus that of IAU 2006/2000A, dpsi sin(eps0) + i deps, rad.
    """

    days: FloatArray
    start: FloatArray
    epoch: float
    path: AxisPath
    analysis: PoleAnalysis
    computed: Secular
    iau: Secular
    computed_circles: Circles
    iau_circles: Circles
    difference: ComplexArray


def steady_figure(path: AxisPath, days: FloatArray) -> FloatArray:
    """Unit vectors of the figure axis without the semidiurnal motion, shape (t, 3)."""
    return path.at(days * DAY, semidiurnal=False)["figure"]


def path_over(
    attractors: Attractors, effects: Sequence[str], start: FloatArray, days: FloatArray
) -> AxisPath:
    """Integrate the motion of the rigid body's axes over a range of days.

    Semidiurnal terms are left out. Positions of the perturbers are stored for the next run.
    """
    steady = [effect for effect in rigid(effects) if effect != TRIAXIALITY.name]
    forces = forces_of(attractors, steady, keep=True)
    span = days[0] * DAY, days[-1] * DAY
    return axes.axis_path(forces, start, attractors.epoch, span, limits=attractors.limits)


def iau_nutation(
    attractors: Attractors, epochs: Epochs
) -> tuple[FloatArray, FloatArray, FloatArray, ComplexArray]:
    """Pole and nutation of IAU 2006/2000A at the days of a series.

    Returns
    -------
    days : ndarray, shape (t,)
        Days from J2000.0.
    ends : ndarray, shape (2,)
        First and last day of an interval that includes the series and J2000.0.
    pole : ndarray, shape (t, 3)
        Unit vectors in the GCRS.
    eta : ndarray, shape (t,), complex
        Nutation dpsi sin(eps0) + i deps, rad.

    Raises
    ------
    EarthspinError
        If the series does not fit into memory, or lies outside the source of positions.
    """
    days = time_axes.days_of(epochs)
    first, last = epochs.span()
    ends = np.array([min(first, 0.0), max(last, 0.0)])
    attractors.sky.check_times(ends, attractors.targets)
    pole = iau_models.at_days(iau_models.true_pole, days)
    return days, ends, pole, analysis.complex_nutation(iau_models.nutation_of(pole, days))


def residual_error(
    comparison: PoleComparison, body: Body, eta: ComplexArray, days: FloatArray
) -> float:
    """95 % half-width of computed minus IAU nutation, the same for both nutation angles, rad.

    It is due to the integration, the uncertainty of H, and interpolation.
    """
    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    error = math.hypot(comparison.path.error, NORMAL_95 * u_h * float(np.max(np.abs(eta))))
    return math.hypot(error, iau_models.node_error(days))


def rigid(effects: Sequence[str]) -> list[str]:
    """Select the effects that apply to a rigid body: all except the non-rigid response."""
    return [effect for effect in effects if effect != NONRIGID.name]


def same_paths(attractors: Attractors, effects: tuple[str, ...], **inputs: object) -> Hashable:
    """Cache key: equal if `path_over` would give the same path; None if inputs may change."""
    sky = attractors.sky
    perturbers = *attractors.gm.items(), *attractors.targets.items(), *sky.reach.items()
    return sky.unchanged(attractors.body, also=(perturbers, attractors.limits, *rigid(effects)))


@dataclass(frozen=True)
class IAUPole:
    """IAU 2006/2000A pole over the analysed days, separated into secular part and circular terms.

    Attributes
    ----------
    days : ndarray, shape (t,)
        Days from J2000.0.
    nutation : ndarray, shape (t,), complex
        Nutation of the pole of IAU 2006/2000A, dpsi sin(eps0) + i deps, rad.
    analysis : PoleAnalysis
        Analysis for these days.
    secular : Secular
        Secular motion of the pole of IAU 2006/2000A.
    circles : Circles
        Circular terms of the original IAU 2000A.
    """

    days: FloatArray
    nutation: ComplexArray
    analysis: PoleAnalysis
    secular: Secular
    circles: Circles


def analysed_span(limits: tuple[float, float]) -> tuple[float, float]:
    """Part of a span of known positions in which nutation is analysed, days from J2000.0.

    Over more than four periods of the node in each direction, slow changes are no short polynomial.
    """
    first, *_, last = iau_models.SERIES_DAYS
    return max(limits[0], first), min(limits[1], last + iau_models.SERIES_STEP)


@part(
    unless=no_iau_model,
    same_for=lambda attractors: attractors.limits,
    loads=("erfa", "scipy.sparse.linalg"),
)
def iau_pole(attractors: Attractors) -> IAUPole:
    """Separate the IAU pole over up to 150 years into a secular part and circular terms."""
    first, last = analysed_span((attractors.limits[0] / DAY, attractors.limits[1] / DAY))
    if last - first < SHORTEST_SPAN:
        years, needed = (days * DAY / JULIAN_YEAR for days in (last - first, SHORTEST_SPAN))
        problem = f"the positions cover {max(years, 0.0):.1f} years near J2000.0"
        problem += f", and the analysis of nutation needs {needed:.0f}"
        raise UndefinedError(f"{problem}; give a longer ephemeris, or remove the effect nonrigid")
    days, pole, original = iau_models.pole_and_nutation(first, last)
    arguments = iau_models.delaunay_arguments(days)
    analyse = PoleAnalysis(
        days, arguments, iau_models.delaunay_rates(), iau_models.fixed_ecliptic()
    )
    nutation = analysis.complex_nutation(iau_models.nutation_of(pole, days))
    circles = analyse.circles(analysis.complex_nutation(original))
    return IAUPole(days, nutation, analyse, analyse.secular(pole), circles)


@part(unless=no_iau_model, same_for=same_paths)
def comparison(
    attractors: Attractors, effects: tuple[str, ...], iau_pole: IAUPole
) -> PoleComparison:
    """Separate the computed pole over up to 150 years into precession and circular terms.

    The initial axis is corrected so that the mean poles agree at the start.
    """
    days, analyse = iau_pole.days, iau_pole.analysis
    start, epoch = attractors.start, attractors.epoch

    def integrate(start: FloatArray) -> tuple[AxisPath, FloatArray]:
        path = path_over(attractors, effects, start, days)
        return path, steady_figure(path, days)

    with progress("analysis", 2) as advance:
        _, pole = integrate(start)
        advance(1)
        secular, t = analyse.secular(pole), epoch / analysis.CENTURY
        start = analysis.shifted_start(start, secular, iau_pole.secular, analyse.ecliptic, t)
        path, pole = integrate(start)
        advance(1)
    eta = analysis.complex_nutation(iau_models.nutation_of(pole, days))
    return PoleComparison(
        days=days,
        start=start,
        epoch=epoch,
        path=path,
        analysis=analyse,
        computed=analyse.secular(pole),
        iau=iau_pole.secular,
        computed_circles=analyse.circles(eta),
        iau_circles=iau_pole.circles,
        difference=eta - iau_pole.nutation,
    )


class IAUTerms(Variables, along=("term",)):
    """Periods and IAU 2000A amplitudes of the largest circular nutation terms."""

    period = number(
        "d", "period of the circle in space, negative if retrograde", no_error=ARGUMENTS
    )
    iau = amplitude(
        "mas",
        "amplitude of IAU 2000A, with the share of the neighbour (no published value)",
        error="amplitude_error",
    )
    amplitude_error = number(
        "mas", "95 % half-width of an amplitude, without the share of the neighbour"
    )
    neighbour = words("term that 150 years cannot separate from this one; empty if there is none")
    neighbour_in_phase = number("mas", f"{_SHARE}, in phase", no_error=_SERIES)
    neighbour_out_of_phase = number("mas", f"{_SHARE}, out of phase", no_error=_SERIES)
    term = labels()


def largest_terms(poles: PoleComparison, count: int) -> tuple[NDArray[np.intp], dict[str, Any]]:
    """Largest circular nutation terms of the computed pole, and the same terms of IAU 2000A.

    Returns
    -------
    order : ndarray, shape (count,)
        Indices of these terms among the circles.
    columns : dict of str
        Variables of a table of terms: periods, amplitudes of IAU 2000A with their half-widths, and
        the neighbours that this span does not separate from them.
    """
    computed = poles.computed_circles
    order = np.argsort(-np.abs(computed.amplitude))[:count]
    sky = iau_models.delaunay_rates(), iau_models.delaunay_arguments(np.zeros(1))[:, 0]
    names, amplitude = analysis.neighbours_of(computed.multiples, computed.frequency, *sky)
    neighbour_in, neighbour_out = analysis.phases(amplitude[order])
    return order, {
        "period": 2 * np.pi / computed.frequency[order],
        "iau": analysis.phases(poles.iau_circles.amplitude[order]),
        "amplitude_error": analysis.amplitude_error(computed.frequency[order]),
        "neighbour": [names[row] for row in order],
        "neighbour_in_phase": neighbour_in,
        "neighbour_out_of_phase": neighbour_out,
        "term": analysis.term_names(computed.multiples[order]),
    }


@part
def core_response(comparison: PoleComparison, body: Body) -> Response:
    """Fit the resonance formula T so that T times rigid amplitudes matches those of IAU 2000A."""
    computed, iau = comparison.computed_circles, comparison.iau_circles
    return _response_between(computed, computed.amplitude, iau.amplitude, body)


def _response_between(
    circles: Circles, rigid: ComplexArray, nonrigid: ComplexArray, body: Body
) -> Response:
    """Fit the transfer function that relates rigid to non-rigid amplitudes of nutation terms."""
    from earthspin.nutation.response import fit_response

    used, h, spin = _circles_for_fit(circles), body.number("dynamical_flattening"), body.spin_rate
    return fit_response(circles.frequency[used], rigid[used], nonrigid[used], h, float(spin))


def _circles_for_fit(circles: Circles) -> NDArray[np.bool_]:
    """Select the circular nutation terms that the fit of the transfer function uses (mask).

    These are all except the prograde annual term.
    """
    from earthspin.nutation.response import SUN_SYNCHRONOUS

    return np.asarray(np.any(circles.multiples != SUN_SYNCHRONOUS, axis=1))


@dataclass(frozen=True)
class ResponseFit:
    """Interior response fitted to IAU 2000A after removal of terms not caused by the interior.

    Attributes
    ----------
    response : Response
        Response fitted to IAU 2000A without `added` and geodesic nutation.
    used : ndarray, shape (k,), bool
        Circles in the fit: all except the prograde annual term, whose published addition in IAU
        2000A is not exact.
    rigid : ndarray, shape (k,), complex
        Rigid amplitude of each circle from torques, without geodesic nutation, rad.
    residual : ndarray, shape (k,), complex
        Residual of each circle of IAU 2000A, without geodesic nutation, rad.
    added : ndarray, shape (k,), complex
        Published additive term of each circle, rad; 0 for most circles.
    """

    response: Response
    used: NDArray[np.bool_]
    rigid: ComplexArray
    residual: ComplexArray
    added: ComplexArray


@part(same_for=same_paths, loads=("earthspin.nutation.response",))
def response_fit(
    comparison: PoleComparison, attractors: Attractors, effects: tuple[str, ...]
) -> ResponseFit:
    """Fit the resonance formula to IAU 2000A without geodesic nutation and additive terms."""
    from earthspin.nutation.response import added_to

    computed, iau = comparison.computed_circles, comparison.iau_circles.amplitude
    rigid_amplitude = computed.amplitude
    if GEODESIC.name in effects:
        # The interior does not respond to a rotation of the frame, which is no torque.
        others = [effect for effect in effects if effect != GEODESIC.name]
        path = path_over(attractors, others, comparison.start, comparison.days)
        pole = steady_figure(path, comparison.days)
        eta = analysis.complex_nutation(iau_models.nutation_of(pole, comparison.days))
        rigid_amplitude = comparison.analysis.circles(eta).amplitude
    iau = iau - (computed.amplitude - rigid_amplitude)
    added = added_to(computed.multiples)
    response = _response_between(computed, rigid_amplitude, iau - added, attractors.body)
    residual = iau - response.transfer(computed.frequency) * rigid_amplitude
    return ResponseFit(response, _circles_for_fit(computed), rigid_amplitude, residual, added)


@dataclass(frozen=True)
class Shift:
    """Displacement of the axes due to the non-rigid interior, to be added to the rigid solution.

    Attributes
    ----------
    start : ndarray, shape (3,)
        Initial axis of the rigid path, for which its mean pole agrees with that of the IAU.
    epoch : float
        Epoch of the initial axis, s from J2000.0 TDB.
    circles : Circles
        Non-rigid minus rigid nutation, as a sum of circles.
    rate : float
        Published contribution to the precession rate, times sin(eps0), rad/s.
    closure : float
        Rate of the difference between the path and IAU 2006/2000A, rad/s.
    residual : float
        Half-width that, combined with the closure, contains 95 % of the differences from IAU
        2006/2000A, rad.
    fitted_residual : float
        Half-width that contains 95 % of the differences after a constant and a rate are removed,
        rad.
    """

    start: FloatArray
    epoch: float
    circles: Circles
    rate: float
    closure: float
    residual: float
    fitted_residual: float

    def apply(self, directions: dict[str, FloatArray], days: FloatArray) -> None:
        """Add the precession and nutation due to the non-rigid interior to the axes, in place.

        Nutation does not move the angular momentum.
        """
        precession = self.rate * (days * DAY - self.epoch)
        nutation = self.circles.at(iau_models.delaunay_arguments(days))
        for name, axis in directions.items():
            nutates = 0.0 if name == "angular_momentum" else 1.0
            shift = precession + nutates * nutation
            directions[name] = iau_models.moved_by_nutation(axis, shift, days)

    def half_width(self, days: FloatArray) -> FloatArray:
        """95 % half-width of axis directions due to errors of the response and rates, rad."""
        return np.hypot(self.residual, self.closure * (days * DAY - self.epoch))


def _shift(comparison: PoleComparison, amplitude: ComplexArray, effects: Sequence[str]) -> Shift:
    """Build the axis displacement (`Shift`) from the amplitudes of non-rigid minus rigid nutation.

    Its errors follow from the difference from the IAU pole.
    """
    circles = replace(comparison.computed_circles, amplitude=amplitude)
    published, sine = rate_budget.published_effects(), np.sin(EPSILON_0.value * ARCSEC)
    # The published rate of the response is applied. The rates of effects that are switched off are
    # listed as neglected, and are not part of the error.
    missing = sum(rate for name, rate in published.items() if name not in rigid(effects))
    elapsed = comparison.days * DAY - comparison.epoch
    difference = comparison.difference + circles.at(iau_models.delaunay_arguments(comparison.days))
    difference += missing * sine * elapsed
    pair = np.stack([difference.real, difference.imag], axis=1)
    line = np.polynomial.polynomial.polyfit(elapsed, pair, 1)
    closure = float(np.linalg.norm(line[1]))
    remainder = np.abs(difference) ** 2 - (closure * elapsed) ** 2
    residual = math.sqrt(max(0.0, float(np.quantile(remainder, 0.95))))
    rest = np.linalg.norm(pair - line[0] - np.outer(elapsed, line[1]), axis=1)
    fitted_residual = float(np.quantile(rest, 0.95))
    rate, start = published[NONRIGID.name] * sine, comparison.start
    return Shift(start, comparison.epoch, circles, rate, closure, residual, fitted_residual)


@part
def fitted_shift(
    comparison: PoleComparison, response_fit: ResponseFit, effects: tuple[str, ...]
) -> Shift:
    """Axis displacement due to core, mantle, oceans and atmosphere, fitted to IAU 2000A."""
    factor = response_fit.response.transfer(comparison.computed_circles.frequency) - 1
    amplitude = response_fit.rigid * factor + response_fit.added
    return _shift(comparison, amplitude, effects)


@part(unless=no_layers)
def predicted_shift(
    comparison: PoleComparison, prediction: Prediction, effects: tuple[str, ...]
) -> Shift:
    """Axis displacement due to the non-rigid interior, predicted from its layers."""
    circles = comparison.computed_circles
    factor = prediction.transfer(CHOSEN, circles.frequency) - 1
    return _shift(comparison, circles.amplitude * factor, effects)


#: Parts that compute the shift due to the interior, for questions that use them.
INTERIOR = (iau_pole, comparison, response_fit, fitted_shift, prediction, predicted_shift)
