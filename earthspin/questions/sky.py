"""Rotating body and perturbers of a computation, and the source of their positions."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np

from earthspin._version import version
from earthspin.bodies import EARTH, MOON, SUN, Body, all_of, checks, moons, planets
from earthspin.bodies.body import SPIN_FIELDS
from earthspin.constants import DAY, NORMAL_95
from earthspin.dates import Span
from earthspin.engine import Question, key, part
from earthspin.errors import ApartError, KernelError, SceneError, UndefinedError, Where
from earthspin.numerics.arrays import FloatArray
from earthspin.questions.ellipse_chains import EllipseChain, all_by_elements, cases, ellipse_chains
from earthspin.sky import iau_models, sources
from earthspin.sky.elements import CENTRE, USUAL_REACH, ByElements, Elements
from earthspin.sky.ephemeris import NAMED_KERNELS
from earthspin.sky.poles import FixedPole, IAU2006Pole, MovingPole, TiltedPole, rotate, spherical
from earthspin.sky.protocol import BY_ELEMENTS, OfDate, Place, Source, words
from earthspin.sky.sources import SourceName
from earthspin.units import FileName


class KernelName(FileName):
    """Kind of input: an ephemeris, as a kernel name, the path of a file, or a Skyfield kernel."""

    words = '"de421", "de440", or the path of a .bsp file'
    hint = "str | PathLike[str] | SpiceKernel"
    expected = "a name, a path, or a Skyfield kernel"
    content = "an SPK kernel"

    def read(self, value: object, where: Where) -> Any:
        """Check an ephemeris given as name, path or Skyfield kernel; return its name or path."""
        if hasattr(value, "spk") and hasattr(value, "path"):
            value = value.path
        if sources.is_vector_function(value):
            remedy = "give it to a perturber, like SUN.replace(position=...), and a kernel here"
            raise where.error(value, f"it is the position of one body; {remedy}")
        return super().read(value, where)

    def is_path(self, value: object) -> bool:
        """Return True if a value is a path and not the name of a known kernel."""
        return isinstance(value, str) and value.lower() not in NAMED_KERNELS

    def begins(self, head: bytes) -> bool:
        """Return True if the first bytes of a file are those of an SPK kernel."""
        return head.startswith((b"DAF/SPK", b"NAIF/DAF"))


SOURCE_DOC = (
    "library that reads the positions: jplephem, which is fast, or Skyfield by its public calls"
)


class PerturbedBody(Question):
    """Base class of computations with a rotating body and its perturbers."""

    body: Body = key(EARTH, doc="rotating body; its numbers may be labelled arrays")
    perturbers: tuple[Body, ...] = key(
        (SUN, MOON),
        doc="bodies that exert torques on the body; for planets other than the Earth, the default "
        "is the Sun",
    )
    ephemeris: Annotated[str, KernelName()] = key(
        "de421", doc="kernel with the positions of the bodies"
    )
    source: SourceName = key("jplephem", doc=SOURCE_DOC)

    #: Fields of the body that the question needs, besides its mass.
    needs: ClassVar[tuple[str, ...]] = SPIN_FIELDS
    #: Whether torques are averaged over revolutions, of which kernels cover too few for the giants.
    averages: ClassVar[bool] = False
    #: Whether a body may have no perturbers.
    may_be_alone: ClassVar[bool] = False
    #: Whether masses of perturbers, and orbits, poles and satellites, may be labelled arrays.
    array_masses: ClassVar[bool] = False
    array_orbits: ClassVar[bool] = False

    def check(self) -> None:
        """Set default perturbers, and refuse a body or perturbers without required properties."""
        if "perturbers" not in self.given:
            object.__setattr__(self, "perturbers", planets.default_perturbers(self.body))
            if self.averages:
                object.__setattr__(self, "body", planets.on_its_orbit(self.body))
        if not all_of(self.body.gm > 0):
            raise self.error("body", self.body.name, "the mass of the body must not be zero")
        self.body.require(self.needed())
        self.check_spin()
        names = [p.name for p in self.perturbers]
        if not names and not self.may_be_alone:
            raise self.error("perturbers", names, "give at least one, like ['sun', 'moon']")
        for p in self.perturbers:
            taken = {"gm"} if self.array_masses else set()
            arrays = [name for name in p.arrays if name in p.UNITS and name not in taken]
            if arrays:
                key_of_array = f"perturbers.{p.name}.{arrays[0]}"
                problem = "a perturber takes single numbers; run the question for each value"
                raise self.error(key_of_array, "an array", problem)
            if names.count(p.name) > 1:
                raise self.error("perturbers", names, f"'{p.name}' is named twice")
        if "total" in names:
            raise self.error("perturbers", names, "'total' is the label of the sum; rename it")
        if self.body.name in names:
            raise self.error("perturbers", names, "a body does not pull on itself")
        carried = {satellite.name.casefold() for satellite in self.body.satellites}
        if twice := [name for name in names if name.casefold() in carried]:
            problem = f"it is among the satellites of {self.body.name}, which act already: "
            raise self.error("perturbers", twice[0], f"{problem}remove it, or set satellites = []")
        orbits, each = cases(self.body, self.perturbers)
        if orbits and not self.array_orbits:
            raise ApartError("this question takes one orbit, pole and set of satellites at a time")
        for body, perturbers in each:
            ellipse_chains(body, perturbers)  # refuses inconsistent elements

    def needed(self) -> tuple[str, ...]:
        """Names of the body's properties that the computation needs."""
        return self.needs

    def check_spin(self) -> None:
        """Refuse a spin so fast that the body would break up, if the computation needs the spin."""
        if "spin_period" in self.needed():
            checks.refuse_break_up(self.body)


