"""Path of the three axes of a body under torques."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from earthspin._lazy import xr
from earthspin.bodies import Body, in_a_sentence
from earthspin.constants import DAY
from earthspin.dates import Epochs, Span, Step, datetime64
from earthspin.engine import Block, Neglected, key, labels, number, part, public_call
from earthspin.motion.axes import AXES, AxisPath
from earthspin.motion.effect_sizes import axis_displacements
from earthspin.motion.effects import LARGEST_CORE_NUTATION, NONRIGID, RESPONSE
from earthspin.numerics.arrays import FloatArray
from earthspin.nutation.analysis import followed, on_fixed_ecliptic
from earthspin.questions import effects_and_torques, iau_comparison, interior_response, reasons
from earthspin.questions.effects_and_torques import ATTRACTORS, Attractors
from earthspin.questions.iau_comparison import Shift, WithInterior
from earthspin.questions.satellites import no_satellites
from earthspin.questions.sky import Sky, start_error
from earthspin.questions.time_axes import SPAN_DOC, Dated, days_of


class Pole(WithInterior, word="pole", call="pole", positional=("start", "stop", "step")):
    """Path of the angular momentum, rotation and figure axes under torques, in the GCRS.

    The path starts at J2000.0 from the pole of the body; for the Earth, from the true pole of IAU
    2006/2000A. By default every effect that is known for the body acts. These include `nonrigid`,
    the response of the interior, for the Earth under Sun and Moon if none of the three is changed
    by more than 1 %; ``effects="rigid"`` leaves it out. The response is `fitted` to IAU 2000A,
    including its additive terms, or `predicted` from the layers. The effect `geodesic` needs the
    Sun among the perturbers and also moves the axis of a sphere. With `nonrigid` the initial axes
    are such that their mean pole agrees with that of the IAU, and all axes receive the published
    contribution of the non-rigid Earth to the rate of precession.

    The label `axis` is ``angular_momentum``, ``rotation`` or ``figure``. The angles `psi` and `eps`
    are given where they are defined, `direction_error_response` with `nonrigid`, and
    `direction_error_satellites` for a body with satellites.

    Raises
    ------
    UndefinedError
        If the spin is too slow for the figure axis to follow the angular momentum.

    Examples
    --------
    >>> import earthspin
    >>> path = earthspin.pole("2000-01-01T12:00", "2001-01-01T12:00", "30 d")
    >>> print(path.sizes["time"], path.axis.values)
    13 ['angular_momentum' 'rotation' 'figure']
    """

    page, headline = "pole", "direction_error"
    with_satellites = True

    span: Span = key(("1980-01-01T12:00:00", "2020-01-01T12:00:00"), doc=SPAN_DOC)
    step: Step = key("5 d", doc="interval between dates")
    response: Literal["fitted", "predicted"] = key(
        "fitted",
        doc="source of the response of the interior for the effect nonrigid: fitted to IAU "
        "2000A, or predicted from the layers of the body",
    )

    def check(self) -> None:
        """Refuse the non-rigid effect for a body whose interior response is not known."""
        super().check()
        if NONRIGID.name not in self.effects:
            return
        if reasons.no_iau_model(self.body):
            name = in_a_sentence(self.body.name)
            problem = f"no response of the inside of {name} is known; leave it out"
            raise self.error("effects", NONRIGID.name, problem)
        if self.response == "predicted" and (why := interior_response.no_layers(self.body)):
            raise self.error("response", self.response, f"{why}; take 'fitted'")


def not_nonrigid(effects: tuple[str, ...]) -> str | None:
    """Return the reason (text) to omit the interior's response if it is switched off, else None."""
    return None if NONRIGID.name in effects else "the non-rigid response is switched off"


def not_fitted(response: str) -> str | None:
    """Return the reason (text) to omit the fit if a predicted response is requested, else None.

    The response is that of the body's interior to nutation torques.
    """
    return None if response == "fitted" else "the response is predicted"


def not_predicted(response: str) -> str | None:
    """Return the reason (text) to omit the prediction if a fitted response is requested, else None.

    The response is that of the body's interior to nutation torques.
    """
    return None if response == "predicted" else "the response is fitted"


@part(unless=(not_nonrigid, not_fitted))
def chosen_fit(fitted_shift: Shift) -> Shift:
    """Return the axis displacement by the interior's response as fitted to IAU 2000A."""
    return fitted_shift


