"""Obliquity, precession and eccentricity over millennia to millions of years."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import MOON, SUN, Body, Numeric, in_a_sentence
from earthspin.choosing.promises import Report, refuse_unkept
from earthspin.constants import ARCSEC, JULIAN_YEAR, PUBLISHED_EFFECTS
from earthspin.engine.asking import ask
from earthspin.engine.labels import Variable, build, covered_by, with_error, without_error
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import key, made_of
from earthspin.errors import Where
from earthspin.parts.averages import MEANS, MeanRates, MeanTorques, of_one
from earthspin.parts.orbits import OrbitChoice, orbit_table
from earthspin.parts.pulls import start_error
from earthspin.parts.reasons import no_accuracy, no_iau_model, not_sun_and_moon
from earthspin.parts.side_by_side import SideBySide
from earthspin.parts.sky import Pulled, Sky, Stretch, places, sky
from earthspin.sky.orbit_table import OrbitTable, shipped
from earthspin.units import AngleError, Number
from earthspin.years import YearList, YearSpan, YearStep, grid

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.secular.budget import Solved
    from earthspin.secular.reading import Readings
    from earthspin.secular.strength import Strength

FloatArray = NDArray[np.float64]
#: Relative half-width of the published contributions to the rate of the Earth: with them it lies so
#: far from that of IAU 2006 (3.8 mas a century, `closure` of `precession`).
CLOSURE = 7.5e-7
Factor = Annotated[float, Number("", "1.0", low=-10.0, high=10.0)]
Shift = Annotated[float, Number("rad", "0.1 deg")]


class LongTerm(Pulled, word="long-term", call="long_term", positional=("start", "stop", "step")):
    """Obliquity, precession and eccentricity from the averaged torque on a changing orbit.

    The spin axis starts at J2000.0 from the mean pole of the body, without nutation. Errors need
    the body's `pole_uncertainty`. Averaged torques of Sun and Moon (those of `precession`, with the
    published contributions that they leave out), geodesic precession, tides, and a rate of J2 that
    fades turn it about the normal of an orbit that comes as a table.

    Returns
    -------
    Dataset
        Over `epoch` (Julian years from J2000.0 TDB): `obliquity`, `longitude_of_perihelion` (from
        the moving equinox, unwrapped), `general_precession`, `psi_A`, `omega_A` (deg),
        `eccentricity`, `climatic_precession`, `coprecession`, `pole` and `ecliptic_pole` (unit
        vectors in the GCRS, over `component`), `precession_rate` (arcsec/yr) and
        `precession_period` (yr) over `perturber`; each with its error. Where the phase of
        precession is uncertain by more than 0.1 rad, for the Earth beyond a million years, errors
        are quantiles over a sample of solutions. Sections: `budget` of the error by cause,
        `matrices` from J2000.0 to mean equator and equinox of date.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line; times outside the orbit's table are refused.

    Examples
    --------
    >>> import earthspin
    >>> past = earthspin.long_term("-100 kyr", "0 kyr", "1 kyr")
    >>> print(past.sizes["epoch"], past.obliquity.isel(epoch=-1).round(3).item())
    101 23.439
    """

    views, page = "long_term", "long_term"

    exclusive = (("times",), ("span", "step"))
    many_pulls = True

    span: YearSpan = key(
        ("-1 Myr", "0 kyr"),
        doc="first and last time: durations from J2000.0 TDB, or dates; the last is included if "
        "the step meets it",
    )
    step: YearStep = key("1 kyr", doc="time between two epochs")
    times: YearList | None = key(None, doc="instead of span and step, the very times wanted")
    orbit: Annotated[str | OrbitTable, OrbitChoice()] = key(
        "own", doc="table of the orbit: the body's own, a file, or what read_orbit gives"
    )
    tides: Factor = key(1.0, doc="factor on the tides that slow Moon and spin; 0 is off")
    ellipticity: Annotated[float, Number("", "1.0", above=0.0)] = key(
        1.0, doc="factor on the dynamical ellipticity"
    )
    j2_rate: Annotated[float, Number("1/s", "-8.8e-16 1/s")] | None = key(
        None,
        doc="relative rate of J2 at J2000.0, which fades from 2 to 10 kyr on; 0 is off, and if "
        "it is not given that of the body is taken",
    )
    obliquity_shift: Shift = key(
        "0 deg", doc="what is added to the obliquity at J2000.0: the axis starts from elsewhere"
    )
    longitude_shift: Shift = key(
        "0 deg",
        doc="by what the start is turned about the normal of the orbit, in the sense of the motion",
    )
    accuracy: AngleError | None = key(None, doc="largest error of the direction of the pole")

    def check(self) -> None:
        """Of a body that the IAU does not describe, no Moon is taken for granted."""
        super().check()
        if "perturbers" not in self.given and no_iau_model(self.body):
            object.__setattr__(self, "perturbers", (SUN,))
        names = [p.name for p in self.perturbers]
        if "sun" not in names or set(names) - {"sun", "moon"}:
            raise self.error(
                "perturbers",
                names,
                "over millennia it is the Sun, or Sun and Moon; give no others",
            )
        if self.accuracy is not None and self.body.pole_uncertainty is None:
            raise self.error(
                "accuracy", f"{self.accuracy / ARCSEC:.4g} arcsec", _unknown_start(self.body)
            )


def _unknown_start(body: Body) -> str:
    """Words for a body whose pole has no uncertainty."""
    return (
        f"how far off the pole of {in_a_sentence(body.name)} is at J2000.0 is not known; give the "
        "body a pole_uncertainty"
    )


def _without_errors(result: xr.Dataset, body: Body) -> xr.Dataset:
    """Claim no error of what depends on the start if the pole of the body has no uncertainty."""
    if body.pole_uncertainty is not None:
        return result
    for name, error in result.data_vars.items():
        if "_error" in str(name) and not str(name).startswith(("eccentricity_", "ecliptic_pole_")):
            error[...] = np.nan
            error.attrs["no_error"] = f"NaN, not given: {_unknown_start(body)}"
    return result


@part
def wanted(span: YearSpan, step: float, times: YearList | None) -> FloatArray:
    """The epochs, s from J2000.0 TDB."""
    return grid(span, step, Where("step")) if times is None else times.listed


@part
def stretch(sky: Sky) -> Stretch:
    """All that the source of positions covers: the averages stand for J2000.0."""
    return Stretch(*sky.coverage())


@part
def numbers(
    mean_rates: MeanRates,
    body: Body,
    perturbers: tuple[Body, ...],
    tides: float,
    ellipticity: float,
    j2_rate: float | None,
    obliquity_shift: float,
    longitude_shift: float,
) -> SideBySide:
    """What may differ among members, laid against one another."""
    rate, error = mean_rates.total()
    as_published = 0.0 if not_sun_and_moon(body, perturbers) else body.are_as_named
    return SideBySide.of(
        **{
            name: of_one(mean_rates.rate.value, place)
            for place, name in enumerate(mean_rates.labels)
        },
        relative_error=np.hypot(error / np.abs(rate), CLOSURE * as_published),
        published=_published() * as_published,
        spin_rate=body.spin_rate,
        tides=tides,
        ellipticity=ellipticity,
        j2_rate=_relative_j2_rate(body) if j2_rate is None else j2_rate,
        obliquity_shift=obliquity_shift,
        longitude_shift=longitude_shift,
    )


@part
def strength(
    numbers: SideBySide,
    mean_torques: MeanTorques,
    body: Body,
    orbit_table: OrbitTable,
) -> Strength:
    """The constant of precession today and how it changes.

    From the rates of `precession` over the cosine of the obliquity; what is published of second
    order, planets, J4 and the inside goes with the Moon's share. What the lag of the Moon's plane
    does at J2000.0, which those rates contain, is taken out of it.
    """
    from earthspin.secular import strength as of
    from earthspin.secular.orbit import moons_height
    from earthspin.torque.quadrupole import dot

    cosine, now = math.cos(mean_torques.obliquity), orbit_table.at(np.zeros(1))
    # the rates are those on the body's own orbit, whichever is given
    own = shipped(body.name) or orbit_table
    eccentricity = float(np.linalg.norm(own.at(np.zeros(1))[1]))
    motion = 2 * math.pi / body.number("orbital_period")
    geodesic = of.geodesic_precession(SUN.gm, motion, eccentricity)
    sun, spin_rate, tides, ellipticity, j2_rate = numbers.columns(
        "sun", "spin_rate", "tides", "ellipticity", "j2_rate"
    )
    sun = sun / cosine
    if "moon" not in numbers.numbers:
        return of.Strength(sun, 0.0, eccentricity, geodesic, ellipticity, j2_rate=j2_rate)
    moon, published = numbers.columns("moon", "published")
    node_rate = 2 * math.pi / MOON.cycle
    pole = np.asarray(body.needed("pole").mean(np.zeros(1))[0])[:, np.newaxis]
    by_lag = float((moons_height(now, pole, node_rate) / dot(now[0], pole)).item())
    return of.Strength(
        sun,
        (moon + published) / (cosine * by_lag),
        eccentricity,
        geodesic,
        ellipticity,
        tides=of.Tides.of_the_earth(tides, spin_rate, 2 * math.pi / MOON.number("orbital_period")),
        j2_rate=j2_rate,
        node_rate=node_rate,
    )


def _published() -> float:
    """Rate of what the average of first order leaves out of the Earth's precession, rad/s."""
    return sum(
        float(effect.value) * ARCSEC / JULIAN_YEAR
        for name, effect in PUBLISHED_EFFECTS.items()
        if name != "geodesic"
    )


