"""Rate of the angular momentum under torques, and the figure axis without free wobble.

The rate is that of all perturbers and of the effects that are switched on. For an effect that is
switched off, no positions and no torque are evaluated.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from earthspin.errors import UndefinedError
from earthspin.motion.equations import BodyLaw, LiquidCore
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.numerics.polynomials import Windows
from earthspin.torque.gravity import apply, cross, quadrupole_torque, tidal_tensor, zonal_law
from earthspin.torque.harmonics import HarmonicsTorque

#: Positions by name, each of shape (t, 3), m, at times in s from J2000.0.
Positions = Callable[[FloatArray], Mapping[str, FloatArray]]
#: Rate of the angular momentum in units of C Omega, s-1, from figure axis and angular momentum.
RateLaw = Callable[[FloatArray, FloatArray], FloatArray]
#: Positions at the nodes of windows by name, each of shape (3, w, n), m.
Places = Mapping[str, FloatArray]
#: Contribution of an effect to l', from the forces, the windows and the positions at their nodes.
Torque = Callable[["Forces", Windows, Places], RateLaw]
#: The same for an effect that depends on the full attitude.
BodyTorque = Callable[["Forces", Windows, Places], BodyLaw]


@dataclass(frozen=True, kw_only=True)
class DynamicalFigure:
    """Parameters of a rotating body (H, spin, J_n) that determine the motion of its axes.

    Attributes
    ----------
    h : float
        Dynamical flattening (C - A)/C, A the mean equatorial moment.
    spin_rate : float
        Spin rate, rad/s; negative if retrograde.
    inverse_polar_moment : float
        M a2/C = H/J2.
    radius : float
        Equatorial radius a, m.
    zonal : mapping of int to float
        Zonal coefficients J_n beyond J2 that are switched on, by degree.
    j2_trend : float
        Relative rate of J2 and H, s-1; 0 if switched off.
    triaxiality : float
        (B - A)/C; 0 if switched off.
    meridian : float
        Angle at J2000.0 from the x axis, projected on the equator, to the axis of least moment,
        rad.
    harmonics : HarmonicsTorque or None
        Harmonics of degree 3 and higher, if switched on.
    """

    h: float
    spin_rate: float
    inverse_polar_moment: float = 0.0
    radius: float = 0.0
    zonal: Mapping[int, float] = field(default_factory=dict)
    j2_trend: float = 0.0
    triaxiality: float = 0.0
    meridian: float = 0.0
    harmonics: HarmonicsTorque | None = None

    @property
    def tau(self) -> float:
        """Time A/(C Omega), s: angle from figure axis to angular momentum, over the axis speed."""
        return (1 - self.h) / self.spin_rate


@dataclass(frozen=True, kw_only=True)
class Forces:
    """Perturbers of a body, with all effects on its axes that are switched on.

    Attributes
    ----------
    figure : DynamicalFigure
    gm : mapping of str to float
        GM of the perturbers, m3 s-2.
    positions : callable
        Positions of the perturbers in `gm`.
    near : tuple of str
        Perturbers that are included in the torques on J3 and J4 and in geodesic precession.
    far : mapping of str to float
        GM of the planets, which an effect may add to `gm`, m3 s-2.
    torques : tuple of callable
        Further contributions to the rate of the angular momentum.
    mean_pole : callable or None
        Function of times (t,) that returns unit vectors (t, 3). If given, torques are evaluated for
        an axis in this direction, so second-order effects are switched off.
    sun : str
        Name of the Sun, if it is among the perturbers.
    primary : str
        Perturber with the largest tide, which acts on `harmonics` and raises tides; empty without
        perturbers.
    primary_bulge : tuple of float and ndarray
        J2 a2 (m2) and pole (unit vector) of that perturber; J2 a2 is 0 if not known.
    body_torques, inertia_changes : tuple of callable
        Effects that depend on the full attitude: torques, and changes of the products of inertia.
    core : LiquidCore or None
    """

    figure: DynamicalFigure
    gm: Mapping[str, float]
    positions: Positions
    near: tuple[str, ...] = ()
    far: Mapping[str, float] = field(default_factory=dict)
    torques: tuple[Torque, ...] = ()
    mean_pole: Callable[[FloatArray], FloatArray] | None = None
    sun: str = "sun"
    primary: str = ""
    primary_bulge: tuple[float, FloatArray] = (0.0, np.zeros(3))
    body_torques: tuple[BodyTorque, ...] = ()
    inertia_changes: tuple[BodyTorque, ...] = ()
    core: LiquidCore | None = None

    def over(self, windows: Windows) -> tuple[RateLaw, FloatArray]:
        """Return a function for the angular momentum's rate in time windows, and the tidal tensor.

        Positions of the perturbers are evaluated at the nodes of the windows.

        Returns
        -------
        rate : callable
            Function of figure axis and angular momentum at the nodes, shape (3, w, n), that returns
            l'.
        tensor : ndarray, shape (6, w, n)
            `tidal_tensor` of all perturbers.
        """
        figure = self.figure
        shape = windows.times.shape
        positions = self.positions(windows.times.ravel())
        positions_at_nodes = {
            name: np.ascontiguousarray(positions[name].T).reshape(3, *shape) for name in self.gm
        }
        tensor = tidal_tensor((gm, positions_at_nodes[name]) for name, gm in self.gm.items())
        scale = figure.h / figure.spin_rate * (1 + figure.j2_trend * windows.times)
        scaled = tensor * scale
        moment_scale = figure.inverse_polar_moment / figure.spin_rate
        zonal = {degree: moment_scale * coefficient for degree, coefficient in figure.zonal.items()}
        on_harmonics = [
            zonal_law(zonal, figure.radius, self.gm[name], positions_at_nodes[name])
            for name in (self.near if zonal else ())
        ]
        effect_laws = [torque(self, windows, positions_at_nodes) for torque in self.torques]

        def figure_torque(axis: FloatArray) -> FloatArray:
            total = quadrupole_torque(scaled, axis)
            for law in on_harmonics:
                total += law(axis)
            return total

        mean_torque: FloatArray | None = None
        if self.mean_pole is not None:
            pole = self.mean_pole(windows.times.ravel()).T
            mean_torque = figure_torque(np.ascontiguousarray(pole).reshape(3, *shape))

        def rate(axis: FloatArray, momentum: FloatArray) -> FloatArray:
            total = figure_torque(axis) if mean_torque is None else mean_torque.copy()
            for law in effect_laws:
                total += law(axis, momentum)
            return total

        return rate, tensor


# --- motion of the figure axis --------------------------------------------------------------------
# For an axisymmetric body whose spin about its figure axis F is Omega, with the angular momentum l
# in units of C Omega,
#
#     l = F + \tau F x F',     \tau = A/(C Omega)
#
# is exact. The free motion rotates F about l in about a day (I.6), while the motion due to torques
# is slow. Iteration for the tilt, l - F = tau F x (l' - (l - F)'), gives the only motion without a
# free part. Each round adds a term, -tau F x (the last term)', of a series in the ratio of the
# frequencies of the axis and of the spin. The series is asymptotic; for a slowly rotating body its
# terms soon grow.

#: Terms below this change no digit of a unit vector, rad.
_SMALLEST_TILT = 1e-17


def tilt_of_figure(
    windows: Windows, figure: FloatArray, rate: FloatArray, tau: float, rounds: int
) -> tuple[FloatArray, list[float]]:
    """Vector from figure axis to angular momentum in motion without free wobble, rad.

    It is tau F x F', where F is the unit figure axis and F' its rate.

    Parameters
    ----------
    windows : Windows
    figure : ndarray, shape (3, w, n)
        Estimate of F that is correct to first order.
    rate : ndarray, shape (3, w, n)
        l', s-1.
    tau : float
        A/(C Omega), s; negative for a retrograde spin.
    rounds : int
        Largest number of terms of the series.

    Returns
    -------
    tilt : ndarray, shape (3, w, n)
        Tilt, rad.
    sizes : list of float
        Largest value of each term, rad. The series is truncated before the terms grow.
    """
    scaled = tau * figure
    tilt = term = cross(scaled, rate)
    sizes = [float(np.max(np.abs(tilt)))]
    for _ in range(rounds):
        term = cross(windows.derivative(term), scaled)
        size = float(np.max(np.abs(term)))
        if size > 0.7 * sizes[-1]:
            break
        tilt += term
        sizes.append(size)
        if size < _SMALLEST_TILT:
            break
    return tilt, sizes


def fastest_sweep(h: float, spin_rate: float, perturbers: Iterable[tuple[float, float]]) -> float:
    """Largest speed of a precessing axis at any obliquity (reached at 45 degrees), rad/s.

    (3/4) H/Omega times the sum of GM/r3: the rate of precession in longitude, (3/2) H/Omega GM/r3
    cos(eps), times sin(eps) (I.8.23).

    Parameters
    ----------
    h : float
    spin_rate : float
        rad/s.
    perturbers : iterable of (gm, distance)
        m3 s-2 and m.
    """
    return abs(0.75 * h / spin_rate) * sum(gm / distance**3 for gm, distance in perturbers)


# --- semidiurnal motion ---------------------------------------------------------------------------
# The torque on B - A varies twice a day with the rotation of the body. In the plane of the equator,
# as a complex number with respect to the non-rotating direction e1, it is
#
#     n = -(3/2) i (B - A) conj(Q_1F + i Q_2F) exp(2 i theta)
#
# (from N = 3 GM/r5 r x I r, I.9.34). Its amplitude varies slowly, so that its integral and the
# response are series in the ratio of a day to the periods of the perturbers. They are computed by
# iteration:
#
#     l' = n/(C Omega),   l = f + i tau f',   w = f + (i/Omega) f'
#
# In addition, l contains the contribution of B - A to the angular momentum of a spin axis that is
# already tilted by l - f, -(B - A)/(2A) conj(l - f) exp(2 i theta) (0.1 uas). The amplitude of the
# axes is 0.03 mas; the mean motion does not change.

#: Smallest distance from the resonance of a flat body for which the series converges.
NEAREST_RESONANCE = 0.2
_ROUNDS = 8  # largest number of rounds; each gains a factor of 25 for fortnightly terms
#: Terms below this change no digit of a unit vector, rad.
_SMALLEST_TERM = 1e-16


def equatorial_basis(figure: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors in the equator plane; the first is along the projected x axis.

    Parameters
    ----------
    figure : ndarray, shape (3, ...)
        Unit vectors, none along x.
    """
    x, y, z = figure
    from_x = np.sqrt(y * y + z * z)
    towards_x = np.stack([1 - x * x, -x * y, -x * z]) / from_x
    across_x = np.stack([np.zeros_like(x), z, -y]) / from_x
    return towards_x, across_x