@part(unless=(not_nonrigid, not_predicted))
def chosen_prediction(predicted_shift: Shift) -> Shift:
    """Return the axis displacement by the interior's response as predicted from the layers."""
    return predicted_shift


@part(unless=not_nonrigid)
def interior_shift(
    chosen_fit: Shift | None = None, chosen_prediction: Shift | None = None
) -> Shift:
    """Return the displacement of the axes by the interior: the fitted or the predicted one."""
    return next(filter(None, (chosen_fit, chosen_prediction)))


_COMPONENT: Any = {"along": ("time", "axis"), "frame": "GCRS"}


class Directions(Dated, error="direction_error"):
    """Unit vectors of the angular momentum, rotation and figure axes in time, with errors."""

    X = number("1", "first component of the unit vector of the axis", **_COMPONENT)
    Y = number("1", "second component of the unit vector of the axis", **_COMPONENT)
    Z = number("1", "third component of the unit vector of the axis", **_COMPONENT)
    direction_error = number("arcsec", "95 % half-width of the directions, from all shares")
    direction_error_method = number("arcsec", "share of direction_error from the integration")
    direction_error_input = number("arcsec", "share of direction_error from the uncertainty of H")
    direction_error_kernel = number(
        "arcsec", "share of direction_error from the positions of the bodies"
    )
    axis = labels()


@part
def axes(
    axis_path: AxisPath,
    epochs: Epochs,
    attractors: Attractors,
    effects: tuple[str, ...],
    interior_shift: Shift | None = None,
    block: Block | None = None,
) -> Directions:
    """Compute unit vectors of the angular momentum, rotation and figure axes at every time."""
    now = days_of(epochs, block, "pole.zarr")
    directions = axis_path.at(now * DAY)
    figure = directions["figure"]
    errors = iau_comparison.direction_errors(
        axis_path, figure, now, epochs, attractors, interior_shift
    )
    if interior_shift is not None:
        interior_shift.apply(directions, now)
    vectors = np.stack([directions[axis] for axis in AXES], axis=1)
    window = np.median(np.diff(axis_path.windows.edges)) / DAY
    return Directions(
        time=datetime64(now),
        axis=list(AXES),
        X=vectors[..., 0],
        Y=vectors[..., 1],
        Z=vectors[..., 2],
        **errors,
    ).with_attributes(
        no_error=attractors.sky.no_error,
        direction_error={
            "method": f"Gauss windows of {window:g} d with {axis_path.windows.order} nodes",
            "evaluations": axis_path.evaluations,
            **effects_and_torques.start_note(attractors.body),
            **effects_and_torques.inactive_effects_note(attractors.body, effects),
        },
    )


class ResponseError(Dated):
    """Error of the axis directions that is due to the response of the interior."""

    direction_error_response = number(
        "arcsec",
        "share of direction_error from the response of the interior: its residual, and the "
        "closure of the rates, against IAU 2006/2000A",
    )


@part(unless=not_nonrigid)
def response_error(
    axes: xr.Dataset,
    interior_shift: Shift,
    epochs: Epochs,
    response: str,
    block: Block | None = None,
) -> ResponseError:
    """Compute the error of the axis directions that is due to the response of the interior."""
    half_width = interior_shift.half_width(days_of(epochs, block, "pole.zarr"))
    share = ResponseError(time=axes.time, direction_error_response=half_width)
    if response == "predicted":
        share.with_attributes(direction_error_response={"references": interior_response.SOURCES})
    return share


class SatelliteError(Dated):
    """Error of the axis directions due to satellites: neglected nutation and uncertain rate."""

    direction_error_satellites = number(
        "arcsec",
        "share of direction_error from the satellites: the nutation by their nodes, which is left "
        "out, and the uncertainty of the rate that they add",
    )


@part(unless=no_satellites)
def satellite_error(
    axes: xr.Dataset, attractors: Attractors, epochs: Epochs, block: Block | None = None
) -> SatelliteError:
    """Compute the error of the axis directions that is due to the satellites."""
    elapsed = days_of(epochs, block, "pole.zarr") * DAY - attractors.epoch
    drift = iau_comparison.displacement_bound(attractors, elapsed)
    return SatelliteError(time=axes.time, direction_error_satellites=drift)


