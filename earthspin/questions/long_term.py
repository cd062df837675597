"""Obliquity, precession and eccentricity over millennia to millions of years."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import MOON, SUN, Body
from earthspin.choosing.promises import promise, refuse_unkept, report
from earthspin.constants import ARCSEC, JULIAN_YEAR, PUBLISHED_EFFECTS, SPEED_OF_LIGHT
from earthspin.engine.asking import ask
from earthspin.engine.labels import Variable, build, covered_by, with_error, without_error
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import key, made_of
from earthspin.errors import UndefinedError, Where
from earthspin.parts.averages import MeanRates, Samples, mean_rates, torque_samples
from earthspin.parts.orbits import OrbitChoice, orbit_table
from earthspin.parts.reasons import no_accuracy, no_iau_model, not_the_iaus_earth
from earthspin.parts.sky import Pulled, Sky, Stretch, places, sky
from earthspin.sky.orbit_table import OrbitTable
from earthspin.units import AngleError, Number
from earthspin.years import YearList, YearSpan, YearStep, grid

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.choosing.averages import Averaging
    from earthspin.choosing.choice import Choice
    from earthspin.secular.budget import Setting
    from earthspin.secular.orbit import Orbit
    from earthspin.secular.strength import Strength
    from earthspin.secular.trajectory import Trajectory

FloatArray = NDArray[np.float64]
Factor = Annotated[float, Number("", "1.0", low=-10.0, high=10.0)]

#: Sine of the obliquity below which there is no equinox.
UPRIGHT = 1e-9


class LongTerm(Pulled, word="long-term", call="long_term", positional=("start", "stop", "step")):
    """Obliquity, precession and eccentricity from the averaged torque on a changing orbit.

    The spin axis starts at J2000.0 from the mean pole of the body. Averaged torques of Sun and Moon
    (those of `precession`, with the published contributions that they leave out), geodesic
    precession, tides, and a rate of J2 that fades turn it about the normal of an orbit that comes
    as a table.

    Returns
    -------
    Dataset
        Over `epoch` (Julian years from J2000.0 TDB): `obliquity`, `longitude_of_perihelion` (from
        the moving equinox, unwrapped), `general_precession`, `psi_A`, `omega_A` (deg),
        `eccentricity`, `climatic_precession`, `coprecession`, `pole` and `ecliptic_pole` (unit
        vectors in the GCRS,
        over `component`), `precession_rate` (arcsec/yr) and `precession_period` (yr) over
        `perturber`; each with its error. Sections: `budget` of the error by cause, `matrices` from
        J2000.0 to mean equator and equinox of date.

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

    exclusive = (("times",), ("span", "step"))

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
    accuracy: AngleError | None = key(None, doc="largest error of the direction of the pole")

    def check(self) -> None:
        """Of a body that the IAU does not describe, no Moon is taken for granted."""
        if "perturbers" not in self.given and no_iau_model(self.body):
            object.__setattr__(self, "perturbers", (SUN,))
        super().check()
        names = [p.name for p in self.perturbers]
        if "sun" not in names or set(names) - {"sun", "moon"}:
            raise self.error(
                "perturbers",
                names,
                "over millennia it is the Sun, or Sun and Moon; give no others",
            )
        if self.body.labelled:
            raise self.error("body", self.body.name, "give single numbers here, no labelled arrays")


@part
def wanted(span: YearSpan, step: float, times: YearList | None) -> FloatArray:
    """The epochs, s from J2000.0 TDB."""
    return grid(span, step, Where("step")) if times is None else times.listed


@part
def stretch(sky: Sky) -> Stretch:
    """All that the source of positions covers: the averages stand for J2000.0."""
    return Stretch(*sky.coverage())


@part
def chosen_average() -> Choice[Averaging] | None:
    """Averages as fine as `precession` takes them by itself."""
    return None