def start_error(body: Body) -> float | None:
    """95 % half-width of the pole's direction at J2000.0, rad; None if it is not known."""
    if body.pole_uncertainty is None:
        return None
    return NORMAL_95 * body.number("pole_uncertainty")


@dataclass(frozen=True)
class Places:
    """Way to find the position of each body: kernel, own trajectory or orbital elements.

    Attributes
    ----------
    body : Body
        The rotating body.
    targets : dict of str to EllipseChain
        Chain of ellipses to each perturber; without ellipses, the perturber itself.
    reach : dict of str to float
        Smallest allowed distance of each perturber, m: the sum of the largest radii.
    by_elements : bool
        True if all positions follow from elements, so that no kernel is needed.
    by_own_orbit : mapping of str to EllipseChain
        Chains that start from the other bodies, including one to the body itself; used if the
        source has no position of the body.
    """

    body: Body
    targets: dict[str, EllipseChain]
    reach: dict[str, float]
    by_elements: bool
    by_own_orbit: dict[str, EllipseChain]


@dataclass(frozen=True)
class Sky:
    """Opened source of positions, and the key (code or trajectory) of each body in that source.

    Attributes
    ----------
    source : Source
    centre : Place
        Place of the rotating body: a NAIF code, or its own trajectory.
    targets : dict of str to Place
        Place of each perturber.
    reach : dict of str to float
        Smallest allowed distance of each perturber, m.
    offset : float
        Largest distance of the body from the barycentre of its satellites, if the source has only
        this barycentre, m.
    """

    source: Source
    centre: Place
    targets: dict[str, Place]
    reach: dict[str, float]
    offset: float = 0.0

    @cached_property
    def provenance(self) -> dict[str, str]:
        """Name of the ephemeris and versions of the libraries that read it, by attribute name."""
        attributes = self.source.provenance | {"pyerfa_version": version("pyerfa")}
        own = {name: p for name, p in self.targets.items() if not isinstance(p, int)}
        if own and self.source.name != BY_ELEMENTS:
            placed = (f"{name}: {words(place)}" for name, place in own.items())
            attributes["own_positions"] = "; ".join(placed)
        return attributes

    def error(self, target: Place, days: Iterable[float] = (0.0,)) -> tuple[float, float]:
        """Largest error of a body's position over given days: angle (rad) and distance (m)."""
        days = np.array([*days])
        errors = [self.source.error(target, self.centre, day) for day in days.tolist()]
        angle, distance = (max(sizes) for sizes in zip(*errors, strict=True))
        if self.offset:
            positions = self.source.positions({"": target}, self.centre, days)[""]
            angle += self.offset / float(np.linalg.norm(positions, axis=1).min())
        return angle, distance + self.offset

    def drift(self, name: str, distance: float) -> float:
        """Relative error of the spin axis motion due to the position error of one perturber."""
        drift = self.source.drift(self.targets[name], self.centre, distance)
        return drift + 5 * self.offset / distance  # two of direction, three of distance

    @property
    def unmeasured(self) -> tuple[str, ...]:
        """Names of perturbers whose position error was not measured and is unknown."""
        return tuple(n for n, place in self.targets.items() if math.isnan(self.error(place)[0]))

    @property
    def no_error(self) -> str:
        """Return the reason (text) why some errors are NaN; an empty text if none is NaN."""
        numbers = f"{', '.join(self.unmeasured)} and dependent numbers"
        words = f"NaN for {numbers}: the errors of these positions were not measured"
        return words if self.unmeasured else ""

    def place(self, body: Body) -> Place:
        """NAIF code or trajectory by which the position of an additional body can be found."""
        return _place(self.source, body.name, EllipseChain(body))

    def coverage(self, targets: Mapping[str, Place] | None = None) -> tuple[float, float]:
        """First and last day on which the positions of all targets are known.

        The targets are the perturbers by default.
        """
        return self.source.coverage(self._all(targets))

    def check_times(
        self, days: Iterable[float], targets: Mapping[str, Place] | None = None
    ) -> None:
        """Raise an error if the position of any target is missing on one of the given days.

        By default the targets are the perturbers.
        """
        self.source.check_times(np.array(list(days)), self._all(targets))

    def unchanged(self, *bodies: Body, also: Hashable = None) -> Hashable:
        """Cache key that is equal if positions, bodies and the inputs `also` are equal.

        None if they contain arrays or objects, which may change.
        """
        places = self.centre, *self.targets.values()
        if any(body.labelled for body in bodies) or not all(isinstance(p, int) for p in places):
            return None
        if type(bodies[0].pole) not in (FixedPole, TiltedPole, IAU2006Pole, MovingPole):
            return None
        return frozenset(self.provenance.items()), places, bodies, also

    def _all(self, targets: Mapping[str, Place] | None) -> set[Place]:
        return {*(self.targets if targets is None else targets).values(), self.centre}

    def positions(
        self, days: FloatArray, targets: Mapping[str, Place] | None = None
    ) -> dict[str, FloatArray]:
        """Positions of perturbers relative to the body, m, (n, 3) each, at days from J2000.0 TDB.

        Parameters
        ----------
        days : ndarray, shape (n,)
        targets : mapping of str to Place, optional
            The perturbers by default.

        Raises
        ------
        UndefinedError
            If a perturber overlaps the body; the formula of the torque is valid only outside.
        """
        targets = self.targets if targets is None else targets
        positions = self.source.positions(targets, self.centre, days)
        for name, position in positions.items():
            self._refuse_inside(name, np.einsum("ti,ti->t", position, position))
        return positions

    def equator(self, body: Body, days: FloatArray) -> FloatArray:
        """Matrices from the ICRF to the body's mean equator of date, shape (n, 3, 3) or (3, 3).

        For the Earth, they are those of the source if it has its own equator.
        """
        pole = body.needed("pole")
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
        nutation: iau_models.NutationSpline | None = None,
    ) -> dict[str, tuple[FloatArray, FloatArray, FloatArray]]:
        """Right ascension and declination (rad, equator of date), and distance (m) of perturbers.

        Parameters
        ----------
        body : Body
            Body that defines the equator.
        days : ndarray, shape (n,)
            Days from J2000.0 TDB.
        targets : mapping of str to Place, optional
            The perturbers by default.
        true : bool
            Use the true equator instead of the mean equator.
        nutation : NutationSpline, optional
            Interpolated nutation, for the source jplephem.
        """
        pole = body.needed("pole")

        def equator(days: FloatArray) -> FloatArray:
            return pole.equator(body.orbit_pole, days, nutation)

        if isinstance(self.source, OfDate):
            targets = self.targets if targets is None else targets
            earth_equator = iau_models.true_equator if true else None
            frame = earth_equator if pole.of_the_iau else equator
            coordinates = self.source.radec(targets, self.centre, days, frame)
            for name, (_, _, distance) in coordinates.items():
                self._refuse_inside(name, distance * distance)
            return coordinates
        axes = equator(days)
        positions = self.positions(days, targets)
        return {name: spherical(rotate(axes, position)) for name, position in positions.items()}

    def _refuse_inside(self, name: str, squares: FloatArray) -> None:
        nearest = float(np.sqrt(np.min(squares, initial=np.inf)))
        # Planets from the effect of that name have no reach, since they are far away.
        if inside := checks.overlap(nearest, self.reach.get(name, 0.0), f"'{name}'", "the body"):
            raise UndefinedError(f"{inside}; the formula of the torque is valid only outside")


