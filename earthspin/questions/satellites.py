"""Effect of satellites on precession: common precession rate, and nutation by satellite nodes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import astuple, dataclass, replace
from typing import Any

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import Body, Numeric, all_of, in_a_sentence
from earthspin.constants import JULIAN_YEAR, NORMAL_95
from earthspin.errors import BodyError
from earthspin.numerics.arrays import FloatArray
from earthspin.sky.poles import angle
from earthspin.torque.laplace import Planet, Satellites, laplace_tilts, nodes, omitted, shares

#: Relative bound on the error of the nutations by nodes: the terms of the IAU's pole of Jupiter
#: differ by up to 22 %, that of Neptune by 10 % for C/(M R2) = 0.23.
NODE_ERROR = 0.25


@dataclass(frozen=True)
class SatelliteFactors:
    """Factors by which satellites change torque, polar moment and precession rate of a body.

    Attributes
    ----------
    bulge : float or DataArray
        J2'/J2: factor on the torque.
    moment : float or DataArray
        C'/C.
    uncertainty, bulge_uncertainty : float or DataArray
        Relative standard uncertainties of the rate and of `bulge`, due to the masses of the
        satellites and to what the model leaves out.
    """

    bulge: Numeric = 1.0
    moment: Numeric = 1.0
    uncertainty: Numeric = 0.0
    bulge_uncertainty: Numeric = 0.0

    @property
    def rate(self) -> Numeric:
        """Precession rate with satellites, divided by the rate of the body alone."""
        return self.bulge / self.moment


def no_satellites(body: Body) -> str | None:
    """Return the reason (text) to omit the motion of satellites if there are none, else None."""
    return None if body.satellites else f"{in_a_sentence(body.name)} has no satellites here"


def with_mean_pole(body: Body) -> Body:
    """Replace the pole of a body by the mean pole, without nutation by the nodes of satellites."""
    if not body.satellites:
        return body
    pole = body.needed("pole").without_nutation()
    return body.replace(pole=pole, pole_uncertainty=body.pole_uncertainty)


def mean_pole_error(body: Body, half: float | None, gm_over_r3: Numeric) -> float | None:
    """95 % half-width of the direction of the mean pole at J2000.0, rad; None if it is not known.

    The pole of a planet without periodic terms of its satellites' nodes may be anywhere on the
    circles that these describe about the mean.

    Parameters
    ----------
    body : Body
    half : float or None
        Half-width of the direction of the body's pole, rad.
    gm_over_r3 : float or DataArray
        Sum of GM <1/r3> of the perturbers, s-2.
    """
    obliquity = obliquity_of(body) if body.satellites else None
    pole = body.needed("pole")
    if half is None or obliquity is None or pole.without_nutation() != pole:
        return half
    nutations = node_nutations(body, gm_over_r3, obliquity).values()
    return math.hypot(half, *(nutation.angle for nutation in nutations))


def describe_pole(body: Body) -> str:
    """Describe in words the pole used for precession: as given, or mean over satellite nodes."""
    if not body.satellites:
        return str(body.needed("pole"))
    names = ", ".join(satellite.name for satellite in body.satellites)
    return f"mean over the nodes of {names}"


def satellite_factors(body: Body, gm_over_r3: Numeric, obliquity: Numeric) -> SatelliteFactors:
    """Compute the factors by which satellites change torque, moment and precession of a body.

    Parameters
    ----------
    body : Body
        Its numbers may be labelled arrays.
    gm_over_r3 : float or DataArray
        Sum of GM <1/r3> of the perturbers, s-2.
    obliquity : float or DataArray
        rad.

    Raises
    ------
    BodyError
        If the polar moment does not follow from J2 and H.
    """
    if not body.satellites:
        return SatelliteFactors()
    _refuse_sphere(body)
    if hasattr(obliquity, "dims") or any(n.startswith("satellites.") for n in body.arrays):
        return _factors_of_each(body, gm_over_r3, obliquity)
    names = ("gm", "radius", "j2", "dynamical_flattening", "spin_rate")
    inputs = [*(getattr(body, name) for name in names), gm_over_r3]
    numbers = xr.broadcast(*map(xr.DataArray, inputs))
    template = numbers[0]
    columns = [array.values.reshape(-1, 1) for array in numbers]
    planet = _planet(columns, obliquity)

    def factors(q: FloatArray, moment: FloatArray) -> tuple[FloatArray, FloatArray]:
        return 1 + q.sum(1) / planet.j2[:, 0], 1 + moment.sum(1) / planet.polar_moment[:, 0]

    satellites = _satellites(body)
    terms = shares(planet, satellites)
    bulge, moment = factors(*terms)
    variance = (omitted(planet, satellites, *terms) / NORMAL_95) ** 2
    bulge_variance = variance.copy()
    for place, satellite in enumerate(body.satellites):
        if satellite.gm_uncertainty:
            gm = satellites.gm.copy()
            gm[place] += satellite.gm_uncertainty
            heavier, larger = factors(*shares(planet, replace(satellites, gm=gm)))
            variance += (heavier / larger * (moment / bulge) - 1) ** 2
            bulge_variance += (heavier / bulge - 1) ** 2

    def labelled(values: FloatArray) -> Numeric:
        if not template.dims:
            return float(values[0])
        return xr.DataArray(values.reshape(template.shape), template.coords, template.dims)

    factors_and_errors = (bulge, moment, np.sqrt(variance), np.sqrt(bulge_variance))
    return SatelliteFactors(*map(labelled, factors_and_errors))


def _factors_of_each(body: Body, gm_over_r3: Numeric, obliquity: Numeric) -> SatelliteFactors:
    """Compute `satellite_factors` one by one where satellites or obliquities are arrays."""
    numbers = obliquity, gm_over_r3, *body.arrays.values()
    eps, pull, *_ = xr.broadcast(*map(xr.DataArray, numbers))
    factors = np.empty((4, *eps.shape))
    for place in np.ndindex(eps.shape):
        alone = body.isel(dict(zip(eps.dims, place, strict=True)))
        case = satellite_factors(alone, float(pull.values[place]), float(eps.values[place]))
        factors[:, *place] = astuple(case)
    return SatelliteFactors(*(eps.copy(data=values) for values in factors))


@dataclass(frozen=True)
class NodeNutation:
    """Nutation of a body caused by the moving node of one of its satellites.

    Attributes
    ----------
    rate : float
        Rate of precession in longitude that it adds and takes away, rad/s.
    angle : float
        Radius of the circle of the pole, rad.
    node_rate : float
        rad/s.
    """

    rate: float
    angle: float
    node_rate: float

    @property
    def years(self) -> str:
        """Period of the satellite's node in years, as text."""
        return f"{float(f'{2 * np.pi / self.node_rate / JULIAN_YEAR:.3g}'):,g} years"


