"""The sky of a question: what spins, what pulls on it, and where they are."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, ClassVar

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import EARTH, MOON, SUN, Body, all_of
from earthspin.dates import Span
from earthspin.engine.part import part
from earthspin.engine.question import Question, key
from earthspin.engine.run import version
from earthspin.errors import SceneError, UndefinedError, Where

if TYPE_CHECKING:
    from earthspin.sky.ephemeris import Ephemeris


@dataclass(frozen=True)
class KernelName:
    """Kind of an ephemeris: the name of a kernel, the path of a file, or a kernel of Skyfield's."""

    words = '"de421", "de440", or the path of a .bsp file'
    hint = "str | PathLike[str] | SpiceKernel"

    def read(self, given: object, where: Where) -> str:
        """Take a name or a path; of a kernel of Skyfield's, its file."""
        if hasattr(given, "spk") and hasattr(given, "path"):
            given = given.path
        if not isinstance(given, (str, os.PathLike)) or not os.fspath(given).strip():
            raise where.error(given, "it is a name, a path, or a Skyfield kernel")
        return os.fspath(given)

    def write(self, value: str) -> str:
        """Give the name or path."""
        return value


class Pulled(Question):
    """Keys of every question about a body that others pull on."""

    body: Body = key(EARTH, doc="what spins; its numbers may be labelled arrays")
    perturbers: tuple[Body, ...] = key((SUN, MOON), doc="what pulls on it")
    ephemeris: Annotated[str, KernelName()] = key("de421", doc="where the bodies are")

    #: What the question needs to know of the body, beside its mass.
    needs: ClassVar[tuple[str, ...]] = (
        "radius",
        "j2",
        "dynamical_flattening",
        "spin_period",
        "pole",
    )

    def check(self) -> None:
        """A body with a mass, and others that pull on it, each once."""
        if not all_of(self.body.gm > 0):
            raise self.error("body", self.body.name, "the mass of a body that spins is not zero")
        self.body.require(self.needs)
        names = [p.name for p in self.perturbers]
        if not names:
            raise self.error("perturbers", names, "name one body or more, like ['sun', 'moon']")
        for one in self.perturbers:
            if hasattr(one.gm, "dims"):
                raise self.error("perturbers", one.name, "the mass of what pulls is one number")
            if names.count(one.name) > 1:
                raise self.error("perturbers", names, f"'{one.name}' is named twice")
        if "total" in names:
            raise self.error("perturbers", names, "'total' stands for the sum of all")
        if self.body.name in names:
            raise self.error("perturbers", names, "a body does not pull on itself")


@dataclass(frozen=True)
class Places:
    """By what names and codes the bodies of a question are known to a kernel.

    Attributes
    ----------
    centre : tuple
        Name and NAIF codes of the body that spins.
    targets : tuple of tuple
        The same of each perturber.
    radius : float
        Of the body that spins, m; the largest, where it is an array.
    """

    centre: tuple[str, tuple[int, ...]]
    targets: tuple[tuple[str, tuple[int, ...]], ...]
    radius: float


@dataclass(frozen=True)
class Sky:
    """An open kernel, and the codes by which it knows the bodies of a question.

    Attributes
    ----------
    ephemeris : Ephemeris
    centre : int
        NAIF code of the body that spins.
    targets : dict of str to int
        NAIF code of each perturber.
    radius : float
        Of the body that spins, m.
    """

    ephemeris: Ephemeris
    centre: int
    targets: dict[str, int]
    radius: float = 0.0

    @cached_property
    def provenance(self) -> dict[str, str]:
        """Kernel and readers, for the attributes of an answer."""
        return {
            "ephemeris": self.ephemeris.name,
            "ephemeris_sha256": self.ephemeris.sha256,
            "jplephem_version": version("jplephem"),
            "pyerfa_version": version("pyerfa"),
        }

    def error(self, code: int) -> tuple[float, float]:
        """How far a body may be from where it is seen: angle (rad), distance (m)."""
        return self.ephemeris.error(code, self.centre)

    def positions(
        self, days: NDArray[np.float64], targets: Mapping[str, int] | None = None
    ) -> dict[str, NDArray[np.float64]]:
        """Positions seen from the body, m, shape (n, 3) each, at days from J2000.0 TDB.

        Parameters
        ----------
        days : ndarray, shape (n,)
        targets : mapping of str to int, optional
            NAIF codes; the perturbers by default.

        Raises
        ------
        UndefinedError
            If one comes into the body: torques on the bulge hold outside alone.
        """
        targets = self.targets if targets is None else targets
        found = self.ephemeris.positions(targets, self.centre, days)
        for name, place in found.items():
            squares = np.einsum("ti,ti->t", place, place)
            nearest = float(np.sqrt(np.min(squares, initial=np.inf)))
            if nearest <= self.radius:
                raise UndefinedError(
                    f"'{name}' comes to {nearest:.4g} m from the centre of a body with a radius "
                    f"of {self.radius:.4g} m; a torque on the bulge holds outside it alone"
                )
        return found


@dataclass(frozen=True)
class Stretch:
    """First and last day that may be used, from J2000.0 TDB."""

    first: float
    last: float


@part
def places(body: Body, perturbers: tuple[Body, ...]) -> Places:
    """Names and codes of the bodies."""
    radius = 0.0 if body.radius is None else body.radius
    return Places(
        (body.name, body.naif),
        tuple((p.name, p.naif) for p in perturbers),
        float(radius.max() if hasattr(radius, "max") else radius),
    )


@part
def sky(ephemeris: str, places: Places) -> Sky:
    """Open the kernel and find the bodies in it."""
    from earthspin.sky.ephemeris import open_ephemeris

    kernel = open_ephemeris(ephemeris)
    centre = kernel.code(places.centre[1], places.centre[0])
    targets = {name: kernel.code(codes, name) for name, codes in places.targets}
    for name, code in targets.items():
        if code == centre:
            raise SceneError("perturbers", name, "a body does not pull on itself")
    return Sky(kernel, centre, targets, places.radius)


@part
def stretch(sky: Sky, span: Span | None) -> Stretch:
    """The span asked for, if the kernel covers it, or all that the kernel covers."""
    codes = {*sky.targets.values(), sky.centre}
    if span is None:
        return Stretch(*sky.ephemeris.coverage(codes))
    sky.ephemeris.check_times(np.array(span.days), codes)
    return Stretch(*span.days)
