"""Rate and period of precession, and quantities that follow from them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import Body, all_of, in_a_sentence
from earthspin.bodies.planets import LEFT_OUT_OF_RATES
from earthspin.choosing.promises import promise, refuse_unkept, report
from earthspin.constants import DAY, JULIAN_YEAR, PUBLISHED_EFFECTS
from earthspin.dates import Span, datetime64
from earthspin.engine.asking import ask
from earthspin.engine.labels import Variable, build, with_error, without_error
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import key, made_of
from earthspin.errors import UndefinedError
from earthspin.parts.averages import MEANS, MeanRates, MeanTorques, Samples, of_all
from earthspin.parts.choices import chosen_average
from earthspin.parts.elements import no_exact_means
from earthspin.parts.observed_wobble import observed_wobble
from earthspin.parts.reasons import (
    many_pulls,
    no_accuracy,
    no_moon,
    not_sun_and_moon,
    not_the_iaus_earth,
)
from earthspin.parts.sky import SOURCE_DOC, Pulled, Sky, Stretch, places, sky, stretch
from earthspin.sky.sources import SourceName
from earthspin.units import Relative

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.torque.rates import Estimate

#: Points of a curve of convergence.
CURVE_POINTS = 81
MODELS = ("mccullough", "homogeneous", "measured")


class Precession(Pulled, word="precession", call="precession"):
    """Rate and period of precession from torques averaged over orbits (I.8).

    Returns
    -------
    Dataset
        Along `perturber`: `precession_rate` (arcsec/yr), `precession_period` (yr) and
        `mean_torque` (N m), each with its 95 % half-width `_error`, referred to
        `reference_epoch`. `earthspin.run_tree` adds the sections: convergence of the
        average, models of the figure, the free wobble, the seasons, IAU 2006, standstills of the
        Moon, and what is neglected.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.

    Examples
    --------
    >>> import earthspin
    >>> result = earthspin.precession()
    >>> print(result.precession_period.round().values)
    [81259. 37614. 25712.]
    """

    source: SourceName = key("skyfield", doc=SOURCE_DOC)
    span: Span | None = key(
        None, doc="first and last date of the average; all that the kernel covers if not given"
    )
    accuracy: Relative | None = key(
        None,
        doc="largest relative error of the rate by all perturbers; the cheapest settings "
        "that keep it are chosen",
    )

    many_pulls = True

    def check(self) -> None:
        """One mass of each perturber where settings are chosen, or means of ellipses taken."""
        super().check()
        many = many_pulls(self.perturbers)
        if many and self.accuracy is not None:
            raise self.error("accuracy", self.accuracy, f"{many}; ask for one at a time")
        if many and no_exact_means(self.body, self.perturbers) is None:
            raise self.error("perturbers", "orbits by their elements", f"{many}; give one mass")


# --- the answer ----------------------------------------------------------------------------------


def _check_accuracy(asked: float | None, rate: Estimate) -> None:
    """Refuse a relative accuracy that the total does not reach, and say what takes most of it."""
    if asked is None:
        return
    if not all_of(of_all(rate.value) != 0):
        raise UndefinedError("the rate is zero and has no relative error; leave accuracy out")
    method, given, best = (
        float((of_all(share) / abs(of_all(rate.value))).max())
        for share in (rate.method, rate.given, rate.error)
    )
    remedy = (
        f"the given numbers are known to {given:.2g}: give the body a better known H"
        if given > method
        else f"the average is known to {method:.2g}: give a longer span"
    )
    refuse_unkept(asked, best, "1", remedy)


_PERTURBER = ("perturber",)
_OVER_WINDOW = (("cell_methods", "time: mean (weighted by the taper)"),)

RATES = {
    **with_error(
        "precession_rate",
        Variable(
            _PERTURBER,
            "arcsec/yr",
            "rate of precession in longitude along the fixed orbit",
            _OVER_WINDOW,
        ),
        split=True,
    ),
    **with_error(
        "precession_period", Variable(_PERTURBER, "yr", "period of one full turn of precession")
    ),
    "rate_ratio": Variable(
        _PERTURBER,
        "1",
        "ratio of the rate to that of the first perturber",
        no_error="a ratio of two rates that each carry their own error",
    ),
    **with_error(
        "mean_torque",
        Variable(_PERTURBER, "N m", "magnitude of the mean torque vector", _OVER_WINDOW),
    ),
    "obliquity": Variable(
        (),
        "deg",
        "angle between spin axis and orbit normal at the epoch",
        no_error="an angle between a pole and a plane that are given",
    ),
    "reference_epoch": Variable((), "", "epoch that the averages refer to (TDB)"),
}


@part(gives=RATES)
def precession_rates(mean_rates: MeanRates, mean_torques: MeanTorques, body: Body) -> xr.Dataset:
    """Rates, periods and torques by perturber, each with its error."""
    from earthspin.torque import rates

    rate, torque = mean_rates.rate, mean_rates.torque
    error = rate.error
    result = build(
        RATES,
        {
            "precession_rate": rate.value,
            "precession_rate_error": error,
            "precession_rate_error_method": rate.method,
            "precession_rate_error_input": rate.given,
            "precession_period": rates.period(rate.value),
            "precession_period_error": rates.period_error(rate.value, error),
            "rate_ratio": mean_rates.ratio,
            "mean_torque": torque.value,
            "mean_torque_error": torque.error,
            "obliquity": mean_torques.obliquity,
            "reference_epoch": datetime64(np.array(mean_torques.epoch / DAY)),
        },
        {"perturber": mean_rates.labels},
        no_error=mean_rates.no_error,
    )
    result["precession_rate"].attrs |= {
        "window": mean_torques.over,
        "pole": str(body.needed("pole")),
        "plane": _plane(body),
    }
    result["precession_rate_error"].attrs |= {
        "method": mean_rates.method,
        "evaluations": mean_rates.evaluations,
    }
    return result


def _plane(body: Body) -> str:
    """The plane along which a rate is counted, in words."""
    if body.needed("pole").of_the_iau:
        return "ecliptic of J2000.0"
    return f"orbit whose normal has {body.orbit_pole} (ICRF)"


PROMISE = promise("1", "relative, of the rate by all perturbers")


@part(gives=PROMISE, unless=no_accuracy)
def rate_accuracy(mean_rates: MeanRates, accuracy: float | None) -> xr.Dataset:
    """Accuracy of the rate: asked, estimated, and the method chosen."""
    _check_accuracy(accuracy, mean_rates.rate)
    rate, error = mean_rates.total()
    worst = float((error / abs(rate)).max())
    return report(PROMISE, accuracy, worst, mean_rates.method, mean_rates.evaluations)


# --- sections ------------------------------------------------------------------------------------

CONVERGENCE = without_error(
    "the curve itself shows the error of each window",
    {
        "rate_by_window": Variable(
            ("window", "window_cycles"), "arcsec/yr", "rate of precession by all perturbers"
        ),
        "window_length": Variable(("window_cycles",), "yr", "length of the averaging window"),
    },
)


@part(gives=CONVERGENCE, unless=many_pulls)
def convergence(torque_samples: Samples, body: Body) -> xr.Dataset:
    """Averaged rate against the length of the window, plain mean and tapers."""
    import xarray as xr

    from earthspin.torque import rates
    from earthspin.torque.average import convergence_curve

    window = torque_samples.window
    cycles = np.linspace(1.0, window.cycles, CURVE_POINTS)
    total = torque_samples.precessing.sum(axis=1)
    curves = convergence_curve(window, torque_samples.times, total, cycles)
    precessing = xr.DataArray(
        np.stack(list(curves.values())),
        {"window": list(curves), "window_cycles": cycles},
        ("window", "window_cycles"),
    )
    rate = rates.precession_rate(precessing, body.needed("dynamical_flattening"), body.spin_rate)
    length = xr.DataArray(cycles * window.cycle, {"window_cycles": cycles}, ("window_cycles",))
    result = build(CONVERGENCE, {"rate_by_window": rate, "window_length": length})
    result["window_cycles"].attrs["long_name"] = "length of the averaging window in cycles"
    return result


def no_figure(body: Body) -> str | None:
    """Leave out the models of a figure that is not known, or from which nothing follows."""
    missing = [k for k in ("j2", "flattening", "radius") if getattr(body, k) is None]
    if missing:
        return f"{in_a_sentence(body.name)} has no {missing[0]}"
    if not all_of(abs(body.needed("flattening")) < 1):
        return "McCullough's formula needs a flattening between -1 and 1"
    if not all_of(body.needed("dynamical_flattening") != 0):
        return "with H = 0 the polar moment does not follow from J2"
    return None


_MODEL = ("earth_model",)
FIGURE_MODELS = without_error(
    "a model of the figure, for comparison with the others",
    {
        "h_by_model": Variable(_MODEL, "1", "dynamical flattening (C - A)/C"),
        "period_by_model": Variable(_MODEL, "yr", "period of one full turn of precession"),
        "wobble_by_model": Variable(_MODEL, "d", "period of the rigid free wobble"),
        "moment_difference": Variable((), "kg m2", "C - A from J2"),
        "polar_moment_factor": Variable((), "1", "C/(M a2) from J2 and H"),
        "j2_from_moment_difference": Variable((), "1", "J2 computed back from C - A"),
    },
)


@part(gives=FIGURE_MODELS, unless=(no_figure, many_pulls))
def figure_models(mean_torques: MeanTorques, body: Body) -> xr.Dataset:
    """Three models of the dynamical flattening, each with its precession and free wobble."""
    import xarray as xr

    from earthspin.mass import inertia
    from earthspin.rotor.axisymmetric import free_wobble_period
    from earthspin.torque import rates

    j2, measured = body.needed("j2"), body.needed("dynamical_flattening")
    precessing = mean_torques.precessing[-1]
    h = xr.concat(
        [
            xr.DataArray(inertia.h_mccullough(body.needed("flattening"))),
            xr.DataArray(inertia.h_homogeneous(j2)),
            xr.DataArray(measured),
        ],
        dim=xr.Variable("earth_model", list(MODELS)),
    )
    spin_period = body.needed("spin_period")
    difference = inertia.moment_difference(j2, body.mass, body.needed("radius"))
    return build(
        FIGURE_MODELS,
        {
            "h_by_model": h,
            "period_by_model": rates.period(rates.precession_rate(precessing, h, body.spin_rate)),
            "wobble_by_model": free_wobble_period(inertia.ellipticity_from_h(h), spin_period),
            "moment_difference": difference,
            "polar_moment_factor": inertia.polar_moment_factor(j2, measured),
            "j2_from_moment_difference": inertia.j2_from_moment_difference(
                difference, body.mass, body.needed("radius")
            ),
        },
    )


def is_sphere(body: Body) -> str | None:
    """Leave the wobble of a sphere out."""
    round_ = not all_of(body.needed("dynamical_flattening") != 0)
    return "a sphere does not wobble" if round_ else None


FREE_WOBBLE = without_error(
    "its relative error is that of free_wobble_period",
    {
        **with_error(
            "free_wobble_period", Variable((), "d", "period of the rigid free wobble, A/(C - A)")
        ),
        "free_wobble_period_sidereal": Variable(
            (), "1", "period of the rigid free wobble in turns of the body, its sidereal days"
        ),
    },
)


@part(gives=FREE_WOBBLE, unless=is_sphere)
def free_wobble(body: Body) -> xr.Dataset:
    """Period of the free wobble of the rigid body."""
    from earthspin.mass.inertia import ellipticity_from_h
    from earthspin.rotor.axisymmetric import free_wobble_error, free_wobble_period

    h = body.needed("dynamical_flattening")
    period = free_wobble_period(ellipticity_from_h(h), body.needed("spin_period"))
    u = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    return build(
        FREE_WOBBLE,
        {
            "free_wobble_period": period,
            "free_wobble_period_error": free_wobble_error(period, h, u),
            "free_wobble_period_sidereal": free_wobble_period(ellipticity_from_h(h), 1.0),
        },
    )


SEASONS = without_error(
    "its relative error is that of general_precession",
    {
        **with_error(
            "general_precession",
            Variable(
                (),
                "arcsec/yr",
                "general precession in longitude: motion of the equinox along the moving ecliptic",
            ),
        ),
        **with_error(
            "general_precession_period",
            Variable((), "yr", "period of one full turn of the equinox"),
        ),
        "time_per_degree": Variable((), "yr", "time in which the equinox moves by one degree"),
        "tropical_year": Variable((), "d", "tropical year, the period of the seasons"),
        "time_per_day_of_drift": Variable(
            (), "yr", "time in which years of 365.25 d drift by a day against the seasons"
        ),
        "time_per_dropped_leap_day": Variable(
            (), "yr", "time in which the Gregorian calendar drops one leap day, 400/3"
        ),
        "time_per_day_of_gregorian_drift": Variable(
            (), "yr", "time in which Gregorian years drift by a day against the seasons"
        ),
    },
)


@part(gives=SEASONS, unless=not_sun_and_moon)
def seasons(
    mean_rates: MeanRates, mean_torques: MeanTorques, body: Body, perturbers: tuple[Body, ...]
) -> xr.Dataset:
    """General precession, years per degree, drift of the calendar.

    For the Earth as it is, the published effects that the rate leaves out are included.
    """
    from earthspin.nutation import seasons as s
    from earthspin.nutation.budget import published_effects
    from earthspin.sky.iau import precession_rates
    from earthspin.torque import rates

    rate, error = mean_rates.total()
    another = not_the_iaus_earth(body, perturbers)
    published = 0.0 if another else sum(published_effects().values())
    chi_rate = precession_rates(mean_torques.epoch / DAY).chi_a
    general = s.general_precession(rate + published, chi_rate, mean_torques.obliquity)
    year = s.tropical_year(general, body.needed("orbital_period"))
    result = build(
        SEASONS,
        {
            "general_precession": general,
            "general_precession_error": error,
            "general_precession_period": rates.period(general),
            "general_precession_period_error": rates.period_error(general, error),
            "time_per_degree": s.time_per_degree(general),
            "tropical_year": year,
            "time_per_day_of_drift": s.time_per_day_of_drift(year),
            "time_per_dropped_leap_day": s.DROPPED_LEAP_DAY * JULIAN_YEAR,
            "time_per_day_of_gregorian_drift": s.time_per_day_of_drift(year, s.GREGORIAN_YEAR),
        },
        no_error=mean_rates.no_error,
    )
    result["general_precession"].attrs["effects"] = (
        f"torques of Sun and Moon alone; no published effects apply: {another}"
        if another
        else "torques of Sun and Moon, and the published effects that their mean leaves out"
    )
    return result


IAU_2006 = {
    "iau_rate": Variable(
        (),
        "arcsec/yr",
        "rate of psi_A in IAU 2006 at the same epoch",
        no_error="a model that was adopted, exact by definition",
    ),
    **with_error("difference_from_iau", Variable((), "arcsec/yr", "computed rate minus the IAU's")),
    **with_error(
        "closure",
        Variable((), "arcsec/yr", "difference that remains after all published contributions"),
    ),
}


@part(gives=IAU_2006, unless=not_the_iaus_earth)
def iau_2006(mean_rates: MeanRates, mean_torques: MeanTorques) -> xr.Dataset:
    """IAU 2006 precession compared with the computed one, published effects included."""
    from earthspin.nutation.budget import closure
    from earthspin.sky.iau import precession_rates

    rate, error = mean_rates.total()
    iau_rate = precession_rates(mean_torques.epoch / DAY).psi_a
    return build(
        IAU_2006,
        {
            "iau_rate": iau_rate,
            "difference_from_iau": rate - iau_rate,
            "difference_from_iau_error": error,
            "closure": closure(rate, iau_rate),
            "closure_error": error,
        },
        no_error=mean_rates.no_error,
    )


STANDSTILLS = {
    "standstill_kind": Variable(("standstill",), "", "major or minor"),
    **with_error(
        "standstill_declination",
        Variable(("standstill",), "deg", "extreme declination, mean equator of date"),
    ),
}


@part(gives=STANDSTILLS, unless=no_moon)
def standstills(sky: Sky, stretch: Stretch, body: Body) -> xr.Dataset:
    """Major and minor standstills of the Moon: dates and extreme declinations."""
    from earthspin.sky.standstill import find_standstills

    moon = {"moon": sky.targets["moon"]}

    def declination(days: NDArray[np.float64]) -> NDArray[np.float64]:
        return sky.radec(body, days, moon)["moon"][1]

    found = find_standstills(declination, stretch.first, stretch.last)
    return build(
        STANDSTILLS,
        {
            "standstill_kind": np.array([s.kind for s in found], dtype=str),
            "standstill_declination": np.array([s.declination for s in found], dtype=float),
            "standstill_declination_error": np.array(
                [sky.error(sky.targets["moon"], (s.day,))[0] for s in found], dtype=float
            ),
        },
        coords={
            "standstill": (
                "standstill",
                datetime64(np.array([s.day for s in found], dtype=float)),
                {"long_name": "day of the extreme declination (TDB)"},
            )
        },
        no_error=sky.no_error,
    )


@part
def neglected(body: Body, perturbers: tuple[Body, ...], mean_rates: MeanRates) -> Neglected:
    """Published size of each effect that torques of Sun and Moon on the mean equator leave out."""
    unknown = not_the_iaus_earth(body, perturbers)
    if body.name in LEFT_OUT_OF_RATES and body.is_as_named:
        what = "contribution to the rate that the model leaves out; others were not measured"
        return Neglected.cited(LEFT_OUT_OF_RATES[body.name], what)
    if unknown:
        return Neglected(
            {"turning of the axis within an orbit": mean_rates.second_order},
            "arcsec/yr",
            "bound on the contribution to the rate that the model leaves out",
            unknown=f"all other effects, because {unknown}",
        )
    from earthspin.nutation.budget import published_effects

    return Neglected(
        published_effects(),
        "arcsec/yr",
        "published contribution to the rate that the model leaves out",
        next(iter(PUBLISHED_EFFECTS.values())).source,
    )


made_of(
    Precession,
    answer=(precession_rates, rate_accuracy),
    sections={
        "convergence": convergence,
        "figure_models": figure_models,
        "free_wobble": (free_wobble, observed_wobble),
        "seasons": seasons,
        "iau_2006": iau_2006,
        "standstills": standstills,
        "neglected": neglected,
    },
    parts=(places, sky, stretch, chosen_average, *MEANS),
    together=("body", "perturbers"),
    widest=16384,
)

precession = ask(Precession)
