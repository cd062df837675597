"""Obliquity, precession and eccentricity over millennia to millions of years."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, Self

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import MOON, SUN, Body, in_a_sentence, label_of
from earthspin.constants import ARCSEC, JULIAN_YEAR, PUBLISHED_EFFECTS
from earthspin.dates import YearList, YearSpan, YearStep, grid
from earthspin.engine import Neglected, Variables, key, labels, measured, number, part, public_call
from earthspin.errors import UndefinedError, Where
from earthspin.numerics.arrays import FloatArray, Numeric
from earthspin.numerics.varied_inputs import MEMBERS
from earthspin.progress import progress
from earthspin.questions.averages import MEANS, MeanRates, MeanTorques, of_perturber
from earthspin.questions.labelled_numbers import LabelledNumbers
from earthspin.questions.reasons import no_iau_model, north_note, not_sun_and_moon
from earthspin.questions.satellites import mean_pole_error
from earthspin.questions.sky import Interval, PerturbedBody, Sky, places, sky, start_error
from earthspin.secular import derived_angles, error_budget
from earthspin.secular.averaged_torque import (
    PrecessionConstant,
    Tides,
    geodesic_precession,
    moon_rate_factor,
)
from earthspin.sky.orbit_files import read_orbit
from earthspin.sky.orbit_table import OrbitTable, shipped
from earthspin.tables import is_table
from earthspin.torque import gravity, rates
from earthspin.units import FileName, Number, Plain, pack, unpack

# --- orbits --------------------------------------------------------------------------------------


#: Name of the table that is shipped for the body.
OWN = "own"


#: Names of the words and of the arrays of a table in a scene.
_WORDS = ("name", "source", "sha256")
_ARRAYS = ("edges", "coefficients", "axes", "errors")


class OrbitChoice(FileName):
    """Kind of input: an orbit table, given as "own", as a file path, or as an `OrbitTable`."""

    words = '"own", the path of a table, or the result of read_orbit'
    hint = "str | PathLike[str] | OrbitTable"
    known = (OWN,)
    content = "the table of an orbit"

    def read(self, value: object, where: Where) -> Any:
        """Check the choice of orbit: "own", a file, an `OrbitTable`, or a dict made by `write`."""
        if isinstance(value, OrbitTable):
            return value
        if isinstance(value, Mapping):
            return _table_of(value, where)
        return super().read(value, where)

    def write(self, value: str | OrbitTable) -> Plain:
        """Return a word or path unchanged; convert an `OrbitTable` to a dict of all its numbers."""
        if isinstance(value, str):
            return value
        words = {name: getattr(value, name) for name in _WORDS}
        return words | {name: pack(getattr(value, name)) for name in _ARRAYS}

    def begins(self, head: bytes) -> bool:
        """Return True if the first bytes `head` begin a NumPy archive or a text table."""
        return head[:2] == b"PK" or is_table(head)


def _table_of(table: Mapping[str, Any], where: Where) -> OrbitTable:
    """Build an `OrbitTable` from the dict that a scene (input) file stores."""
    names = {*_WORDS, *_ARRAYS}
    if set(table) != names:
        raise where.error(sorted(table), f"an orbit table needs {', '.join(sorted(names))}")
    edges, coefficients, axes, errors = (unpack(table[name], where) for name in _ARRAYS)
    windows = len(edges) - 1
    shapes = coefficients.shape[:2] == (4, windows) and errors.shape == (2, windows)
    if not shapes or axes.shape != (3, 3) or coefficients.ndim != 3:
        raise where.error("a table", "the shapes of its arrays do not fit together")
    name, source, sha256 = (str(table[key]) for key in _WORDS)
    return OrbitTable(name, edges, coefficients, axes, source, errors, sha256)


@part
def orbit_table(orbit: str | OrbitTable, body: Body) -> OrbitTable:
    """Return the table of the body's orbit over millions of years."""
    if not isinstance(orbit, str):
        return orbit
    if orbit != OWN:
        return read_orbit(orbit, body=body.known_as or body.name)
    table = shipped(body.known_as)
    if table is None:
        raise UndefinedError(
            f"no orbit over millions of years is shipped for {body.name}; give a file as orbit"
        )
    return table


