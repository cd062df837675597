"""The sky of a question: what spins, what pulls on it, and where they are."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import numpy as np

from earthspin._version import version
from earthspin.bodies import EARTH, MOON, SUN, Body, all_of
from earthspin.bodies.limits import extent, overlap, refuse_break_up
from earthspin.bodies.planets import on_its_orbit, pulled_by
from earthspin.dates import Span
from earthspin.engine.part import part
from earthspin.engine.question import Question, key
from earthspin.errors import SceneError, UndefinedError, Where
from earthspin.parts.elements import EllipseChain, all_by_elements, ellipse_chains
from earthspin.sky.elements import CENTRE, USUAL_REACH, ByElements, Elements
from earthspin.sky.ephemeris import NAMED_KERNELS
from earthspin.sky.equator import rotate, spherical
from earthspin.sky.poles import Pole
from earthspin.sky.protocol import BY_ELEMENTS, OfDate, Place, Source, words
from earthspin.sky.sources import (
    SourceName,
    describe_position,
    describe_source,
    is_measured,
    is_vector_function,
    open_source,
    place_of,
)
from earthspin.units import FileName, FloatArray

if TYPE_CHECKING:
    from earthspin.sky.iau import Nutation


class KernelName(FileName):
    """Kind of an ephemeris: the name of a kernel, the path of a file, or a kernel of Skyfield's."""

    words = '"de421", "de440", or the path of a .bsp file'
    hint = "str | PathLike[str] | SpiceKernel"
    expected = "a name, a path, or a Skyfield kernel"
    content = "an SPK kernel"

    def read(self, value: object, where: Where) -> Any:
        """Take a name or a path; of a kernel of Skyfield's, its file."""
        if hasattr(value, "spk") and hasattr(value, "path"):
            value = value.path
        if is_vector_function(value):
            raise where.error(
                value,
                "it places one body; give it to a perturber, like SUN.replace(position=...), and "
                "a kernel here",
            )
        return super().read(value, where)

    def is_path(self, value: object) -> bool:
        """Whether a value names a file; names of kernels are read in any case."""
        return isinstance(value, str) and value.lower() not in NAMED_KERNELS

    def begins(self, head: bytes) -> bool:
        """Whether it begins as an SPK kernel does."""
        return head.startswith((b"DAF/SPK", b"NAIF/DAF"))


SOURCE_DOC = (
    "library that reads the positions: jplephem, which is fast, or Skyfield by its public calls"
)


class PerturbedBody(Question):
    """Keys of every question about a body that others pull on."""

    body: Body = key(EARTH, doc="body that spins; its numbers may be labelled arrays")
    perturbers: tuple[Body, ...] = key(
        (SUN, MOON), doc="bodies that pull on it; on another planet than the Earth the Sun alone"
    )
    ephemeris: Annotated[str, KernelName()] = key(
        "de421", doc="kernel with the positions of the bodies"
    )
    source: SourceName = key("jplephem", doc=SOURCE_DOC)

    #: What the question needs to know of the body, beside its mass.
    needs: ClassVar[tuple[str, ...]] = (
        "radius",
        "j2",
        "dynamical_flattening",
        "spin_period",
        "pole",
    )
    #: Whether a body may be left to itself.
    may_be_alone: ClassVar[bool] = False
    #: Whether masses of what pulls may be labelled arrays.
    many_pulls: ClassVar[bool] = False

    def check(self) -> None:
        """A body with a mass, and others that pull on it, each once."""
        if "perturbers" not in self.given:
            object.__setattr__(self, "perturbers", pulled_by(self.body))
            object.__setattr__(self, "body", on_its_orbit(self.body))
        if not all_of(self.body.gm > 0):
            raise self.error("body", self.body.name, "the mass of a body that spins is not zero")
        self.body.require(self.needed())
        self.check_spin()
        names = [p.name for p in self.perturbers]
        if not names and not self.may_be_alone:
            raise self.error("perturbers", names, "name one body or more, like ['sun', 'moon']")
        for p in self.perturbers:
            if p.labelled_field is not None and not (self.many_pulls and p.labelled_field == "gm"):
                raise self.error(
                    f"perturbers.{p.name}.{p.labelled_field}",
                    "an array",
                    "what pulls is one body: one number each; ask again for every other",
                )
            if names.count(p.name) > 1:
                raise self.error("perturbers", names, f"'{p.name}' is named twice")
        if "total" in names:
            raise self.error("perturbers", names, "'total' stands for the sum of all")
        if self.body.name in names:
            raise self.error("perturbers", names, "a body does not pull on itself")
        # refuses elements that do not fit together
        mixed = not all_by_elements(self.body, self.perturbers)
        accuracy = getattr(self, "accuracy", None)
        for member in (self.body, *self.perturbers) if accuracy is not None else ():
            if unmeasured(member) or (mixed and member.orbit is not None):
                problem = (
                    f"how far off the positions of '{member.name}' are was never measured, so none "
                    "can be promised; leave accuracy out"
                )
                raise self.error("accuracy", accuracy, problem)

    def needed(self) -> tuple[str, ...]:
        """What has to be known of the body, for the keys that are given."""
        return self.needs

    def check_spin(self) -> None:
        """Refuse a spin above break-up, where the spin matters."""
        if "spin_period" in self.needed():
            refuse_break_up(self.body)


