"""Bodies that are placed by the elements of their orbits: which ellipses lead to each."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from earthspin.bodies import Body
from earthspin.bodies.limits import extent, overlap
from earthspin.errors import SceneError, nearest
from earthspin.sky.elements import Ellipse, Plane

#: How far half the long axis and the period of one orbit may be from Kepler's third law, relative:
#: the Sun makes the Moon's month 0.3 per cent longer than its mean distance says.
THIRD_LAW = 0.01


class EllipseChain(NamedTuple):
    """Ellipses that lead from one body to another.

    Attributes
    ----------
    start : Body
        Where the first ellipse begins.
    ellipses : tuple of (Ellipse, int)
        One after the other; the number is -1 where an ellipse is followed backward.
    """

    start: Body
    ellipses: tuple[tuple[Ellipse, int], ...] = ()


def ellipse_chains(body: Body, perturbers: tuple[Body, ...]) -> dict[str, EllipseChain]:
    """Ellipses to each perturber that elements place, by its name.

    They start from the spinning body, or, if its own orbit and theirs do not meet, from a body
    without elements.

    Raises
    ------
    SceneError
        If an orbit is about nothing that is there or about itself, contradicts Kepler's third law,
        or goes through the body that it is about.
    UndefinedError
        If the body has no such plane as the elements are counted from.
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
    for start in (body, *(member for member in perturbers if member.orbit is None)):
        if start.name not in reached:
            _follow(EllipseChain(start), start.name, links, reached)
    return {name: chain for name, chain in reached.items() if chain.ellipses}


def _follow(
    chain: EllipseChain,
    end: str,
    links: Mapping[str, Mapping[str, tuple[Ellipse, int]]],
    reached: dict[str, EllipseChain],
) -> None:
    """Note the chain to a body, and go on to its neighbours."""
    reached[end] = chain
    for name, link in links[end].items():
        if name not in reached:
            _follow(EllipseChain(chain.start, (*chain.ellipses, link)), name, links, reached)


def _centre(member: Body, body: Body, known: Mapping[str, Body]) -> str:
    """Name of what a body goes round; empty if its orbit places nothing that pulls."""
    assert member.orbit is not None
    about = member.orbit.about
    if about:
        if about not in known or about == member.name:
            others = [name for name in known if name != member.name]
            raise SceneError(f"{member.name}.orbit.about", about, nearest(about, others))
        return about
    if member is not body:
        return body.name
    left = [name for name, other in known.items() if other.orbit is None and other is not body]
    if len(left) > 1:
        raise SceneError(f"{member.name}.orbit.about", "", f"say which it is: {', '.join(left)}")
    return left[0] if left else ""


def _refuse_circles(centres: Mapping[str, str]) -> None:
    """Refuse bodies each of which goes round the other."""
    for name in centres:
        at, seen = name, [name]
        while at in centres:
            at = centres[at]
            if at in seen:
                raise SceneError(
                    f"{name}.orbit.about",
                    centres[name],
                    f"these go round one another: {', '.join(seen)}; leave out the orbit of one",
                )
            seen.append(at)


def _ellipse(member: Body, centre: Body, body: Body) -> Ellipse:
    """Elements in SI, with the plane that they are counted from."""
    orbit = member.orbit
    assert orbit is not None
    a, motion = size_and_motion(member, centre)
    refuse_overlap(member, centre, a)
    node = 0.0 if orbit.node_period is None else 2 * math.pi / orbit.node_period
    turn = 0.0 if orbit.pericentre_period is None else 2 * math.pi / orbit.pericentre_period
    return Ellipse(
        a=a,
        e=orbit.e,
        i=orbit.i,
        node=orbit.node,
        pericentre=orbit.pericentre,
        mean_anomaly=orbit.mean_anomaly,
        epoch=orbit.epoch,
        motion=motion - node - turn,
        node_rate=node,
        pericentre_rate=turn,
        plane=Plane.of(orbit.plane, body.pole, body.orbit_pole),
    )


def refuse_overlap(member: Body, centre: Body, a: float, advice: str = "") -> None:
    """Refuse an orbit of half the long axis `a` (m) whose pericentre lies inside a body.

    Raises
    ------
    SceneError
    """
    assert member.orbit is not None
    reach, names = extent(member) + extent(centre), (f"'{member.name}'", f"'{centre.name}'")
    if inside := overlap(a * (1 - member.orbit.e), reach, *names):
        shown = f"a = {a:.6g} m, e = {member.orbit.e:g}"
        raise SceneError(f"{member.name}.orbit", shown, f"{inside}{advice}")


def size_and_motion(member: Body, centre: Body) -> tuple[float, float]:
    """Half the long axis (m) and the sidereal mean motion (rad/s), by Kepler's third law."""
    orbit = member.orbit
    assert orbit is not None
    a, period = orbit.a, orbit.period
    if hasattr(member.gm, "dims") or hasattr(centre.gm, "dims"):
        if a is None or period is None:
            raise SceneError(
                f"{member.name}.orbit",
                str(orbit),
                "masses are an array here: give both a and period",
            )
        return a, 2 * math.pi / period
    gm = float(member.gm + centre.gm)
    if not gm > 0:
        if a is None or period is None:
            raise SceneError(f"{member.name}.orbit", str(orbit), "nothing here has a mass")
        return a, 2 * math.pi / period
    if a is None:
        assert period is not None
        return math.cbrt(gm * (period / (2 * math.pi)) ** 2), 2 * math.pi / period
    by_law = 2 * math.pi * math.sqrt(a / gm) * a
    if period is None:
        return a, 2 * math.pi / by_law
    if abs(period / by_law - 1) > THIRD_LAW:
        raise SceneError(
            f"{member.name}.orbit",
            f"a = {a:.6g} m, period = {period:.6g} s",
            f"they contradict each other: about {gm:.6g} m3 s-2 this a has a period of "
            f"{by_law:.6g} s; give one of the two",
        )
    return a, 2 * math.pi / period


def all_by_elements(body: Body, perturbers: tuple[Body, ...]) -> bool:
    """Whether elements alone place everything that pulls, as seen from the body."""
    if not any(member.orbit is not None for member in (body, *perturbers)):
        return False
    by_name = ellipse_chains(body, perturbers)
    return all(p.name in by_name and by_name[p.name].start is body for p in perturbers)


def exact_means(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Leave windows out where each pull is an ellipse about the body, whose mean is known."""
    by_name = ellipse_chains(body, perturbers)
    single = all(chain.start is body and len(chain.ellipses) == 1 for chain in by_name.values())
    if len(by_name) < len(perturbers) or not single:
        return None
    return "orbits by their elements have exact means"


def no_exact_means(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Leave exact means out where a pull is anything but one ellipse about the body."""
    if exact_means(body, perturbers) is None:
        return "not every pull is one ellipse about the body, so windows are averaged over"
    return None