# --- the question --------------------------------------------------------------------------------


#: Relative half-width of the published contributions to the rate of the Earth: with them it lies so
#: far from that of IAU 2006 (3.8 mas a century, `closure` of `precession`).
CLOSURE = 7.5e-7
Factor = Annotated[float, Number("", "1.0", low=-10.0, high=10.0)]
Shift = Annotated[float, Number("rad", "0.1 deg")]


class LongTerm(
    PerturbedBody, word="long-term", call="long_term", positional=("start", "stop", "step")
):
    """Obliquity, precession and eccentricity from the averaged torque on a changing orbit.

    The spin axis starts at J2000.0 from the mean pole of the body, without nutation. Errors need
    the body's `pole_uncertainty`. Averaged torques of Sun and Moon (those of `precession`, with the
    published contributions that they leave out), geodesic precession, tides, and a rate of J2 that
    fades turn it about the normal of an orbit that comes as a table.

    The label `epoch` is in Julian years from J2000.0 TDB; `pole` and `ecliptic_pole` refer to the
    GCRS. Where the phase of precession is uncertain by more than 0.1 rad, for the Earth beyond a
    million years, errors are quantiles over a sample of solutions.

    Raises
    ------
    CoverageError
        If times lie outside the table of the orbit.

    Examples
    --------
    >>> import earthspin
    >>> past = earthspin.long_term("-100 kyr", "0 kyr", "1 kyr")
    >>> print(past.sizes["epoch"], past.obliquity.isel(epoch=-1).round(3).item())
    101 23.439
    """

    page, headline = "long_term", "obliquity"
    csv_columns = ("obliquity", "eccentricity", "longitude_of_perihelion", "climatic_precession")

    exclusive = ((("times",), ("span", "step")),)
    array_masses = True

    span: YearSpan = key(
        ("-1 Myr", "0 kyr"),
        doc="first and last time: durations from J2000.0 TDB, or dates; the last is included if "
        "the step meets it",
    )
    step: YearStep = key("1 kyr", doc="time between two epochs")
    times: YearList | None = key(None, doc="list of times, instead of span and step")
    orbit: Annotated[str | OrbitTable, OrbitChoice()] = key(
        "own", doc="table of the orbit: that of the body, a file, or a result of read_orbit"
    )
    tides: Factor = key(1.0, doc="factor on the tides that slow Moon and spin; 0 is off")
    ellipticity: Annotated[float, Number("", "1.0", low=1e-9)] = key(
        1.0, doc="factor on the dynamical ellipticity"
    )
    j2_rate: Annotated[float, Number("1/s", "-8.8e-16 1/s")] | None = key(
        None,
        doc="relative rate of J2 at J2000.0, which decays from 2 to 10 kyr; 0 switches it off; "
        "that of the body if not given",
    )
    obliquity_shift: Shift = key("0 deg", doc="change of the initial obliquity at J2000.0")
    longitude_shift: Shift = key(
        "0 deg",
        doc="rotation of the initial axis about the normal of the orbit, in the direction of "
        "the orbital motion",
    )

    @property
    def unused(self) -> str:
        """Neglected effect of satellites, in words; empty for a body without satellites.

        The rate of precession includes satellites with the tilts of their orbits at J2000.0; later
        changes of these tilts are neglected.
        """
        satellites = super().unused
        return f"the change of the tilts of {satellites}" if satellites else ""

    def check(self) -> None:
        """Set default perturbers, and refuse any other than the Sun and the Moon."""
        super().check()
        if "perturbers" not in self.given and no_iau_model(self.body):
            object.__setattr__(self, "perturbers", (SUN,))
        if sorted(p.known_as for p in self.perturbers) not in (["sun"], ["moon", "sun"]):
            problem = (
                "orbits over millennia, node and tides are those of the Sun (NAIF 10) and the Moon "
                "(301): give ('sun',) or both; for another star ask for precession or rotation"
            )
            raise self.error("perturbers", [p.name for p in self.perturbers], problem)