def unmeasured(body: Body) -> bool:
    """Whether a body has a place of its own whose error was never measured."""
    return body.position is not None and not is_measured(body.position)


@dataclass(frozen=True)
class Places:
    """What places the bodies of a question.

    Attributes
    ----------
    body : Body
        That spins.
    targets : dict of str to EllipseChain
        Ellipses that lead to each perturber; a chain without ellipses starts from itself.
    reach : dict of str to float
        How near each perturber may come, m: the radii of both bodies, the largest of arrays.
    by_elements : bool
        Whether ellipses lead from the body to all of them: no kernel is needed.
    """

    body: Body
    targets: dict[str, EllipseChain]
    reach: dict[str, float]
    by_elements: bool = False


@dataclass(frozen=True)
class Sky:
    """An open source of positions, and where it finds the bodies of a question.

    Attributes
    ----------
    source : Source
    centre : Place
        Of the body that spins: a NAIF code, or a trajectory of its own.
    targets : dict of str to Place
        The same of each perturber.
    reach : dict of str to float
        How near each perturber may come to the body, m.
    """

    source: Source
    centre: Place
    targets: dict[str, Place]
    reach: dict[str, float]

    @cached_property
    def provenance(self) -> dict[str, str]:
        """Kernel and readers, for the attributes of an answer."""
        own = {
            name: words(place)
            for name, place in self.targets.items()
            if not isinstance(place, int) and self.source.name != BY_ELEMENTS
        }
        attributes = self.source.provenance | {"pyerfa_version": version("pyerfa")}
        if own:
            attributes["own_positions"] = "; ".join(f"{name}: {text}" for name, text in own.items())
        return attributes

    def error(self, target: Place, days: Iterable[float] = (0.0,)) -> tuple[float, float]:
        """How far a body may be from where it is seen, at the worst of some days: rad and m."""
        angles, distances = zip(
            *(self.source.error(target, self.centre, day) for day in days), strict=True
        )
        return max(angles), max(distances)

    def drift(self, name: str, distance: float) -> float:
        """By what the pull of a perturber may turn an axis aside, over what the axis sweeps."""
        return self.source.drift(self.targets[name], self.centre, distance)

    @property
    def unmeasured(self) -> tuple[str, ...]:
        """Perturbers of whose positions no error was ever measured."""
        return tuple(n for n, place in self.targets.items() if math.isnan(self.error(place)[0]))

    @property
    def no_error(self) -> str:
        """Why some errors are not given; empty if all are."""
        if not self.unmeasured:
            return ""
        return (
            f"NaN, not given, for {', '.join(self.unmeasured)} and what depends on it: how far off "
            "the positions are was never measured"
        )

    def place(self, body: Body) -> Place:
        """Where the source finds another body."""
        return _place(self.source, body.name, EllipseChain(body))

    def coverage(self, targets: Mapping[str, Place] | None = None) -> tuple[float, float]:
        """First and last day on which the bodies can be placed; the perturbers by default."""
        return self.source.coverage(self._all(targets))

    def check_times(
        self, days: Iterable[float], targets: Mapping[str, Place] | None = None
    ) -> None:
        """Refuse days on which not all of the bodies can be placed; the perturbers by default."""
        self.source.check_times(np.array(list(days)), self._all(targets))

    def _all(self, targets: Mapping[str, Place] | None) -> set[Place]:
        return {*(self.targets if targets is None else targets).values(), self.centre}

    def positions(
        self, days: FloatArray, targets: Mapping[str, Place] | None = None
    ) -> dict[str, FloatArray]:
        """Positions seen from the body, m, shape (n, 3) each, at days from J2000.0 TDB.

        Parameters
        ----------
        days : ndarray, shape (n,)
        targets : mapping of str to Place, optional
            The perturbers by default.

        Raises
        ------
        UndefinedError
            If a perturber overlaps the body: torques on the bulge hold outside alone.
        """
        targets = self.targets if targets is None else targets
        positions = self.source.positions(targets, self.centre, days)
        for name, position in positions.items():
            self._refuse_inside(name, np.einsum("ti,ti->t", position, position))
        return positions

    def equator(self, body: Body, days: FloatArray) -> FloatArray:
        """Matrices from the ICRF to the mean equator of date, shape (n, 3, 3) or (3, 3).

        The Earth's is the source's own, if it has one.
        """
        pole: Pole = body.needed("pole")
        if isinstance(self.source, OfDate) and pole.of_the_iau:
            return self.source.equator(days)
        return pole.equator(body.orbit_pole, days)

    def radec(
        self,
        body: Body,
        days: FloatArray,
        targets: Mapping[str, Place] | None = None,
        *,
        true: bool = False,
        nutation: Nutation | None = None,
    ) -> dict[str, tuple[FloatArray, FloatArray, FloatArray]]:
        """Right ascension, declination (rad) and distance (m) at the equator of date.

        Parameters
        ----------
        body : Body
            Whose equator it is.
        days : ndarray, shape (n,)
            From J2000.0 TDB.
        targets : mapping of str to Place, optional
            The perturbers by default.
        true : bool
            At the true equator; the mean one by default.
        nutation : Nutation, optional
            Interpolated nutation, for the fast reader.
        """
        pole: Pole = body.needed("pole")

        def equator(days: FloatArray) -> FloatArray:
            return pole.equator(body.orbit_pole, days, nutation)

        if isinstance(self.source, OfDate):
            from earthspin.sky.iau import true_equator

            targets = self.targets if targets is None else targets
            earths = true_equator if true else None
            frame = earths if pole.of_the_iau else equator
            seen = self.source.radec(targets, self.centre, days, frame)
            for name, (_, _, distance) in seen.items():
                self._refuse_inside(name, distance * distance)
            return seen
        axes = equator(days)
        positions = self.positions(days, targets)
        return {name: spherical(rotate(axes, position)) for name, position in positions.items()}

    def _refuse_inside(self, name: str, squares: FloatArray) -> None:
        nearest = float(np.sqrt(np.min(squares, initial=np.inf)))
        # the planets, which are no perturbers by name, are far away
        if inside := overlap(nearest, self.reach.get(name, 0.0), f"'{name}'", "the body"):
            raise UndefinedError(f"{inside}; a torque on the bulge holds outside it alone")


