"""Positions of the perturbers and their torques at many times."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import Body, Numeric, in_a_sentence
from earthspin.bodies.earth_moon_sun import with_principal_pole
from earthspin.dates import Epochs, Span, Step, datetime64
from earthspin.engine import Block, Neglected, key, part, public_call
from earthspin.engine.variables import labels, measured, number, variable_of
from earthspin.mass.figure import moment_difference
from earthspin.numerics.arrays import FloatArray
from earthspin.questions import reasons, satellites
from earthspin.questions.sky import Sky, places, sky, start_error
from earthspin.questions.time_axes import SPAN_DOC, Dated, DateSeries, days_of, epochs
from earthspin.sky.iau_models import NUTATION_NODE_STEP, NutationSpline
from earthspin.sky.sources import OF_DATE, SourceName
from earthspin.torque.gravity import largest_torque_on_figure, torque_error, torque_from_declination


class Torque(DateSeries, word="torque", call="torque_series", positional=("start", "stop", "step")):
    """Declination, distance and torque of each perturber in time (source text, I.8.7).

    Examples
    --------
    >>> import earthspin
    >>> year = earthspin.torque_series("2000-01-01", "2001-01-01", "1 d")
    >>> print(year.declination.sel(perturber="sun").max().round(3).values)
    23.439
    """

    page, headline = "torques", "torque_magnitude"
    with_satellites = True

    span: Span = key(("2000-01-01T12:00:00", "2001-01-01T12:00:00"), doc=SPAN_DOC)
    step: Step = key("6 h", doc="interval between dates")
    equator: Literal["mean", "true"] = key(
        "mean", doc="equator and equinox of date that directions refer to"
    )

    needs = ("radius", "j2", "pole")

    def check(self) -> None:
        """Refuse the true equator of date for a body that has no nutation model."""
        super().check()
        if self.equator == "true" and reasons.no_iau_model(self.body):
            why = f"there is no nutation model for {in_a_sentence(self.body.name)}; use 'mean'"
            raise self.error("equator", "true", why)


def on_mean_equator(equator: str) -> str | None:
    """Return the reason (text) to omit nutation if the mean equator is requested, else None."""
    return "the equator is the mean one" if equator == "mean" else None


def source_has_equator(source: SourceName) -> str | None:
    """Return the reason (text) to omit nutation if the source has its own equator, else None.

    This is a source of positions that has the equator of date.
    """
    return f"{source} has the equator of date" if source in OF_DATE else None


@part(unless=(on_mean_equator, source_has_equator))
def nutation(epochs: Epochs) -> NutationSpline:
    """IAU nutation for the true equator of date, over the time span of the series."""
    start, end = epochs.span()
    return NutationSpline(start, end, epochs.size)


class Torques(Dated, along=("time", "perturber")):
    """Positions of the perturbers, and their torques on the body, in time."""

    right_ascension = number("deg", "right ascension, geometric", error="direction_error")
    declination = number("deg", "declination, geometric", error="direction_error")
    distance = number("m", "distance between the centres")
    torque = number(
        "N m",
        "torque on the equatorial bulge",
        along=("time", "perturber", "component"),
        error="torque_magnitude_error",
    )
    torque_magnitude = measured("N m", "magnitude of the torque")
    direction_error = number(
        "arcsec",
        "bound on the error of right ascension and declination: positions, and pole at J2000.0",
        along=("perturber",),
    )
    distance_error = number("m", "bound on the error of the distance", along=("perturber",))
    perturber = labels()
    component = labels(default=["x", "y", "z"])


@part
def torques(
    epochs: Epochs,
    sky: Sky,
    body: Body,
    perturbers: tuple[Body, ...],
    equator: str,
    nutation: NutationSpline | None = None,
    block: Block | None = None,
) -> Torques:
    """Compute declination, distance and torque of each perturber at every time."""
    now = days_of(epochs, block, "series.zarr", (body, *perturbers))
    names = list(sky.targets)
    principal = with_principal_pole(body)
    radec = sky.radec(principal, now, true=equator == "true", nutation=nutation)
    pole_error = start_error(body)
    left_out = {"not_included": "uncertainty of the pole, not known"} if pole_error is None else {}
    errors = {}
    for name in names:
        angle, far = sky.error(sky.targets[name], epochs.span())
        errors[name] = math.hypot(angle, pole_error or 0.0), far

    def stack(values: list[FloatArray], *dims: str, times: Numeric = 1.0) -> xr.DataArray:
        stacked, is_array = np.stack(values, axis=1), hasattr(times, "dims")
        if not is_array:
            stacked *= times  # in place: fresh memory costs more than the product
        array = xr.DataArray(variable_of(("time", "perturber", *dims), stacked))
        return array * times if is_array else array

    bulge = moment_difference(body.needed("j2"), body.mass, body.needed("radius"))
    u_bulge = body.relative_uncertainty_of_bulge()
    per_bulge = [torque_from_declination(p.gm_on(body), 1.0, *radec[p.name]) for p in perturbers]
    error = []
    for p in perturbers:
        place = (*radec[p.name][1:], *errors[p.name])
        u_product = math.hypot(u_bulge, p.relative_uncertainty.get("gm", 0.0))
        error.append(torque_error(p.gm_on(body), 1.0, *place, u_product))
    magnitudes = [np.linalg.norm(t, axis=-1) for t in per_bulge]
    return Torques(
        time=datetime64(now),
        perturber=names,
        right_ascension=stack([radec[name][0] for name in names]),
        declination=stack([radec[name][1] for name in names]),
        distance=stack([radec[name][2] for name in names]),
        torque=stack(per_bulge, "component", times=bulge),
        torque_magnitude=(stack(magnitudes, times=abs(bulge)), stack(error, times=abs(bulge))),
        direction_error=[errors[name][0] for name in names],
        distance_error=[errors[name][1] for name in names],
    ).with_attributes(
        no_error=sky.no_error,
        torque={"frame": f"{equator} equator and equinox of date"},
        direction_error={
            "method": _equator_words(equator, nutation),
            "evaluations": epochs.size * len(names) + getattr(nutation, "evaluations", 0),
            **left_out,
        },
    )


def _equator_words(equator: str, nutation: NutationSpline | None) -> str:
    """Describe the model of the equator in words, for the attributes of the result."""
    if nutation is not None and nutation.interpolates:
        return f"IAU 2000A nutation, a node each {NUTATION_NODE_STEP:g} d"
    return "mean equator" if equator == "mean" else "IAU 2000A nutation at each time"


#: Number of times, evenly spread over a series, among which the smallest distances are searched.
#: Over 150 years they are 20 h apart, within which the distance of the Moon changes by 1e-3.
_SEARCHED = 1 << 16


def one_body(body: Body) -> str | None:
    """Return the reason (text) to omit effect sizes if the body's numbers are arrays, else None."""
    return "the sizes are given for one body at a time" if body.labelled else None


