"""Effects on the axes besides the torque on the equatorial bulge, one section for each effect.

An effect is a function that switches it on, registered with its name.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple, Protocol

import numpy as np

from earthspin.constants import DAYS_PER_YEAR, MAS, SPEED_OF_LIGHT, UAS
from earthspin.motion.forces import Forces, Places, RateLaw
from earthspin.numerics.arrays import FloatArray
from earthspin.numerics.polynomials import Windows
from earthspin.plug_ins import plug_in
from earthspin.torque.gravity import cross, dot

# --- effects and their register -------------------------------------------------------------------


#: Fields of a body on which effects depend.
Coefficient = Literal[
    "j2", "j2_rate", "j3", "j4", "triaxiality", "k2", "tidal_delay", "core_moment",
    "core_flattening", "core_friction", "gm", "spin_period",
]  # fmt: skip


class HasVector(Protocol):
    """Protocol of a direction in the ICRF."""

    def vector(self) -> FloatArray:
        """Unit vector of the direction, shape (3,)."""


class BodyNumbers(Protocol):
    """Protocol of a body whose numeric properties, such as J3, can be looked up by name."""

    @property
    def harmonics(self) -> Mapping[str, float]:
        """Stokes coefficients of degree 3 and higher by name, such as "c31"."""

    @property
    def orbit_pole(self) -> HasVector | None:
        """Normal of the orbit of the body."""

    def number(self, name: Coefficient) -> float:
        """Return a numeric property of the body, such as "j3", as a float."""


@dataclass(frozen=True)
class Effect:
    """An effect on the axes, besides the torque on the bulge, that users can switch on.

    Attributes
    ----------
    name : str
        Name of the effect in scenes.
    switch_on : callable
        Function of the forces without the effect and the numbers of the body that returns the
        forces with the effect.
    coefficient : str
        Field of the body to which the effect is proportional; empty if there is none.
    further : tuple of str
        Further fields of the body that the effect needs.
    """

    name: str
    switch_on: Callable[[Forces, BodyNumbers], Forces]
    coefficient: Coefficient | Literal["harmonics", ""] = ""
    further: tuple[Coefficient, ...] = ()

    def missing(self, body: BodyNumbers) -> list[str]:
        """Return the names of the fields that the effect needs, and that are not known."""
        needed = (self.coefficient, *self.further) if self.coefficient else ()
        unknown = {"harmonics"} if not body.harmonics else set()
        return [name for name in needed if name in unknown or getattr(body, name) is None]

    def is_idle(self, body: BodyNumbers) -> bool:
        """Return True if the coefficient of the effect is 0, or not known, for a body."""
        if self.missing(body) or self.coefficient == "" or self.coefficient == "harmonics":
            return bool(self.missing(body))
        return body.number(self.coefficient) == 0


class _Effects(dict[str, Effect]):
    """All effects by name; those of other packages are loaded when their names are not known."""

    def __missing__(self, name: str) -> Effect:
        if effect := plug_in("effects", name):
            return add(effect)
        raise KeyError(name)

    def __contains__(self, name: object) -> bool:
        return super().__contains__(name) or bool(plug_in("effects", str(name)) and self[str(name)])


#: Effects on the axes of any body by name.
EFFECTS = _Effects()


def add(effect: Effect) -> Effect:
    """Register an effect on the axes in `EFFECTS`, so that users can switch it on."""
    return register(EFFECTS, effect)


def register(effects: dict[str, Effect], effect: Effect) -> Effect:
    """Add an effect to a table of effects by its name.

    Returns
    -------
    Effect
        The same effect.

    Raises
    ------
    ValueError
        If another effect has this name.
    """
    if effects.setdefault(effect.name, effect) is not effect:
        raise ValueError(f"another effect has the name '{effect.name}'; choose a different one")
    return effect


# --- torques of the planets -----------------------------------------------------------------------
# Torques of the planets on the equatorial bulge of a body.


PLANETS = add(
    Effect("planets", lambda forces, body: replace(forces, gm={**forces.gm, **forces.far}))
)


# --- J3 and J4 ------------------------------------------------------------------------------------
# Torques of the nearest masses on the zonal harmonics J3 and J4 of the body.


def _zonal_harmonic(degree: int, name: Coefficient) -> Effect:
    def switch_on(forces: Forces, body: BodyNumbers) -> Forces:
        coefficient = body.number(name)
        if not coefficient:
            return forces
        zonal = {**forces.figure.zonal, degree: coefficient}
        return replace(forces, figure=replace(forces.figure, zonal=zonal))

    return add(Effect(name, switch_on, coefficient=name))


J3 = _zonal_harmonic(3, "j3")
J4 = _zonal_harmonic(4, "j4")


# --- triaxiality ----------------------------------------------------------------------------------
# Inequality of the equatorial moments A and B, which causes semidiurnal motion of the axes.


def _set_triaxiality(forces: Forces, body: BodyNumbers) -> Forces:
    figure = forces.figure
    triaxiality = figure.inverse_polar_moment * body.number("triaxiality")
    return replace(forces, figure=replace(figure, triaxiality=triaxiality))


TRIAXIALITY = add(Effect("triaxiality", _set_triaxiality, coefficient="triaxiality"))


# --- geodesic precession and nutation -------------------------------------------------------------
# Relativistic rotation of the local inertial frame.
#
# A gyroscope that orbits a mass precesses with respect to the stars (de Sitter 1916). For several
# masses, with positions and velocities in the barycentric frame (Brumberg, Bretagnon & Francou
# 1992; IERS Conventions 2010, eq. 10.12 for the same term in a satellite's motion),
#
#     \Omega_g = sum_A GM_A / (c2 r_A3) (x - x_A) x ((3/2) v - 2 v_A)
#
# It is 1.92 arcsec per century, prograde, with half a milliarcsecond from the Moon. The axes of the
# GCRS do not rotate with the local frame, so that an angular momentum in the GCRS has the rate N +
# Omega_g x L. The rotation is faster at perihelion, which causes geodesic nutation.


def geodesic_rate(
    gm: Mapping[str, float],
    position: Mapping[str, FloatArray],
    velocity: Mapping[str, FloatArray],
    primary: str,
) -> FloatArray:
    """Angular velocity of the body's local inertial frame relative to the stars, rad/s.

    Parameters
    ----------
    gm : mapping of str to float
        GM of the masses, m3 s-2.
    position, velocity : mapping of str to ndarray, shape (3, ...)
        Positions (m) and velocities (m/s) of the masses relative to the body.
    primary : str
        Mass that is used as the barycentre: the Sun moves at 13 m/s, the Earth at 30 km/s.

    Returns
    -------
    ndarray, shape (3, ...)
    """
    body_velocity = -velocity[primary]
    total = np.zeros_like(body_velocity)
    for name, mass in gm.items():
        offset = position[name]
        distance = np.sqrt(dot(offset, offset))
        scale = mass / (SPEED_OF_LIGHT.value**2 * distance**3)
        mass_velocity = velocity[name] + body_velocity
        total += scale * cross(2 * mass_velocity - 1.5 * body_velocity, -offset)
    return total


def geodesic_torque(forces: Forces, windows: Windows, place: Places) -> RateLaw:
    """Return a function for the rate of angular momentum due to geodesic precession."""
    near = {name: forces.gm[name] for name in {forces.sun, *forces.near}}
    velocity = {name: windows.derivative(place[name]) for name in near}
    rate = geodesic_rate(near, place, velocity, forces.sun)
    return lambda axis, momentum: cross(rate, momentum)


def _add_geodesic(forces: Forces, body: BodyNumbers) -> Forces:
    # The effect needs the Sun among the perturbers.
    if forces.sun not in forces.gm:
        return forces
    return replace(forces, torques=(*forces.torques, geodesic_torque))


GEODESIC = add(Effect("geodesic", _add_geodesic))


# --- change of J2 ---------------------------------------------------------------------------------
# Slow change of J2 due to post-glacial rebound of the mantle.


def _set_j2_trend(forces: Forces, body: BodyNumbers) -> Forces:
    j2 = body.number("j2")
    if not j2:
        return forces
    trend = body.number("j2_rate") / j2
    return replace(forces, figure=replace(forces.figure, j2_trend=trend))


J2_RATE = add(Effect("j2-rate", _set_j2_trend, coefficient="j2_rate"))


# --- second-order effects -------------------------------------------------------------------------
# Torques are computed for the nutating axis instead of the mean pole.


SECOND_ORDER = add(Effect("second-order", lambda forces, body: replace(forces, mean_pole=None)))


# --- response of the interior ---------------------------------------------------------------------
# Nutation response of a body's non-rigid interior, added to the path of the rigid body.
#
# Its size includes the different initial axes: the rigid path starts at the true pole of IAU
# 2006/2000A, the path with the response starts 30 mas away, such that the mean poles agree.


class AngleBound(NamedTuple):
    """Bound on an angle, swing + rate |t| in mas, with t in years from J2000.0."""

    swing: float
    rate: float

    def at(self, day: float) -> float:
        """Bound on the angle at a time in days from J2000.0, rad."""
        return MAS * (self.swing + self.rate * abs(day) / DAYS_PER_YEAR)


NONRIGID = add(Effect("nonrigid", lambda forces, body: forces))

#: Bound on the displacement of the figure axis of the Earth by the response of its interior,
#: measured on DE421 from 1950 to 2050 with `python -m data_tools neglected`.
RESPONSE = AngleBound(84.4, 0.116)
#: Largest amplitude of the free core nutation in windows of three years from 1984 to 2026, rad, in
#: the section `core_nutation` of `earthspin.pole_offsets`; no model predicts it.
LARGEST_CORE_NUTATION = 290 * UAS

#: Names of the effects on a rigid body.
RIGID = tuple(name for name in EFFECTS if name != NONRIGID.name)
