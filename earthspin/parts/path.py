"""The three axes of a body followed in time, and what separates ours from the IAU's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import Body
from earthspin.choosing.choice import Choice
from earthspin.choosing.windows import PoleWindows
from earthspin.constants import ARCSEC, DAY, EPSILON_0, JULIAN_YEAR, NORMAL_95
from earthspin.dates import Epochs, Span, Step
from earthspin.engine.part import part
from earthspin.engine.question import key
from earthspin.errors import UndefinedError
from earthspin.motion import axes
from earthspin.motion.axes import AxisPath
from earthspin.motion.effects import GEODESIC, NONRIGID
from earthspin.motion.figure import fastest_sweep
from earthspin.nutation.angles import followed, on_fixed_ecliptic
from earthspin.nutation.budget import published_effects
from earthspin.parts.predicted import CHOSEN, Prediction, no_layers, prediction
from earthspin.parts.pulls import AxisMotion, Pulls, forces_of, start_of
from earthspin.parts.reasons import no_accuracy, no_iau_model
from earthspin.parts.times import days_of
from earthspin.progress import progress
from earthspin.sky.kernel_differences import DRIFT_FROM, growth
from earthspin.units import FloatArray

if TYPE_CHECKING:
    from earthspin.nutation.analysis import PoleAnalysis, Secular
    from earthspin.nutation.circles import Circles
    from earthspin.nutation.response import Response

ComplexArray = NDArray[np.complex128]

#: Half of the stretch about J2000.0 that is analysed, as far as the kernel has it: four turns of
#: the node each way, in which slow changes are a short polynomial.
HALF_SPAN = 27200.0  # d
#: Shortest stretch that is analysed. Paths with the fitted response depart from IAU 2006/2000A by
#: 0.7 mas with 50 years of DE421, 1 to 3 mas with 45, 9 to 11 with 40 and 150 with 35.
SHORTEST_SPAN = 45 * JULIAN_YEAR / DAY  # d
SAMPLING = 4.0  # d

#: Times at which errors are looked at at once.
_AT_ONCE = 1 << 16


@part
def axis_path(
    pulls: Pulls,
    epochs: Epochs,
    body: Body,
    effects: tuple[str, ...],
    accuracy: float | None,
    chosen_windows: list[Choice[PoleWindows]] | None = None,
    interior_shift: Shift | None = None,
) -> AxisPath:
    """The axes from J2000.0 to the times wanted: Picard iteration on Gauss windows.

    The windows that were chosen are taken if they will do, the finest otherwise. With the response
    of the interior the rigid axes start where their mean pole meets that of the IAU.
    """
    start = None if interior_shift is None else interior_shift.start
    tried: list[AxisPath] = []
    for choice in (*(chosen_windows or ()), None):
        try:
            path = _follow(body, pulls, effects, epochs, choice, start)
        except UndefinedError:
            if choice is None and not tried:
                raise
            continue  # windows that are too wide for the slow manifold of this spin
        tried.append(path)
        if choice and PathErrors(path, epochs, body, pulls).total <= (accuracy or 0.0):
            break
    if len(tried) == 1:
        return tried[0]
    return min(tried, key=lambda path: PathErrors(path, epochs, body, pulls).total)


@dataclass(frozen=True)
class Errors:
    """95 % half-widths of directions by what they come from, rad.

    Attributes
    ----------
    method, given, kernel, response : ndarray, shape (t,)
        From the integration, from the uncertainty of H, from the positions of the bodies, from the
        response of the interior (0 for a rigid body).
    """

    method: FloatArray
    given: FloatArray
    kernel: FloatArray
    response: FloatArray

    @property
    def total(self) -> FloatArray:
        """Root sum of squares of all shares."""
        return np.asarray(
            np.sqrt(self.method**2 + self.given**2 + self.kernel**2 + self.response**2)
        )


@dataclass(frozen=True)
class PathErrors:
    """Errors of the directions of a path.

    Attributes
    ----------
    path : AxisPath
    epochs : TimeGrid or TimeList
        All times of the series: how well the sky is known depends on the farthest.
    body : Body
    pulls : Pulls
    shift : Shift or None
        Response of the interior, if it is switched on.
    """

    path: AxisPath
    epochs: Epochs
    body: Body
    pulls: Pulls
    shift: Shift | None = None

    def at(self, days: FloatArray, figure: FloatArray) -> Errors:
        """Errors on some days from J2000.0, shape (t,), with the figure axis there, (t, 3)."""
        u_h = self.body.relative_uncertainty.get("dynamical_flattening", 0.0)
        method = np.nan if self.pulls.sky.unmeasured else self.path.error
        return Errors(
            method=np.full(len(figure), method),
            given=axes.error_of_input(self.path, figure, u_h),
            kernel=self._of_sky(figure),
            response=np.zeros(len(figure)) if self.shift is None else self.shift.half_width(days),
        )

    def _of_sky(self, figure: FloatArray) -> FloatArray:
        """95 % half-width of a direction from errors of the positions, rad, shape (t,)."""
        sky, body = self.pulls.sky, self.body
        _, epoch = start_of(body, self.pulls)
        positions = sky.positions(np.array([epoch / DAY]))
        distance = {name: float(np.linalg.norm(position)) for name, position in positions.items()}
        drift = max(sky.drift(name, far) for name, far in distance.items())
        speed = fastest_sweep(
            body.number("dynamical_flattening"),
            float(body.spin_rate),
            [(self.pulls.gm[name], far) for name, far in distance.items()],
        )
        grown = max(map(growth, self.epochs.span()))
        return grown * axes.error_of_sky(self.path, figure, drift, speed, DRIFT_FROM)

    def largest(self) -> dict[str, float]:
        """Largest error at the times wanted, total and by share, rad.

        Windows decide on all shares but that of the response, which is left out without a shift.
        """
        largest: dict[str, float] = {}
        for first in range(0, self.epochs.size, _AT_ONCE):
            days = self.epochs.days(first, min(first + _AT_ONCE, self.epochs.size))
            errors = self.at(days, self.path.at(days * DAY)["figure"])
            for name, share in {"total": errors.total, **vars(errors)}.items():
                largest[name] = float(np.maximum(largest.get(name, 0.0), share.max()))
        return largest

    @property
    def total(self) -> float:
        """Largest error at the times wanted, rad."""
        return self.largest()["total"]


@dataclass(frozen=True)
class LargestError:
    """Largest error of a series.

    Attributes
    ----------
    error : float
        rad.
    remedy : str
        What would make its largest share smaller.
    """

    error: float
    remedy: str


@part(unless=no_accuracy)
def largest_error(
    axis_path: AxisPath,
    epochs: Epochs,
    body: Body,
    pulls: Pulls,
    interior_shift: Shift | None = None,
) -> LargestError:
    """The largest error of the whole series, before the first of its stretches is written."""
    remedies = {
        "kernel": "the sky is no better known that far from J2000.0",
        "given": "stay nearer to J2000.0 or give the body a better known H",
        "response": "the response of the interior is known no better; leave nonrigid out",
        "method": "the integration takes the finest windows",
    }
    shares = PathErrors(axis_path, epochs, body, pulls, interior_shift).largest()
    return LargestError(shares["total"], remedies[max(remedies, key=lambda name: shares[name])])


@dataclass(frozen=True)
class Turns:
    """How often a path has gone round the orbit's normal, so that longitudes do not jump.

    Attributes
    ----------
    times : ndarray, shape (w,)
        Where windows begin, s.
    psi : ndarray, shape (w,)
        Longitude there, without jumps, rad.
    """

    times: FloatArray
    psi: FloatArray

    def unwrapped(self, psi: FloatArray, times: FloatArray) -> FloatArray:
        """Longitudes at given times, shapes (t, k) and (t,), with their whole turns."""
        return followed(psi, np.interp(times, self.times, self.psi)[:, np.newaxis])


def turns_of(path: AxisPath, first: float, ecliptic: FloatArray) -> Turns:
    """Follow the longitude through all windows; it is a principal value at the first time, s."""
    psi = np.unwrap(on_fixed_ecliptic(path.at_starts(), ecliptic)[:, 0])
    times = path.windows.edges[:-1]
    there = on_fixed_ecliptic(path.at(np.array([first]))["angular_momentum"], ecliptic)[0, 0]
    off = np.interp(first, times, psi) - there
    return Turns(times, psi - 2 * np.pi * np.rint(off / (2 * np.pi)))


def _follow(
    body: Body,
    pulls: Pulls,
    effects: Sequence[str],
    epochs: Epochs,
    choice: Choice[PoleWindows] | None,
    start: FloatArray | None,
) -> AxisPath:
    """Integrate on chosen windows, or on the finest, from the body's own pole or another start."""
    pulls.sky.check_times(epochs.span(), pulls.targets)
    own, epoch = start_of(body, pulls)
    axis = own if start is None else start
    first, last = epochs.span()
    span = first * DAY, last * DAY
    settings = {} if choice is None else vars(choice.settings)
    window = axes.WINDOW if choice is None else choice.settings.window
    with progress("pole", axes.window_count(epoch, span, window)) as advance:
        path = axes.axis_path(
            forces_of(body, pulls, effects),
            axis,
            epoch,
            span,
            limits=pulls.limits,
            advance=advance,
            **settings,
        )
    # What was measured of the settings is a bound; the path itself only sees its last terms.
    return path if choice is None else replace(path, interpolation_error=choice.error)


