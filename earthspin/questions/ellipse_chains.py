"""Bodies with orbital elements: the chain of ellipses that leads to each body."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from earthspin.bodies import BODIES, Body, Orbit, checks, in_a_sentence, label_of, moons
from earthspin.bodies.laplace_plane import reference_plane
from earthspin.errors import SceneError, UndefinedError, nearest
from earthspin.sky.elements import Ellipse
from earthspin.torque.cassini import locked_turns

#: Largest relative deviation of semi-major axis and period from Kepler's third law. The Sun makes
#: the Moon's month 0.3 per cent longer than the law with its mean distance.
THIRD_LAW = 0.01


#: Elements that an ellipse has from the orbit of a body; those that are not given are zero.
_SAME = Orbit.KINDS.keys() & {field.name for field in fields(Ellipse)} - {"a", "plane"}


class EllipseChain(NamedTuple):
    """Sequence of ellipses whose position vectors lead from one body to another.

    Attributes
    ----------
    start : Body
        Body at the start of the first ellipse.
    ellipses : tuple of (Ellipse, int)
        Ellipses in sequence, with -1 if the ellipse is taken from the moving body to its centre,
        else 1.
    """

    start: Body
    ellipses: tuple[tuple[Ellipse, int], ...] = ()


def ellipse_chains(
    body: Body, perturbers: tuple[Body, ...], starts_at_body: bool = True
) -> dict[str, EllipseChain]:
    """Chains of ellipses that lead to the bodies with orbital elements, by name of the body.

    With `starts_at_body`, a chain starts from the spinning body if possible, else from a body
    without elements. Otherwise bodies without elements come first, as is needed if only its own
    orbit places the spinning body.

    Raises
    ------
    SceneError
        If the centre of an orbit is unknown or the body itself, or if an orbit contradicts Kepler's
        third law or passes through its central body.
    UndefinedError
        If the body has no reference plane of the kind that the elements use.
    """
    known = {member.name: member for member in (body, *perturbers)}
    centres = {
        name: centre
        for name, member in known.items()
        if member.orbit is not None and (centre := _centre(member, body, known))
    }
    _refuse_circles(centres)
    links: dict[str, dict[str, tuple[Ellipse, int]]] = {name: {} for name in known}
    for name, about in centres.items():
        ellipse = _ellipse(known[name], known[about], body)
        links[about][name], links[name][about] = (ellipse, 1), (ellipse, -1)
    reached: dict[str, EllipseChain] = {}
    without_orbit = [member for member in perturbers if member.orbit is None]
    for start in (body, *without_orbit) if starts_at_body else (*without_orbit, body):
        if start.name not in reached:
            _add_chain(EllipseChain(start), start.name, links, reached)
    return {name: chain for name, chain in reached.items() if chain.ellipses}


def _add_chain(
    chain: EllipseChain,
    end: str,
    links: Mapping[str, Mapping[str, tuple[Ellipse, int]]],
    reached: dict[str, EllipseChain],
) -> None:
    """Store in `reached` the chains to the body `end` and to all bodies linked to `end`."""
    reached[end] = chain
    for name, link in links[end].items():
        if name not in reached:
            _add_chain(EllipseChain(chain.start, (*chain.ellipses, link)), name, links, reached)


def _centre(member: Body, body: Body, known: Mapping[str, Body]) -> str:
    """Name of the central body of `member`; an empty text if no known body can be the centre."""
    about = member.needed("orbit").about
    if about:
        label = about if about in known else label_of(about, known.values())
        if label is None or label == member.name:
            others = [name for name in known if name != member.name]
            problem = f"add it to the perturbers, or leave `about` out; {nearest(about, others)}"
            raise SceneError(f"{member.name}.orbit.about", about, problem)
        return label
    if member is not body:
        return body.name
    centres = [name for name, other in known.items() if other.orbit is None and other is not body]
    if len(centres) > 1:
        raise SceneError(f"{member.name}.orbit.about", "", f"give one of {', '.join(centres)}")
    return centres[0] if centres else ""


def _refuse_circles(centres: Mapping[str, str]) -> None:
    """Refuse central bodies that form a closed loop, such as two bodies that orbit each other."""
    for name in centres:
        current, visited = name, [name]
        while current in centres:
            current = centres[current]
            if current in visited:
                problem = f"these bodies orbit one another: {', '.join(visited)}; remove one orbit"
                raise SceneError(f"{name}.orbit.about", centres[name], problem)
            visited.append(current)


def _ellipse(member: Body, centre: Body, body: Body) -> Ellipse:
    """Ellipse of the orbit of `member` about the body `centre`, from the orbital elements."""
    orbit = member.needed("orbit")
    a, motion = size_and_motion(member, centre)
    refuse_overlap(member, centre, a)
    node = 0.0 if orbit.node_period is None else 2 * math.pi / orbit.node_period
    turn = 0.0 if orbit.pericentre_period is None else 2 * math.pi / orbit.pericentre_period
    planet = centre if centre.known_as in BODIES else None
    return Ellipse(
        a=a,
        **{name: getattr(orbit, name) or 0.0 for name in _SAME},
        motion=motion - node - turn,
        node_rate=node,
        pericentre_rate=turn,
        plane=reference_plane(orbit, float(np.min(member.gm)), planet, body.pole, body.orbit_pole),
    )


def refuse_overlap(member: Body, centre: Body, a: float, advice: str = "") -> None:
    """Refuse an orbit, semi-major axis `a` (m), on which the two bodies overlap at pericentre.

    Raises
    ------
    SceneError
        If they do.
    """
    reach, e = checks.extent(member) + checks.extent(centre), member.needed("orbit").e
    if inside := checks.overlap(a * (1 - e), reach, f"'{member.name}'", f"'{centre.name}'"):
        shown = f"a = {a:.6g} m, e = {e:g}"
        raise SceneError(f"{member.name}.orbit", shown, f"{inside}{advice}")


def size_and_motion(member: Body, centre: Body) -> tuple[float, float]:
    """Semi-major axis (m) and mean motion (rad/s) of an orbit, which follow Kepler's third law.

    Raises
    ------
    SceneError
        If semi-major axis and period contradict each other, or one of them is missing and does not
        follow from the masses.
    """
    orbit = member.needed("orbit")
    a, period = orbit.a, orbit.period
    gm = member.gm_on(centre) + centre.gm_on(member)
    is_array = hasattr(gm, "dims")
    if is_array or not gm > 0:
        if a is None or period is None:
            masses = "the masses are an array" if is_array else "both masses are zero"
            problem = f"{masses}; give both a and period"
            raise SceneError(f"{member.name}.orbit", str(orbit), problem)
    elif a is None:
        assert period is not None
        a = math.cbrt(float(gm) * (period / (2 * math.pi)) ** 2)
    else:
        by_law = 2 * math.pi * math.sqrt(a / float(gm)) * a
        period = by_law if period is None else period
        if abs(period / by_law - 1) > THIRD_LAW:
            elements = f"a = {a:.6g} m, period = {period:.6g} s"
            law = f"with GM = {float(gm):.6g} m3 s-2 the period for this a is {by_law:.6g} s"
            problem = f"they contradict each other: {law}; give either a or period"
            raise SceneError(f"{member.name}.orbit", elements, problem)
    return a, 2 * math.pi / period


def locked_error(body: Body, perturber: str, turns: float) -> UndefinedError:
    """Build the exception for a body whose spin is locked to its orbit with a perturber."""
    return UndefinedError(
        f"{in_a_sentence(body.name)} is locked to its orbit with '{perturber}' ({turns:g} "
        f"rotation{'' if turns == 1 else 's'} per orbit), so averages over orbits do not apply; "
        "use cassini_states for the position of its axis"
    )


@lru_cache(maxsize=1)  # several parts of a question need them
def cases(
    body: Body, perturbers: tuple[Body, ...]
) -> tuple[dict[str, int], list[tuple[Body, tuple[Body, ...]]]]:
    """Separate orbits, poles and satellites that are arrays, with the masses about them.

    Returns
    -------
    sizes : dict of str to int
        Dimensions of the arrays with their lengths; empty if there is one orbit of each body.
    bodies : list of (Body, tuple of Body)
        Body and perturbers with one orbit each, in the order of the arrays.
    """
    bodies = (body, *perturbers)
    orbits = [member.orbit for member in bodies if member.orbit is not None]
    by_mass = any(orbit.a is None or orbit.period is None for orbit in orbits)
    sizes = {
        str(dim): n
        for member in bodies
        for name, array in member.arrays.items()
        if name not in body.UNITS or (by_mass and name == "gm")
        for dim, n in array.sizes.items()
    }
    places = [dict(zip(sizes, place, strict=True)) for place in np.ndindex(*sizes.values())]
    return sizes, [(body.isel(p), tuple(other.isel(p) for other in perturbers)) for p in places]


def all_by_elements(body: Body, perturbers: tuple[Body, ...]) -> bool:
    """Return True if all perturber positions relative to the body follow from orbital elements."""
    if not any(member.orbit is not None for member in (body, *perturbers)):
        return False
    body, perturbers = cases(body, perturbers)[1][0]
    by_name = ellipse_chains(body, perturbers)
    return all(p.name in by_name and by_name[p.name].start is body for p in perturbers)


def exact_means(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Return the reason (text) to omit windowed means if exact means are possible, else None.

    Exact means are possible if each perturber moves on an ellipse about the body.

    Raises
    ------
    UndefinedError
        If the body is a moon locked to its orbit that has neither an orbit nor a position.
    """
    moon = moons.ORBITS.get(body.known_as)
    if moon is not None and body.orbit is body.position is None and not body.labelled:
        turns = locked_turns(float(body.spin_rate), 2 * math.pi / body.number("orbital_period"))
        if turns is not None:
            raise locked_error(body, moon.about, turns)
    body, perturbers = cases(body, perturbers)[1][0]
    by_name = ellipse_chains(body, perturbers)
    single = all(chain.start is body and len(chain.ellipses) == 1 for chain in by_name.values())
    exact = single and len(by_name) >= len(perturbers)
    return "orbits by their elements have exact means" if exact else None


def no_exact_means(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Return the reason (text) to omit exact means if some orbits are not ellipses, else None."""
    if exact_means(body, perturbers) is None:
        return "not all perturbers move on ellipses about the body, so windowed averages are used"
    return None
