"""Our pole over a century and a half, analysed as the IAU's is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from earthspin.scene.part import Part
from earthspin.scene.parts.conditions import needs_nonrigid

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from earthspin.compare.analysis import PoleAnalysis, Secular
    from earthspin.compare.nutation import Circles
    from earthspin.motion.axes import AxisPath
    from earthspin.scene.spec import Scene

#: Half of the stretch about J2000.0 that is analysed, as far as the kernel has it: four turns of
#: the node each way, in which slow changes are a short polynomial.
HALF_SPAN = 27200.0  # d
SAMPLING = 4.0  # d


@dataclass(frozen=True)
class Analysed:
    """Our pole and the IAU's, analysed alike.

    Attributes
    ----------
    days : ndarray, shape (t,)
    start : ndarray, shape (3,)
        Axis to start with so that our mean pole meets the IAU's at J2000.0.
    path : AxisPath
        With all effects of the scene.
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

    def pole(self, path: AxisPath, days: NDArray[np.float64], axis: str = "figure") -> Any:
        """Unit vectors of one axis without the semidiurnal motion."""
        from earthspin.constants import DAY

        return path.at(days * DAY, semidiurnal=False)[axis]


def analyse(scene: Scene, given: Mapping[str, Any]) -> Analysed:
    """Follow the pole, start it where the mean poles meet, and analyse it with the IAU's."""
    import numpy as np

    from earthspin.compare.analysis import PoleAnalysis, shifted_start
    from earthspin.compare.nutation import complex_nutation
    from earthspin.constants import DAY
    from earthspin.progress import progress
    from earthspin.scene.parts.pulls import start_of
    from earthspin.sky import iau

    pulls = given["pulls"]
    low, high = (limit / DAY for limit in pulls.limits)
    days = np.arange(max(low, -HALF_SPAN), min(high, HALF_SPAN), SAMPLING)
    effects = [e for e in scene.effects or () if e != "nonrigid"]
    start, _ = start_of(scene, pulls)

    def follow(start: Any) -> tuple[AxisPath, Any]:
        path = path_over(scene, pulls, effects, start, days)
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


def path_over(scene: Scene, pulls: Any, effects: Any, start: Any, days: Any) -> AxisPath:
    """Axes over some days, the sky kept for the next run over the same."""
    from earthspin.constants import DAY
    from earthspin.motion.axes import axis_path
    from earthspin.scene.parts.pulls import forces_of, start_of

    _, epoch = start_of(scene, pulls)
    forces = forces_of(scene, pulls, effects, keep=True)
    return axis_path(forces, start, epoch, (days[0] * DAY, days[-1] * DAY), limits=pulls.limits)


POLE_ANALYSIS = Part(
    name="pole-analysis",
    does="our pole and the IAU's over 150 years, started alike, analysed alike",
    function="earthspin.scene.parts.pole_analysis:analyse",
    needs=("pulls",),
    left_out=needs_nonrigid,
    keys=("body", "perturbers", "effects", "ephemeris", "compute"),
)