def _relative_j2_rate(body: Body) -> Numeric:
    """Rate of J2 over J2, s-1; none where the body has none."""
    j2 = body.needed("j2")
    return body.j2_rate / (j2 + (j2 == 0))


@part
def solved(
    strength: Strength,
    numbers: SideBySide,
    orbit_table: OrbitTable,
    wanted: FloatArray,
    body: Body,
) -> Solved:
    """Newton's method in time, and again with each cause changed and with windows twice as long."""
    from earthspin.secular import budget

    span = float(wanted.min()), float(wanted.max())
    orbit_table.check_times(np.array(span))
    (relative_error,) = numbers.columns("relative_error")
    setting = budget.Setting(strength, orbit_table, _start(numbers, body, orbit_table))
    uncertainty = budget.Uncertainty(
        constant=relative_error,
        start=_half_widths_of_start(body),
        orbit=orbit_table.error,
        earth=strength.node_rate < math.inf,
    )
    return budget.solved(setting, span, uncertainty)


def _half_widths_of_start(body: Body) -> tuple[float, ...]:
    """Half-widths of the start as `budget.changes` takes them, rad.

    Of the IAU's pole that of the obliquity: longitudes count from it.
    """
    half = start_error(body)
    if half is None:
        return ()
    return (half,) if body.needed("pole").of_the_iau else (half, half)


