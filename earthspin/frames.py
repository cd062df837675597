"""Frames for astropy and Skyfield whose axes were computed by this package.

The frames rotate directions: no light time, aberration or light deflection is applied, unlike in
astropy's GCRS and CIRS. The question of an answer is solved again at the very time of the frame,
since interpolation between its dates would lose accuracy.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import astropy.units as u
import erfa
import numpy as np
import xarray as xr
from astropy.coordinates import (
    ICRS,
    Attribute,
    BaseCoordinateFrame,
    DynamicMatrixTransform,
    RepresentationMapping,
    SphericalRepresentation,
    TimeAttribute,
    frame_transform_graph,
)
from astropy.time import Time

from earthspin.constants import J2000_JD
from earthspin.dates import datetime64, days
from earthspin.engine.labels import si
from earthspin.engine.question import Question
from earthspin.errors import SceneError, Where
from earthspin.scenes import Scene, load_scene, run, run_tree
from earthspin.secular.angles import equator_and_equinox
from earthspin.units import FloatArray

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation

__all__ = ["BodyFixed", "EquatorOfDate", "SkyfieldFrame", "rotations"]


@dataclass(frozen=True, eq=False)
class Model:
    """Question and inputs of a result, with which it is computed again at other times.

    Attributes
    ----------
    question : Question
        Question of the answer, without its times.
    first : float
        First date of the answer, days from J2000.0 TDB; a rotation starts there.
    text : str
        Scene of the answer, by which models are compared.
    """

    question: Question
    first: float
    text: str

    @classmethod
    def of(cls, answer: Any, words: tuple[str, ...]) -> Model:
        """Make the model (question and inputs) from a result.

        Raises
        ------
        SceneError
            If the answer is not that of one of the questions `words` for a single body.
        """
        if isinstance(answer, cls):
            return answer
        if isinstance(answer, xr.DataTree):
            answer = answer.to_dataset()
        if not isinstance(answer, xr.Dataset) or answer.attrs.get("compute") not in words:
            allowed = " or ".join(f"'{word}'" for word in words)
            raise SceneError("model", type(answer).__name__, f"give an answer to {allowed}")
        question = load_scene(answer)
        several = set(answer.dims) - {"time", "epoch", "axis", "component", "perturber"}
        several -= {"quaternion", "effect", "cause"}
        if several:
            problem = "give the answer for a single body or member"
            raise SceneError("model", f"an answer along {', '.join(map(str, several))}", problem)
        first = float(days(answer.time, Where("time"))[0]) if "time" in answer.coords else 0.0
        return cls(question, first, answer.attrs["scene"])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Model) and other.text == self.text

    def __hash__(self) -> int:
        return hash(self.text)

    def __repr__(self) -> str:
        return f"<answer to '{self.question.word}'>"

    def at(self, **times: Any) -> Question:
        """Build a question with the inputs of the result, and with new times."""
        own = {
            name: getattr(self.question, name)
            for name in self.question.given
            if name not in ("span", "step", "times")
        }
        scene: Question = Scene(compute=self.question.word, **own, **times)
        return scene


@lru_cache(maxsize=64)
def _solved(model: Model, times: tuple[float, ...]) -> tuple[FloatArray, FloatArray]:
    """Rotation matrices from the ICRS, shape (n, 3, 3), and 95 % half-widths of the axes, rad.

    The half-width is that of the pole or, for a rotation, of the attitude.
    """
    solvers = {"long-term": _long_term, "pole": _pole, "rotation": _rotation}
    return solvers[model.question.word](model, np.array(times))


def _long_term(model: Model, times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Matrices from the ICRS to the mean equator and equinox of date, and pole errors, rad."""
    different, index = np.unique(times, return_inverse=True)
    tree = run_tree(model.at(times=different * u.d), sections=["matrices"])
    section = tree["matrices"].to_dataset()
    return section.matrix.values[index], si(section.matrix_error).values[index]