@part
def strength(
    mean_rates: MeanRates,
    torque_samples: Samples,
    body: Body,
    perturbers: tuple[Body, ...],
    orbit_table: OrbitTable,
    tides: float,
    ellipticity: float,
    j2_rate: float | None,
) -> Strength:
    """The constant of precession today and how it changes.

    From the rates of `precession` over the cosine of the obliquity; what is published of second
    order, planets, J4 and the inside goes with the Moon's share.
    """
    from earthspin.secular import strength as of

    cosine = math.cos(torque_samples.obliquity)
    rates = dict(zip(torque_samples.labels, mean_rates.rate.value.values.tolist(), strict=True))
    as_published = not_the_iaus_earth(body, perturbers) is None
    more = sum(
        float(effect.value) * ARCSEC / JULIAN_YEAR
        for name, effect in PUBLISHED_EFFECTS.items()
        if name != "geodesic" and as_published
    )
    eccentricity = float(np.linalg.norm(orbit_table.at(np.zeros(1))[1]))
    motion = 2 * math.pi / body.number("orbital_period")
    a = (SUN.gm / motion**2) ** (1 / 3)
    with_moon = "moon" in rates
    moon_motion = 2 * math.pi / MOON.number("orbital_period")
    return of.Strength(
        sun=rates["sun"] / cosine,
        moon=(rates["moon"] + more) / cosine if with_moon else 0.0,
        eccentricity=eccentricity,
        geodesic=1.5 * SUN.gm * motion / (SPEED_OF_LIGHT.value**2 * a * (1 - eccentricity**2)),
        ellipticity=ellipticity,
        tides=of.Tides.of_the_earth(tides, body.spin_rate, moon_motion)
        if with_moon
        else of.Tides(),
        j2_rate=_relative_j2_rate(body) if j2_rate is None else j2_rate,
        node_rate=2 * math.pi / MOON.cycle if with_moon else math.inf,
    )


def _relative_j2_rate(body: Body) -> float:
    """Rate of J2 over J2, s-1; none where the body has none."""
    return float(body.j2_rate / body.j2) if body.j2 else 0.0


@dataclass(frozen=True)
class Solved:
    """The axis in time, and how far it may be off by each cause.

    Attributes
    ----------
    path : Trajectory
    others : dict of str to tuple
        By cause: the trajectory with that cause changed, and the setting it belongs to.
    setting : Setting
    steps : int
        Newton steps of all.
    """

    path: Trajectory
    others: dict[str, tuple[Trajectory, Setting]]
    setting: Setting
    steps: int


@part
def solved(
    strength: Strength,
    orbit_table: OrbitTable,
    wanted: FloatArray,
    body: Body,
    mean_rates: MeanRates,
) -> Solved:
    """Newton's method in time, and again with each cause changed and with windows half as long."""
    from earthspin.secular.budget import Setting, changes
    from earthspin.secular.trajectory import solve

    start = np.asarray(body.needed("pole").mean(np.zeros(1))[0])
    span = float(wanted.min()), float(wanted.max())
    orbit_table.check_times(np.array(span))
    setting = Setting(strength, orbit_table, start)
    rate, error = mean_rates.total()
    others = changes(
        setting,
        constant=float(error / abs(rate)),
        earth=strength.node_rate < math.inf,
        error=orbit_table.error,
    )
    path = solve(strength, orbit_table, start, span, pieces=2)
    made = {"method": (solve(strength, orbit_table, start, span), setting)} | {
        name: (solve(other.strength, other.orbit, other.start, span), other)
        for name, other in others.items()
    }
    steps = path.steps + sum(other.steps for other, _ in made.values())
    return Solved(path, made, setting, steps)


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


@dataclass(frozen=True)
class Read:
    """What is read off a trajectory, SI: by name, along `epoch`."""

    values: dict[str, FloatArray]
    pole: FloatArray
    normal: FloatArray


def read_off(
    path: Trajectory, setting: Setting, times: FloatArray, fixed: FloatArray, orbits: FloatArray
) -> Read:
    """Angles, precession and rates at some times.

    Parameters
    ----------
    path : Trajectory
    setting : Setting
        That it was solved with.
    times : ndarray, shape (n,)
        s.
    fixed : ndarray, shape (3, 3)
        Orbit and equinox of J2000.0 in the GCRS.
    orbits : ndarray, shape (n + 1,)
        Longitude of perihelion in those axes at the times and at J2000.0, rad, without jumps.
    """
    from earthspin.secular.angles import seasons, unwrapped

    # at the nodes, which are close enough to follow precession from one to the next
    nodes = np.sort(np.append(path.windows.times.ravel(), 0.0))
    followed = np.unwrap(_turns(path, setting, nodes, fixed)[1:], axis=1)
    origin, turn = int(np.searchsorted(nodes, 0.0)), 2 * np.pi
    followed -= turn * np.rint(followed[:, origin : origin + 1] / turn)
    nearest = np.searchsorted((nodes[1:] + nodes[:-1]) / 2, times)
    perihelion, general, psi = _turns(path, setting, np.append(times, 0.0), fixed)
    general, psi = (
        unwrapped(angle[:-1], coarse, nearest)
        for angle, coarse in zip((general, psi), followed, strict=True)
    )
    # perihelion from the moving equinox is that of the orbit and precession, but for its tilt
    about = orbits + np.append(general, 0.0)
    perihelion = unwrapped(perihelion, about, np.arange(about.size))
    perihelion = perihelion[:-1] - turn * np.floor(perihelion[-1] / turn)
    axis = path.at(times)
    normal, eccentricity, _ = setting.orbit.at(times)
    of = seasons(axis, normal, eccentricity)
    e2 = of.eccentricity**2
    height = np.sum(axis * normal, axis=0)
    strength = setting.strength
    sun = replace(strength, moon=0.0).constant(times, e2) * height
    both = strength.constant(times, e2) * height
    return Read(
        {
            "obliquity": of.obliquity,
            "longitude_of_perihelion": perihelion,
            "general_precession": general,
            "psi_A": psi,
            "omega_A": np.arccos(np.clip(fixed[2] @ axis, -1.0, 1.0)),
            "eccentricity": of.eccentricity,
            "climatic_precession": of.climatic_precession,
            "coprecession": of.coprecession,
            "sun": sun,
            "moon": both - sun,
            "total": both - strength.geodesic_rate(e2),
        },
        axis,
        normal,
    )


