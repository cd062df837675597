"""Reference frames for astropy and Skyfield, with axes from results of this package.

The frames rotate directions: no light time, aberration or light deflection is applied, unlike in
astropy's GCRS and CIRS. The question of an answer is solved again at the very time of the frame,
since interpolation between its dates would lose accuracy.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import astropy.coordinates as coord
import astropy.units as u
import erfa
import numpy as np
import xarray as xr
from astropy.time import Time

from earthspin.bodies import MOON, in_a_sentence
from earthspin.bodies.librations import mean_earth_matrix
from earthspin.constants import ARCSEC, DAY, J2000_JD
from earthspin.dates import date_text, two_parts
from earthspin.engine import Question, scene_of, si
from earthspin.engine.atomic_writes import replacing
from earthspin.errors import SceneError, UndefinedError, Where
from earthspin.numerics.arrays import FloatArray
from earthspin.progress import progress
from earthspin.questions.first_attitude import ARBITRARY, x_axis_note
from earthspin.questions.time_axes import epochs
from earthspin.scenes import load_scene, members_of, run, run_tree, versions_of, warn_of_versions
from earthspin.secular.derived_angles import NO_EQUINOX, equator_and_equinox, equinox_error
from earthspin.sky import binary_pck
from earthspin.sky.binary_pck import chebyshev_series, euler_angles
from earthspin.units import in_order

if TYPE_CHECKING:
    from pathlib import Path

    from scipy.spatial.transform import Rotation

    from earthspin.engine.accessor import Answer

#: Resolution of the times of an answer, d.
MICROSECOND = 1e-6 / DAY

#: Largest last term of the series in a PCK, rad.
_PCK_TRUNCATION = 1e-4 * ARCSEC

__all__ = ["BodyFixed", "EquatorOfDate", "SkyfieldFrame", "rotations", "to_pck"]


def _give(words: tuple[str, ...]) -> str:
    """Advice for an error message: give a result of one of the computations named in `words`."""
    return f"give an answer to {' or '.join(map(repr, words))}"


@dataclass(frozen=True, eq=False)
class Model:
    """Question and inputs of a result, from which the axes are computed at other times.

    Attributes
    ----------
    question : Question
        Question of the answer, for a single body.
    text : str
        Scene of the answer.
    versions : dict of str to str
        Versions and file hashes with which the answer was computed. Models are compared by text
        and versions.
    """

    question: Question
    text: str
    versions: dict[str, str]

    @classmethod
    def of(cls, answer: Any) -> Model:
        """Make the model (question and inputs) from a result.

        Raises
        ------
        SceneError
            If this is no whole answer, or is for several bodies.
        """
        if isinstance(answer, xr.DataTree):
            answer = answer.to_dataset()
        if isinstance(answer, xr.Dataset) and scene_of(answer):
            answer = cls(load_scene(answer), scene_of(answer), versions_of(answer.attrs))
        if not isinstance(answer, cls):
            problem = "it has no scene; give a whole answer or its tree, not a section of it"
            raise SceneError("model", type(answer).__name__, problem)
        if answer.question.members is not None or members_of(answer.question) > 1:
            problem = "a frame needs one body; give an answer that is no ensemble"
            raise SceneError("model", "an answer for several bodies", problem)
        return answer

    def check(self, words: tuple[str, ...]) -> None:
        """Raise an error if the result is not that of one of the computations named in `words`."""
        if self.question.word not in words:
            raise SceneError("model", f"an answer to '{self.question.word}'", _give(words))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Model):
            return False
        return other.text == self.text and other.versions == self.versions

    def __hash__(self) -> int:
        return hash(self.text)

    def __repr__(self) -> str:
        return f"<answer to '{self.question.word}'>"

    @property
    def span(self) -> tuple[float, float]:
        """First and last date of the result, days from J2000.0 TDB."""
        keys = self.question.keys()
        return epochs(keys["span"], keys["step"], keys["times"]).span()

    @property
    def first(self) -> float:
        """First date of the result (of a rotation, the initial date), days from J2000.0 TDB."""
        return float(self.span[0])

    def at(self, times: Any) -> Question:
        """Build a question with the inputs of the result, and with new times."""
        return load_scene(self.question, {"times": times})


class FrameMatrices(NamedTuple):
    """Rotation matrices of the axes at given times, with errors and software versions.

    Attributes
    ----------
    matrix : ndarray, shape (n, 3, 3)
        Rotation matrices from the ICRS.
    error : ndarray, shape (n,)
        95 % half-widths of the directions of the axes, rad.
    versions : Dataset
        Versions and file hashes of this computation, as attributes.
    """

    matrix: FloatArray
    error: FloatArray
    versions: xr.Dataset


@lru_cache(maxsize=16)
def _solved(model: Model, times: tuple[float, ...]) -> FrameMatrices:
    """Compute the axes of a model at given times, days from J2000.0 TDB, as read-only arrays."""
    solvers = {"long-term": _long_term, "pole": _pole, "rotation": _rotation}
    solved = solvers[model.question.word](model, np.array(times))
    for array in (solved.matrix, solved.error):
        array.flags.writeable = False
    return solved


def _long_term(model: Model, times: FloatArray) -> FrameMatrices:
    """Matrices from the ICRS to the mean equator and equinox of date, and errors of axes, rad."""
    different, index = np.unique(times, return_inverse=True)
    tree = run_tree(model.at(different * u.d), sections=["matrices"])
    section, versions = tree.earthspin.section("matrices"), xr.Dataset(attrs=tree.attrs)
    return FrameMatrices(
        section.matrix.values[index], si(section.matrix_error).values[index], versions
    )


def _pole(model: Model, times: FloatArray) -> FrameMatrices:
    """Matrices from the ICRS to the true equator and equinox of date, and errors of axes, rad.

    The equinox is the node on the ecliptic of date or on the orbit.
    """
    answer = run(model.at(_tdb(times))).sel(axis="figure")
    axis = np.stack([answer[name].values for name in "XYZ"])
    body = model.question.body  # type: ignore[attr-defined]
    if body.needed("pole").of_the_iau:
        normal = erfa.ecm06(J2000_JD, times)[:, 2].T
    else:
        own = body.needed("pole").orbit_normal(body.orbit_pole)
        normal = np.repeat(own[:, np.newaxis], times.size, axis=1)
    error = si(answer.direction_error).values
    sine = np.linalg.norm(np.cross(axis, normal, axis=0), axis=0)
    if np.any(sine <= np.fmax(error, NO_EQUINOX)):
        raise UndefinedError(
            f"the axis of {in_a_sentence(body.name)} stands upright on the orbit: there is no "
            "equinox; use the axes of the answer itself"
        )
    matrix = equator_and_equinox(axis, normal)
    return FrameMatrices(matrix, equinox_error(error, 0.0, sine), xr.Dataset(attrs=answer.attrs))


def _rotation(model: Model, times: FloatArray) -> FrameMatrices:
    """Matrices from the ICRS to the principal axes of the body, and errors of these axes, rad."""
    first = model.first
    if times.min() < first - MICROSECOND:
        problem = f"the rotation starts at {date_text(first, 'us')} TDB; take a later time"
        raise SceneError("obstime", date_text(times.min(), "us"), problem)
    x_axis = x_axis_note(model.question.body, model.question.start_attitude)  # type: ignore[attr-defined]
    if x_axis.startswith(ARBITRARY):
        problem = f"its x axis is {x_axis}; set prime_meridian of the body, or give start_attitude"
        raise SceneError("model", f"{model}", problem)
    answer = run(model.at(_tdb(np.array([first, *np.maximum(times, first)]))))
    answer = answer.isel(time=slice(1, None))
    # times of an answer are rounded to a microsecond
    spin = np.sqrt(np.sum(answer.omega**2, axis=-1)).values
    error = si(answer.attitude_error).values + spin * MICROSECOND * DAY / 2
    return FrameMatrices(rotations(answer).inv().as_matrix(), error, xr.Dataset(attrs=answer.attrs))


def _tdb(times: FloatArray) -> Time:
    """Convert days from J2000.0 TDB to times of astropy."""
    return Time(J2000_JD, times, format="jd", scale="tdb")


def _at(model: Model, time: Any, where: Where) -> tuple[FloatArray, FloatArray]:
    """Rotation matrices from the ICRS at given times, and 95 % half-widths of the axes, rad."""
    times = np.add(*two_parts(time, where))
    if times.size == 0:
        return np.empty((*times.shape, 3, 3)), np.empty(times.shape)
    with progress("axes of the frame"):
        solved = _solved(model, tuple(times.ravel().tolist()))
    warn_of_versions(model.versions, solved.versions, stacklevel=5)
    return solved.matrix.reshape(*times.shape, 3, 3), solved.error.reshape(times.shape)


class _DateAttribute(coord.TimeAttribute):  # type: ignore[misc]
    """Frame attribute (astropy) for dates, in all forms that this package accepts."""

    def convert_input(self, value: Any) -> tuple[Any, bool]:
        """Convert dates to an astropy Time (TDB); leave an astropy Time unchanged."""
        if value is None or isinstance(value, Time):
            return super().convert_input(value)  # type: ignore[no-any-return]
        whole, rest = two_parts(value, Where("obstime"))
        return Time(J2000_JD + whole, rest, format="jd", scale="tdb"), True


class _ModelAttribute(coord.Attribute):  # type: ignore[misc]
    """Frame attribute (astropy) for a result of this package, stored as a `Model`.

    astropy hands the attributes of one frame on to others by their names, so that each frame checks
    the question itself.
    """

    def convert_input(self, value: Any) -> tuple[Any, bool]:
        """Convert a result to its model (question and inputs), as astropy requires."""
        return (None, False) if value is None else (Model.of(value), True)


#: Axes of the frame `BodyFixed`.
PRINCIPAL, MEAN_EARTH = "principal", "mean-earth"


class _Computed:
    """Base class of astropy frames with computed axes: rotation matrix, and error of the axes."""

    obstime: Time
    model: Model | None
    _words: tuple[str, ...]

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        if self.model is not None:
            self.model.check(self._words)

    @property
    def error(self) -> u.Quantity:
        """95 % half-width of the directions of the axes, arcsec."""
        return (self._matrix_and_error()[1] * u.rad).to(u.arcsec)

    @property
    def matrix(self) -> FloatArray:
        """Rotation matrix from the ICRS to this frame, shape (..., 3, 3)."""
        return self._matrix_and_error()[0]

    def _matrix_and_error(self) -> tuple[FloatArray, FloatArray]:
        """Rotation matrices from the ICRS at the times of the frame, and errors of axes, rad."""
        if self.model is None:
            raise SceneError("model", None, f"{_give(self._words)}, as in model=answer")
        return _at(self.model, self.obstime, Where("obstime"))


class EquatorOfDate(_Computed, coord.BaseRADecFrame):  # type: ignore[misc]
    """Frame of astropy: equator and equinox of date of a computed pole.

    Directions and velocities are rotated only: no light time, aberration or light deflection is
    applied, unlike in astropy's GCRS and CIRS.

    Parameters
    ----------
    obstime : Time
        Time of the equator and equinox, J2000.0 by default; several times are allowed. A plain date
        is TDB, as in the questions.
    model : Dataset
        Answer of `long_term`: mean equator and equinox of date. Answer of `pole`: true equator of
        the figure axis, and its node on the ecliptic of date of IAU 2006; for another body than the
        Earth its node on the orbit. The question is solved at `obstime` itself. The pole of
        the Earth agrees with IAU 2006/2000A to 0.66 mas (1950 to 2050), except for answers with
        ``effects="rigid"``, which differ from it by up to 0.09 arcsec.

    Attributes
    ----------
    error : Quantity
        95 % half-width of the directions of pole and equinox, arcsec. For `pole` it does not
        contain effects that the answer leaves out.
    matrix : ndarray, shape (..., 3, 3)
        Rotation matrix from the ICRS.

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

    obstime = _DateAttribute(default=Time(J2000_JD, format="jd", scale="tdb"))
    model = _ModelAttribute(default=None)
    _words = ("long-term", "pole")