def _unknown_start(body: Body) -> str:
    """Text that explains missing errors: the body's pole at J2000.0 has no known uncertainty."""
    return (
        f"how far off the pole of {in_a_sentence(body.name)} is at J2000.0 is not known; give the "
        "body a pole_uncertainty"
    )


class FromPole(Variables):
    """Base class of results that depend on the direction of a body's pole at J2000.0."""

    _unknown_start = ""

    def started_from(self, body: Body) -> Self:
        """If the uncertainty of the body's pole is unknown, mark the result's errors as unknown."""
        if body.pole_uncertainty is None:
            self._unknown_start = f"NaN, not given: {_unknown_start(body)}"
        return self

    def dataset(self) -> xr.Dataset:
        """Build the dataset; errors are NaN if they depend on a pole of unknown uncertainty."""
        result = super().dataset()
        for name, error in result.data_vars.items():
            of_orbit = str(name).startswith(("eccentricity_", "ecliptic_pole_"))
            if self._unknown_start and "_error" in str(name) and not of_orbit:
                error[...] = np.nan
                error.attrs["no_error"] = self._unknown_start
        return result


@part
def output_times(span: YearSpan, step: float, times: YearList | None) -> FloatArray:
    """Return the epochs at which the user requests results, s from J2000.0 TDB."""
    return grid(span, step, Where("step")) if times is None else times.listed


@part
def interval(sky: Sky) -> Interval:
    """Return the first and last day of the torque average: the whole time span of the kernel."""
    return Interval(*sky.coverage())


@part
def inputs(
    mean_rates: MeanRates,
    body: Body,
    perturbers: tuple[Body, ...],
    tides: float,
    ellipticity: float,
    j2_rate: float | None,
    obliquity_shift: float,
    longitude_shift: float,
) -> LabelledNumbers:
    """Broadcast the inputs of the long-term precession (numbers or arrays) to one shape."""
    (rate, error), j2 = mean_rates.total(), body.needed("j2")
    own_rate: Numeric = (0.0 if body.j2_rate is None else body.j2_rate) / (j2 + (j2 == 0))
    as_published = 0.0 if not_sun_and_moon(body, perturbers) else body.are_as_named
    return LabelledNumbers.broadcast(
        **{
            p.known_as: of_perturber(mean_rates.rate.value, place)
            for place, p in enumerate(perturbers)
        },
        relative_error=np.hypot(error / np.abs(rate), CLOSURE * as_published),
        published=_published() * as_published,
        spin_rate=body.spin_rate,
        tides=tides,
        ellipticity=ellipticity,
        j2_rate=own_rate if j2_rate is None else j2_rate,
        obliquity_shift=obliquity_shift,
        longitude_shift=longitude_shift,
    )


