"""Bodies that are placed by the elements of their orbits: which ellipses lead to each."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

from earthspin.bodies import Body
from earthspin.bodies.limits import extent, overlap
from earthspin.errors import SceneError, nearest
from earthspin.sky.elements import Ellipse, Plane

if TYPE_CHECKING:
    from earthspin.sky.elements import Ellipse

#: How far half the long axis and the period of one orbit may be from Kepler's third law, relative:
#: the Sun makes the Moon's month 0.3 per cent longer than its mean distance says.
THIRD_LAW = 0.01


class EllipseChain(NamedTuple):
    """How one comes to a body by ellipses.

    Attributes
    ----------
    start : Body
        Where the first ellipse begins.
    ellipses : tuple of (Ellipse, int)
        One after the other; the number is -1 where one goes an ellipse back.
    """

    start: Body
    ellipses: tuple[tuple[Ellipse, int], ...]


def ellipse_chains(body: Body, perturbers: tuple[Body, ...]) -> dict[str, EllipseChain]:
    """Ways to each perturber that elements place, by its name.

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
    known = {one.name: one for one in (body, *perturbers)}
    centres = {
        one.name: centre
        for one in known.values()
        if one.orbit is not None and (centre := _centre(one, body, known))
    }
    _refuse_circles(centres)
    links: dict[str, dict[str, tuple[Ellipse, int]]] = {name: {} for name in known}
    for name, about in centres.items():
        ellipse = _ellipse(known[name], known[about], body)
        links[about][name], links[name][about] = (ellipse, 1), (ellipse, -1)
    chains: dict[str, EllipseChain] = {}
    for start in (body, *(one for one in perturbers if one.orbit is None)):
        if start.name not in chains:
            _walk(start, start.name, (), links, chains)
    return {name: chain for name, chain in chains.items() if chain.ellipses}


def _walk(
    start: Body,
    at: str,
    so_far: tuple[tuple[Ellipse, int], ...],
    links: Mapping[str, Mapping[str, tuple[Ellipse, int]]],
    chains: dict[str, EllipseChain],
) -> None:
    """Note the chain to a body, and go on to its neighbours."""
    chains[at] = EllipseChain(start, so_far)
    for name, step in links[at].items():
        if name not in chains:
            _walk(start, name, (*so_far, step), links, chains)


def _centre(one: Body, body: Body, known: Mapping[str, Body]) -> str:
    """Name of what a body goes round; empty if its orbit places nothing that pulls."""
    assert one.orbit is not None
    about = one.orbit.about
    if about:
        if about not in known or about == one.name:
            others = [name for name in known if name != one.name]
            raise SceneError(f"{one.name}.orbit.about", about, nearest(about, others))
        return about
    if one is not body:
        return body.name
    left = [name for name, other in known.items() if other.orbit is None and other is not body]
    if len(left) > 1:
        raise SceneError(f"{one.name}.orbit.about", "", f"say which it is: {', '.join(left)}")
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


def _ellipse(one: Body, centre: Body, body: Body) -> Ellipse:
    """Elements in SI, with the plane that they are counted from."""
    given = one.orbit
    assert given is not None
    a, motion = size_and_motion(one, centre)
    refuse_overlap(one, centre, a)
    node = 0.0 if given.node_period is None else 2 * math.pi / given.node_period
    turn = 0.0 if given.pericentre_period is None else 2 * math.pi / given.pericentre_period
    return Ellipse(
        a=a,
        e=given.e,
        i=given.i,
        node=given.node,
        pericentre=given.pericentre,
        mean_anomaly=given.mean_anomaly,
        epoch=given.epoch,
        motion=motion - node - turn,
        node_rate=node,
        pericentre_rate=turn,
        plane=Plane.of(given.plane, body.pole, body.orbit_pole),
    )


def refuse_overlap(one: Body, centre: Body, a: float, advice: str = "") -> None:
    """Refuse an orbit of half the long axis `a` (m) whose pericentre lies inside a body.

    Raises
    ------
    SceneError
    """
    assert one.orbit is not None
    reach, names = extent(one) + extent(centre), (f"'{one.name}'", f"'{centre.name}'")
    if inside := overlap(a * (1 - one.orbit.e), reach, *names):
        shown = f"a = {a:.6g} m, e = {one.orbit.e:g}"
        raise SceneError(f"{one.name}.orbit", shown, f"{inside}{advice}")


def size_and_motion(one: Body, centre: Body) -> tuple[float, float]:
    """Half the long axis (m) and the sidereal mean motion (rad/s), by Kepler's third law."""
    given = one.orbit
    assert given is not None
    a, period = given.a, given.period
    if hasattr(one.gm, "dims") or hasattr(centre.gm, "dims"):
        if a is None or period is None:
            raise SceneError(
                f"{one.name}.orbit", str(given), "masses are an array here: give both a and period"
            )
        return a, 2 * math.pi / period
    gm = float(one.gm + centre.gm)
    if not gm > 0:
        if a is None or period is None:
            raise SceneError(f"{one.name}.orbit", str(given), "nothing here has a mass")
        return a, 2 * math.pi / period
    if a is None:
        assert period is not None
        return math.cbrt(gm * (period / (2 * math.pi)) ** 2), 2 * math.pi / period
    by_law = 2 * math.pi * math.sqrt(a / gm) * a
    if period is None:
        return a, 2 * math.pi / by_law
    if abs(period / by_law - 1) > THIRD_LAW:
        raise SceneError(
            f"{one.name}.orbit",
            f"a = {a:.6g} m, period = {period:.6g} s",
            f"they contradict each other: about {gm:.6g} m3 s-2 this a has a period of "
            f"{by_law:.6g} s; give one of the two",
        )
    return a, 2 * math.pi / period


def all_by_elements(body: Body, perturbers: tuple[Body, ...]) -> bool:
    """Whether elements alone place everything that pulls, as seen from the body."""
    if not any(one.orbit is not None for one in (body, *perturbers)):
        return False
    chains = ellipse_chains(body, perturbers)
    return all(one.name in chains and chains[one.name].start is body for one in perturbers)


def exact_means(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Leave windows out where each pull is an ellipse about the body, whose mean is known."""
    if not any(one.orbit is not None for one in (body, *perturbers)):
        return None
    chains = ellipse_chains(body, perturbers)
    single = len(chains) == len(perturbers) and all(
        chain.start is body and len(chain.ellipses) == 1 for chain in chains.values()
    )
    return "orbits by their elements have exact means" if single else None


def no_exact_means(body: Body, perturbers: tuple[Body, ...]) -> str | None:
    """Leave exact means out where a pull is anything but one ellipse about the body."""
    if exact_means(body, perturbers) is None:
        return "not every pull is one ellipse about the body, so windows are averaged over"
    return None