# --- beside the IAU's ----------------------------------------------------------------------------


class Comparison(AxisMotion):
    """Keys of every question that compares the pole with the IAU's in time."""

    span: Span = key(
        ("1980-01-01T12:00:00", "2020-01-01T12:00:00"),
        doc="first and last date of the residuals, TDB",
    )
    step: Step = key("5 d", doc="interval between residuals")


@dataclass(frozen=True)
class PoleComparison:
    """Our pole and the IAU's, analysed alike.

    Attributes
    ----------
    days : ndarray, shape (t,)
    start : ndarray, shape (3,)
        Axis to start with so that our mean pole meets the IAU's at the epoch.
    epoch : float
        J2000.0, or as near to it as the positions reach, s from J2000.0 TDB.
    path : AxisPath
        With all effects that are switched on.
    analysis : PoleAnalysis
    ours, theirs : Secular
    our_circles, their_circles : Circles
    difference : ndarray, shape (t,), complex
        Our rigid pole minus that of IAU 2006/2000A, dpsi sin(eps0) + i deps, rad.
    """

    days: FloatArray
    start: FloatArray
    epoch: float
    path: AxisPath
    analysis: PoleAnalysis
    ours: Secular
    theirs: Secular
    our_circles: Circles
    their_circles: Circles
    difference: ComplexArray