class BodyFixed(_Computed, coord.BaseCoordinateFrame):  # type: ignore[misc]
    """Frame of astropy: axes of a rotating body, computed by `rotation`.

    Vectors are rotated only: a velocity remains the velocity relative to the ICRS.

    Parameters
    ----------
    obstime : Time
        Time of the attitude, not before the start of the answer; J2000.0 by default.
    model : Dataset
        Answer of `rotation`, which is solved at `obstime` itself.
    axes : str
        ``"principal"`` axes, that of C last; or, for the Moon, the ``"mean-earth"`` axes of maps
        and of the IAU, which differ from them by 103.85 arcsec.

    Attributes
    ----------
    error : Quantity
        95 % half-width of the attitude, arcsec.
    matrix : ndarray, shape (..., 3, 3)
        Rotation matrix from the ICRS to these axes.

    Raises
    ------
    SceneError
        If `model` is no such answer, if `obstime` is before its start, if the prime meridian of
        the body is not known, or if mean-Earth axes of another body than the Moon are requested.
    """

    default_representation = coord.SphericalRepresentation
    default_differential = coord.SphericalCosLatDifferential
    obstime = _DateAttribute(default=Time(J2000_JD, format="jd", scale="tdb"))
    model = _ModelAttribute(default=None)
    axes = coord.Attribute(default=PRINCIPAL)
    _words = ("rotation",)

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        if self.axes not in (PRINCIPAL, MEAN_EARTH):
            raise SceneError("axes", self.axes, f"give '{PRINCIPAL}' or '{MEAN_EARTH}'")

    def _matrix_and_error(self) -> tuple[FloatArray, FloatArray]:
        """Rotation matrices from the ICRS to the requested axes, and errors of axes, rad."""
        matrix, error = super()._matrix_and_error()
        if self.axes == PRINCIPAL:
            return matrix, error
        body = self.model.question.body
        if body.known_as != MOON.name:
            problem = f"only the Moon has them, not {in_a_sentence(body.name)}"
            raise SceneError("axes", MEAN_EARTH, problem)
        return mean_earth_matrix() @ matrix, error


