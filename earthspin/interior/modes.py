r"""Coupled rotation of mantle, fluid core and inner core as one linear system of equations.

In a frame that rotates with the mantle at Omega (z + m), the fluid core rotates at Omega m_f, the
inner core at Omega m_s, and the figure axis of the inner core is tilted by n. With complex
vectors (x + i y) that vary as exp(i sigma Omega t), sigma = -1 being at rest in space, and a tidal
potential phi in the units of the wobbles (Mathews, Buffett, Herring & Shapiro 1991, JGR 96, 8219)::

    (sigma - e) m + (1 + sigma) (c + A_f/A m_f + A_s/A (m_s + a3 e_s n)) = -e phi
    sigma (m + c_f - (A_s/A_f) a1 e_s n) + (1 + sigma + e_f) m_f + K ...  = 0
    sigma (m + c_s) + a3 e_s (phi - m) + (1 + sigma) m_s + a1 e_s m_f
                                                + (1 + sigma - a2) e_s n + K ... = 0
    m_s + sigma n = 0

c, c_f, c_s are the products of inertia of the whole body, the fluid core and the inner core,
divided by the A of each. They are linear in (m - phi, m_f, m_s), with coefficients from
`love.DegreeTwoLoveNumbers`.

The second and the third row have the same derivation. Let S be a region of the core within a fluid
that rotates at w, in equilibrium with the potential Psi of gravity, tide and centrifugal force. The
torque on S is the integral of r x grad(V) over its mass, minus the torque of the pressure on its
surface, whose gradient is rho_f grad(Psi); grad(V) is grad(Psi) minus the centrifugal force. Hence

    torque on S = w x (I w) + integral over S of (rho - rho_f) r x grad(Psi).

For the fluid itself the second term vanishes, and dH_f/dt + Omega (z + m) x H_f = w x H_f is the
second row. For the inner core the second term is the torque of tide, rotation and outer masses on
its excess over the fluid: A_s e_s a3 [(m + m_f - phi) - (1 + a_g) n] Omega2, a2 = a1 - a3 a_g.
Its product of inertia c_s occurs on both sides, with 1 + sigma on the left and 1 on the right, so
that sigma c_s remains. The torque on the *excess* caused by deformation, a few hundredths of c_s,
is neglected.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from operator import itemgetter

import numpy as np

from earthspin.interior.equilibrium import Regions, figure
from earthspin.interior.layers import LayeredBody
from earthspin.interior.love import elastic
from earthspin.numerics.arrays import Array, Numeric

#: Names of the free modes: first the one of mantle or fluid core, then that of the inner core.
WOBBLES = ("chandler_wobble", "inner_core_wobble")
NUTATIONS = ("free_core_nutation", "inner_core_nutation")
#: Names of all free modes, in the order in which regions are added.
MODES = (WOBBLES[0], *NUTATIONS, WOBBLES[1])


@dataclass(frozen=True)
class Parts(Regions):
    """Parameters of the coupled rotation of mantle and core; floats, or arrays of one shape.

    Attributes
    ----------
    inertia : array, shape (..., 3, 3), complex
        Products of inertia, divided by A, of the whole body, fluid core and inner core, for unit
        wobbles m, m_f and m_s.
    k_cmb, k_icb : complex
        Coupling constants of the fluid core's two boundaries, in addition to pressure and gravity,
        in the units of e_f and e_s (Buffett, Mathews & Herring 2002, JGR 107(B4), 2070).
    """

    inertia: Array
    k_cmb: Numeric = 0.0
    k_icb: Numeric = 0.0

    @property
    def count(self) -> int:
        """Number of unknown rotations: 4 with an inner core, 2 with a fluid core only, else 1."""
        return 4 if np.any(self.inner) else 2 if np.any(self.fluid) else 1

    @property
    def compliances(self) -> dict[str, Numeric]:
        """Compliances of mantle, fluid core and inner core, named as in Mathews et al. (1991).

        Each is normalised by the equatorial moment A of its region.
        """
        rows = (("kappa", "xi", "zeta"), ("gamma", "beta", "delta"), ("theta", "chi", "nu"))
        moments = (1.0, self.fluid, self.inner)
        regions = 1 + bool(np.any(self.fluid)) + bool(np.any(self.inner))
        return {
            name: self.inertia[..., i, j] / moments[i]
            for i, row in enumerate(rows[:regions])
            for j, name in enumerate(row[:regions])
        }


def all_fluid(parts: Parts, e_core: Numeric) -> Parts:
    """Parameters of coupled rotation if the inner core is treated as part of the fluid core.

    Parameters
    ----------
    parts : Parts
    e_core : float
        (C - A)/A of the whole core.
    """
    regions = np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 1.0]])
    inertia = np.zeros((*np.shape(parts.inertia)[:-2], 3, 3), dtype=np.asarray(parts.inertia).dtype)
    inertia[..., :2, :2] = regions.T @ parts.inertia @ regions
    none = dict.fromkeys(("e_s", "inner", "a1", "a2", "a3"), 0.0)
    return replace(
        parts, e_f=e_core, fluid=parts.fluid + parts.inner, inertia=inertia, k_icb=0.0, **none
    )


def system(parts: Parts) -> tuple[Array, Array, Array, Array]:
    """Matrices P, Q and vectors p, q of the linear equations of coupled rotation.

    The equations are (sigma P + Q) x = (sigma p + q) phi with x = (m, m_f, m_s, n).

    Returns
    -------
    P, Q : ndarray, shape (..., n, n)
    p, q : ndarray, shape (..., n)
        n is `Parts.count`.
    """
    o = parts
    shape = np.broadcast_shapes(
        np.shape(o.inertia)[:-2], *(np.shape(v) for v in (o.e, o.e_f, o.fluid, o.k_cmb, o.k_icb))
    )
    p, q = (np.zeros((*shape, 4, 4), dtype=complex) for _ in range(2))
    right, left = (np.zeros((*shape, 4), dtype=complex) for _ in range(2))
    c = np.asarray(o.inertia)
    moments = (None, o.fluid, o.inner)
    # The whole body: c and the angular momentum of the core enter with (1 + sigma).
    for j in range(3):
        p[..., 0, j] = q[..., 0, j] = c[..., 0, j] + (1.0 if j == 0 else moments[j])
    q[..., 0, 0] -= 1 + o.e
    p[..., 0, 3] = q[..., 0, 3] = o.inner * o.a3 * o.e_s
    right[..., 0], left[..., 0] = c[..., 0, 0], c[..., 0, 0] - o.e
    if o.count > 1:  # the fluid core
        ratio = o.inner / o.fluid
        for j in range(3):
            p[..., 1, j] = c[..., 1, j] / o.fluid + (j < 2)
        p[..., 1, 3] = -o.a1 * o.e_s * ratio
        q[..., 1, 1] = 1 + o.e_f + o.k_cmb + ratio * o.k_icb
        q[..., 1, 2] = -ratio * o.k_icb
        right[..., 1] = c[..., 1, 0] / o.fluid
    if o.count > 2:  # the inner core, and the kinematics of its axis
        for j in range(3):
            p[..., 2, j] = c[..., 2, j] / o.inner + (j != 1)
        p[..., 2, 3] = o.e_s
        q[..., 2, 0], q[..., 2, 1] = -o.a3 * o.e_s, o.a1 * o.e_s - o.k_icb
        q[..., 2, 2], q[..., 2, 3] = 1 + o.k_icb, (1 - o.a2) * o.e_s
        right[..., 2], left[..., 2] = c[..., 2, 0] / o.inner, -o.a3 * o.e_s
        p[..., 3, 3] = q[..., 3, 2] = 1
    n = o.count
    return p[..., :n, :n], q[..., :n, :n], right[..., :n], left[..., :n]


def wobble_response(parts: Parts, sigma: Array) -> Array:
    """Wobble m of the mantle per unit tidal potential, at frequencies in cycles per rotation."""
    p, q, right, left = system(parts)
    frequency = np.asarray(sigma)[..., None]
    solution = np.linalg.solve(frequency[..., None] * p + q, (frequency * right + left)[..., None])
    return np.asarray(solution[..., 0, 0])


def transfer(parts: Parts, sigma: Array, rigid_e: float) -> Array:
    """Ratio of nutation amplitudes, actual to rigid body, at body-fixed frequencies.

    Parameters
    ----------
    parts : Parts
    sigma : ndarray
        Frequencies in cycles per rotation, negative if retrograde; -1 is at rest in space.
    rigid_e : float
        (C - A)/A of the rigid body. For any interior, T(-1) is H of the body divided by H of the
        rigid one.
    """
    return np.asarray(wobble_response(parts, sigma) * (rigid_e - sigma) / rigid_e)


def free_modes(parts: Parts) -> dict[str, complex]:
    """Complex body-fixed frequencies of the free modes, cycles per rotation, by name.

    The imaginary part is positive if the mode decays. Modes of absent regions are not included.
    """
    p, q, _, _ = system(parts)
    roots, vectors = np.linalg.eig(-np.linalg.solve(p, q))
    wobbles: list[tuple[float, complex]] = []
    nutations: list[tuple[float, complex]] = []
    for s, x in zip(roots, vectors.T, strict=True):
        # Relative amplitude of the inner core: of its axis, or of its rotation.
        amplitude = abs(x[3] / x[0]) if s.real > -0.5 and x.size > 2 else 0.0
        amplitude = abs(x[2] / x[1]) if s.real <= -0.5 and x.size > 2 else amplitude
        (wobbles if s.real > -0.5 else nutations).append((amplitude, complex(s)))
    by_amplitude = itemgetter(0)
    modes = dict(zip(WOBBLES, (s for _, s in sorted(wobbles, key=by_amplitude)), strict=False))
    modes |= zip(NUTATIONS, (s for _, s in sorted(nutations, key=by_amplitude)), strict=False)
    return {name: modes[name] for name in MODES if name in modes}


def parts_of(layers: LayeredBody, spin_rate: float, response: Array, e: float) -> Parts:
    """Parameters of coupled rotation: hydrostatic core, and given (C - A)/A of the whole body.

    Parameters
    ----------
    layers : LayeredBody
    spin_rate : float
        rad/s.
    response : ndarray, shape (..., 3, 3)
        Responses from `love.DegreeTwoLoveNumbers`.
    e : float
        (C - A)/A of the whole body.
    """
    f = figure(layers, spin_rate)
    regions = {field.name: getattr(f, field.name) for field in fields(Regions)}
    return Parts(**regions | {"e": e}, inertia=f.tidal_inertia * response)


def numbers_of(layers: LayeredBody, spin_rate: float) -> dict[str, float]:
    """Compliances, ellipticities, coupling numbers and moments of a layered body, by name.

    The moments are relative; regions that the body lacks are omitted.

    Parameters
    ----------
    layers : LayeredBody
    spin_rate : float
        rad/s.
    """
    f = figure(layers, spin_rate)
    parts = parts_of(layers, spin_rate, elastic(layers).response, f.e)
    numbers = {name: float(value) for name, value in parts.compliances.items()} | {"e": f.e}
    if parts.count > 1:
        numbers |= {"e_f": f.e_f, "fluid": f.fluid}
    if parts.count > 2:
        numbers |= {"e_s": f.e_s, "a1": f.a1, "a2": f.a2, "a3": f.a3, "inner": f.inner}
    return numbers


def mode_period(name: str, mode: Numeric, spin_rate: float) -> Numeric:
    """Period of a free mode, s: in space for a nutation, relative to the body for a wobble."""
    rotations = 1 / (1 + mode.real) if name.endswith("nutation") else 1 / mode.real
    return rotations * 2 * np.pi / abs(spin_rate)
