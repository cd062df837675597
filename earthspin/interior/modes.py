r"""Mantle, fluid core and inner core that turn against one another: one linear system.

In a frame that turns at Omega (z + m) with the mantle, the fluid core turns by Omega m_f and the
inner core by Omega m_s beside it, and the axis of the inner core is tilted by n. With complex
vectors (x + i y) that vary as exp(i sigma Omega t), sigma = -1 being at rest in space, and a tidal
potential phi in the units of the wobbles (Mathews, Buffett, Herring & Shapiro 1991, JGR 96, 8219)::

    (sigma - e) m + (1 + sigma) (c + A_f/A m_f + A_s/A (m_s + a3 e_s n)) = -e phi
    sigma (m + c_f - (A_s/A_f) a1 e_s n) + (1 + sigma + e_f) m_f + K ...  = 0
    sigma (m + c_s) + a3 e_s (phi - m) + (1 + sigma) m_s + a1 e_s m_f
                                                + (1 + sigma - a2) e_s n + K ... = 0
    m_s + sigma n = 0

c, c_f, c_s are the products of inertia of whole, fluid and inner core over their A: linear in
(m - phi, m_f, m_s) through the answers of the layers (`love.Yielding`).

The second and the third row follow from one statement. Let S be a part of the core within a liquid
that turns at w, in equilibrium with the potential Psi of gravity, tide and its own centrifugal
force. The torque on S is the integral of r x grad(V) over its mass, less that of the pressure on
its surface, whose gradient is rho_f grad(Psi); and grad(V) is grad(Psi) less the centrifugal
force. So

    torque on S = w x (I w) + integral over S of (rho - rho_f) r x grad(Psi).

For the liquid itself the second term vanishes, and dH_f/dt + Omega (z + m) x H_f = w x H_f is the
second row. For the inner core it is the pull of tide, rotation and of the masses outside on what it
has more than the liquid would: A_s e_s a3 [(m + m_f - phi) - (1 + a_g) n] Omega2, a2 = a1 - a3 a_g.
Its product of inertia c_s stands on both sides, with 1 + sigma on the left and 1 on the right, so
that sigma c_s remains. What is left out is the pull on the *excess* that deformation makes, a few
hundredths of c_s.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from earthspin.interior.equilibrium import figure
from earthspin.interior.layers import LayeredBody
from earthspin.interior.love import elastic

Numeric = Any
Array = NDArray[Any]

#: Names of the free modes, in the order in which parts are added.
MODES = ("chandler_wobble", "free_core_nutation", "inner_core_nutation", "inner_core_wobble")


@dataclass(frozen=True)
class Parts:
    """What the system stands on; floats, or arrays of one shape.

    Attributes
    ----------
    e, e_f, e_s : float
        (C - A)/A of whole, fluid core and inner core.
    fluid, inner : float
        A_f/A and A_s/A; 0 for a part that is missing.
    a1, a2, a3 : float
        Coupling numbers of the inner core (`equilibrium.Figure`).
    answers : array, shape (..., 3, 3), complex
        Products of inertia over A of whole, fluid and inner core, for wobbles m, m_f and m_s of
        size 1.
    k_cmb, k_icb : complex
        Coupling at the boundaries of the fluid core beside that of the figure, in the units of
        e_f and e_s (Buffett, Mathews & Herring 2002, JGR 107(B4), 2070).
    """

    e: Numeric
    e_f: Numeric
    e_s: Numeric
    fluid: Numeric
    inner: Numeric
    a1: Numeric
    a2: Numeric
    a3: Numeric
    answers: Array
    k_cmb: Numeric = 0.0
    k_icb: Numeric = 0.0

    @property
    def count(self) -> int:
        """Unknowns: 4 with an inner core, 2 without, 1 for a body without a core."""
        return 4 if np.any(self.inner) else 2 if np.any(self.fluid) else 1

    @property
    def compliances(self) -> dict[str, Numeric]:
        """The same answers as Mathews et al. (1991) name them, each over the A of its part."""
        rows = (("kappa", "xi", "zeta"), ("gamma", "beta", "delta"), ("theta", "chi", "nu"))
        over = (1.0, self.fluid, self.inner)
        there = 1 + bool(np.any(self.fluid)) + bool(np.any(self.inner))
        return {
            name: self.answers[..., i, j] / over[i]
            for i, row in enumerate(rows[:there])
            for j, name in enumerate(row[:there])
        }


def all_fluid(parts: Parts, e_core: Numeric) -> Parts:
    """The same body with its inner core counted with the fluid: mantle and core alone.

    Parameters
    ----------
    parts : Parts
    e_core : float
        (C - A)/A of all the core.
    """
    lump = np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 1.0]])
    answers = np.zeros((*np.shape(parts.answers)[:-2], 3, 3), dtype=np.asarray(parts.answers).dtype)
    answers[..., :2, :2] = lump.T @ parts.answers @ lump
    none = dict.fromkeys(("e_s", "inner", "a1", "a2", "a3"), 0.0)
    return replace(
        parts, e_f=e_core, fluid=parts.fluid + parts.inner, answers=answers, k_icb=0.0, **none
    )


def system(parts: Parts) -> tuple[Array, Array, Array, Array]:
    """Matrices of (sigma P + Q) x = (sigma p + q) phi, x = (m, m_f, m_s, n).

    Returns
    -------
    P, Q : ndarray, shape (..., n, n)
    p, q : ndarray, shape (..., n)
        n is `Parts.count`.
    """
    o = parts
    shape = np.broadcast_shapes(
        np.shape(o.answers)[:-2], *(np.shape(v) for v in (o.e, o.e_f, o.fluid, o.k_cmb, o.k_icb))
    )
    p, q = (np.zeros((*shape, 4, 4), dtype=complex) for _ in range(2))
    right, left = (np.zeros((*shape, 4), dtype=complex) for _ in range(2))
    c = np.asarray(o.answers)
    share = (None, o.fluid, o.inner)
    # The whole body: c answers at (1 + sigma), as does what the core carries.
    for j in range(3):
        p[..., 0, j] = q[..., 0, j] = c[..., 0, j] + (1.0 if j == 0 else share[j])
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
    if o.count > 2:  # the inner core, and how its axis follows it
        for j in range(3):
            p[..., 2, j] = c[..., 2, j] / o.inner + (j != 1)
        p[..., 2, 3] = o.e_s
        q[..., 2, 0], q[..., 2, 1] = -o.a3 * o.e_s, o.a1 * o.e_s - o.k_icb
        q[..., 2, 2], q[..., 2, 3] = 1 + o.k_icb, (1 - o.a2) * o.e_s
        right[..., 2], left[..., 2] = c[..., 2, 0] / o.inner, -o.a3 * o.e_s
        p[..., 3, 3] = q[..., 3, 2] = 1
    n = o.count
    return p[..., :n, :n], q[..., :n, :n], right[..., :n], left[..., :n]


def held_by_mantle(parts: Parts) -> Parts:
    """The same body with its inner core bound to the mantle: the fluid core turns alone."""
    answers = np.array(parts.answers)
    answers[..., 2, :] = answers[..., :, 2] = 0
    none = dict.fromkeys(("e_s", "inner", "a1", "a2", "a3"), 0.0)
    return replace(parts, answers=answers, k_icb=0.0, **none)


def wobble_response(parts: Parts, sigma: Array) -> Array:
    """Wobble over tide, m/phi, at frequencies in the body, turns per turn."""
    p, q, right, left = system(parts)
    at = np.asarray(sigma)[..., None]
    found = np.linalg.solve(at[..., None] * p + q, (at * right + left)[..., None])
    return np.asarray(found[..., 0, 0])


def transfer(parts: Parts, sigma: Array, rigid_e: float) -> Array:
    """Nutation over that of a rigid body, at frequencies in the body.

    Parameters
    ----------
    parts : Parts
    sigma : ndarray
        Turns per turn of the body, negative if retrograde; -1 is at rest in space.
    rigid_e : float
        (C - A)/A of the rigid body. Whatever is inside, T(-1) is H of the body over that of the
        rigid one.
    """
    return np.asarray(wobble_response(parts, sigma) * (rigid_e - sigma) / rigid_e)


def free_modes(parts: Parts) -> dict[str, complex]:
    """Frequencies of the free modes in the body, turns per turn; Im > 0 decays.

    A mode that the body does not have, because a part is missing, is not among them.
    """
    p, q, _, _ = system(parts)
    roots, vectors = np.linalg.eig(-np.linalg.solve(p, q))
    wobbles: list[tuple[float, complex]] = []
    nutations: list[tuple[float, complex]] = []
    for s, x in zip(roots, vectors.T, strict=True):
        # How much of the motion is the inner core's own: of its axis, or of its turning.
        share = abs(x[3] / x[0]) if s.real > -0.5 and x.size > 2 else 0.0
        share = abs(x[2] / x[1]) if s.real <= -0.5 and x.size > 2 else share
        (wobbles if s.real > -0.5 else nutations).append((share, complex(s)))
    found = dict(zip(MODES[::3], (s for _, s in sorted(wobbles, key=_first)), strict=False))
    found |= zip(MODES[1:3], (s for _, s in sorted(nutations, key=_first)), strict=False)
    return {name: found[name] for name in MODES if name in found}


def _first(pair: tuple[float, complex]) -> float:
    return pair[0]


def parts_of(layers: LayeredBody, spin_rate: float, answers: Array, e: float) -> Parts:
    """All parts of a layered body, with its hydrostatic figure inside and a given one outside.

    Parameters
    ----------
    layers : LayeredBody
    spin_rate : float
        rad/s.
    answers : ndarray, shape (..., 3, 3)
        Of `love.Yielding`.
    e : float
        (C - A)/A of the whole.
    """
    f = figure(layers, spin_rate)
    return Parts(
        e=e, e_f=f.e_f, e_s=f.e_s, fluid=f.fluid, inner=f.inner, a1=f.a1, a2=f.a2, a3=f.a3,
        answers=f.unit * answers,
    )  # fmt: skip


def chandler_by_core(layers: LayeredBody, e: float, spin_rate: float) -> dict[str, float]:
    """Turns of the body in a free wobble, by what its inner core does.

    Parameters
    ----------
    layers : LayeredBody
    e : float
        (C - A)/A of the whole.
    spin_rate : float
        rad/s.

    Returns
    -------
    dict of str to float
        With the inner core bound to the mantle, counted with the fluid, and free.
    """
    free = parts_of(layers, spin_rate, elastic(layers).answers, e)
    models = {
        "bound to the mantle": held_by_mantle(free),
        "counted with the fluid": all_fluid(free, figure(layers, spin_rate).e_core),
        "free": free,
    }
    return {name: 1 / free_modes(of)["chandler_wobble"].real for name, of in models.items()}


def numbers_of(layers: LayeredBody, spin_rate: float) -> dict[str, float]:
    """Compliances, ellipticities, coupling numbers and moments, of the parts that there are.

    Parameters
    ----------
    layers : LayeredBody
    spin_rate : float
        rad/s.
    """
    f = figure(layers, spin_rate)
    parts = parts_of(layers, spin_rate, elastic(layers).answers, f.e)
    found = {name: float(value) for name, value in parts.compliances.items()} | {"e": f.e}
    if parts.count > 1:
        found |= {"e_f": f.e_f, "fluid": f.fluid}
    if parts.count > 2:
        found |= {"e_s": f.e_s, "a1": f.a1, "a2": f.a2, "a3": f.a3, "inner": f.inner}
    return found


def mode_period(name: str, mode: complex, spin_rate: float) -> float:
    """Period of a free mode, s: of a nutation in space, of a wobble in the body."""
    turns = 1 / (1 + mode.real) if name.endswith("nutation") else 1 / mode.real
    return float(turns * 2 * np.pi / abs(spin_rate))