for _frame in (EquatorOfDate, BodyFixed):
    for _from, _to, _matrix in (
        (coord.ICRS, _frame, lambda _, to: to.matrix),
        (_frame, coord.ICRS, lambda frame, _: np.swapaxes(frame.matrix, -1, -2)),
        (_frame, _frame, lambda frame, to: to.matrix @ np.swapaxes(frame.matrix, -1, -2)),
    ):
        _transform = coord.DynamicMatrixTransform(_matrix, _from, _to)
        coord.frame_transform_graph.add_transform(_from, _to, _transform)


class SkyfieldFrame:
    """Skyfield frame, for `frame_xyz` and `frame_latlon`, with axes from a result.

    Vectors are rotated only: a velocity remains the velocity relative to the ICRF.

    Parameters
    ----------
    answer : Dataset
        Answer of `long_term`, `pole` or `rotation`, as in `EquatorOfDate` and `BodyFixed`.
    """

    def __init__(self, answer: xr.Dataset) -> None:
        self.model = Model.of(answer)
        self.model.check(("long-term", "pole", "rotation"))

    def __repr__(self) -> str:
        return f"SkyfieldFrame({self.model})"

    def rotation_at(self, t: Any) -> FloatArray:
        """Rotation matrix from the ICRF to this frame at a Time or date, (3, 3) or (3, 3, n)."""
        return np.moveaxis(_at(self.model, t, Where("t"))[0], (-2, -1), (0, 1))

    def error_at(self, t: Any) -> u.Quantity:
        """95 % half-width of the directions of the axes at the times of a Skyfield Time, arcsec."""
        return (_at(self.model, t, Where("t"))[1] * u.rad).to(u.arcsec)