def _start(numbers: SideBySide, body: Body, orbit_table: OrbitTable) -> FloatArray:
    """Unit vectors of the axis at J2000.0, shape (3, ...)."""
    from earthspin.secular.angles import leaning

    now = np.zeros(1)
    pole = np.asarray(body.needed("pole").without_nutation().mean(now)[0])
    more, turned = (np.asarray(numbers.numbers[f"{of}_shift"]) for of in ("obliquity", "longitude"))
    leant = leaning(pole, orbit_table.at(now)[0][:, 0], more, turned)
    as_it_is = np.multiply.outer(pole, np.ones(more.shape))
    return np.where((more == 0) & (turned == 0), as_it_is, leant)


@part
def readings(solved: Solved, wanted: FloatArray, body: Body) -> Readings:
    """What is read off the axis, and off it with each cause changed."""
    from earthspin.secular import reading

    fixed = body.needed("pole").without_nutation().orbit_axes(body.orbit_pole)
    return reading.readings(solved, wanted, fixed)


# --- the answer ----------------------------------------------------------------------------------

_ANGLES = {
    "obliquity": "angle from the orbit's normal to the spin axis",
    "longitude_of_perihelion": "longitude of perihelion from the moving equinox, without jumps",
    "general_precession": "p_A, precession of the equinox along the moving orbit",
    "psi_A": "precession of the equator along the orbit of J2000.0",
    "omega_A": "inclination of the equator to the orbit of J2000.0",
}
_NUMBERS = {
    "eccentricity": "eccentricity of the orbit",
    "climatic_precession": "eccentricity times the sine of the longitude of perihelion",
    "coprecession": "eccentricity times the cosine of the longitude of perihelion",
}
_VECTOR, _BY = ("epoch", "component"), ("perturber", "epoch")
LONG_TERM = {
    **{
        variable: of
        for name, words in _ANGLES.items()
        for variable, of in with_error(name, Variable(("epoch",), "deg", words)).items()
    },
    **{
        variable: of
        for name, words in _NUMBERS.items()
        for variable, of in with_error(name, Variable(("epoch",), "1", words)).items()
    },
    "pole": Variable(_VECTOR, "1", "unit vector of the spin axis", error="pole_error"),
    "pole_error": Variable(("epoch",), "arcsec", "95 % half-width of the direction of the pole"),
    "ecliptic_pole": Variable(
        _VECTOR, "1", "unit normal of the orbit", error="ecliptic_pole_error"
    ),
    "ecliptic_pole_error": Variable(
        ("epoch",), "arcsec", "95 % half-width of the direction of the orbit's normal"
    ),
    **with_error(
        "precession_rate",
        Variable(_BY, "arcsec/yr", "rate of precession in longitude along the moving orbit"),
    ),
    **with_error("precession_period", Variable(_BY, "yr", "period of one full turn at that rate")),
}