@part(unless=one_body)
def nearest(sky: Sky, epochs: Epochs) -> dict[str, float]:
    """Find the smallest distance of each perturber over all times of the series, m.

    It does not depend on the block, so every block of a long series has the same attributes.
    """
    every = -(-epochs.size // _SEARCHED)
    positions = sky.positions(epochs.days(every=every))
    return {name: float(np.linalg.norm(r, axis=1).min()) for name, r in positions.items()}


@part
def neglected(
    body: Body, perturbers: tuple[Body, ...], nearest: dict[str, float] | None = None
) -> Neglected:
    """Largest neglected torques: on J3, J4 and triaxiality of the body, and those of satellites.

    They are computed at the smallest distance of each perturber.
    """
    if nearest is None:
        return Neglected(what="effects whose sizes are given for one body at a time")
    points = [(p.gm_on(body), nearest[p.name]) for p in perturbers]
    zonal = {"j3": body.j3, "j4": body.j4}
    figure = {int(name[1]): float(j_n) for name, j_n in zonal.items() if j_n is not None}
    unknown = ", ".join(name for name, j_n in zonal.items() if j_n is None)
    sizes = largest_torque_on_figure(
        points, float(body.mass), float(body.needed("radius")), figure, float(body.triaxiality)
    )
    gm_over_r3 = sum(gm / r**3 for gm, r in points)
    sizes |= satellites.largest_torques_of_satellites(body, gm_over_r3)
    what = "largest torque that the model leaves out"
    return Neglected(sizes, "N m", what, body.reference, unknown=unknown)


torque_series = public_call(
    Torque,
    answer=torques,
    sections=(neglected,),
    parts=(places, sky, epochs, nutation, nearest),
    together=("body",),
    widest=256,
)