def steady_figure(path: AxisPath, days: FloatArray) -> FloatArray:
    """Unit vectors of the figure axis without the semidiurnal motion, shape (t, 3)."""
    return path.at(days * DAY, semidiurnal=False)["figure"]


def path_over(
    body: Body,
    pulls: Pulls,
    effects: Sequence[str],
    start: FloatArray,
    days: FloatArray,
) -> AxisPath:
    """Axes of the rigid body over some days, the sky kept for the next run over the same."""
    _, epoch = start_of(body, pulls)
    forces = forces_of(body, pulls, rigid(effects), keep=True)
    span = days[0] * DAY, days[-1] * DAY
    return axes.axis_path(forces, start, epoch, span, limits=pulls.limits)


def iau_nutation(pulls: Pulls, epochs: Epochs) -> tuple[FloatArray, FloatArray, ComplexArray]:
    """Nutation of the IAU at the days of a series.

    Returns
    -------
    days : ndarray, shape (t,)
        From J2000.0.
    ends : ndarray, shape (2,)
        Days that bound the series and J2000.0.
    eta : ndarray, shape (t,), complex
        dpsi sin(eps0) + i deps, rad.

    Raises
    ------
    EarthspinError
        If the series does not fit into memory, or lies outside the source of positions.
    """
    from earthspin.nutation.circles import complex_nutation
    from earthspin.sky import iau

    days = days_of(epochs)
    first, last = epochs.span()
    ends = np.array([min(first, 0.0), max(last, 0.0)])
    pulls.sky.check_times(ends, pulls.targets)
    angles = iau.at_days(lambda at: iau.nutation_of(iau.true_pole(at), at), days)
    return days, ends, complex_nutation(angles)


def residual_error(
    analysed: PoleComparison, body: Body, eta: ComplexArray, days: FloatArray
) -> float:
    """95 % half-width of either angle of a residual: integration, H in nutation, interpolation."""
    from earthspin.sky.iau import node_error

    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    error = math.hypot(analysed.path.error, NORMAL_95 * u_h * float(np.max(np.abs(eta))))
    between_nodes = node_error(days)
    return math.hypot(error, between_nodes) if between_nodes else error


def rigid(effects: Sequence[str]) -> list[str]:
    """Effects that move a rigid body."""
    return [effect for effect in effects if effect != NONRIGID.name]


