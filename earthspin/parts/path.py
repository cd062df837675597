"""The three axes of a body followed in time, and what separates ours from the IAU's."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import Body
from earthspin.constants import DAY
from earthspin.engine.part import part
from earthspin.errors import UndefinedError
from earthspin.motion.effects import NONRIGID
from earthspin.parts.pulls import Pulls, forces_of, start_of
from earthspin.parts.reasons import no_iau_model
from earthspin.parts.times import refuse_what_does_not_fit
from earthspin.progress import progress
from earthspin.units import FloatArray

if TYPE_CHECKING:
    from earthspin.choosing.choice import Choice
    from earthspin.choosing.windows import PoleWindows
    from earthspin.dates import TimeGrid, TimeList
    from earthspin.motion.axes import AxisPath
    from earthspin.nutation.analysis import PoleAnalysis, Secular
    from earthspin.nutation.nutation import Circles
    from earthspin.nutation.response import Response

#: Half of the stretch about J2000.0 that is analysed, as far as the kernel has it: four turns of
#: the node each way, in which slow changes are a short polynomial.
HALF_SPAN = 27200.0  # d
SAMPLING = 4.0  # d


@part
def axis_path(
    pulls: Pulls,
    epochs: TimeGrid | TimeList,
    body: Body,
    effects: tuple[str, ...],
    accuracy: float | None,
    chosen_windows: list[Choice[PoleWindows]] | None = None,
) -> AxisPath:
    """The axes from J2000.0 to the times wanted: Picard iteration on Gauss windows.

    The windows that were chosen are taken if they will do, the finest otherwise.
    """
    refuse_what_does_not_fit(epochs, "choose a longer step or a shorter span")
    tried: list[AxisPath] = []
    for choice in (*(chosen_windows or ()), None):
        try:
            path = _follow(body, pulls, effects, epochs, choice)
        except UndefinedError:
            if choice is None and not tried:
                raise
            continue  # windows that are too wide for the slow manifold of this spin
        tried.append(path)
        if choice is None or _worst_error(body, pulls, path, epochs) <= (accuracy or 0.0):
            break
    if not tried[1:]:
        return tried[0]
    return min(tried, key=lambda path: _worst_error(body, pulls, path, epochs))


def _worst_error(body: Body, pulls: Pulls, path: AxisPath, epochs: TimeGrid | TimeList) -> float:
    """Largest error of a direction at the times wanted, H and the sky included, rad."""
    from earthspin.motion.axes import error_of_input

    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    now = epochs.days(0, epochs.size)
    figure = path.at(now * DAY)["figure"]
    given = np.hypot(
        error_of_input(path, figure, u_h), error_of_sky(path, figure, now, body, pulls)
    )
    return float(np.hypot(path.error, given.max()))


def error_of_sky(
    path: AxisPath, figure: FloatArray, days: FloatArray, body: Body, pulls: Pulls
) -> FloatArray:
    """95 % half-width of a direction from where the bodies may be off, rad, shape (t,)."""
    from earthspin.motion import axes
    from earthspin.motion.figure import fastest_sweep
    from earthspin.sky.kernel_differences import DRIFT_FROM, growth

    _, epoch = start_of(body, pulls)
    found = pulls.sky.positions(np.array([epoch / DAY]))
    distance = {name: float(np.linalg.norm(place)) for name, place in found.items()}
    drift = max(pulls.sky.drift(name, far) for name, far in distance.items())
    speed = fastest_sweep(
        body.number("dynamical_flattening"),
        float(body.spin_rate),
        [(pulls.gm[name], far) for name, far in distance.items()],
    )
    grown = max(growth(float(days.min())), growth(float(days.max())))
    return grown * axes.error_of_sky(path, figure, drift, speed, DRIFT_FROM)


def _follow(
    body: Body,
    pulls: Pulls,
    effects: Sequence[str],
    epochs: TimeGrid | TimeList,
    choice: Choice[PoleWindows] | None,
) -> AxisPath:
    """Integrate on chosen windows, or on the finest."""
    from earthspin.motion.axes import WINDOW, axis_path, window_count

    pulls.sky.check_times(epochs.span(), pulls.targets)
    axis, epoch = start_of(body, pulls)
    first, last = epochs.span()
    span = first * DAY, last * DAY
    settings = {} if choice is None else vars(choice.settings)
    window = WINDOW if choice is None else choice.settings.window
    with progress("pole", window_count(epoch, span, window)) as advance:
        path = axis_path(
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


@dataclass(frozen=True)
class Analysed:
    """Our pole and the IAU's, analysed alike.

    Attributes
    ----------
    days : ndarray, shape (t,)
    start : ndarray, shape (3,)
        Axis to start with so that our mean pole meets the IAU's at J2000.0.
    path : AxisPath
        With all effects that are switched on.
    analysis : PoleAnalysis
    ours, theirs : Secular
    our_circles, their_circles : Circles
    """

    days: NDArray[np.float64]
    start: NDArray[np.float64]
    path: AxisPath
    analysis: PoleAnalysis
    ours: Secular
    theirs: Secular
    our_circles: Circles
    their_circles: Circles

    def pole(
        self, path: AxisPath, days: NDArray[np.float64], axis: str = "figure"
    ) -> NDArray[np.float64]:
        """Unit vectors of one axis without the semidiurnal motion."""
        return path.at(days * DAY, semidiurnal=False)[axis]


def path_over(
    body: Body,
    pulls: Pulls,
    effects: Sequence[str],
    start: NDArray[np.float64],
    days: NDArray[np.float64],
) -> AxisPath:
    """Axes over some days, the sky kept for the next run over the same."""
    from earthspin.motion.axes import axis_path

    _, epoch = start_of(body, pulls)
    forces = forces_of(body, pulls, rigid(effects), keep=True)
    return axis_path(forces, start, epoch, (days[0] * DAY, days[-1] * DAY), limits=pulls.limits)


def rigid(effects: Sequence[str]) -> list[str]:
    """Effects that move a rigid body."""
    return [effect for effect in effects if effect != NONRIGID.name]


@part(unless=no_iau_model)
def pole_analysis(body: Body, pulls: Pulls, effects: tuple[str, ...]) -> Analysed:
    """Our pole and the IAU's over 150 years, started where the mean poles meet, analysed alike."""
    from earthspin.nutation.analysis import PoleAnalysis, shifted_start
    from earthspin.nutation.nutation import complex_nutation
    from earthspin.sky import iau

    low, high = (limit / DAY for limit in pulls.limits)
    days = np.arange(max(low, -HALF_SPAN), min(high, HALF_SPAN), SAMPLING)
    start, _ = start_of(body, pulls)

    def follow(start: NDArray[np.float64]) -> tuple[AxisPath, NDArray[np.float64]]:
        path = path_over(body, pulls, effects, start, days)
        return path, path.at(days * DAY, semidiurnal=False)["figure"]

    with progress("analysis", 4) as advance:
        analysis = PoleAnalysis(
            days, iau.delaunay_arguments(days), iau.delaunay_rates(), iau.fixed_ecliptic()
        )
        advance(1)
        theirs = analysis.secular(iau.true_pole(days))
        advance(1)
        _, pole = follow(start)
        start = shifted_start(start, analysis.secular(pole), theirs, analysis.ecliptic)
        path, pole = follow(start)
        advance(1)
        their_circles = analysis.circles(complex_nutation(iau.nutation_2000a(days)))
        advance(1)
    return Analysed(
        days=days,
        start=start,
        path=path,
        analysis=analysis,
        ours=analysis.secular(pole),
        theirs=theirs,
        our_circles=analysis.circles(complex_nutation(iau.nutation_of(pole, days))),
        their_circles=their_circles,
    )


