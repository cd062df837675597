"""Three solvers of the axes that share no method: on windows, (L, F), and the whole attitude."""

from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from earthspin.bodies import EARTH
from earthspin.motion.axes import AxisPath, axis_path
from earthspin.motion.forces import equatorial_basis
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.effects_and_torques import figure_of
from earthspin.sky.ephemeris import Ephemeris
from tests.motion.sky import NORTH, UAS, figure, forces
from tests.reference.attitude import attitude_motion
from tests.reference.momentum_and_figure import axisymmetric_motion
from tests.reference.sky import Tide

H, SPIN = EARTH.dynamical_flattening, float(EARTH.spin_rate)
TRIAXIALITY = EARTH.triaxiality * H / EARTH.j2
#: Angle of the axis of least moment at J2000.0.
MERIDIAN = figure_of(EARTH, SPIN).meridian


def differences(a: FloatArray, b: FloatArray) -> float:
    """Largest angle between two directions, uas."""
    a, b = (v / np.linalg.norm(v, axis=1, keepdims=True) for v in (a, b))
    return float(np.max(np.linalg.norm(a - b, axis=1)) / UAS)


def body_frame(axis: FloatArray, turned: float) -> FloatArray:
    """Matrix from the body's axes to the sky's."""
    first, second = equatorial_basis(axis)
    x = np.cos(turned) * first + np.sin(turned) * second
    return np.stack([x, np.cross(axis, x), axis], axis=1)


class Solvers:
    """The Earth under Sun and Moon by each of them, from J2000.0 on.

    Parameters
    ----------
    kernel : Ephemeris
    span : float
        s.
    turned : float, optional
        So far the attitude is followed, turn by turn, s; the whole span if it is not given.
    """

    def __init__(self, kernel: Ephemeris, span: float, turned: float | None = None) -> None:
        self.kernel, self.span = kernel, span
        self.times = np.linspace(0, span, 200)
        self.few = self.times[self.times <= (turned or span)]

    @cached_property
    def round_path(self) -> AxisPath:
        """The round Earth on windows."""
        return axis_path(forces(self.kernel), NORTH, 0.0, (0.0, self.span))

    @cached_property
    def uneven_path(self) -> AxisPath:
        """The triaxial Earth on windows."""
        body = figure(triaxiality=TRIAXIALITY, meridian=MERIDIAN)
        return axis_path(forces(self.kernel, body), NORTH, 0.0, (0.0, self.span))

    def start(self, path: AxisPath) -> FloatArray:
        """Angular momentum at the first time, in units of C Omega."""
        return np.asarray(path.windows.evaluate(path.momentum, self.times[:1])[:, 0])

    @cached_property
    def integrated(self) -> tuple[FloatArray, FloatArray]:
        """(L, F) by DOP853."""
        start = self.start(self.round_path)
        return axisymmetric_motion(Tide(self.span), H, SPIN, start, NORTH, self.times)

    @cached_property
    def turned(self) -> FloatArray:
        """Figure axis of the round Earth from its attitude."""
        first = Rotation.from_matrix(body_frame(NORTH, 0.3)).as_quat(scalar_first=True)
        start = self.start(self.round_path)
        _, turn = attitude_motion(Tide(self.span), H, 0.0, SPIN, start, first, self.few)
        return np.asarray(Rotation.from_quat(turn, scalar_first=True).as_matrix()[:, :, 2])

    @cached_property
    def turned_uneven(self) -> tuple[FloatArray, FloatArray]:
        """Angular momentum and attitude matrices of the triaxial Earth."""
        length = float(np.linalg.norm(self.start(self.uneven_path)))
        start = self.uneven_path.at(self.few[:1])
        first = Rotation.from_matrix(body_frame(start["figure"][0], MERIDIAN))
        momentum, turn = attitude_motion(
            Tide(self.span),
            H,
            TRIAXIALITY,
            SPIN,
            length * start["angular_momentum"][0],
            first.as_quat(scalar_first=True),
            self.few,
        )
        return momentum, np.asarray(Rotation.from_quat(turn, scalar_first=True).as_matrix())

    def windows_and_momentum(self) -> tuple[float, float]:
        """Figure axis and angular momentum on windows beside (L, F), uas."""
        momentum, axis = self.integrated
        found = self.round_path.at(self.times)
        return differences(found["figure"], axis), differences(found["angular_momentum"], momentum)

    def momentum_and_attitude(self) -> float:
        """Figure axis by (L, F) beside that of the attitude, uas."""
        return differences(self.turned, self.integrated[1][: self.few.size])

    def windows_and_attitude(self) -> float:
        """Figure axis of the triaxial Earth on windows beside that of the attitude, uas."""
        return differences(self.uneven_path.at(self.few)["figure"], self.turned_uneven[1][:, :, 2])
