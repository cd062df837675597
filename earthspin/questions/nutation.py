"""The nutation predicted from the layers of the body, rung by rung, beside IAU 2000A."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from numpy.typing import NDArray

from earthspin.bodies import Body
from earthspin.constants import DAYS_PER_CENTURY, NORMAL_95
from earthspin.dates import Span, Step, TimeGrid, TimeList, datetime64
from earthspin.engine.asking import ask
from earthspin.engine.labels import Variable, build, with_error, without_error
from earthspin.engine.neglected import Neglected
from earthspin.engine.part import part
from earthspin.engine.question import key, made_of, setting
from earthspin.interior.named import ANELASTIC_EXPONENT
from earthspin.parts.path import Analysed, path_over, pole_analysis, rigid
from earthspin.parts.predicted import SOURCES, Prediction, no_layers, predict
from earthspin.parts.pulls import Moved, Pulls, pulls
from earthspin.parts.sky import places, sky
from earthspin.parts.times import DATES, epochs, refuse_what_does_not_fit
from earthspin.progress import progress
from earthspin.units import Number

if TYPE_CHECKING:
    import xarray as xr

#: Terms of the table: the largest circles.
LARGEST = 12


class NutationLadder(
    Moved,
    word="nutation",
    call="nutation_ladder",
    table="nutation",
    positional=("start", "stop", "step"),
):
    """Nutation predicted from the layers of the Earth, rung by rung, beside IAU 2000A.

    A ladder of models, each of which adds one thing to the model before, from a rigid Earth to
    the layers of the `interior` of the body. The dynamical flattening H is the observed one
    throughout; nothing is fitted to nutation, save where a rung says so.

    Returns
    -------
    Dataset
        Along `rung`: `rms_dpsi_sineps` and `rms_deps` (mas), what is left against IAU 2000A after
        a constant and a rate, and `adds`, what the rung adds. `earthspin.run_tree` adds the
        sections: two models beside the ladder, the main circular terms, the free modes, the
        transfer function, compliances, and the residuals in time.

    Raises
    ------
    EarthspinError
        Whatever is wrong, in one line; among it a body whose layers are not known.

    Examples
    --------
    >>> import earthspin
    >>> ladder = earthspin.nutation_ladder()
    >>> print(ladder.rms_deps.round(1).values)
    [21.7 22.5  2.8  2.7  2.   1.9  0.4]
    """

    views, page = "nutation", "nutation"

    span: Span = key(
        ("1980-01-01T12:00:00", "2020-01-01T12:00:00"),
        doc="first and last date of the residuals, TDB",
    )
    step: Step = key("5 d", doc="interval between residuals")
    coupling: Literal["none", "inferred"] = setting(
        "none",
        doc="whether a last rung couples the core to what is around it beside its figure; the "
        "numbers are inferred from nutation itself",
    )
    anelastic_exponent: Annotated[float, Number("", "0.09", low=0.0, high=0.2)] = setting(
        ANELASTIC_EXPONENT.value, doc="exponent of frequency in the mantle's quality factor"
    )

    def check(self) -> None:
        """A body that the IAU has a nutation of, and whose layers are known."""
        super().check()
        if self.body.labelled:
            raise self.error("body", self.body.name, "give single numbers here, no labelled arrays")
        if why := no_layers(self.body):
            raise self.error("body", self.body.name, f"{why}; leave it out")


@part
def models(body: Body, coupling: str, anelastic_exponent: float) -> Prediction:
    """Climb the ladder: compliances, figure, and the system of mantle, core and inner core."""
    return predict(body, coupling == "inferred", anelastic_exponent)


@dataclass(frozen=True)
class Left:
    """What is left of each model against IAU 2000A, a constant and a rate removed.

    Attributes
    ----------
    days : ndarray, shape (t,)
    series : dict of str to ndarray, shape (t, 2)
        dpsi sin(eps0) and deps, rad, by rung.
    error : float
        95 % half-width of either angle, from the integration and H; what the interior adds is what
        the ladder is about.
    """

    days: NDArray[np.float64]
    series: dict[str, NDArray[np.float64]]
    error: float


@part
def left(
    pole_analysis: Analysed,
    models: Prediction,
    pulls: Pulls,
    epochs: TimeGrid | TimeList,
    body: Body,
    effects: tuple[str, ...],
) -> Left:
    """Computed pole with the response of each rung minus the IAU's, in time."""
    from earthspin.nutation.nutation import complex_nutation, responses, without_line
    from earthspin.sky import iau

    refuse_what_does_not_fit(epochs, "choose a longer step or a shorter span")
    done, days = pole_analysis, epochs.days(0, epochs.size)
    first, last = epochs.span()
    ends = np.array([min(first, 0.0), max(last, 0.0)])
    pulls.sky.check_times(ends, pulls.targets)
    path = path_over(body, pulls, rigid(effects), done.start, ends)
    own = complex_nutation(iau.nutation_of(done.pole(path, days), days))
    theirs = complex_nutation(iau.at_days(lambda at: iau.nutation_of(iau.true_pole(at), at), days))
    circles = done.our_circles
    factors = {name: models.transfer(name, circles.frequency) - 1 for name in models.rungs}

    def shifts(at: NDArray[np.float64]) -> NDArray[np.float64]:
        added = np.array([*responses(circles, iau.delaunay_arguments(at), factors).values()])
        return np.stack([added.real, added.imag], axis=-1).swapaxes(0, 1)

    series = {}
    with progress("residuals", len(factors)) as advance:
        for name, shift in zip(factors, iau.at_days(shifts, days).swapaxes(0, 1), strict=True):
            eta = own + shift[:, 0] + 1j * shift[:, 1] - theirs
            angles = np.stack([eta.real, eta.imag], axis=1)
            series[name] = without_line(days / DAYS_PER_CENTURY, angles)
            advance(1)
    u_h = body.relative_uncertainty.get("dynamical_flattening", 0.0)
    from_h = NORMAL_95 * u_h * float(np.max(np.abs(theirs)))
    return Left(days, series, math.hypot(done.path.error, from_h))