@part
def core_response(pole_analysis: Analysed, body: Body) -> Response:
    """Resonance form fitted to IAU 2000A over our rigid amplitudes."""
    from earthspin.nutation.response import SUN_SYNCHRONOUS, fit_response

    ours, theirs = pole_analysis.our_circles, pole_analysis.their_circles
    used = np.any(ours.multiples != SUN_SYNCHRONOUS, axis=1)
    return fit_response(
        ours.frequency[used],
        ours.amplitude[used],
        theirs.amplitude[used],
        body.number("dynamical_flattening"),
        float(body.spin_rate),
    )


@dataclass(frozen=True)
class Shift:
    """What the non-rigid response adds to the figure and rotation axes.

    Attributes
    ----------
    circles : Circles
        Non-rigid less rigid nutation, as a sum of circles.
    """

    circles: Circles

    def eta(self, days: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Shift as dpsi sin(eps0) + i deps, rad."""
        from earthspin.sky import iau

        return self.circles.at(iau.delaunay_arguments(days))

    def apply(self, axes: dict[str, NDArray[np.float64]], days: NDArray[np.float64]) -> None:
        """Move the axes of the mantle in place; the angular momentum is not changed."""
        from earthspin.sky.iau import moved_by_nutation

        eta = self.eta(days)
        for name in ("rotation", "figure"):
            axes[name] = moved_by_nutation(axes[name], eta, days)


@part
def nonrigid_shift(pole_analysis: Analysed, core_response: Response) -> Shift:
    """What the fluid core and the yielding mantle add to the rigid nutations."""
    circles = pole_analysis.our_circles
    factor = core_response.transfer(circles.frequency) - 1
    return Shift(replace(circles, amplitude=circles.amplitude * factor))
