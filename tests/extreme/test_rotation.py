"""Full attitude of a body in time."""

import numpy as np

from earthspin.bodies import Body
from earthspin.constants import G
from earthspin.motion.equations import Rigid
from earthspin.motion.march import Masses
from earthspin.motion.solution import AttitudeIntegrator, start_of
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.rotation import rotation
from earthspin.rotor.triaxial import free_rotation
from earthspin.sky.poles import FixedPole
from tests.extreme import Distances, holds
from tests.reference.sky import eccentric_anomaly

UPRIGHT = np.array([1.0, 0.0, 0.0, 0.0])


def _body(a: float, b: float, unit: float = 1.0) -> Rigid:
    """Make a rigid body whose principal moments of inertia are a, b and 1."""
    one = np.ones(1)
    return Rigid(c_minus_a=(1 - a) * one, c_minus_b=(1 - b) * one, tide=one, unit=unit)


def _free(moments: tuple[float, float], omega: tuple[float, ...], end: float) -> float:
    """Largest angle between an integrated free rotation and Jacobi's closed form, rad."""
    times = np.linspace(0.0, end, 50)
    body, alone = _body(*moments), Masses(gm={}, positions=lambda times: {})
    result = AttitudeIntegrator(body, alone, start_of(body, UPRIGHT, np.array(omega)), end).at(
        times
    )
    true = free_rotation((*moments, 1.0), omega, times).attitude
    return _angle(result.attitude, true)


def _angle(a: FloatArray, b: FloatArray) -> float:
    """Largest angle between attitudes, where q and -q are the same, rad."""
    chords = [np.linalg.norm(a - s * b, axis=1) for s in (1, -1)]
    return float(2 * np.max(np.minimum(*chords)))


@holds(bound=1e-11, unit="rad")
def test_nearly_round() -> Distances:
    """attitude of a nearly spherical body over a thousand rotations

    Hard because: the moments agree to 1e-12, so the pole moves once around in 1e12 rotations
    Compared with: Jacobi's closed form
    """
    yield _free((1 - 2e-12, 1 - 1e-12), (0.1, 0.2, 1.0), 2000 * np.pi)


@holds(bound=1e-8, unit="rad")
def test_rod() -> Distances:
    """attitude of a thin tumbling rod

    Hard because: one moment is 1e-4 of the others, and the spin about its axis is fast
    Compared with: Jacobi's closed form
    """
    yield _free((1e-4, 1.0 - 1e-6), (50.0, 0.3, 0.2), 20.0)


@holds(bound=1.0)
def test_close_passage() -> Distances:
    """attitude while the perturber passes at a hundredth of its mean distance

    Hard because: the tide grows a million times within a thousandth of the orbit, and decreases
        again
    Compared with: sum of the claimed errors at two tolerances
    """
    body, eccentricity = _body(0.7, 0.8), 0.99

    def places(times: FloatArray) -> dict[str, FloatArray]:
        start = times + eccentricity * np.sin(times)
        anomaly = eccentric_anomaly(times, eccentricity, steps=60, start=start)
        across = np.sqrt(1 - eccentricity**2) * np.sin(anomaly)
        return {"mass": np.stack([np.cos(anomaly) - eccentricity, across, 0 * times], axis=-1)}

    masses, end = Masses(gm={"mass": 1.0}, positions=places), np.array([9.0])
    start = start_of(body, UPRIGHT, np.array([0.1, 0.0, 1.0]))
    tight, loose = (
        AttitudeIntegrator(body, masses, start, 9.0, tolerance=tolerance).at(end)
        for tolerance in (1e-13, 1e-9)
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
def test_at_rest() -> Distances:
    """attitude of a body without initial rotation

    Hard because: there is no angular velocity to set a unit of time or the length of the first
        window
    Compared with: initial attitude
    """
    numbers = {"start_attitude": UPRIGHT, "start_omega": [0.0, 0.0, 0.0]}
    still = rotation("2000-01-01", "2000-01-02", "6 h", body=TOP, perturbers=[], **numbers)
    yield still.attitude.values - UPRIGHT
