"""Rate and period of precession, and derived quantities such as the tropical year."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import Body, all_of, in_a_sentence, label_of, planets
from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.dates import Span, datetime64
from earthspin.engine import Neglected, key, part, public_call
from earthspin.engine.variables import Variables, labels, labels_of, measured, number, words
from earthspin.mass import figure
from earthspin.numerics.arrays import FloatArray, Numeric
from earthspin.nutation import rate_budget
from earthspin.questions import reasons, satellites
from earthspin.questions.averages import MEANS, MeanRates, MeanTorques, Samples
from earthspin.questions.sky import SOURCE_DOC, Interval, PerturbedBody, Sky, interval, places, sky
from earthspin.rotor.axisymmetric import free_wobble_error, free_wobble_period
from earthspin.sky import iau_models, sources
from earthspin.torque import average, rates

#: Points of a curve of convergence.
CURVE_POINTS = 81
MODELS = ("maccullagh", "homogeneous", "measured")


class Precession(PerturbedBody, word="precession", call="precession"):
    """Rate and period of precession, from torques averaged over orbits (source text, I.8).

    A body with satellites precesses together with them, each in its Laplace plane; the rate is then
    the mean over the nodes of the satellites.

    Examples
    --------
    >>> import earthspin
    >>> result = earthspin.precession()
    >>> print(result.precession_period.round().values)
    [81259. 37614. 25712.]
    """

    page, headline = "precession", "precession_rate"
    with_satellites = True
    averages = True

    source: sources.SourceName = key("skyfield", doc=SOURCE_DOC)
    span: Span | None = key(
        None, doc="first and last date of the average; all that the kernel covers if not given"
    )

    array_masses = array_orbits = True


# --- the answer ----------------------------------------------------------------------------------


_OVER_WINDOW = "time: mean (weighted by the taper)"


class Rates(Variables, along=("perturber",)):
    """Precession rate, precession period and mean torque of each perturber."""

    precession_rate = measured(
        "arcsec/yr",
        "rate of precession in longitude along the fixed orbit",
        split=True,
        short="rate",
        cell_methods=_OVER_WINDOW,
    )
    precession_period = measured("yr", "period of one full turn of precession", short="period")
    rate_ratio = number(
        "1",
        "ratio of the rate to that of the first perturber",
        no_error="a ratio of two rates that each carry their own error",
    )
    mean_torque = measured("N m", "magnitude of the mean torque vector", cell_methods=_OVER_WINDOW)
    obliquity = number(
        "deg",
        "angle between spin axis and orbit normal at the epoch",
        along=(),
        no_error="an angle between a pole and a plane that are given",
    )
    reference_epoch = words("epoch that the averages refer to (TDB)", along=())
    perturber = labels()


@part
def precession_rates(mean_rates: MeanRates, mean_torques: MeanTorques, body: Body) -> Rates:
    """Compute precession rate, precession period and mean torque of each perturber, with errors."""
    rate, means = mean_rates.rate, mean_torques
    plane = f"orbit whose normal has {body.orbit_pole} (ICRF)"
    if body.needed("pole").of_the_iau:
        plane = "ecliptic of J2000.0"
    return Rates(
        precession_rate=rate,
        precession_period=(rates.period(rate.value), rates.period_error(rate.value, rate.error)),
        rate_ratio=mean_rates.ratio,
        mean_torque=mean_rates.torque,
        obliquity=means.obliquity,
        reference_epoch=datetime64(np.array(means.epoch / DAY)),
        perturber=means.labels,
    ).with_attributes(
        no_error=means.no_error,
        obliquity=reasons.north_note(body, means.obliquity),
        precession_rate={
            "window": means.over,
            "pole": satellites.describe_pole(body),
            "plane": plane,
        },
        precession_rate_error={"method": means.method, "evaluations": means.evaluations},
    )


# --- sections ------------------------------------------------------------------------------------


class Convergence(Variables, no_error="the curve itself shows the error of each window"):
    """Precession rate for averaging windows of different lengths, to show the convergence."""

    rate_by_window = number(
        "arcsec/yr", "rate of precession by all perturbers", along=("window", "window_cycles")
    )
    window_length = number(
        "yr", "length of the averaging window", along=("window_cycles",), no_error="it is chosen"
    )
    window = labels()
    window_cycles = labels("length of the averaging window in cycles")


@part(unless=reasons.mass_is_array)
def convergence(torque_samples: Samples, mean_rates: MeanRates, body: Body) -> Convergence:
    """Compute the precession rate for averaging windows of different lengths and tapers."""
    window = torque_samples.window
    cycles = np.linspace(1.0, window.cycles, CURVE_POINTS)
    total = torque_samples.precessing.sum(axis=1)
    curves = average.convergence_curve(window, torque_samples.times, total, cycles)
    precessing = xr.DataArray(np.stack(list(curves.values())), dims=("window", "window_cycles"))
    h = body.needed("dynamical_flattening") * mean_rates.satellite_factors.rate
    return Convergence(
        rate_by_window=rates.precession_rate(precessing, h, body.spin_rate),
        window_length=cycles * window.cycle,
        window=list(curves),
        window_cycles=cycles,
    )


def no_figure(body: Body) -> str | None:
    """Return the reason (text) to omit figure models if body data are unsuitable, else None."""
    missing = [k for k in ("j2", "flattening", "radius") if getattr(body, k) is None]
    if missing:
        return f"{in_a_sentence(body.name)} has no {missing[0]}"
    if not all_of(np.abs(body.needed("flattening")) < 1):
        return "MacCullagh's formula needs a flattening between -1 and 1"
    if not all_of(body.needed("dynamical_flattening") != 0):
        return "with H = 0 the polar moment does not follow from J2"
    return None


class FigureModels(
    Variables,
    along=("earth_model",),
    no_error="a model of the figure, for comparison with the others",
):
    """Dynamical flattening, precession period and wobble period, for three figure models."""

    h_by_model = number("1", "dynamical flattening (C - A)/C", short="H = (C-A)/C")
    period_by_model = number("yr", "period of one full turn of precession", short="precession")
    wobble_by_model = number("d", "period of the rigid free wobble", short="wobble")
    moment_difference = measured("kg m2", "C - A from J2", along=())
    polar_moment_factor = measured("1", "C/(M a2) from J2 and H", along=())
    j2_from_moment_difference = measured("1", "J2 computed back from C - A", along=())


@part(unless=(no_figure, reasons.mass_is_array, reasons.orbit_is_array))
def figure_models(mean_torques: MeanTorques, mean_rates: MeanRates, body: Body) -> FigureModels:
    """Compute H from three models of the figure, and the precession and free wobble for each H."""
    j2, measured_h = body.needed("j2"), body.needed("dynamical_flattening")
    by_maccullagh = figure.h_maccullagh(body.needed("flattening"))
    models = (by_maccullagh, figure.h_homogeneous(j2), measured_h)
    h = xr.concat(map(xr.DataArray, models), dim=labels_of("earth_model", list(MODELS)))
    precessing, radius = mean_torques.precessing[-1], body.needed("radius")
    difference, e = figure.moment_difference(j2, body.mass, radius), figure.ellipticity_from_h(h)
    rate = rates.precession_rate(precessing, h * mean_rates.satellite_factors.rate, body.spin_rate)
    u_j2, u_h = (body.relative_uncertainty.get(n, 0.0) for n in ("j2", "dynamical_flattening"))
    factor = figure.polar_moment_factor(j2, measured_h)
    back = figure.j2_from_moment_difference(difference, body.mass, radius)
    difference_error = rates.half_width(difference, body.relative_uncertainty_of_bulge())
    return FigureModels(
        h_by_model=h,
        period_by_model=rates.period(rate),
        wobble_by_model=free_wobble_period(e, body.needed("spin_period")),
        moment_difference=(difference, difference_error),
        polar_moment_factor=(factor, rates.half_width(factor, u_j2, u_h)),
        j2_from_moment_difference=(back, rates.half_width(back, u_j2)),
    )


def is_sphere(body: Body) -> str | None:
    """Return the reason (text) to omit the free wobble if the body is a sphere, else None."""
    oblate = all_of(body.needed("dynamical_flattening") != 0)
    return None if oblate else "a sphere does not wobble"


class RigidFreeWobble(Variables):
    """Period of the free wobble of the body, computed as if the body were rigid."""

    free_wobble_period = measured("d", "period of the rigid free wobble, A/(C - A)")
    free_wobble_period_sidereal = measured(
        "1", "period of the rigid free wobble in turns of the body, its sidereal days"
    )


@part(unless=is_sphere)
def free_wobble(body: Body) -> RigidFreeWobble:
    """Compute the period of the free wobble of the body, as if the body were rigid."""
    h = body.needed("dynamical_flattening")
    turns = free_wobble_period(figure.ellipticity_from_h(h), 1.0)
    period = free_wobble_period(figure.ellipticity_from_h(h), body.needed("spin_period"))
    u = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    return RigidFreeWobble(
        free_wobble_period=(period, free_wobble_error(period, h, u)),
        free_wobble_period_sidereal=(turns, free_wobble_error(turns, h, u)),
    )


class SeasonsAndCalendar(Variables):
    """Motion of the equinox, tropical year, and drift of the calendar relative to the seasons."""

    general_precession = measured(
        "arcsec/yr",
        "general precession in longitude: motion of the equinox along the moving ecliptic",
    )
    general_precession_period = measured(
        "yr", "period of one full turn of the equinox", short="period"
    )
    time_per_degree = measured("yr", "time in which the equinox moves by one degree")
    tropical_year = measured("d", "tropical year, the period of the seasons")
    time_per_day_of_drift = measured(
        "yr", "time in which years of 365.25 d drift by a day against the seasons"
    )
    time_per_dropped_leap_day = number(
        "yr", "time in which the Gregorian calendar drops one leap day, 400/3", no_error="a rule"
    )
    time_per_day_of_gregorian_drift = measured(
        "yr", "time in which Gregorian years drift by a day against the seasons"
    )


@part(unless=reasons.not_sun_and_moon)
def seasons(
    mean_rates: MeanRates, mean_torques: MeanTorques, body: Body, perturbers: tuple[Body, ...]
) -> SeasonsAndCalendar:
    """Compute the motion of the equinox, the tropical year, and the drift of the calendar.

    For the Earth as it is, the published effects that the rate leaves out are included.
    """
    rate, error = mean_rates.total()
    another = reasons.not_the_iaus_earth(body, perturbers)
    published = 0.0 if another else sum(rate_budget.published_effects().values())
    effects = "torques of Sun and Moon, and the published effects that their mean leaves out"
    if another:
        effects = f"torques of Sun and Moon alone; no published effects apply: {another}"
    chi_rate = iau_models.precession_rates(mean_torques.epoch / DAY).chi_a
    general = rate_budget.general_precession(rate + published, chi_rate, mean_torques.obliquity)
    year = rate_budget.tropical_year(general, body.number("orbital_period"))
    period = rates.period(general), rates.period_error(general, error)
    u_year = body.relative_uncertainty.get("orbital_period", 0.0)
    year_error = np.hypot(year**2 / (2 * np.pi) * error, rates.half_width(year, u_year))

    def drift(calendar: float) -> tuple[Numeric, Numeric]:
        """Time in which a calendar drifts by a day against the seasons, and its half-width, s."""
        time = rate_budget.time_per_day_of_drift(year, calendar)
        return time, np.abs(time / (calendar - year)) * year_error

    return SeasonsAndCalendar(
        general_precession=(general, error),
        general_precession_period=period,
        time_per_degree=(rate_budget.time_per_degree(general), period[1] / 360),
        tropical_year=(year, year_error),
        time_per_day_of_drift=drift(JULIAN_YEAR),
        time_per_dropped_leap_day=rate_budget.DROPPED_LEAP_DAY * JULIAN_YEAR,
        time_per_day_of_gregorian_drift=drift(rate_budget.GREGORIAN_YEAR),
    ).with_attributes(no_error=mean_torques.no_error, general_precession={"effects": effects})


class RateDifference(Variables):
    """Computed precession rate minus that of IAU 2006, and the part that remains unexplained."""

    iau_rate = number(
        "arcsec/yr",
        "rate of psi_A in IAU 2006 at the same epoch",
        no_error="a model that was adopted, exact by definition",
    )
    difference_from_iau = measured("arcsec/yr", "computed rate minus the IAU's")
    closure = measured("arcsec/yr", "difference that remains after all published contributions")
    period_from_prem = number(
        "yr",
        "precession period with all known effects, if C is that of PREM instead of J2/H",
        no_error="the difference from the period with the observed H measures it",
    )


@part(unless=reasons.not_the_iaus_earth)
def iau_2006(mean_rates: MeanRates, mean_torques: MeanTorques, body: Body) -> RateDifference:
    """Compute precession rate minus IAU 2006 rate, before and after adding published effects.

    The observed H comes from the observed precession. So does the moment of inertia among the data
    of PREM: the period with C of PREM tests that the model kept the moment that it was given.
    """
    rate, error = mean_rates.total()
    iau_rate = iau_models.precession_rates(mean_torques.epoch / DAY).psi_a
    unexplained = rate_budget.closure(rate, iau_rate)
    h, j2, radius = (body.needed(name) for name in ("dynamical_flattening", "j2", "radius"))
    h_of_prem = j2 / rate_budget.prem_polar_moment(radius, j2)
    return RateDifference(
        iau_rate=iau_rate,
        difference_from_iau=(rate - iau_rate, error),
        closure=(unexplained, error),
        period_from_prem=rates.period(iau_rate + unexplained) * h / h_of_prem,
    ).with_attributes(no_error=mean_torques.no_error)


class Standstills(Variables, along=("standstill",)):
    """Dates of lunar standstills, with the extreme declinations of the Moon."""

    standstill_kind = words("major or minor", short="kind")
    standstill_declination = measured(
        "deg", "extreme declination, mean equator of date", short="extreme declination"
    )
    standstill = labels("day of the extreme declination (TDB)")


@part(unless=(reasons.no_moon, reasons.orbit_is_array))
def standstills(
    sky: Sky, interval: Interval, body: Body, perturbers: tuple[Body, ...]
) -> Standstills:
    """Find major and minor lunar standstills, with dates and extreme declinations."""
    moon = {"moon": sky.targets[str(label_of("moon", perturbers))]}

    def declination(days: FloatArray) -> FloatArray:
        return sky.radec(body, days, moon)["moon"][1]

    extremes = iau_models.find_standstills(declination, interval.first, interval.last)
    errors = [sky.error(moon["moon"], (extreme.day,))[0] for extreme in extremes]
    return Standstills(
        standstill_kind=np.array([extreme.kind for extreme in extremes], dtype=str),
        standstill_declination=(
            np.array([extreme.declination for extreme in extremes], dtype=float),
            np.array(errors, dtype=float),
        ),
        standstill=datetime64(np.array([extreme.day for extreme in extremes], dtype=float)),
    ).with_attributes(no_error=sky.no_error)


@part
def neglected(body: Body, perturbers: tuple[Body, ...], mean_rates: MeanRates) -> Neglected:
    """Contributions to the precession rate by effects that are not modelled."""
    unknown = reasons.not_the_iaus_earth(body, perturbers)
    published = planets.LEFT_OUT_OF_RATES.get(body.known_as, {}) if body.is_as_named else {}
    nutations = satellites.node_nutations(body, mean_rates.gm_over_r3, mean_rates.means.obliquity)
    nodes = {
        f"{name}, period {nutation.years}": nutation.rate for name, nutation in nutations.items()
    }
    if published:
        what = "contribution to the rate that the model leaves out; others were not measured"
        cited = Neglected.cited(published, what)
        return replace(cited, sizes={**cited.sizes, **nodes}, periodic=tuple(nodes))
    if unknown:
        sizes = {"turning of the axis within an orbit": mean_rates.second_order, **nodes}
        what = "bound on the contribution to the rate that the model leaves out"
        others = f"all other effects, because {unknown}"
        return Neglected(sizes, "arcsec/yr", what, unknown=others, periodic=tuple(nodes))
    return reasons.neglected_rates()


precession = public_call(
    Precession,
    answer=precession_rates,
    sections=(
        convergence,
        figure_models,
        (free_wobble, reasons.observed_wobble),
        seasons,
        iau_2006,
        standstills,
        neglected,
    ),
    parts=(places, sky, interval, *MEANS),
    together=("body", "perturbers"),
    widest=16384,
)