@part(unless=no_iau_model)
def pole_analysis(body: Body, pulls: Pulls, effects: tuple[str, ...]) -> PoleComparison:
    """Our pole and the IAU's over 150 years, started where the mean poles meet, analysed alike."""
    from earthspin.nutation.analysis import CENTURY, PoleAnalysis, shifted_start
    from earthspin.nutation.circles import complex_nutation
    from earthspin.sky import iau

    low, high = (limit / DAY for limit in pulls.limits)
    days = np.arange(max(low, -HALF_SPAN), min(high, HALF_SPAN), SAMPLING)
    if (covered := days.size * SAMPLING) < SHORTEST_SPAN:
        raise UndefinedError(
            f"the positions cover {covered * DAY / JULIAN_YEAR:.1f} years near J2000.0, and the "
            f"analysis of nutation needs {SHORTEST_SPAN * DAY / JULIAN_YEAR:.0f}; give a longer "
            "ephemeris, or leave the effect nonrigid out"
        )
    start, epoch = start_of(body, pulls)

    def follow(start: FloatArray) -> tuple[AxisPath, FloatArray]:
        path = path_over(body, pulls, effects, start, days)
        return path, steady_figure(path, days)

    with progress("analysis", 4) as advance:
        analysis = PoleAnalysis(
            days, iau.delaunay_arguments(days), iau.delaunay_rates(), iau.fixed_ecliptic()
        )
        advance(1)
        true_pole = iau.true_pole(days)
        theirs = analysis.secular(true_pole)
        advance(1)
        _, pole = follow(start)
        start = shifted_start(
            start, analysis.secular(pole), theirs, analysis.ecliptic, epoch / CENTURY
        )
        path, pole = follow(start)
        advance(1)
        their_circles = analysis.circles(complex_nutation(iau.nutation_2000a(days)))
        advance(1)
    eta = complex_nutation(iau.nutation_of(pole, days))
    return PoleComparison(
        days=days,
        start=start,
        epoch=epoch,
        path=path,
        analysis=analysis,
        ours=analysis.secular(pole),
        theirs=theirs,
        our_circles=analysis.circles(eta),
        their_circles=their_circles,
        difference=eta - complex_nutation(iau.nutation_of(true_pole, days)),
    )


@part
def core_response(pole_analysis: PoleComparison, body: Body) -> Response:
    """Resonance form fitted to IAU 2000A over our rigid amplitudes."""
    ours, theirs = pole_analysis.our_circles, pole_analysis.their_circles
    return _fitted(ours, ours.amplitude, theirs.amplitude, body)


def _fitted(circles: Circles, rigid: ComplexArray, other: ComplexArray, body: Body) -> Response:
    """Response by which circles of one amplitude follow from those of a rigid body."""
    from earthspin.nutation.response import fit_response

    used = _used(circles)
    return fit_response(
        circles.frequency[used],
        rigid[used],
        other[used],
        body.number("dynamical_flattening"),
        float(body.spin_rate),
    )


def _used(circles: Circles) -> NDArray[np.bool_]:
    """Circles that a response is fitted to: all but the prograde year."""
    from earthspin.nutation.response import SUN_SYNCHRONOUS

    return np.asarray(np.any(circles.multiples != SUN_SYNCHRONOUS, axis=1))


@dataclass(frozen=True)
class ResponseFit:
    """A response that is not allowed to absorb what no response makes.

    Attributes
    ----------
    response : Response
        Fitted to IAU 2000A less `added` and geodesic nutation.
    used : ndarray, shape (k,), bool
        The circles that it is fitted to: all but the prograde year, to which IAU 2000A adds not
        quite what was published.
    rigid : ndarray, shape (k,), complex
        What torques make of each circle, without geodesic nutation, rad.
    left : ndarray, shape (k,), complex
        What the response leaves of each circle of IAU 2000A, geodesic nutation apart, rad.
    added : ndarray, shape (k,), complex
        What its authors say is added to each, rad; 0 to most.
    """

    response: Response
    used: NDArray[np.bool_]
    rigid: ComplexArray
    left: ComplexArray
    added: ComplexArray