def _pole(model: Model, times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Matrices from the ICRS to the true equator and equinox of date, and pole errors, rad.

    The equinox is the node on the ecliptic of date or on the orbit.
    """
    answer = run(model.at(times=_tdb(times))).sel(axis="figure")
    axis = np.stack([answer[name].values for name in "XYZ"])
    body = model.question.body  # type: ignore[attr-defined]
    if body.needed("pole").of_the_iau:
        normal = erfa.ecm06(J2000_JD, times)[:, 2].T
    else:
        own = body.needed("pole").orbit_normal(body.orbit_pole)
        normal = np.repeat(own[:, np.newaxis], times.size, axis=1)
    return equator_and_equinox(axis, normal), si(answer.direction_error).values


def _rotation(model: Model, times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Matrices from the ICRS to the principal axes of the body, and attitude errors, rad."""
    if times.min() < model.first:
        start, asked = datetime64(np.array([model.first, times.min()]))
        problem = f"the rotation starts at {start} TDB; take a later time"
        raise SceneError("obstime", str(asked), problem)
    answer = run(model.at(times=_tdb(np.array([model.first, *times])))).isel(time=slice(1, None))
    return rotations(answer).inv().as_matrix(), si(answer.attitude_error).values


def _tdb(times: FloatArray) -> Time:
    """Convert days from J2000.0 TDB to times of astropy."""
    return Time(J2000_JD, times, format="jd", scale="tdb")


def _at(model: Model | None, obstime: Time) -> tuple[FloatArray, FloatArray]:
    """Rotation matrices from the ICRS to a frame, at its times, and their errors, rad."""
    if model is None:
        raise SceneError("model", "nothing", "give an answer, as in model=answer")
    times = days(obstime.reshape(-1), Where("obstime"))
    matrix, error = _solved(model, tuple(times.tolist()))
    return matrix.reshape(*obstime.shape, 3, 3), error.reshape(obstime.shape)


class _ModelAttribute(Attribute):  # type: ignore[misc]
    """Attribute of an astropy frame that holds a result of this package."""

    def __init__(self, *words: str) -> None:
        self.words = words
        super().__init__(default=None)

    def convert_input(self, value: Any) -> tuple[Any, bool]:
        """Convert a result to its model (question and inputs), as astropy requires."""
        return (None, False) if value is None else (Model.of(value, self.words), True)


class _Rotated(BaseCoordinateFrame):  # type: ignore[misc]
    """Base class of astropy frames whose axes are computed by this package."""

    default_representation = SphericalRepresentation

    @property
    def error(self) -> u.Quantity:
        """95 % half-width of the pole's direction or, for a rotation, of the attitude, arcsec."""
        return (_at(self.model, self.obstime)[1] * u.rad).to(u.arcsec)

    @property
    def matrix(self) -> FloatArray:
        """Rotation matrix from the ICRS to this frame, shape (..., 3, 3)."""
        return _at(self.model, self.obstime)[0]


class EquatorOfDate(_Rotated):
    """Frame of astropy: equator and equinox of date of a computed pole.

    Directions are rotated only: no light time, aberration or light deflection is applied, unlike
    in astropy's GCRS and CIRS.

    Parameters
    ----------
    obstime : Time
        Time of the equator and equinox; several times are allowed.
    model : Dataset
        Answer of `long_term`: mean equator and equinox of date. Answer of `pole`: equator of the
        figure axis with its nutation, and its node on the ecliptic of date of IAU 2006; for another
        body than the Earth its node on the orbit. The question is solved at `obstime` itself.

    Raises
    ------
    SceneError
        If `model` is no such answer.
    CoverageError
        If the orbit or the kernel of the answer does not cover `obstime`.

    Examples
    --------
    >>> import earthspin
    >>> from astropy.coordinates import SkyCoord
    >>> from astropy.time import Time
    >>> from earthspin.frames import EquatorOfDate
    >>> past = earthspin.long_term("-12 kyr", "0 kyr", "1 kyr")
    >>> date = EquatorOfDate(obstime=Time(-9999.0, format="jyear", scale="tdb"), model=past)
    >>> vega = SkyCoord("18h36m56.3s", "+38d47m01s").transform_to(date)
    >>> print(f"{vega.ra.deg:.1f} {vega.dec.deg:.1f}")
    183.3 76.8
    """

    frame_specific_representation_info = {  # noqa: RUF012 - astropy makes it a property
        SphericalRepresentation: [
            RepresentationMapping("lon", "ra"),
            RepresentationMapping("lat", "dec"),
        ]
    }
    obstime = TimeAttribute(default=Time(J2000_JD, format="jd", scale="tdb"))
    model = _ModelAttribute("long-term", "pole")


class BodyFixed(_Rotated):
    """Frame of astropy: principal axes of a rotating body, computed by `rotation`.

    Parameters
    ----------
    obstime : Time
        Time of the attitude, not before the start of the answer.
    model : Dataset
        Answer of `rotation`, which is solved at `obstime` itself.

    Raises
    ------
    SceneError
        If `model` is no such answer, or if `obstime` is before its start.
    """

    obstime = TimeAttribute(default=Time(J2000_JD, format="jd", scale="tdb"))
    model = _ModelAttribute("rotation")


for _frame in (EquatorOfDate, BodyFixed):
    frame_transform_graph.add_transform(
        ICRS, _frame, DynamicMatrixTransform(lambda _, to: to.matrix, ICRS, _frame)
    )
    frame_transform_graph.add_transform(
        _frame,
        ICRS,
        DynamicMatrixTransform(lambda frame, _: np.swapaxes(frame.matrix, -1, -2), _frame, ICRS),
    )
    frame_transform_graph.add_transform(
        _frame,
        _frame,
        DynamicMatrixTransform(
            lambda frame, to: to.matrix @ np.swapaxes(frame.matrix, -1, -2), _frame, _frame
        ),
    )


class SkyfieldFrame:
    """Frame of Skyfield, for `frame_xyz` and `frame_latlon`, whose axes are those of a result.

    Parameters
    ----------
    answer : Dataset
        Answer of `long_term`, `pole` or `rotation`, as in `EquatorOfDate` and `BodyFixed`.
    """

    def __init__(self, answer: xr.Dataset) -> None:
        self.model = Model.of(answer, ("long-term", "pole", "rotation"))

    def rotation_at(self, t: Any) -> FloatArray:
        """Rotation matrix from the ICRF at the times of a Skyfield Time, (3, 3) or (3, 3, n)."""
        times = days(t, Where("t"))
        matrix, _ = _solved(self.model, tuple(times.tolist()))
        return np.moveaxis(matrix.reshape(*t.shape, 3, 3), (-2, -1), (0, 1))


def rotations(answer: xr.Dataset) -> Rotation:
    """Attitudes of a result as SciPy rotations, from body axes to inertial axes.

    Parameters
    ----------
    answer : Dataset
        Answer of `rotation`, `free_rotor` or `heavy_top`, with quaternions in `attitude`.

    Returns
    -------
    Rotation
        One for each time; `as_matrix`, `as_quat` and `as_euler` give other forms.

    Raises
    ------
    SceneError
        If the answer has no attitude.
    """
    from scipy.spatial.transform import Rotation

    if "attitude" not in answer:
        raise SceneError("answer", answer.attrs.get("compute", ""), "it has no 'attitude'")
    return Rotation.from_quat(
        answer.attitude.transpose(..., "quaternion").values, scalar_first=True
    )