REFERENCES = (("references", SOURCES),)


def _sizes(dim: str, prefix: str = "") -> dict[str, Variable]:
    words = "root mean square of computed minus IAU 2000A in"
    return {
        f"{prefix}rms_dpsi_sineps": Variable(
            (dim,), "mas", f"{words} longitude times sin(eps), straight line removed",
            attrs=REFERENCES, error=f"{prefix}rms_error",
        ),
        f"{prefix}rms_deps": Variable(
            (dim,), "mas", f"{words} obliquity, straight line removed", error=f"{prefix}rms_error"
        ),
        f"{prefix}rms_error": Variable(
            (), "mas", "95 % half-width of a root mean square, from H and integration"
        ),
        f"{prefix}adds": Variable((dim,), "", "what the model adds, or what it is"),
    }  # fmt: skip


SIZES, BESIDE = _sizes("rung"), _sizes("model", "model_")


def _measured(
    left: Left, names: list[str], words: dict[str, str], prefix: str = ""
) -> dict[str, object]:
    sizes = np.array([np.sqrt(np.mean(left.series[name] ** 2, axis=0)) for name in names])
    return {
        f"{prefix}rms_dpsi_sineps": sizes[:, 0],
        f"{prefix}rms_deps": sizes[:, 1],
        f"{prefix}rms_error": left.error,
        f"{prefix}adds": np.array([words[name] for name in names]),
    }


@part(gives=SIZES)
def rung_sizes(left: Left, models: Prediction) -> xr.Dataset:
    """What is left against IAU 2000A, rung by rung."""
    from earthspin.nutation import ladder

    names = models.ladder
    return build(SIZES, _measured(left, names, ladder.RUNGS), coords={"rung": names})