def semidiurnal_amplitudes(
    windows: Windows,
    tensor: FloatArray,
    direction: FloatArray,
    tilt: FloatArray,
    figure: DynamicalFigure,
) -> ComplexArray:
    """Complex amplitudes of the semidiurnal motion of a triaxial body's axes, rad, (3, w, n).

    The torque on an elongated equator changes twice in each turn of the body. The axes are, in
    this order, the angular momentum, the rotation axis and the figure axis.

    Parameters
    ----------
    windows : Windows
    tensor : ndarray, shape (6, w, n)
        `earthspin.torque.gravity.tidal_tensor`.
    direction : ndarray, shape (3, w, n)
        Figure axis without this motion.
    tilt : ndarray, shape (3, w, n)
        Angular momentum minus figure axis, rad.
    figure : DynamicalFigure

    Returns
    -------
    ndarray, shape (3, w, n), complex
        Amplitudes, rad, to be multiplied by exp(2 i theta), with the angle theta of the axis of
        least moment.

    Raises
    ------
    UndefinedError
        If the body is so flat that the period of its free nutation is close to half a day.
    """
    spin_rate, tau = figure.spin_rate, figure.tau
    towards_x, across_x = equatorial_basis(direction)
    q = _on_equator(apply(tensor, direction), towards_x, across_x)
    torque = -1.5j * figure.triaxiality / spin_rate * np.conj(q)
    phase_rate = 2j * spin_rate
    momentum = _series(windows, torque / phase_rate, -1 / phase_rate)

    ratio = tau * spin_rate  # A/C
    detuning = 1 - 2 * ratio  # from the free nutation, which a thin disc has at half a day
    if abs(detuning) < NEAREST_RESONANCE:
        raise UndefinedError(
            f"A/C = {ratio:.3g}: the semidiurnal torque on B - A resonates with the free nutation "
            f"(|1 - 2 A/C| under {NEAREST_RESONANCE}); remove the effect 'triaxiality' or set "
            f"the body's triaxiality to 0"
        )
    by_tilt = figure.triaxiality / (2 * ratio) * np.conj(_on_equator(tilt, towards_x, across_x))
    axis = _series(windows, (momentum + by_tilt) / detuning, -1j * tau / detuning)
    rotation = -axis + 1j * windows.derivative(axis) / spin_rate
    return np.stack([momentum, rotation, axis])


def _series(windows: Windows, start: ComplexArray, factor: complex) -> ComplexArray:
    """Solve x = start + factor dx/dt for x, by repeated differentiation of `start`.

    Each term is `factor` times the derivative of the previous term.
    """
    total = term = start
    for _ in range(_ROUNDS):
        term = factor * windows.derivative(term)
        total = total + term
        if np.max(np.abs(term.view(float))) < _SMALLEST_TERM:
            break
    return total


def _on_equator(vector: FloatArray, towards_x: FloatArray, across_x: FloatArray) -> ComplexArray:
    """Projections of vectors on the equator plane, as complex numbers in a given basis."""
    return np.asarray(np.sum(vector * towards_x, axis=0) + 1j * np.sum(vector * across_x, axis=0))
