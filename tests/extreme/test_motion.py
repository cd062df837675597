"""Motion of the Earth's axes in time.

The spin is 10^7 times faster than the precession. The averaged rate does not depend on the phase of
the spin, the axis solver uses windows of several days, and the solver of (L, F) resolves every
rotation.
"""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from earthspin.bodies import MOON, SUN
from earthspin.constants import ARCSEC_PER_YEAR, DAY, JULIAN_YEAR, PUBLISHED_EFFECTS, UAS
from earthspin.motion.axes import AxisPath, axis_path
from earthspin.motion.forces import DynamicalFigure, Forces
from earthspin.numerics.arrays import FloatArray
from earthspin.nutation.analysis import on_fixed_ecliptic
from earthspin.questions.averages import Samples, torque_samples
from earthspin.questions.pole import pole
from earthspin.questions.sky import Interval, interval, places, sky
from earthspin.sky.iau_models import fixed_ecliptic
from earthspin.torque.rates import precession_rate
from tests.extreme import Distances, holds, relative_error
from tests.reference.momentum_and_figure import axisymmetric_motion
from tests.reference.sky import BODY, CENTRE, CODES, FORCES, J2, SPIN, H, Tide, kernel, positions

YEAR = JULIAN_YEAR
ROUND = FORCES.figure
TRIAXIALITY = float(BODY.triaxiality) * H / J2
#: An arbitrary direction near the pole.
NORTH = np.array([2e-5, -3e-5, 1.0]) / np.linalg.norm([2e-5, -3e-5, 1.0])


def _path(days: float, body: DynamicalFigure = ROUND, **settings: Any) -> AxisPath:
    return axis_path(replace(FORCES, figure=body), NORTH, 0.0, (0.0, days * DAY), **settings)


def _angle(a: FloatArray, b: FloatArray) -> float:
    """Largest angle between two directions, uas."""
    a, b = (v / np.linalg.norm(v, axis=-1, keepdims=True) for v in (a, b))
    return float(np.max(np.linalg.norm(a - b, axis=-1)) / UAS)


def _momentum(path: AxisPath) -> FloatArray:
    """Initial angular momentum of a path, in units of C Omega, shape (3,)."""
    return path.windows.evaluate(path.momentum, np.zeros(1))[:, 0]


def _pole_against_exact(days: float, forces: Forces = FORCES) -> float:
    """Largest angle between the figure axes of the axis solver and of a direct integration, uas."""
    times, body = np.linspace(0.0, days * DAY, 40), forces.figure
    path = axis_path(forces, NORTH, 0.0, (0.0, times[-1]))
    start, tide = path.at(times[:1])["figure"][0], Tide(days * DAY, forces.gm)
    _, axis = axisymmetric_motion(tide, body.h, body.spin_rate, _momentum(path), start, times)
    return _angle(path.at(times)["figure"], axis)


@holds(bound=2e-5, unit="arcsec/yr")
def test_average_and_pole() -> Distances:
    """averaged precession rate and Earth's pole over 93 years

    Hard because: a nutation of 9 arcsec, half a million times the error per year, must average to
        zero
    Compared with: averaged rate plus the published second-order effect (Capitaine et al. 2003)
    """
    samples = _samples()
    window, times = samples.window, samples.times
    averaged = precession_rate(window.mean(times, samples.precessing).sum(), H, SPIN)
    start = BODY.needed("pole").true(0.0)
    path = axis_path(FORCES, start, 0.0, (times[0] - DAY, times[-1] + DAY))
    before, after = (_psi(path.at(times + s * DAY / 2)["angular_momentum"]) for s in (-1, 1))
    integrated = float(window.mean(times, after - before)) / DAY
    second_order = PUBLISHED_EFFECTS["second-order"].value
    yield (integrated - averaged) / ARCSEC_PER_YEAR - second_order


def _samples(cycles: float | None = None) -> Samples:
    """Daily torques of Sun and Moon over some periods of the Moon's node, or the whole kernel."""
    both = BODY, (SUN, MOON)
    above = sky("de421", places(*both), "jplephem")
    if cycles is None:
        return torque_samples(above, interval(above, None), *both)
    half = cycles * MOON.cycle / DAY / 2 + 1e-3
    return torque_samples(above, Interval(-half, half), *both)


def _psi(vectors: FloatArray) -> FloatArray:
    return np.unwrap(on_fixed_ecliptic(vectors, fixed_ecliptic())[:, 0])


@holds(bound=0.01, unit="uas")
def test_retrograde() -> Distances:
    """pole of an Earth that rotates in the opposite sense

    Hard because: the free mode has the opposite sense, and A/(C Omega) is negative
    Compared with: integration of (L, F) over 20 d
    """
    yield _pole_against_exact(20.0, replace(FORCES, figure=replace(ROUND, spin_rate=-SPIN)))


@holds(bound=10.0, unit="uas")
def test_thousandfold() -> Distances:
    """Earth's pole with a Sun and Moon of a thousand times their mass

    Hard because: the axis precesses once in 26 years and is tilted by 9 arcsec from L
    Compared with: integration of (L, F) over 20 d
    """
    heavy = {name: 1e3 * gm for name, gm in FORCES.gm.items()}
    yield _pole_against_exact(20.0, replace(FORCES, gm=heavy))


@holds(bound=5e-7)
def test_fast_spin() -> Distances:
    """pole of an Earth with a rotation period of ten seconds

    Hard because: the period of the free mode and the window differ by a factor of 70,000
    Compared with: half the displacement at half the spin rate, because precession is proportional
        to 1/spin, relative
    """
    times = np.linspace(0.0, YEAR, 20)
    fast, half = (
        _path(365.25, replace(ROUND, spin_rate=2 * np.pi / seconds)).at(times)["figure"][1:] - NORTH
        for seconds in (10.0, 20.0)
    )
    yield relative_error(2 * fast, half)