def node_nutations(body: Body, gm_over_r3: Numeric, obliquity: Numeric) -> dict[str, NodeNutation]:
    """Nutations of a body caused by the moving nodes of satellites, by name of the node.

    An orbit that is tilted to the Laplace plane turns, so its node goes round, and the torque on
    the body changes with the period of the node. Parameters are those of `satellite_factors`;
    of arrays with labels the means are used. Empty for a body without satellites.
    """
    if not body.satellites:
        return {}
    _refuse_sphere(body)
    figure = (body.needed(name) for name in ("radius", "j2", "dynamical_flattening"))
    numbers = [body.gm, *figure, body.spin_rate, gm_over_r3]
    obliquity = float(np.mean(obliquity))
    planet = _planet([np.full((1, 1), float(np.mean(number))) for number in numbers], obliquity)
    sine = math.sin(obliquity)
    nutations = {}
    for satellite, node in zip(body.satellites, nodes(planet, _satellites(body)), strict=True):
        if node.swing:
            # infinite for an upright pole, whose longitude is not defined
            rate = node.rate * math.sin(node.swing) / sine if sine else math.inf
            nutations[f"node of {satellite.name}"] = NodeNutation(rate, node.swing, node.rate)
    return nutations


def largest_torques_of_satellites(body: Body, gm_over_r3: float) -> dict[str, float]:
    """Largest torques of the satellites on the bulge of their planet, N m, by name.

    They are those at the largest distance of each from the equator. `gm_over_r3` is the sum of
    GM/r3 of the perturbers, s-2, which tilts the Laplace planes.
    """
    obliquity = obliquity_of(body) if body.satellites else None
    if obliquity is None:
        return {}
    moment = body.number("j2") * float(body.mass) * body.number("radius") ** 2
    # the precession, which is slow beside the nodes, is left out: H = 0.1 and an infinite spin
    numbers = [body.gm, body.number("radius"), body.number("j2"), 0.1, np.inf, gm_over_r3]
    planet = _planet([np.full((1, 1), float(number)) for number in numbers], obliquity)
    tilts = laplace_tilts(planet, _satellites(body))[0]
    torques = {}
    for moon, tilt in zip(body.satellites, tilts, strict=True):
        turn = min(2 * (abs(tilt) + min(moon.i, math.pi - moon.i)), math.pi / 2)
        torques[f"pull of {moon.name}"] = 1.5 * moon.gm / moon.a**3 * abs(moment) * math.sin(turn)
    return torques