class Interval(NamedTuple):
    """First and last day of the time span of an average, days from J2000.0 TDB."""

    first: float
    last: float


def _place(source: Source, name: str, chain: EllipseChain) -> Place:
    """NAIF code, trajectory or ellipses with which a source of positions finds a body."""
    start = chain.start
    try:
        if chain.ellipses:
            return ByElements(chain.ellipses, source.code(start.naif, name))
        return sources.place_of(source, name, start.naif, start.position)
    except KernelError as error:
        codes = ", ".join(map(str, start.naif)) or "no code"
        problem = f"it has no position of '{start.name}' (NAIF {codes})"
        moon, orbit = moons.ORBITS.get(start.known_as), {"a": "2.5 au", "about": SUN.name}
        if moon is not None and moon.period is not None:
            orbit = {"period": f"{moon.period / DAY:.8g} d", "about": moon.about}
        remedy = f"give an orbit or a position, like .replace(orbit={orbit}), or another kernel"
        raise KernelError(error.path, problem, remedy) from None


@part
def places(body: Body, perturbers: tuple[Body, ...]) -> Places:
    """Determine for each body how its position is found: kernel, own trajectory or elements."""
    body, perturbers = cases(body, perturbers)[1][0]  # of many orbits, the first
    alone = {p.name: EllipseChain(p) for p in perturbers}
    targets = alone | ellipse_chains(body, perturbers)
    for p in perturbers:
        start = targets[p.name].start
        if targets[p.name].ellipses and start.position is not None:
            problem = f"'{start.name}' has no NAIF code, but a position"
            raise SceneError(f"{p.name}.orbit", str(p.orbit), problem)
    reach = {p.name: checks.extent(body) + checks.extent(p) for p in perturbers}
    own = alone | ellipse_chains(body, perturbers, starts_at_body=False)
    return Places(body, targets, reach, all_by_elements(body, perturbers), own)