@dataclass(frozen=True)
class Stretch:
    """First and last day that may be used, from J2000.0 TDB."""

    first: float
    last: float


def _place(source: Source, name: str, chain: EllipseChain) -> Place:
    """Where a source finds a body: by itself, or at the end of its ellipses."""
    if chain.ellipses:
        return ByElements(chain.ellipses, source.code(chain.start.naif, name))
    return place_of(source, name, chain.start.naif, chain.start.position)


@part
def places(body: Body, perturbers: tuple[Body, ...]) -> Places:
    """Names, codes, own places and elements of the bodies."""
    targets = {p.name: EllipseChain(p) for p in perturbers} | ellipse_chains(body, perturbers)
    for p in perturbers:
        start = targets[p.name].start
        if targets[p.name].ellipses and start.position is not None:
            problem = f"'{start.name}' has no NAIF code, but a position"
            raise SceneError(f"{p.name}.orbit", str(p.orbit), problem)
    return Places(
        body,
        targets,
        {p.name: extent(body) + extent(p) for p in perturbers},
        all_by_elements(body, perturbers),
    )


def from_where(source: SourceName, ephemeris: str, body: Body, perturbers: tuple[Body, ...]) -> str:
    """Say which source the positions come from."""
    if all_by_elements(body, perturbers):
        return "positions by the elements of orbits; no kernel is opened"
    phrases = [f"positions {describe_source(source, ephemeris)}"]
    phrases += [f"{name} by the elements of its orbit" for name in ellipse_chains(body, perturbers)]
    phrases += [
        f"{member.name} by {describe_position(member.position)}"
        for member in (body, *perturbers)
        if member.position is not None
    ]
    return "; ".join(phrases)


@part(describe=from_where)
def sky(ephemeris: str, places: Places, source: SourceName) -> Sky:
    """Open the source of positions and find the bodies in it."""
    if places.by_elements:
        ellipses: dict[str, Place] = {
            name: ByElements(chain.ellipses, CENTRE) for name, chain in places.targets.items()
        }
        return Sky(Elements(), CENTRE, ellipses, places.reach)
    opened = open_source(source, ephemeris)
    centre = _place(opened, places.body.name, EllipseChain(places.body))
    targets = {name: _place(opened, name, chain) for name, chain in places.targets.items()}
    for name, place in targets.items():
        if place == centre:
            raise SceneError("perturbers", name, "a body does not pull on itself")
    return Sky(opened, centre, targets, places.reach)


@part
def stretch(sky: Sky, span: Span | None) -> Stretch:
    """The span asked for, if the source covers it, or all that the source covers."""
    if span is not None:
        sky.check_times(span.days)
        return Stretch(*span.days)
    if isinstance(sky.source, Elements):
        return Stretch(-USUAL_REACH, USUAL_REACH)
    first, last = sky.coverage()
    if not math.isfinite(last - first):
        raise SceneError("span", None, "nothing limits these positions in time; give a span")
    return Stretch(first, last)
