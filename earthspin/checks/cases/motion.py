"""Stiff and extreme cases of what the axis does: three solvers and the average.

Spin to precession is 10^7 to one. The averaged rate knows nothing of the spin, the pole's
solver steps over it, the two attitude solvers follow every turn; they meet where they overlap.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from earthspin.bodies import MOON, SUN
from earthspin.checks.case import Distances, FloatArray, holds, relative_error
from earthspin.checks.sky import BODY, CENTRE, CODES, FORCES, J2, SPIN, H, Tide, kernel, positions
from earthspin.checks.solvers.attitude import attitude_about, attitude_motion, figure_axis
from earthspin.checks.solvers.momentum_and_figure import axisymmetric_motion
from earthspin.constants import ARCSEC_PER_YEAR, DAY, JULIAN_YEAR, PUBLISHED_EFFECTS, UAS
from earthspin.motion.axes import AxisPath, axis_path
from earthspin.motion.forces import Figure, Forces
from earthspin.nutation.angles import on_fixed_ecliptic
from earthspin.parts.averages import Samples, torque_samples
from earthspin.parts.sky import Stretch, places, sky, stretch
from earthspin.questions.pole import pole
from earthspin.sky.iau import fixed_ecliptic
from earthspin.torque.rates import precession_rate

YEAR = JULIAN_YEAR
ROUND = FORCES.figure
TRIAXIALITY = float(BODY.triaxiality) * H / J2
#: Any direction near the pole.
NORTH = np.array([2e-5, -3e-5, 1.0]) / np.linalg.norm([2e-5, -3e-5, 1.0])


def _path(days: float, body: Figure = ROUND, **settings: Any) -> AxisPath:
    return axis_path(replace(FORCES, figure=body), NORTH, 0.0, (0.0, days * DAY), **settings)


def _angle(a: FloatArray, b: FloatArray) -> float:
    """Largest angle between two directions, uas."""
    a, b = (v / np.linalg.norm(v, axis=-1, keepdims=True) for v in (a, b))
    return float(np.max(np.linalg.norm(a - b, axis=-1)) / UAS)


def _momentum(path: AxisPath) -> FloatArray:
    """Angular momentum at the start in units of C Omega, shape (3,)."""
    return path.windows.evaluate(path.momentum, np.zeros(1))[:, 0]


def _pole_against_exact(days: float, forces: Forces = FORCES) -> float:
    """Figure axes of the pole's solver and of (L, F) step by step, largest angle, uas."""
    times, body = np.linspace(0.0, days * DAY, 40), forces.figure
    path = axis_path(forces, NORTH, 0.0, (0.0, times[-1]))
    start, tide = path.at(times[:1])["figure"][0], Tide(days * DAY, forces.gm)
    _, axis = axisymmetric_motion(tide, body.h, body.spin_rate, _momentum(path), start, times)
    return _angle(path.at(times)["figure"], axis)


def _exact(start: FloatArray, tide: Tide, times: FloatArray) -> FloatArray:
    """Figure axis of the round body from an angular momentum, by (L, F)."""
    return axisymmetric_motion(tide, H, SPIN, start, NORTH, times)[1]


def _attitude(start: FloatArray, tide: Tide, times: FloatArray) -> FloatArray:
    """The same by the whole attitude."""
    turned = attitude_about(NORTH, 0.3)
    return figure_axis(attitude_motion(tide, H, 0.0, SPIN, start, turned, times)[1])


@holds(bound=0.01, unit="uas")
def _pole_and_exact() -> Distances:
    """spin to precession 10^7: the pole and (L, F) step by step

    Hard because: one steps over a day eight at a time, the other turns with the body
    Held against: the figure axis of axisymmetric_motion over 30 d
    """
    yield _pole_against_exact(30.0)


@holds(bound=2e-4, unit="uas")
def _exact_and_attitude() -> Distances:
    """spin to precession 10^7: (L, F) and the whole attitude

    Hard because: two sets of equations of different size, a thousand steps a turn of the sky
    Held against: the figure axis of attitude_motion over 10 d
    """
    start, tide = _momentum(_path(10.0)), Tide(10 * DAY)
    times = np.linspace(0.0, 10 * DAY, 20)
    yield _angle(_attitude(start, tide, times), _exact(start, tide, times))


