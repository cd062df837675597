"""Stiff and extreme cases of the whole attitude."""

from __future__ import annotations

import numpy as np

from earthspin.bodies import Body
from earthspin.checks.case import Distances, FloatArray, holds
from earthspin.checks.ladders import of_rotation
from earthspin.checks.sky import eccentric_anomaly
from earthspin.checks.stored import attitude_error, load
from earthspin.constants import G
from earthspin.motion.equations import Rigid
from earthspin.motion.march import Above
from earthspin.motion.solution import Motion, start_of
from earthspin.questions.rotation import rotation
from earthspin.rotor.triaxial import free_rotation
from earthspin.sky.poles import FixedPole

UPRIGHT = np.array([1.0, 0.0, 0.0, 0.0])


def _body(a: float, b: float, unit: float = 1.0) -> Rigid:
    """A body of moments a, b and 1."""
    one = np.ones(1)
    return Rigid(c_minus_a=(1 - a) * one, c_minus_b=(1 - b) * one, tide=one, unit=unit)


def _free(moments: tuple[float, float], omega: tuple[float, ...], end: float) -> float:
    """Largest angle from Jacobi's closed form."""
    times = np.linspace(0.0, end, 50)
    body, alone = _body(*moments), Above(gm={}, positions=lambda times: {})
    result = Motion(body, alone, start_of(body, UPRIGHT, np.array(omega)), end).at(times)
    true = free_rotation((*moments, 1.0), omega, times).attitude
    return _angle(result.attitude, true)


def _angle(a: FloatArray, b: FloatArray) -> float:
    """Largest angle between attitudes, of which q and -q are the same."""
    chords = [np.linalg.norm(a - s * b, axis=1) for s in (1, -1)]
    return float(2 * np.max(np.minimum(*chords)))


@holds(bound=1e-11, unit="rad")
def _nearly_round() -> Distances:
    """a thousand turns of a body that is a hair from round

    Hard because: moments agree to 1e-12: what is left of them turns the pole once in 1e12 turns
    Held against: Jacobi's closed form
    """
    yield _free((1 - 2e-12, 1 - 1e-12), (0.1, 0.2, 1.0), 2000 * np.pi)


@holds(bound=9e-10, unit="rad")
def _racket() -> Distances:
    """a racket that flips, its attitude followed

    Hard because: near the middle axis each flip multiplies what rounding left by a thousand
    Held against: Jacobi's closed form
    """
    yield _free((0.4, 0.7), (1e-3, 1.0, 0.0), 60.0)


@holds(bound=1e-8, unit="rad")
def _rod() -> Distances:
    """a rod that tumbles

    Hard because: one moment is a ten-thousandth of the others, and the spin about it fast
    Held against: Jacobi's closed form
    """
    yield _free((1e-4, 1.0 - 1e-6), (50.0, 0.3, 0.2), 20.0)


@holds(bound=2e-13, unit="rad")
def _tumbling() -> Distances:
    """a tumbling moon over two and a half orbits

    Hard because: neighbours part fifteen times as far in that time
    Held against: extrapolation of order 20 in long double
    """
    times = of_rotation.times()
    (_, attitude), _ = of_rotation._windows(times, 1e-13)
    yield attitude_error(attitude, load("rotation", of_rotation.INPUTS)["attitude"])


@holds(bound=1.0)
def _close_passage() -> Distances:
    """a passage at a hundredth of the distance

    Hard because: the tide grows a million times within a thousandth of the orbit, and goes
    Held against: what both claim of their errors, at two tolerances
    """
    body, eccentricity = _body(0.7, 0.8), 0.99

    def places(times: FloatArray) -> dict[str, FloatArray]:
        start = times + eccentricity * np.sin(times)
        anomaly = eccentric_anomaly(times, eccentricity, steps=60, start=start)
        across = np.sqrt(1 - eccentricity**2) * np.sin(anomaly)
        return {"mass": np.stack([np.cos(anomaly) - eccentricity, across, 0 * times], axis=-1)}

    above, end = Above(gm={"mass": 1.0}, positions=places), np.array([9.0])
    start = start_of(body, UPRIGHT, np.array([0.1, 0.0, 1.0]))
    tight, loose = (
        Motion(body, above, start, 9.0, tolerance=tolerance).at(end) for tolerance in (1e-13, 1e-9)
    )
    apart = _angle(tight.attitude, loose.attitude)
    yield apart / (tight.error[0, 0, -1] + loose.error[0, 0, -1])


TOP = Body(
    name="gyroscope",
    gm=float(G.value),
    radius=1.0,
    j2=0.1,
    dynamical_flattening=0.25,
    pole=FixedPole(0.0, 1.2),
    spin_period=2.0,
)


@holds(bound=0.0, unit="rad")
def _at_rest() -> Distances:
    """a body at rest

    Hard because: nothing gives a unit of time, and the first window none of its length
    Held against: the attitude that it had
    """
    numbers = {"start_attitude": UPRIGHT, "start_omega": [0.0, 0.0, 0.0]}
    still = rotation("2000-01-01", "2000-01-02", "6 h", body=TOP, perturbers=[], **numbers)
    yield still.attitude.values - UPRIGHT