@part(gives=LONG_TERM)
def series(
    readings: Readings,
    numbers: SideBySide,
    wanted: FloatArray,
    solved: Solved,
    orbit_table: OrbitTable,
    body: Body,
    accuracy: float | None,
) -> xr.Dataset:
    """Angles, eccentricity, poles and rates at every epoch, each with its error."""
    from earthspin.torque import rates

    mine = readings.mine
    values: dict[str, Any] = {}
    for name in (*_ANGLES, *_NUMBERS):
        values[name] = mine.values[name]
        values[f"{name}_error"] = readings.half_width(name)
    values |= {
        "pole": np.moveaxis(mine.pole, 0, -1),
        "pole_error": readings.direction_half_width("pole"),
        "ecliptic_pole": mine.normal.T,
        "ecliptic_pole_error": readings.direction_half_width("normal"),
    }
    refuse_unkept(
        accuracy,
        float(values["pole_error"].max()),
        "arcsec",
        "what is known of the body allows no more that far from J2000.0: stay nearer to it",
    )
    with_moon = solved.setting.strength.node_rate < math.inf
    labels = ["sun", "moon", "total"] if with_moon else ["sun", "total"]
    rate = np.stack([mine.values[label] for label in labels], axis=-2)
    error = np.stack([readings.half_width(label) for label in labels], axis=-2)
    values |= {
        "precession_rate": rate,
        "precession_rate_error": error,
        "precession_period": rates.period(rate),
        "precession_period_error": rates.period_error(rate, error),
    }
    years = wanted / JULIAN_YEAR
    told = {"units": "yr", "long_name": "Julian years from J2000.0 (TDB)"}
    result = build(
        LONG_TERM,
        {name: numbers.lay(of, *LONG_TERM[name].dims) for name, of in values.items()},
        coords={
            "epoch": ("epoch", years, told),
            "component": ["x", "y", "z"],
            "perturber": labels,
        },
        frame="GCRS",
    )
    result["obliquity"].attrs |= {"orbit": orbit_table.source, "orbit_of": orbit_table.name}
    result["pole_error"].attrs |= {
        "method": f"Newton's method in time, {solved.path.windows.order} nodes in each window of "
        f"{np.median(np.diff(solved.path.windows.edges)) / JULIAN_YEAR:.0f} yr",
        "evaluations": solved.steps,
    }
    return _without_errors(result, body)