@part
def precession_constant(
    inputs: LabelledNumbers, mean_torques: MeanTorques, body: Body, orbit_table: OrbitTable
) -> PrecessionConstant:
    """Compute the constant of precession at J2000.0, and parameters of its change in time.

    It follows from the rates of `precession` divided by the cosine of the obliquity. The published
    effects of second order, planets, J4 and the interior are added to the Moon's part, which is
    then divided by the effect of the lag of the Moon's plane at J2000.0.
    """
    cosine, now = math.cos(mean_torques.obliquity), orbit_table.at(np.zeros(1))
    # the rates are those on the body's own orbit, whichever is given
    own = shipped(body.known_as) or orbit_table
    eccentricity = float(np.linalg.norm(own.at(np.zeros(1))[1]))
    motion = 2 * math.pi / body.number("orbital_period")
    geodesic = geodesic_precession(SUN.gm, motion, eccentricity)
    sun, spin_rate, tides, ellipticity, j2_rate = inputs.columns(
        "sun", "spin_rate", "tides", "ellipticity", "j2_rate"
    )
    sun = sun / cosine
    if "moon" not in inputs.values:
        return PrecessionConstant(sun, 0.0, eccentricity, geodesic, ellipticity, j2_rate=j2_rate)
    moon, published = inputs.columns("moon", "published")
    node_rate = 2 * math.pi / MOON.cycle
    pole = body.needed("pole").mean(np.zeros(1))[0][:, np.newaxis]
    by_lag = float((moon_rate_factor(now, pole, node_rate) / gravity.dot(now[0], pole)).item())
    return PrecessionConstant(
        sun,
        (moon + published) / (cosine * by_lag),
        eccentricity,
        geodesic,
        ellipticity,
        tides=Tides.of_the_earth(tides, spin_rate, 2 * math.pi / MOON.number("orbital_period")),
        j2_rate=j2_rate,
        node_rate=node_rate,
    )


def _published() -> float:
    """Sum of published contributions to the Earth's precession rate, except geodesic, rad/s."""
    return sum(
        float(effect.value) * ARCSEC / JULIAN_YEAR
        for name, effect in PUBLISHED_EFFECTS.items()
        if name != "geodesic"
    )


@part
def solved_axes(
    precession_constant: PrecessionConstant,
    inputs: LabelledNumbers,
    orbit_table: OrbitTable,
    output_times: FloatArray,
    body: Body,
    mean_rates: MeanRates,
) -> error_budget.AxisFamily:
    """Integrate the motion of the spin axis, and repeat it with each uncertain input changed.

    A further integration has windows of twice the length.
    """
    span = float(output_times.min()), float(output_times.max())
    orbit_table.check_times(np.array(span))
    (relative_error,) = inputs.columns("relative_error")
    half = mean_pole_error(body, start_error(body), mean_rates.gm_over_r3)
    # of the IAU's pole the obliquity alone is uncertain, because longitudes count from it
    directions = 1 if body.needed("pole").of_the_iau else 2
    start = _start(inputs, body, orbit_table)
    setting = error_budget.AxisInputs(precession_constant, orbit_table, start)
    uncertainty = error_budget.Uncertainty(
        constant=relative_error,
        start=() if half is None else (half,) * directions,
        orbit=orbit_table.error,
        earth=precession_constant.node_rate < math.inf,
    )
    return error_budget.solved(setting, span, uncertainty)


def _start(inputs: LabelledNumbers, body: Body, orbit_table: OrbitTable) -> FloatArray:
    """Unit vectors of the spin axis at J2000.0, for all sets of inputs, shape (3, ...)."""
    now = np.zeros(1)
    pole = body.needed("pole").without_nutation().mean(now)[0]
    obliquity, longitude = (
        np.asarray(inputs.values[name]) for name in ("obliquity_shift", "longitude_shift")
    )
    shifted = derived_angles.inclined_axis(pole, orbit_table.at(now)[0][:, 0], obliquity, longitude)
    own = np.multiply.outer(pole, np.ones(obliquity.shape))
    return np.where((obliquity == 0) & (longitude == 0), own, shifted)


@part
def angles(
    solved_axes: error_budget.AxisFamily, output_times: FloatArray, body: Body
) -> derived_angles.AnglesWithErrors:
    """Compute angles and rates, with their errors, from the integrated motions of the spin axis."""
    fixed = body.needed("pole").without_nutation().orbit_axes(body.orbit_pole)
    with progress("solutions", MEMBERS) as advance:
        return derived_angles.derive_all(solved_axes, output_times, fixed, advance)


# --- the answer ----------------------------------------------------------------------------------