#: Length of a window of a binary PCK, of one turn of the body: 4 d for the Moon.
_PCK_WINDOW = 4 / 27.32
#: First class ID of frames in binary PCK files, to which the NAIF code of the body is added.
PCK_FRAMES = 1_900_000


def to_pck(answer: Answer, path: str | Path, frame_id: int | None = None) -> int:
    """Write the attitudes of an answer of `rotation` as a binary PCK of SPICE, of type 2.

    The question is solved again at the nodes of Chebyshev series over the span of the answer. The
    axes are the principal axes of the body.

    Parameters
    ----------
    answer : Answer
        Accessor of the answer, of which this is a method.
    path : str or Path
        File to write, usually with the suffix ``.bpc``.
    frame_id : int, optional
        Class ID of the frame; by default 1900000 plus the NAIF code of the body.

    Returns
    -------
    int
        Class ID of the frame, for a frame kernel or the variables ``FRAME_...`` of a reader.

    Raises
    ------
    SceneError
        If this is no answer of `rotation`, if it has one date only, or if the body has no NAIF code
        and no `frame_id` is given.
    UndefinedError
        If the pole is so near that of the ICRF that its right ascension changes too fast.

    Examples
    --------
    >>> import earthspin
    >>> moon = earthspin.rotation("2026-01-01", "2026-01-09", "1 d", body="moon")
    >>> moon.earthspin.to_pck("moon.bpc")
    1900301
    """
    model = Model.of(answer.dataset)
    model.check(("rotation",))
    body, span = model.question.body, model.span  # type: ignore[attr-defined]
    if frame_id is None:
        if not body.naif:
            raise SceneError("frame_id", None, f"{body.name} has no NAIF code; give a number")
        frame_id = PCK_FRAMES + body.naif[0]
    if not span[1] > span[0]:
        raise SceneError("span", date_text(span[0], "us"), "give an answer for more than one date")
    turn = 2 * np.pi / float(np.max(np.linalg.norm(answer.dataset.omega.values, axis=-1))) / DAY
    count = max(1, int(np.ceil((span[1] - span[0]) / (_PCK_WINDOW * turn))))

    def angles(seconds: FloatArray) -> FloatArray:
        solved = run(model.at(_tdb(np.array([span[0], *(seconds / DAY)]))))
        return euler_angles(solved.attitude.values[1:])

    start, stop = span[0] * DAY, span[1] * DAY
    series = chebyshev_series(angles, start, stop, count)
    truncation = float(np.abs(series[..., -1]).max())
    if truncation > _PCK_TRUNCATION:
        raise UndefinedError(
            f"a PCK cannot hold this motion of {in_a_sentence(body.name)}: the last terms of its "
            f"Euler angles are {truncation / ARCSEC:.2g} arcsec"
        )
    with replacing(path) as draft, draft.open("wb") as file:
        binary_pck.write(file, series, start, stop, frame_id, f"{body.name} by earthspin")
    return frame_id


def rotations(answer: xr.Dataset) -> Rotation:
    """Attitudes of a result as SciPy rotations, from body axes to inertial axes.

    Parameters
    ----------
    answer : Dataset
        Answer of `rotation`, `free_rotor` or `heavy_top`, with quaternions in `attitude`.

    Returns
    -------
    Rotation
        One for each time; `as_matrix`, `as_quat` and `as_euler` give other forms. `as_quat()` has
        the order (x, y, z, w); ``as_quat(scalar_first=True)`` has that of `attitude`, (w, x, y, z).

    Raises
    ------
    SceneError
        If the answer has no attitude, or only some components of it.
    """
    from scipy.spatial.transform import Rotation

    if "attitude" not in getattr(answer, "data_vars", ()):
        word = getattr(answer, "attrs", {}).get("compute")
        given = f"an answer to '{word}'" if word else type(answer).__name__
        raise SceneError("answer", given, _give(("rotation", "free-rotor", "top")))
    attitude = in_order(answer.attitude, Where("answer.attitude"))
    return Rotation.from_quat(attitude.values, scalar_first=True)