@holds(bound=5e-3, unit="uas")
def _triaxial() -> Distances:
    """spin to precession 10^7: three unequal moments

    Hard because: the semidiurnal motion of 34 uas rides on a precession of 10^6 times that
    Held against: the figure axis of attitude_motion over 10 d
    """
    days, times = 10.0, np.linspace(0.0, 10 * DAY, 20)
    path = _path(days, replace(ROUND, triaxiality=TRIAXIALITY, meridian=float(BODY.meridian)))
    result = path.at(times)
    start = np.linalg.norm(_momentum(path)) * result["angular_momentum"][0]
    turned = attitude_about(result["figure"][0], float(BODY.meridian))
    _, turn = attitude_motion(Tide(days * DAY), H, TRIAXIALITY, SPIN, start, turned, times)
    yield _angle(result["figure"], figure_axis(turn))


@holds(bound=2e-5, unit="arcsec/yr")
def _average_and_pole() -> Distances:
    """spin to precession 10^7: the average and the pole over 93 years

    Hard because: a nutation of 9 arcsec, half a million times a year's error, must average out
    Held against: averaged rate and the published second-order effect (Capitaine et al. 2003)
    """
    samples = _samples()
    window, times = samples.window, samples.times
    averaged = precession_rate(window.mean(times, samples.precessing).sum(), H, SPIN)
    start = BODY.needed("pole").true(0.0)
    path = axis_path(FORCES, start, 0.0, (times[0] - DAY, times[-1] + DAY))
    before, after = (_psi(path.at(times + s * DAY / 2)["angular_momentum"]) for s in (-1, 1))
    followed = float(window.mean(times, after - before)) / DAY
    second_order = PUBLISHED_EFFECTS["second-order"].value
    yield (followed - averaged) / ARCSEC_PER_YEAR - second_order


def _samples(cycles: float | None = None) -> Samples:
    """Daily torques of Sun and Moon over a number of turns of the node, or all that there are."""
    both = BODY, (SUN, MOON)
    above = sky("de421", places(*both), "jplephem")
    if cycles is None:
        return torque_samples(above, stretch(above, None), *both)
    half = cycles * MOON.cycle / DAY / 2 + 1e-3
    return torque_samples(above, Stretch(-half, half), *both)


def _psi(vectors: FloatArray) -> FloatArray:
    return np.unwrap(on_fixed_ecliptic(vectors, fixed_ecliptic())[:, 0])


def _exponent(count: Callable[[float], int], spans: Sequence[float]) -> float:
    """Slope of the logarithm of the cost against that of the span, less 1."""
    counts = [count(span) for span in spans]
    return float(np.polyfit(np.log(spans), np.log(counts), 1)[0]) - 1


def _cost(
    follow: Callable[[FloatArray, Tide, FloatArray], FloatArray], spans: Sequence[float]
) -> float:
    """The same of a solver's requests for the tide, over spans in d."""
    start = _momentum(_path(8.0))

    def count(days: float) -> int:
        tide = Tide(days * DAY)
        follow(start, tide, np.array([0.0, days * DAY]))
        return tide.calls

    return _exponent(count, spans)


@holds(bound=3e-4)
def _cost_of_average() -> Distances:
    """cost of the average as the span grows

    Hard because: a cost that grows faster than the span would end all long spans
    Held against: exponent 1 of the number of epochs, over 3 to 5 turns of the node
    """
    yield _exponent(lambda cycles: _samples(cycles).times.size, (3.0, 4.0, 5.0))


@holds(bound=0.02)
def _cost_of_pole() -> Distances:
    """cost of the pole as the span grows

    Hard because: each round of its iteration covers all windows; more rounds would show
    Held against: exponent 1 of windows times rounds, over 2 to 48 years
    """

    def count(years: float) -> int:
        path = _path(years * 365.25)
        return path.rounds * path.windows.times.size

    yield _exponent(count, (2.0, 6.0, 16.0, 48.0))


@holds(bound=0.1)
def _cost_of_exact() -> Distances:
    """cost of (L, F) step by step as the span grows

    Hard because: the step is bound to the turn of the body
    Held against: exponent 1 of the number of evaluations, over 8 to 64 d
    """
    yield _cost(_exact, (8.0, 16.0, 32.0, 64.0))