class LongTermSeries(FromPole, along=("epoch",)):
    """Obliquity, precession, eccentricity, poles and precession rates at every epoch."""

    obliquity = measured(
        "deg",
        "angle from the orbit's normal to the spin axis",
        comment="half-widths from method, orbit, start, and the assumed uncertainty of tides and "
        "figure in the past",
    )
    longitude_of_perihelion = measured(
        "deg", "longitude of perihelion from the moving equinox, without jumps"
    )
    general_precession = measured("deg", "p_A, precession of the equinox along the moving orbit")
    psi_A = measured("deg", "precession of the equator along the orbit of J2000.0")
    omega_A = measured("deg", "inclination of the equator to the orbit of J2000.0")
    eccentricity = measured("1", "eccentricity of the orbit")
    climatic_precession = measured(
        "1", "eccentricity times the sine of the longitude of perihelion"
    )
    coprecession = measured("1", "eccentricity times the cosine of the longitude of perihelion")
    pole = number("1", "unit vector of the spin axis", along=("epoch", "component"), frame="GCRS")
    pole_error = number("arcsec", "95 % half-width of the direction of the pole")
    ecliptic_pole = number(
        "1", "unit normal of the orbit", along=("epoch", "component"), frame="GCRS"
    )
    ecliptic_pole_error = number("arcsec", "95 % half-width of the direction of the orbit's normal")
    precession_rate = measured(
        "arcsec/yr",
        "rate of precession in longitude along the moving orbit",
        along=("perturber", "epoch"),
    )
    precession_period = measured(
        "yr", "period of one full turn at that rate", along=("perturber", "epoch"), short="period"
    )
    epoch = labels("Julian years from J2000.0 (TDB)", "yr")
    component = labels(default=["x", "y", "z"])
    perturber = labels()


@part
def series(
    angles: derived_angles.AnglesWithErrors,
    inputs: LabelledNumbers,
    output_times: FloatArray,
    solved_axes: error_budget.AxisFamily,
    orbit_table: OrbitTable,
    body: Body,
    perturbers: tuple[Body, ...],
) -> LongTermSeries:
    """Return obliquity, precession, eccentricity, poles and rates at every epoch, with errors."""
    nominal, labelled = angles.nominal, inputs.array
    pole_error = angles.half_width("pole")
    with_moon = solved_axes.setting.precession.node_rate < math.inf
    names = ["sun", "moon", "total"] if with_moon else ["sun", "total"]
    rate = np.stack([nominal.values[name] for name in names], axis=-2)
    error = np.stack([angles.half_width(name) for name in names], axis=-2)
    windows = solved_axes.path.windows
    window = np.median(np.diff(windows.edges)) / JULIAN_YEAR

    return (
        LongTermSeries(
            **{
                name: inputs.pair(nominal.values[name], angles.half_width(name), "epoch")
                for name in nominal.values.keys() & LongTermSeries.fields.keys()
            },
            pole=labelled(np.moveaxis(nominal.pole, 0, -1), "epoch", "component"),
            pole_error=labelled(pole_error, "epoch"),
            ecliptic_pole=labelled(nominal.normal.T, "epoch", "component"),
            ecliptic_pole_error=labelled(angles.half_width("normal"), "epoch"),
            precession_rate=inputs.pair(rate, error, "perturber", "epoch"),
            precession_period=inputs.pair(
                rates.period(rate), rates.period_error(rate, error), "perturber", "epoch"
            ),
            epoch=output_times / JULIAN_YEAR,
            perturber=[label_of(name, perturbers) or name for name in names],
        )
        .with_attributes(
            obliquity=north_note(body)
            | {"orbit": orbit_table.source, "orbit_of": orbit_table.name},
            pole_error={
                "method": f"Newton's method in time, {windows.order} nodes in each window of "
                f"{window:.0f} yr",
                "evaluations": solved_axes.steps,
            },
        )
        .started_from(body)
    )


# --- sections ------------------------------------------------------------------------------------