#: Time between two looks at a perihelion, s: it turns fast where an orbit is all but round, by 1.2
#: rad in 200 years where the Earth's eccentricity is 1.6e-4.
LOOK = 200 * JULIAN_YEAR


def followed_perihelion(orbit: Orbit, times: FloatArray, fixed: FloatArray) -> FloatArray:
    """Longitude of perihelion in fixed axes without jumps, rad, of the orbit alone."""
    from earthspin.secular.angles import unwrapped

    first, last = np.floor(min(times.min(), 0.0) / LOOK), np.ceil(max(times.max(), 0.0) / LOOK)
    looks = np.clip(LOOK * np.arange(first, last + 1), *orbit.coverage)
    angle, coarse = (np.arctan2(*(fixed[:2] @ orbit.at(at)[1])[::-1]) for at in (times, looks))
    nearest = np.rint(times / LOOK - first).astype(int)
    return unwrapped(angle, np.unwrap(coarse), nearest)


def _turns(path: Trajectory, setting: Setting, times: FloatArray, fixed: FloatArray) -> FloatArray:
    """Longitude of perihelion, p_A and psi_A in any turn, rad, shape (3, n)."""
    from earthspin.nutation.angles import on_fixed_ecliptic, precession_angles
    from earthspin.secular.angles import seasons

    axis = path.at(times)
    normal, eccentricity, _ = setting.orbit.at(times)
    of = seasons(axis, normal, eccentricity)
    psi, omega = on_fixed_ecliptic(axis.T, fixed).T
    general = precession_angles(psi, omega, (fixed @ normal).T)[:, 4]
    return np.stack([np.arctan2(of.climatic_precession, of.coprecession), general, psi])


@part
def readings(solved: Solved, wanted: FloatArray, body: Body) -> dict[str, Read]:
    """What is read off each trajectory, the answer's under the name of nothing."""
    fixed = body.needed("pole").orbit_axes(body.orbit_pole)
    times, own = np.append(wanted, 0.0), solved.setting.orbit
    followed = followed_perihelion(own, times, fixed)
    found = {"": read_off(solved.path, solved.setting, wanted, fixed, followed)}
    _refuse_upright(found[""].values["obliquity"], wanted)
    for name, (path, setting) in solved.others.items():
        same = setting.orbit is own
        orbits = followed if same else followed_perihelion(setting.orbit, times, fixed)
        found[name] = read_off(path, setting, wanted, fixed, orbits)
        _on_the_same_side(found[name].values, found[""].values)
    return found


def _on_the_same_side(moved: dict[str, FloatArray], mine: dict[str, FloatArray]) -> None:
    """Bring a longitude of perihelion into the turn of the answer's.

    Where the orbit is all but a circle, one that is a little other goes round the other side of
    it: from then on it would be a turn off, in an orbit that is hardly another.
    """
    own, true = (of["longitude_of_perihelion"] - of["general_precession"] for of in (moved, mine))
    moved["longitude_of_perihelion"] += 2 * np.pi * np.rint((true - own) / (2 * np.pi))


def _refuse_upright(obliquity: FloatArray, times: FloatArray) -> None:
    """Without an equinox there is no longitude."""
    worst = int(np.argmin(np.sin(obliquity)))
    if not np.sin(obliquity[worst]) > UPRIGHT:
        raise UndefinedError(
            f"the axis stands upright on the orbit {times[worst] / JULIAN_YEAR:.0f} yr from "
            "J2000.0: there is no equinox to count from"
        )