@holds(bound=0.1, slow=True)
def _cost_of_attitude() -> Distances:
    """cost of the whole attitude as the span grows

    Hard because: the step is bound to the turn of the body
    Held against: exponent 1 of the number of evaluations, over 8 to 32 d
    """
    yield _cost(_attitude, (8.0, 16.0, 32.0))


@holds(bound=0.01, unit="uas")
def _retrograde() -> Distances:
    """retrograde spin

    Hard because: the free mode turns the other way, and A/(C Omega) is negative
    Held against: (L, F) step by step over 20 d
    """
    yield _pole_against_exact(20.0, replace(FORCES, figure=replace(ROUND, spin_rate=-SPIN)))


@holds(bound=10.0, unit="uas")
def _thousandfold() -> Distances:
    """Sun and Moon of a thousandfold mass

    Hard because: the axis precesses by a turn in 26 years, and tilts by 9 arcsec from L
    Held against: (L, F) step by step over 20 d
    """
    heavy = {name: 1e3 * gm for name, gm in FORCES.gm.items()}
    yield _pole_against_exact(20.0, replace(FORCES, gm=heavy))


@holds(bound=5e-7)
def _fast_spin() -> Distances:
    """a spin of ten seconds

    Hard because: free mode and window are a factor of 70,000 apart
    Held against: what half that spin moves, halved: precession is as 1/spin, over what it moves
    """
    times = np.linspace(0.0, YEAR, 20)
    fast, half = (
        _path(365.25, replace(ROUND, spin_rate=2 * np.pi / seconds)).at(times)["figure"][1:] - NORTH
        for seconds in (10.0, 20.0)
    )
    yield relative_error(2 * fast, half)


@holds(bound=2e-4, unit="uas")
def _tiny_h() -> Distances:
    """dynamical flattening of 1e-9

    Hard because: a year's precession is 6 uas: 10^-11 of the vector that carries it
    Held against: what H = 1e-6 moves, a thousandth of it
    """
    times = np.linspace(0.0, YEAR, 20)
    paths = (_path(365.25, replace(ROUND, h=h)) for h in (1e-9, 1e-6))
    small, large = (path.at(times)["figure"] - NORTH for path in paths)
    yield (small - 1e-3 * large) / UAS


@holds(bound=0.02, unit="uas")
def _there_and_back() -> Distances:
    """there and back over 20 years

    Hard because: the figure at the end carries the tilt of that day into the new start
    Held against: the figure axis at the start and along the way
    """
    end = 20 * YEAR
    there = _path(20 * 365.25)
    turned = there.at(np.array([end]))["figure"][0]
    back = axis_path(FORCES, turned, end, (0.0, end))
    times = np.linspace(0.0, end, 60)
    yield _angle(there.at(times)["figure"], back.at(times)["figure"])


@holds(bound=1e-4, unit="uas")
def _backwards() -> Distances:
    """the Moon run backwards

    Hard because: time and spin are reversed together; every odd term must change sign
    Held against: the axis before the epoch, as it was
    """
    times = np.linspace(0.0, 5 * YEAR, 40)
    before = axis_path(FORCES, NORTH, 0.0, (-5 * YEAR, 0.0)).at(-times)
    turned = replace(ROUND, spin_rate=-SPIN)
    mirrored = replace(FORCES, figure=turned, positions=lambda t: positions(-t / DAY))
    after = axis_path(mirrored, NORTH, 0.0, (0.0, 5 * YEAR)).at(times)
    yield _angle(before["figure"], after["figure"])


@holds(bound=0.01, unit="uas")
def _resonant_windows() -> Distances:
    """windows in resonance with the free mode

    Hard because: steps of a half, one, two and three turns of the body alias its free motion
    Held against: windows of 8 d over 60 d
    """
    times = np.linspace(0.0, 60 * DAY, 100)
    usual = _path(60.0).at(times)["figure"]
    turn = 2 * np.pi / SPIN * (1 - H)
    for turns in (0.5, 1.0, 1.0 + 1e-12, 2.0, 3.0):
        yield _angle(_path(60.0, window=turns * turn).at(times)["figure"], usual)