#: What shares mean where errors are quantiles over a sample.
_ONE_AT_A_TIME = (
    "of solutions with one cause changed at a time; where the phase error exceeds 0.1 rad, errors "
    "are quantiles over solutions with all causes changed, and shares do not add up to them"
)


class ErrorShares(Variables, along=("cause", "epoch"), no_error="a share of an error"):
    """Contribution of each error source to the errors of obliquity, perihelion and pole."""

    obliquity_share = number("arcsec", "share of the error of the obliquity")
    longitude_share = number("deg", "share of the error of the longitude of perihelion")
    pole_share = number("arcsec", "share of the error of the pole's direction")
    cause = labels()
    epoch = labels()

    def dataset(self) -> xr.Dataset:
        """Build the Dataset of error contributions, with a comment that explains these numbers."""
        return super().dataset().assign_attrs(comment=_ONE_AT_A_TIME)


@part
def budget(
    angles: derived_angles.AnglesWithErrors, inputs: LabelledNumbers, series: xr.Dataset
) -> ErrorShares:
    """Compute the contribution of each error source to errors of obliquity, perihelion and pole."""

    def labelled(by_cause: dict[str, FloatArray]) -> xr.DataArray:
        shares = np.broadcast_arrays(*by_cause.values())
        return inputs.array(np.stack(shares, axis=-2), "cause", "epoch")

    by_pole = angles.changes("pole")
    return ErrorShares(
        obliquity_share=labelled(angles.changes("obliquity")),
        longitude_share=labelled(angles.changes("longitude_of_perihelion")),
        pole_share=labelled(by_pole),
        cause=list(by_pole),
        epoch=series.epoch,
    )


class Matrices(FromPole, along=("epoch", "axis", "component"), error="matrix_error"):
    """Precession matrices from the GCRS to mean equator and equinox of date."""

    matrix = number("1", "precession matrix from the GCRS to mean equator and equinox of date")
    matrix_error = number(
        "arcsec", "95 % half-width of the directions of equinox and pole", along=("epoch",)
    )
    epoch = labels()
    axis = labels(default=["equinox", "90 deg east", "pole"])
    component = labels(default=["x", "y", "z"])


@part
def matrices(
    angles: derived_angles.AnglesWithErrors, inputs: LabelledNumbers, series: xr.Dataset, body: Body
) -> Matrices:
    """Compute the precession matrices from the GCRS to mean equator and equinox of date."""
    matrix = derived_angles.equator_and_equinox(angles.nominal.pole, angles.nominal.normal)
    error = derived_angles.equinox_error(
        angles.half_width("pole"),
        angles.half_width("normal"),
        np.sin(angles.nominal.values["obliquity"]),
    )
    return Matrices(
        matrix=inputs.array(matrix, "epoch", "axis", "component"),
        matrix_error=inputs.array(error, "epoch"),
        epoch=series.epoch,
    ).started_from(body)


@part
def neglected(body: Body, j2_rate: float | None) -> Neglected:
    """Effects on the long-term motion that are neither modelled nor included in the errors."""
    unknown = j2_rate is None and body.j2_rate is None
    return Neglected(
        what=f"{'change of J2 with time: not known; ' * unknown}"
        "friction between core and mantle, ice ages in the figure: not measured; asteroids "
        "and the Sun's flattening in the orbit: in the errors of a shipped orbit, not in those of "
        "one that is given; past some fifty million years the orbit is chaotic"
    )


#: Parts that every question on the long-term motion shares, and how their members are computed.
SHARED: dict[str, Any] = {
    "parts": (
        *(places, sky, interval, output_times, *MEANS),
        *(orbit_table, inputs, precession_constant, solved_axes, angles),
    ),
    "together": (
        *("body", "perturbers", "tides", "ellipticity", "j2_rate"),
        *("obliquity_shift", "longitude_shift"),
    ),
    "widest": 64,
}

long_term = public_call(LongTerm, answer=series, sections=(budget, matrices, neglected), **SHARED)