@part(gives=BESIDE)
def beside(left: Left) -> xr.Dataset:
    """The same of two models beside the ladder."""
    from earthspin.nutation import ladder

    names = list(ladder.BESIDE)
    return build(BESIDE, _measured(left, names, ladder.BESIDE, "model_"), coords={"model": names})


# --- sections ------------------------------------------------------------------------------------

_ADOPTED = "it follows from the adopted arguments of IERS 2003"
_IN_TERM = ("rung", "term")
TERMS = {
    "period": Variable(
        ("term",), "d", "period of the circle in space, negative if retrograde", no_error=_ADOPTED
    ),
    "predicted_in_phase": Variable(
        _IN_TERM, "mas", "predicted amplitude, in phase", REFERENCES, "predicted_error"
    ),
    "predicted_out_of_phase": Variable(
        _IN_TERM, "mas", "predicted amplitude, out of phase", error="predicted_error"
    ),
    "predicted_error": Variable(
        _IN_TERM, "mas", "95 % half-width of a predicted amplitude, from the numbers of the inside"
    ),
    "iau_in_phase": Variable(
        ("term",), "mas", "amplitude of IAU 2000A, in phase", error="amplitude_error"
    ),
    "iau_out_of_phase": Variable(
        ("term",), "mas", "amplitude of IAU 2000A, out of phase", error="amplitude_error"
    ),
    "amplitude_error": Variable(
        ("term",), "mas", "95 % half-width of an amplitude from its analysis"
    ),
}


@part(gives=TERMS)
def terms(pole_analysis: Analysed, models: Prediction) -> xr.Dataset:
    """The largest circular terms of each rung, in phase and out of phase."""
    from earthspin.nutation.neighbours import amplitude_error
    from earthspin.nutation.nutation import phases

    ours, theirs = pole_analysis.our_circles, pole_analysis.their_circles
    order = np.argsort(-np.abs(ours.amplitude))[:LARGEST]
    frequency, own = ours.frequency[order], ours.amplitude[order]
    names = models.ladder
    found = np.array([models.transfer(name, frequency) * own for name in names])
    spread = np.array([models.half_width(name, frequency) * np.abs(own) for name in names])
    within, without = phases(found)
    iau_within, iau_without = phases(theirs.amplitude[order])
    error = amplitude_error(frequency)
    return build(
        TERMS,
        {
            "period": 2 * np.pi / frequency,
            "predicted_in_phase": within,
            "predicted_out_of_phase": without,
            "predicted_error": np.hypot(spread, error),
            "iau_in_phase": iau_within,
            "iau_out_of_phase": iau_without,
            "amplitude_error": error,
        },
        coords={
            "rung": names,
            "term": [" ".join(f"{m:+d}" for m in multiple) for multiple in ours.multiples[order]],
        },
    )


_MODE = ("mode",)
MODES = {
    "mode_rung": Variable(_MODE, "", "rung that has the mode"),
    "mode_name": Variable(_MODE, "", "name of the mode"),
    **with_error(
        "mode_period",
        Variable(
            _MODE, "d", "period: of a nutation in space, negative if retrograde; else in the body"
        ),
    ),
    "mode_quality": Variable(
        _MODE,
        "1",
        "quality factor of the mode; infinite where nothing is lost",
        no_error="it follows from published quality factors, which have none",
    ),
}


@part(gives=MODES)
def modes(models: Prediction) -> xr.Dataset:
    """Free modes of each rung; a mode that a rung does not have is not among them."""
    from earthspin.interior.rotation import mode_period
    from earthspin.nutation import ladder

    rows = []
    for name in models.ladder:
        rung = models.rungs[name]
        widths = rung.mode_half_widths(models.uncertainty)
        for mode, s in rung.modes().items():
            period = mode_period(mode, s, models.spin_rate)
            relative = widths[mode] / abs(1 + s.real if mode.endswith("nutation") else s.real)
            rows.append((name, mode, period, abs(period) * relative, ladder.quality(s)))
    rungs, names, periods, errors, qualities = zip(*rows, strict=True)
    return build(
        MODES,
        {
            "mode_rung": np.array(rungs),
            "mode_name": np.array(names),
            "mode_period": np.array(periods),
            "mode_period_error": np.array(errors),
            "mode_quality": np.array(qualities),
        },
        coords={"mode": [f"{rung} {name}" for rung, name in zip(rungs, names, strict=True)]},
    )