@holds(bound=0.03, unit="uas", slow=True)
def _whole_kernel() -> Distances:
    """the whole kernel in one run

    Hard because: 154 years, 7000 windows, in segments chained outward from J2000
    Held against: windows half as long with 16 nodes
    """
    start, end = (day * DAY for day in kernel().coverage({*CODES.values(), CENTRE}))
    times = np.linspace(start, end, 3000)

    def figure(days: float, nodes: int) -> FloatArray:
        span, window = (start, end), days * DAY
        path = axis_path(FORCES, NORTH, 0.0, span, limits=span, window=window, order=nodes)
        return path.at(times)["figure"]

    yield _angle(figure(8, 14), figure(4, 16))


@holds(bound=5e-15)
def _obliquities() -> Distances:
    """obliquities of 0, 90 and 180 degrees in time

    Hard because: longitudes lose their meaning; vectors must not
    Held against: unit vectors, and no torque on a body upright in a circular orbit
    """
    phase = 2 * np.pi / (20 * DAY)

    def circle(times: FloatArray) -> dict[str, FloatArray]:
        around = np.stack([np.cos(phase * times), np.sin(phase * times), 0 * times], axis=1)
        return {"moon": 4e8 * around}

    times = np.linspace(0.0, 100 * DAY, 50)
    for axis in ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]):
        forces = replace(FORCES, gm={"moon": float(MOON.gm)}, positions=circle)
        result = axis_path(forces, np.array(axis), 0.0, (0.0, times[-1])).at(times)["figure"]
        yield result - axis if axis[2] else np.linalg.norm(result, axis=1) - 1


@holds(bound=3.0, unit="uas")
def _kernel_ends() -> Distances:
    """the pole in the first and last second of the kernel

    Hard because: windows may not look beyond; where the sky ends no sliver of one may remain
    Held against: what a second of precession and nutation moves the figure axis by, 0.2 to 2 uas
    """
    times = ["1899-07-29T00:00:00", "1899-07-29T00:00:01", "2053-10-08T23:59:59", "2053-10-09"]
    result = pole(times=times).sel(axis="figure")
    place = np.stack([result.X, result.Y, result.Z], axis=-1)
    yield _angle(place[0], place[1])
    yield _angle(place[2], place[3])


@holds(bound=9e-4)
def _geodesic_alone() -> Distances:
    """geodesic precession on a body without a bulge to speak of

    Hard because: nothing but the frame turns, forward, at 1/2600 of the rate that torques make
    Held against: its published rate along the ecliptic, 30 years, over itself
    """
    years = 30.0
    body = BODY.replace(j2=1e-15, dynamical_flattening=1e-15)
    path = pole("2000-01-01T12:00", "2030-01-01", "3652.5 d", body=body, effects=["geodesic"])
    turned = float((path.psi[-1] - path.psi[0]).sel(axis="figure"))  # arcsec
    yield turned / (PUBLISHED_EFFECTS["geodesic"].value * years) - 1


@holds(bound=4e-18)
def _three_axes() -> Distances:
    """rotation axis between figure axis and angular momentum

    Hard because: the three are a few milliarcseconds apart, and on one arc
    Held against: L = A w + (C - A)(w . F) F: the part of L across (1 - H) w + H F
    """
    result = pole("2010-01-01", "2010-03-01", "1 d", effects=[])
    momentum, rotation, figure = (
        np.stack([result[c].sel(axis=axis).values for c in "XYZ"], axis=-1)
        for axis in ("angular_momentum", "rotation", "figure")
    )
    # w . F is 1 but for 1e-15
    across = np.cross(momentum, (1 - H) * rotation + H * figure)
    yield np.linalg.norm(across, axis=-1)


@holds(bound=0.03)
def _slow_bulge() -> Distances:
    """a J2 that changes by three parts in a million a century

    Hard because: after 40 years it has moved the pole by two milliarcseconds of thirty arcminutes
    Held against: rate x trend x t2/2 in longitude, over itself
    """
    years = 40.0
    ends = ("2000-01-01T12:00", "2040-01-01T12:00", "14610 d")
    with_trend, without = (
        pole(*ends, effects=effects).psi.sel(axis="figure") for effects in (["j2-rate"], [])
    )
    moved = np.radians(float((with_trend - without)[-1]) / 3600)
    rate = np.radians(float(without[-1] - without[0]) / 3600) / (years * YEAR)
    expected = rate * float(BODY.j2_rate / BODY.j2) * (years * YEAR) ** 2 / 2
    yield moved / expected - 1