def largest_displacements(nutations: Mapping[str, NodeNutation], span: float) -> dict[str, float]:
    """Largest displacements of the pole by the nodes of satellites within a time span (s), rad."""
    return {
        name: 2 * nutation.angle * math.sin(min(nutation.node_rate * span, math.pi) / 2)
        for name, nutation in nutations.items()
    }


def displacements(nutations: Mapping[str, NodeNutation], time: FloatArray) -> dict[str, FloatArray]:
    """Displacements of the pole by the nodes of satellites since the epoch, rad, shape (t,) each.

    They are chords of the circles that the pole describes, larger by `NODE_ERROR`; `time` is in s
    from the epoch.
    """
    return {
        name: 2 * (1 + NODE_ERROR) * nutation.angle * np.abs(np.sin(nutation.node_rate * time / 2))
        for name, nutation in nutations.items()
    }


def obliquity_of(body: Body) -> float | None:
    """Obliquity of the mean pole at J2000.0 to the orbit, rad; None without a pole or an orbit."""
    if body.pole is None or (body.orbit_pole is None and not body.pole.of_the_iau):
        return None
    pole = body.pole.without_nutation()
    axis = pole.mean(np.zeros(1))[0]
    return angle(axis, pole.orbit_normal(body.orbit_pole))


def common_precession(body: Body, gm_over_r3: float) -> tuple[FloatArray, float] | None:
    """Precession vector added by the satellites of a planet, and error of the total rate, rad/s.

    The shape of the vector is (3,). The second number is the 95 % half-width of the common rate due
    to the satellites, rad/s.

    The torque of the perturbers on the bulge turns the planet as if it were alone. Its satellites,
    each near its Laplace plane, make planet and satellites precess together about the normal of
    the orbit. None without satellites or without an orbit.
    """
    obliquity = obliquity_of(body) if body.satellites else None
    if obliquity is None:
        return None
    h = body.number("dynamical_flattening")
    rate_alone = 1.5 * gm_over_r3 * math.cos(obliquity) * h / body.spin_rate
    moons = satellite_factors(body, gm_over_r3, obliquity)
    turn = -rate_alone * (moons.rate - 1) * body.needed("pole").orbit_normal(body.orbit_pole)
    return np.asarray(turn), float(NORMAL_95 * moons.uncertainty * abs(rate_alone * moons.rate))


def _planet(columns: list[Any], obliquity: float) -> Planet:
    """Make a `Planet` from arrays GM, radius, J2, H, spin rate and the perturbers' GM <1/r3>."""
    gm, radius, j2, h, spin_rate, gm_over_r3 = columns
    return Planet(gm, radius, j2, j2 / h, np.abs(spin_rate), gm_over_r3, obliquity)


def _satellites(body: Body) -> Satellites:
    """Masses and orbits of the satellites of a body as arrays."""
    rows = [[float(np.mean(number)) for number in (s.gm, s.a, s.i)] for s in body.satellites]
    gm, a, i = np.array(rows).T
    return Satellites(gm, a, i)


def _refuse_sphere(body: Body) -> None:
    """Raise an error if H = 0, because C of a body with satellites must follow from J2 and H."""
    if not all_of(body.needed("dynamical_flattening") != 0):
        allowed = "with satellites C must follow from J2 and H; give another H, or satellites = []"
        raise BodyError(body.name, "dynamical_flattening", 0.0, allowed)