def from_where(source: SourceName, ephemeris: str, body: Body, perturbers: tuple[Body, ...]) -> str:
    """Describe in words where the positions of the body and its perturbers come from."""
    if all_by_elements(body, perturbers):
        return "positions from orbital elements; no kernel is opened"
    bodies = (body, *perturbers)
    phrases = [f"positions {sources.describe_source(source, ephemeris)}"]
    phrases += [f"{b.name} by the elements of its orbit" for b in bodies if b.orbit is not None]
    placed = {b.name: b.position for b in bodies if b.position is not None}
    phrases += [f"{name} by {sources.describe_position(p)}" for name, p in placed.items()]
    return "; ".join(phrases)


@part(describe=from_where)
def sky(ephemeris: str, places: Places, source: SourceName) -> Sky:
    """Open the source of positions, and look up the bodies in it."""
    if places.by_elements:
        ellipses: dict[str, Place] = {
            name: ByElements(chain.ellipses, CENTRE) for name, chain in places.targets.items()
        }
        return Sky(Elements(), CENTRE, ellipses, places.reach)
    opened = sources.open_source(source, ephemeris)
    name, chains = places.body.name, places.targets
    try:
        centre = _place(opened, name, EllipseChain(places.body))
    except KernelError:
        if name not in places.by_own_orbit:
            raise
        chains = places.by_own_orbit
        centre = _place(opened, name, chains[name])
    targets = {name: _place(opened, name, chains[name]) for name in places.targets}
    for name, place in targets.items():
        if place == centre:
            raise SceneError("perturbers", name, "a body does not pull on itself")
    body = places.body
    moons = body.satellites if centre in body.naif[1:] else ()
    offset = sum(moon.gm * moon.a for moon in moons) / float(np.min(body.gm)) if moons else 0.0
    return Sky(opened, centre, targets, places.reach, offset)


@part
def interval(sky: Sky, span: Span | None) -> Interval:
    """Time span of an average: the requested span, or by default the span with known positions.

    For orbits by elements, which have no limits, a usual length is taken.
    """
    if span is not None:
        sky.check_times(span.days)
        return Interval(*span.days)
    if isinstance(sky.source, Elements):
        return Interval(-USUAL_REACH, USUAL_REACH)
    first, last = sky.coverage()
    if not math.isfinite(last - first):
        raise SceneError("span", None, "these positions have no time limits; give a span")
    return Interval(first, last)