@holds(bound=2e-4, unit="uas")
def test_tiny_h() -> Distances:
    """pole of an Earth with a dynamical flattening of 1e-9

    Hard because: the precession in a year is 6 uas, 10^-11 of the vector
    Compared with: a thousandth of the displacement with H = 1e-6
    """
    times = np.linspace(0.0, YEAR, 20)
    paths = (_path(365.25, replace(ROUND, h=h)) for h in (1e-9, 1e-6))
    small, large = (path.at(times)["figure"] - NORTH for path in paths)
    yield (small - 1e-3 * large) / UAS


@holds(bound=0.02, unit="uas")
def test_there_and_back() -> Distances:
    """Earth's pole integrated 20 years forward and back

    Hard because: the figure axis at the end contains the tilt of that day, which enters the new
        start
    Compared with: figure axis at the start and at 60 times
    """
    end = 20 * YEAR
    there = _path(20 * 365.25)
    figure = there.at(np.array([end]))["figure"][0]
    back = axis_path(FORCES, figure, end, (0.0, end))
    times = np.linspace(0.0, end, 60)
    yield _angle(there.at(times)["figure"], back.at(times)["figure"])


@holds(bound=1e-4, unit="uas")
def test_backwards() -> Distances:
    """Earth's pole with the positions of Sun and Moon in reversed time

    Hard because: time and spin are both reversed, so every odd term must change sign
    Compared with: axis before the epoch in the original time
    """
    times = np.linspace(0.0, 5 * YEAR, 40)
    before = axis_path(FORCES, NORTH, 0.0, (-5 * YEAR, 0.0)).at(-times)
    retrograde = replace(ROUND, spin_rate=-SPIN)
    mirrored = replace(FORCES, figure=retrograde, positions=lambda t: positions(-t / DAY))
    after = axis_path(mirrored, NORTH, 0.0, (0.0, 5 * YEAR)).at(times)
    yield _angle(before["figure"], after["figure"])


@holds(bound=0.01, unit="uas")
def test_resonant_windows() -> Distances:
    """Earth's pole by integration windows in resonance with the free wobble

    Hard because: windows of 0.5, 1, 2 and 3 rotations alias the free motion
    Compared with: windows of 8 d over 60 d
    """
    times = np.linspace(0.0, 60 * DAY, 100)
    usual = _path(60.0).at(times)["figure"]
    rotation = 2 * np.pi / SPIN * (1 - H)
    for rotations in (0.5, 1.0, 1.0 + 1e-12, 2.0, 3.0):
        yield _angle(_path(60.0, window=rotations * rotation).at(times)["figure"], usual)


@pytest.mark.slow
@holds(bound=0.03, unit="uas")
def test_whole_kernel() -> Distances:
    """Earth's pole over the whole span of the ephemeris kernel

    Hard because: 154 years take 7000 windows in segments that are joined outward from J2000
    Compared with: windows of half the length with 16 nodes
    """
    start, end = (day * DAY for day in kernel().coverage({*CODES.values(), CENTRE}))
    times = np.linspace(start, end, 3000)

    def figure(days: float, nodes: int) -> FloatArray:
        span, window = (start, end), days * DAY
        path = axis_path(FORCES, NORTH, 0.0, span, limits=span, window=window, order=nodes)
        return path.at(times)["figure"]

    yield _angle(figure(8, 14), figure(4, 16))


@holds(bound=5e-15)
def test_obliquities() -> Distances:
    """motion of the pole at obliquities of 0, 90 and 180 degrees

    Hard because: longitudes are undefined at 0 and 180 degrees, but vectors are not
    Compared with: unit vectors, and zero torque on a body with its axis normal to a circular orbit
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
def test_kernel_ends() -> Distances:
    """Earth's pole in the first and last second of the ephemeris kernel

    Hard because: windows must not extend beyond the kernel, and no very short window may remain at
        its ends
    Compared with: motion of the figure axis in one second, 0.2 to 2 uas
    """
    times = ["1899-07-29T00:00:00", "1899-07-29T00:00:01", "2053-10-08T23:59:59", "2053-10-09"]
    result = pole(times=times).sel(axis="figure")
    place = np.stack([result.X, result.Y, result.Z], axis=-1)
    yield _angle(place[0], place[1])
    yield _angle(place[2], place[3])


@holds(bound=9e-4)
def test_geodesic_alone() -> Distances:
    """geodesic precession of a body with almost no bulge

    Hard because: only the frame rotates, prograde, at 1/2600 of the rate that torques produce
    Compared with: published rate along the ecliptic over 30 years, relative
    """
    years = 30.0
    body = BODY.replace(j2=1e-15, dynamical_flattening=3e-15)
    path = pole("2000-01-01T12:00", "2030-01-01", "3652.5 d", body=body, effects=["geodesic"])
    precession = float((path.psi[-1] - path.psi[0]).sel(axis="figure"))  # arcsec
    yield precession / (PUBLISHED_EFFECTS["geodesic"].value * years) - 1


@holds(bound=0.03)
def test_slow_bulge() -> Distances:
    """motion of the pole with a J2 that changes by 3e-6 of its value per century

    Hard because: in 40 years it moves the pole by two milliarcseconds, compared with thirty
        arcminutes of precession
    Compared with: rate x trend x t2/2 in longitude, relative
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