#: Frequencies of the transfer function in the body, turns per turn: dense about -1.
_IN_SPACE = np.concatenate([-np.geomspace(0.1, 2e-4, 240), np.geomspace(2e-4, 0.1, 240)])
_SEEN = "the section terms gives errors at the frequencies of nutation"
TRANSFER = {
    "transfer_real": Variable(
        ("rung", "frequency"), "1", "nutation over that of a rigid body, real part", no_error=_SEEN
    ),
    "transfer_imaginary": Variable(
        ("rung", "frequency"), "1", "nutation over that of a rigid body, imaginary part",
        no_error=_SEEN,
    ),
}  # fmt: skip


@part(gives=TRANSFER)
def transfer(models: Prediction) -> xr.Dataset:
    """The transfer function of each rung, through its resonances."""
    names = models.ladder
    found = np.array([models.rungs[name].transfer(_IN_SPACE - 1, models.e) for name in names])
    frequency = {"units": "1", "long_name": "frequency in space, turns per turn of the body"}
    return build(
        TRANSFER,
        {"transfer_real": found.real, "transfer_imaginary": found.imag},
        coords={"rung": names, "frequency": ("frequency", _IN_SPACE, frequency)},
    )


RESIDUALS = {
    "dpsi_sineps": Variable(
        ("time", "rung"), "mas",
        "predicted pole minus the IAU's in longitude times sin(eps), straight line removed",
        error="residual_error",
    ),
    "deps": Variable(
        ("time", "rung"), "mas",
        "predicted pole minus the IAU's in obliquity, straight line removed",
        error="residual_error",
    ),
    "residual_error": Variable(
        (), "mas", "95 % half-width of a residual, from H and integration"
    ),
}  # fmt: skip


@part(gives=RESIDUALS)
def residuals(left: Left, models: Prediction) -> xr.Dataset:
    """Predicted pole minus the IAU's in time, rung by rung."""
    series = np.stack([left.series[name] for name in models.ladder], axis=1)
    return build(
        RESIDUALS,
        {
            "dpsi_sineps": series[..., 0],
            "deps": series[..., 1],
            "residual_error": left.error,
        },
        coords={"time": ("time", datetime64(left.days), dict(DATES)), "rung": models.ladder},
    )


COMPLIANCES = without_error(
    "they follow from the layers; the relative uncertainty of the interior is that of k2",
    {"compliance": Variable(("compliance_name",), "1", "answer of a part to a wobble of size 1")},
)


@part(gives=COMPLIANCES)
def compliances(models: Prediction) -> xr.Dataset:
    """Compliances of the elastic body, in the notation of Mathews et al. (1991)."""
    parts = models.rungs["inner-core"].parts(np.array(-1.0))
    found = {name: float(value) for name, value in parts.compliances.items()}
    return build(
        COMPLIANCES,
        {"compliance": list(found.values())},
        coords={"compliance_name": list(found)},
    )


@part
def neglected() -> Neglected:
    """What the last rung leaves out."""
    from earthspin.nutation.ladder import LEFT_OUT

    return Neglected.cited(LEFT_OUT, "change of the largest term that is concerned")


made_of(
    NutationLadder,
    answer=rung_sizes,
    sections={
        "beside": beside,
        "terms": terms,
        "modes": modes,
        "transfer": transfer,
        "compliances": compliances,
        "residuals": residuals,
        "neglected": neglected,
    },
    parts=(places, sky, pulls, epochs, pole_analysis, models, left),
)

nutation_ladder = ask(NutationLadder)