class PoleAccuracy(Report, units="arcsec", error_of="in direction"):
    """Accuracy of the pole: asked, estimated, and the method."""


@part(unless=no_accuracy)
def long_term_accuracy(series: xr.Dataset, accuracy: float | None) -> PoleAccuracy:
    """Accuracy of the pole: asked, estimated, and the method."""
    return PoleAccuracy.of_series(accuracy, series.pole_error)


# --- sections ------------------------------------------------------------------------------------

_SHARE = ("cause", "epoch")
#: What shares mean where errors are quantiles over a sample.
_ONE_AT_A_TIME = (
    "of solutions with one cause changed at a time; where the phase error exceeds 0.1 rad, errors "
    "are quantiles over solutions with all causes changed, and shares do not add up to them"
)
BUDGET = without_error(
    "a share of an error",
    {
        "obliquity_share": Variable(_SHARE, "arcsec", "share of the error of the obliquity"),
        "longitude_share": Variable(
            _SHARE, "deg", "share of the error of the longitude of perihelion"
        ),
        "pole_share": Variable(_SHARE, "arcsec", "share of the error of the pole's direction"),
    },
)


@part(gives=BUDGET)
def budget(readings: Readings, numbers: SideBySide, series: xr.Dataset) -> xr.Dataset:
    """Error of obliquity, perihelion and pole by cause."""
    shares = {
        "obliquity_share": readings.apart("obliquity"),
        "longitude_share": readings.apart("longitude_of_perihelion"),
        "pole_share": readings.poles_apart("pole"),
    }
    found = build(
        BUDGET,
        {
            name: numbers.lay(np.stack(np.broadcast_arrays(*by_cause.values()), axis=-2), *_SHARE)
            for name, by_cause in shares.items()
        },
        coords={"cause": list(shares["pole_share"]), "epoch": series.epoch},
    )
    return found.assign_attrs(comment=_ONE_AT_A_TIME)


MATRICES = covered_by(
    "matrix_error",
    {
        "matrix": Variable(
            ("epoch", "axis", "component"),
            "1",
            "precession matrix from the GCRS to mean equator and equinox of date",
        ),
        "matrix_error": Variable(
            ("epoch",), "arcsec", "95 % half-width of the direction of its third row, the pole"
        ),
    },
)


@part(gives=MATRICES)
def matrices(readings: Readings, numbers: SideBySide, series: xr.Dataset, body: Body) -> xr.Dataset:
    """Precession matrices to mean equator and equinox of date."""
    from earthspin.secular.angles import equator_and_equinox

    mine, lay = readings.mine, numbers.lay
    matrix = equator_and_equinox(mine.pole, mine.normal)
    result = build(
        MATRICES,
        {
            "matrix": lay(matrix, *MATRICES["matrix"].dims),
            "matrix_error": lay(readings.direction_half_width("pole"), "epoch"),
        },
        coords={
            "epoch": series.epoch,
            "axis": ["equinox", "90 deg east", "pole"],
            "component": ["x", "y", "z"],
        },
    )
    return _without_errors(result, body)


@part
def neglected() -> Neglected:
    """What neither equation nor orbit holds, and no half-width stands for."""
    return Neglected(
        what="friction between core and mantle, ice ages in the figure: not measured; asteroids "
        "and the Sun's flattening in the orbit: in the errors of a shipped orbit, not in those of "
        "one that is given; past some fifty million years the orbit is chaotic"
    )


made_of(
    LongTerm,
    answer=(series, long_term_accuracy),
    sections={"budget": budget, "matrices": matrices, "neglected": neglected},
    parts=(
        places, sky, stretch, wanted, *MEANS, orbit_table,
        numbers, strength, solved, readings,
    ),
    without=("chosen_average",),
    together=(
        *("body", "perturbers", "tides", "ellipticity", "j2_rate"),
        *("obliquity_shift", "longitude_shift"),
    ),
    widest=64,
)  # fmt: skip

long_term = ask(LongTerm)