def no_longitude(body: Body) -> str | None:
    """Return the reason (text) to omit psi and eps of the axes if they are undefined, else None."""
    pole = body.needed("pole")
    if body.orbit_pole is None and not pole.of_the_iau:
        return f"psi is counted along the orbit, and {in_a_sentence(body.name)} has no orbit_pole"
    if pole.is_upright(body.orbit_pole):
        return "the axis stands upright on the orbit: its longitude psi is not defined"
    return None


class PoleAngles(Dated, along=("time", "axis"), error="direction_error"):
    """Longitude psi and inclination eps of the axes, relative to the body's orbit at J2000.0."""

    psi = number("arcsec", "precession and nutation in longitude along the orbit of J2000.0")
    eps = number("arcsec", "angle of the axis from the normal of the orbit of J2000.0")
    axis = labels()


@part(unless=no_longitude)
def longitudes(axis_path: AxisPath, epochs: Epochs, body: Body) -> tuple[FloatArray, FloatArray]:
    """Window start times, s, and longitude psi of the angular momentum at these times, rad."""
    ecliptic = body.needed("pole").orbit_axes(body.orbit_pole)
    return iau_comparison.continuous_longitude(
        axis_path, float(epochs.days(0, 1)[0]) * DAY, ecliptic
    )


@part(unless=no_longitude)
def pole_angles(
    axes: xr.Dataset,
    longitudes: tuple[FloatArray, FloatArray],
    epochs: Epochs,
    body: Body,
    block: Block | None = None,
) -> PoleAngles:
    """Compute longitude psi and inclination eps of the axes, relative to the J2000.0 orbit."""
    vectors = np.stack([axes.X, axes.Y, axes.Z], axis=-1)
    ecliptic = body.needed("pole").orbit_axes(body.orbit_pole)
    angles = on_fixed_ecliptic(vectors.reshape(-1, 3), ecliptic).reshape(*vectors.shape[:2], 2)
    reference = np.interp(days_of(epochs, block, "pole.zarr") * DAY, *longitudes)
    psi = followed(angles[..., 0], reference[:, np.newaxis])
    return PoleAngles(time=axes.time, axis=axes.axis, psi=psi, eps=angles[..., 1]).with_attributes(
        eps=reasons.north_note(body)
    )


@part
def neglected(
    body: Body,
    perturbers: tuple[Body, ...],
    effects: tuple[str, ...],
    sky: Sky,
    attractors: Attractors,
    axis_path: AxisPath,
    epochs: Epochs,
) -> Neglected:
    """Sizes of effects that are switched off or are not part of the model.

    They are the largest changes of the figure axis from J2000.0 to the first and the last date.
    """
    off = effects_and_torques.switched_off(body, perturbers, effects)
    forces, further = effects_and_torques.with_each_effect(sky, body, perturbers, effects, off)
    moved = axis_displacements(axis_path, attractors.epoch, forces, further)
    if {*off} - {*further}:
        reach = max(abs(day * DAY - attractors.epoch) for day in epochs.span())
        moved |= effects_and_torques.drift_by_planets(body, reach)
    sizes = {name: size for name, size in moved.items() if size}
    unknown = [name for name in off if name not in moved]
    sources = ["effects that are off: to first order, along the computed path"] if off else []
    known = not reasons.no_iau_model(body) and body.is_as_named and not body.orbit
    if not known and NONRIGID.name not in effects:
        unknown.append(f"response of the interior of {in_a_sentence(body.name)}")
    elif NONRIGID.name in effects:
        sizes |= {"free core nutation": LARGEST_CORE_NUTATION}
        sources.append("free core nutation: the largest that pole_offsets finds from 1984 to 2026")
    else:
        sizes |= {NONRIGID.name: max(map(RESPONSE.at, epochs.span()))}
        sources.append("nonrigid: measured on DE421 from 1950 to 2050")
    if not body.needed("pole").of_the_iau:
        half = start_error(body)
        if half is None:
            unknown.append("uncertainty of the pole at the start")
        else:
            sizes |= {"start": half}
            sources.append("start: 95 % half-width of the pole at J2000.0")
    what = "largest change of direction that the model leaves out"
    return Neglected(sizes, "mas", what, "; ".join(sources), unknown=", ".join(unknown))


pole = public_call(
    Pole,
    answer=(axes, response_error, satellite_error, pole_angles),
    sections=(neglected,),
    parts=(
        *ATTRACTORS,
        iau_comparison.axis_path,
        longitudes,
        *iau_comparison.INTERIOR,
        chosen_fit,
        chosen_prediction,
        interior_shift,
    ),
)