@part
def response_apart(
    pole_analysis: PoleComparison, pulls: Pulls, body: Body, effects: tuple[str, ...]
) -> ResponseFit:
    """Resonance form fitted with geodesic nutation and additive terms taken away."""
    from earthspin.nutation.additions import added_to
    from earthspin.nutation.circles import complex_nutation
    from earthspin.sky import iau

    done = pole_analysis
    ours, theirs = done.our_circles, done.their_circles.amplitude
    torques = ours.amplitude
    if GEODESIC.name in effects:
        # A turn of the frame is no torque: the body does not answer to it.
        rest = [effect for effect in effects if effect != GEODESIC.name]
        path = path_over(body, pulls, rest, done.start, done.days)
        pole = steady_figure(path, done.days)
        eta = complex_nutation(iau.nutation_of(pole, done.days))
        torques = done.analysis.circles(eta).amplitude
    theirs = theirs - (ours.amplitude - torques)
    added = added_to(ours.multiples)
    response = _fitted(ours, torques, theirs - added, body)
    left = theirs - response.transfer(ours.frequency) * torques
    return ResponseFit(response, _used(ours), torques, left, added)


@dataclass(frozen=True)
class Shift:
    """What the non-rigid response adds to the axes of a rigid body.

    Attributes
    ----------
    start : ndarray, shape (3,)
        Axis with which the rigid path starts: its mean pole then meets that of the IAU.
    epoch : float
        Time of the start, s from J2000.0 TDB.
    circles : Circles
        Non-rigid less rigid nutation, as a sum of circles.
    rate : float
        Published contribution to the rate of precession, times sin(eps0), rad/s.
    closure : float
        Rate at which the path departs from IAU 2006/2000A, rad/s.
    residual : float
        Half-width that, with the departure, contains 95 % of the distances from it, rad.
    """

    start: FloatArray
    epoch: float
    circles: Circles
    rate: float
    closure: float
    residual: float

    def apply(self, directions: dict[str, FloatArray], days: FloatArray) -> None:
        """Move the axes in place: all of them precess, those of the mantle also nutate."""
        from earthspin.sky import iau

        precession = self.rate * (days * DAY - self.epoch)
        nutation = self.circles.at(iau.delaunay_arguments(days))
        for name, axis in directions.items():
            of_mantle = 0.0 if name == "angular_momentum" else 1.0
            shift = precession + of_mantle * nutation
            directions[name] = iau.moved_by_nutation(axis, shift, days)

    def half_width(self, days: FloatArray) -> FloatArray:
        """95 % half-width of the direction, from the response and the closure of the rates, rad."""
        return np.hypot(self.residual, self.closure * (days * DAY - self.epoch))


def _shift(analysed: PoleComparison, amplitude: ComplexArray, effects: Sequence[str]) -> Shift:
    """Shift by circles of given amplitudes, and what it leaves of the distance from the IAU."""
    from earthspin.sky import iau

    circles = replace(analysed.our_circles, amplitude=amplitude)
    published, sine = published_effects(), np.sin(EPSILON_0.value * ARCSEC)
    # The published rate of the response is applied; those of effects that are switched off are
    # neglected with their sizes, and are no error.
    off = sum(rate for name, rate in published.items() if name not in rigid(effects))
    since = analysed.days * DAY - analysed.epoch
    difference = analysed.difference + circles.at(iau.delaunay_arguments(analysed.days))
    difference += off * sine * since
    pair = np.stack([difference.real, difference.imag], axis=1)
    closure = float(np.linalg.norm(np.polynomial.polynomial.polyfit(since, pair, 1)[1]))
    remainder = np.abs(difference) ** 2 - (closure * since) ** 2
    return Shift(
        analysed.start,
        analysed.epoch,
        circles,
        rate=published[NONRIGID.name] * sine,
        closure=closure,
        residual=math.sqrt(max(0.0, float(np.quantile(remainder, 0.95)))),
    )


@part
def nonrigid_shift(
    pole_analysis: PoleComparison, response_apart: ResponseFit, effects: tuple[str, ...]
) -> Shift:
    """What core, mantle, oceans and atmosphere add to rigid nutation, fitted to IAU 2000A."""
    factor = response_apart.response.transfer(pole_analysis.our_circles.frequency) - 1
    amplitude = response_apart.rigid * factor + response_apart.added
    return _shift(pole_analysis, amplitude, effects)


@part(unless=no_layers)
def predicted_shift(
    pole_analysis: PoleComparison, prediction: Prediction, effects: tuple[str, ...]
) -> Shift:
    """What the interior adds to the rigid nutations, predicted from its layers."""
    circles = pole_analysis.our_circles
    factor = prediction.transfer(CHOSEN, circles.frequency) - 1
    return _shift(pole_analysis, circles.amplitude * factor, effects)


#: What stands between the pulls and the response of the interior, for the questions that use it.
INTERIOR = (pole_analysis, response_apart, nonrigid_shift, prediction, predicted_shift)
