"""Positions of the perturbers and their torques at many times."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import Body, Numeric, in_a_sentence
from earthspin.choosing.choice import Choice
from earthspin.choosing.nutation import NutationNodes
from earthspin.choosing.promises import Report, refuse_unkept
from earthspin.dates import Epochs, Span, Step, datetime64
from earthspin.engine.asking import public_call
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import Block, part
from earthspin.engine.question import define_parts, key
from earthspin.engine.variables import Labels, Pair, Value, labels, measured, number
from earthspin.mass.inertia import moment_difference
from earthspin.parts.choices import chosen_nutation, on_mean_equator, source_has_equator
from earthspin.parts.reasons import no_accuracy, no_iau_model
from earthspin.parts.sky import Sky, places, sky
from earthspin.parts.times import DIRECTION_DOC, SPAN_DOC, Dated, Series, by_region, days_of, epochs
from earthspin.torque.gravity import torque_error, torque_from_declination
from earthspin.torque.neglected import largest_torque_on_figure
from earthspin.units import AngleError

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.sky.iau import Nutation


class Torque(Series, word="torque", call="torque_series", positional=("start", "stop", "step")):
    """Declination, distance and torque of each perturber in time (source text, I.8.7).

    Returns
    -------
    Dataset
        Over `time` and `perturber`: `right_ascension`, `declination` (deg), `distance` (m),
        `torque` (N m, `component` x, y, z), `torque_magnitude` and its error; bounds on
        directions and distances for each perturber.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line.

    Examples
    --------
    >>> import earthspin
    >>> year = earthspin.torque_series("2000-01-01", "2001-01-01", "1 d")
    >>> print(year.declination.sel(perturber="sun").max().round(3).values)
    23.439
    """

    views, page = "torque", "theory"

    span: Span = key(("2000-01-01T12:00:00", "2001-01-01T12:00:00"), doc=SPAN_DOC)
    step: Step = key("6 h", doc="interval between dates")
    equator: Literal["mean", "true"] = key(
        "mean", doc="equator and equinox of date that directions refer to"
    )
    accuracy: AngleError | None = key(None, doc=DIRECTION_DOC)

    needs = ("radius", "j2", "pole")

    def check(self) -> None:
        """Refuse the true equator of date for a body that has no nutation model."""
        super().check()
        if self.equator == "true" and no_iau_model(self.body):
            why = f"there is no nutation model for {in_a_sentence(self.body.name)}; use 'mean'"
            raise self.error("equator", "true", why)


@part(unless=(on_mean_equator, source_has_equator))
def nutation(
    epochs: Epochs, chosen_nutation: Choice[NutationNodes | None] | None = None
) -> Nutation | None:
    """Interpolated IAU nutation for the true equator; None if the mean equator is sufficient."""
    from earthspin.sky.iau import Nutation

    start, end = epochs.span()
    if chosen_nutation is None:
        return Nutation(start, end, epochs.size)
    nodes = chosen_nutation.settings
    if nodes is None:
        return None
    return Nutation(start, end, epochs.size, model=nodes.model, spacing=nodes.spacing)


class Torques(Dated, along=("time", "perturber")):
    """Positions of the perturbers, and their torques on the body, in time."""

    right_ascension: Value = number("deg", "right ascension, geometric", error="direction_error")
    declination: Value = number("deg", "declination, geometric", error="direction_error")
    distance: Value = number("m", "distance between the centres")
    torque: Value = number(
        "N m",
        "torque on the equatorial bulge",
        along=("time", "perturber", "component"),
        error="torque_magnitude_error",
    )
    torque_magnitude: Pair = measured("N m", "magnitude of the torque")
    direction_error: Value = number(
        "arcsec", "bound on right ascension and declination", along=("perturber",)
    )
    distance_error: Value = number(
        "m", "bound on the distance from the kernel", along=("perturber",)
    )
    perturber: Labels = labels()
    component: Labels = labels(default=["x", "y", "z"])


@part
def torques(
    epochs: Epochs,
    sky: Sky,
    body: Body,
    perturbers: tuple[Body, ...],
    equator: str,
    accuracy: float | None,
    nutation: Nutation | None = None,
    chosen_nutation: Choice[NutationNodes | None] | None = None,
    block: Block | None = None,
) -> Torques:
    """Compute declination, distance and torque of each perturber at every time."""
    import xarray as xr

    now = days_of(epochs, block, by_region("series.zarr"), (body, *perturbers))
    names = list(sky.targets)
    seen = sky.radec(body, now, true=equator == "true", nutation=nutation)
    turned = 0.0 if chosen_nutation is None else chosen_nutation.error
    bounds = {name: sky.error(sky.targets[name], epochs.span()) for name in names}
    kernel_error = {name: (turned + angle, far) for name, (angle, far) in bounds.items()}
    worst = max(angle for angle, _ in kernel_error.values())
    refuse_unkept(accuracy, worst, "mas", "that is what the kernel is known to; ask for less")

    def stack(
        values: list[NDArray[np.float64]], *dims: str, times: Numeric | None = None
    ) -> xr.DataArray:
        array = xr.DataArray(np.stack(values, axis=1), dims=("time", "perturber", *dims))
        if times is None or hasattr(times, "dims"):
            return array if times is None else array * times
        array.values *= times  # in place: fresh memory costs more than the product
        return array

    bulge = moment_difference(body.needed("j2"), body.mass, body.needed("radius"))
    u_bulge = body.relative_uncertainty_of_bulge()
    per_bulge = [torque_from_declination(p.gm, 1.0, *seen[p.name]) for p in perturbers]
    error = [
        torque_error(
            p.gm,
            1.0,
            declination=seen[p.name][1],
            distance=seen[p.name][2],
            angle_error=kernel_error[p.name][0],
            distance_error=kernel_error[p.name][1],
            u_product=math.hypot(u_bulge, p.relative_uncertainty.get("gm", 0.0)),
        )
        for p in perturbers
    ]
    magnitudes = [np.linalg.norm(t, axis=-1) for t in per_bulge]
    return Torques(
        time=datetime64(now),
        perturber=names,
        right_ascension=stack([seen[name][0] for name in names]),
        declination=stack([seen[name][1] for name in names]),
        distance=stack([seen[name][2] for name in names]),
        torque=stack(per_bulge, "component", times=bulge),
        torque_magnitude=(stack(magnitudes, times=abs(bulge)), stack(error, times=abs(bulge))),
        direction_error=[kernel_error[name][0] for name in names],
        distance_error=[kernel_error[name][1] for name in names],
    ).with_attributes(
        no_error=sky.no_error,
        torque={"frame": f"{equator} equator and equinox of date"},
        direction_error={
            "method": _equator_words(equator, nutation, chosen_nutation),
            "evaluations": epochs.size * len(names) + getattr(nutation, "evaluations", 0),
        },
    )


def _equator_words(
    equator: str, nutation: Nutation | None, chosen: Choice[NutationNodes | None] | None
) -> str:
    """Describe the model of the equator in words, for the attributes of the result."""
    if nutation is not None:
        return f"IAU {nutation.model} nutation, a node each {nutation.spacing:g} d"
    if chosen is not None:
        return chosen.words
    return "mean equator" if equator == "mean" else "IAU 2000A nutation at each time"


class DirectionAccuracy(Report, units="arcsec", error_of="in direction"):
    """Estimated error of the directions, the accuracy that was requested, and the method used."""


@part(unless=no_accuracy)
def series_accuracy(torques: xr.Dataset, accuracy: float | None) -> DirectionAccuracy:
    """Estimated error of the directions, the accuracy that was requested, and the method used."""
    return DirectionAccuracy.of_series(accuracy, torques.direction_error)


@part
def neglected(torques: xr.Dataset, body: Body, perturbers: tuple[Body, ...]) -> Neglected:
    """Largest neglected torques, which act on J3, J4 and the triaxiality of the body.

    They are computed at the smallest distance of each perturber.
    """
    if body.labelled:
        return Neglected(what="effects whose sizes are given for one body at a time")
    nearest = torques.distance.min("time")
    pulls = [(p.gm, float(nearest.sel(perturber=p.name))) for p in perturbers]
    figure = {3: float(body.j3), 4: float(body.j4)}
    sizes = largest_torque_on_figure(
        pulls, float(body.mass), float(body.needed("radius")), figure, float(body.triaxiality)
    )
    return Neglected(sizes, "N m", "largest torque that the model leaves out", body.reference)


define_parts(
    Torque,
    answer=(torques, series_accuracy),
    sections={"neglected": neglected},
    parts=(places, sky, epochs, chosen_nutation, nutation),
    together=("body",),
    widest=256,
)

torque_series = public_call(Torque)