def apart(readings: dict[str, Read], name: str) -> dict[str, FloatArray]:
    """By cause, how far a quantity of the answer is moved."""
    mine = readings[""].values
    moved = {cause: of.values[name] - mine[name] for cause, of in readings.items() if cause}
    if name == "longitude_of_perihelion":
        for cause in moved:
            # an orbit that is all but round may pass on the other side of a circle: of how far its
            # perihelion itself is moved, whole turns say nothing
            by_axis = readings[cause].values["general_precession"] - mine["general_precession"]
            by_orbit = moved[cause] - by_axis
            moved[cause] = by_axis + by_orbit - 2 * np.pi * np.rint(by_orbit / (2 * np.pi))
    return {cause: np.abs(by) for cause, by in moved.items()}


def poles_apart(readings: dict[str, Read], which: str) -> dict[str, FloatArray]:
    """By cause, how far pole or normal of the orbit is moved, rad."""
    mine = getattr(readings[""], which)
    return {
        cause: np.linalg.norm(getattr(of, which) - mine, axis=0)
        for cause, of in readings.items()
        if cause
    }


def together(shares: dict[str, FloatArray]) -> FloatArray:
    """Root of the sum of squares."""
    return np.sqrt(sum(share**2 for share in shares.values()))


@part(gives=LONG_TERM)
def series(
    readings: dict[str, Read],
    wanted: FloatArray,
    solved: Solved,
    orbit_table: OrbitTable,
    accuracy: float | None,
) -> xr.Dataset:
    """Angles, eccentricity, poles and rates at every epoch, each with its error."""
    from earthspin.torque import rates

    mine = readings[""]
    values: dict[str, Any] = {}
    for name in (*_ANGLES, *_NUMBERS):
        values[name] = mine.values[name]
        values[f"{name}_error"] = together(apart(readings, name))
    for name, which in (("pole", "pole"), ("ecliptic_pole", "normal")):
        values[name] = getattr(mine, which).T
        values[f"{name}_error"] = together(poles_apart(readings, which))
    refuse_unkept(
        accuracy,
        float(values["pole_error"].max()),
        "arcsec",
        "what is known of the body allows no more that far from J2000.0: stay nearer to it",
    )
    with_moon = solved.setting.strength.node_rate < math.inf
    labels = ["sun", "moon", "total"] if with_moon else ["sun", "total"]
    rate = np.stack([mine.values[label] for label in labels])
    error = np.stack([together(apart(readings, label)) for label in labels])
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
        values,
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
    return result


PROMISE = promise("arcsec", "in direction")


@part(gives=PROMISE, unless=no_accuracy)
def long_term_accuracy(series: xr.Dataset, accuracy: float | None) -> xr.Dataset:
    """Accuracy of the pole: asked, estimated, and the method."""
    error = series.pole_error
    worst = float(error.max()) * ARCSEC
    return report(PROMISE, accuracy, worst, error.attrs["method"], error.attrs["evaluations"])


# --- sections ------------------------------------------------------------------------------------

_SHARE = ("cause", "epoch")
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
def budget(readings: dict[str, Read], series: xr.Dataset) -> xr.Dataset:
    """Error of obliquity, perihelion and pole by cause."""
    causes = [cause for cause in readings if cause]
    shares = {
        "obliquity_share": apart(readings, "obliquity"),
        "longitude_share": apart(readings, "longitude_of_perihelion"),
        "pole_share": poles_apart(readings, "pole"),
    }
    return build(
        BUDGET,
        {name: np.stack([of[cause] for cause in causes]) for name, of in shares.items()},
        coords={"cause": causes, "epoch": series.epoch},
    )


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
def matrices(readings: dict[str, Read], series: xr.Dataset) -> xr.Dataset:
    """Precession matrices to mean equator and equinox of date."""
    from earthspin.secular.angles import equator_and_equinox

    mine = readings[""]
    return build(
        MATRICES,
        {
            "matrix": equator_and_equinox(mine.pole, mine.normal),
            "matrix_error": together(poles_apart(readings, "pole")),
        },
        coords={
            "epoch": series.epoch,
            "axis": ["equinox", "90 deg east", "pole"],
            "component": ["x", "y", "z"],
        },
    )


@part
def neglected() -> Neglected:
    """What neither equation nor orbit holds, and no half-width stands for."""
    return Neglected(
        what="asteroids and the Sun's flattening in the orbit, friction between core and mantle, "
        "ice ages in the figure: not measured; past some million years the orbit is chaotic"
    )


made_of(
    LongTerm,
    answer=(series, long_term_accuracy),
    sections={"budget": budget, "matrices": matrices, "neglected": neglected},
    parts=(
        places, sky, stretch, wanted, chosen_average, torque_samples, mean_rates, orbit_table,
        strength, solved, readings,
    ),
)  # fmt: skip

long_term = ask(LongTerm)
