"""Our pole in time beside that of IAU 2006/2000A: budget, residuals, nutations, angles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from earthspin.bodies import IAU_2006
from earthspin.dataset import Variable
from earthspin.scene.part import Part
from earthspin.scene.parts.axes_in_time import pole_times
from earthspin.scene.parts.torque_at_times import TIME

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

    from earthspin.compare.analysis import PoleAnalysis, Secular
    from earthspin.compare.nutation import Circles
    from earthspin.compare.response import Response
    from earthspin.motion.axes import AxisPath
    from earthspin.scene.spec import Scene

#: Half of the stretch about J2000.0 that is analysed, as far as the kernel has it: four turns of
#: the node each way, in which slow changes are a short polynomial.
HALF_SPAN = 27200.0  # d
SAMPLING = 4.0  # d
#: The terms of the nutation table.
LARGEST = 30


@dataclass(frozen=True)
class Analysed:
    """Our pole and the IAU's, analysed alike.

    Attributes
    ----------
    days : ndarray, shape (t,)
    start : ndarray, shape (3,)
        Axis to start with so that our mean pole meets the IAU's at J2000.0.
    path : AxisPath
        With all effects of the scene.
    analysis : PoleAnalysis
    ours, theirs : Secular
    our_circles, their_circles : Circles
    """

    days: NDArray[np.float64]
    start: NDArray[np.float64]
    path: AxisPath
    analysis: PoleAnalysis
    ours: Secular
    theirs: Secular
    our_circles: Circles
    their_circles: Circles

    def pole(self, path: AxisPath, days: NDArray[np.float64], axis: str = "figure") -> Any:
        """Unit vectors of one axis without the semidiurnal motion."""
        from earthspin.constants import DAY

        return path.at(days * DAY, semidiurnal=False)[axis]


def analyse(scene: Scene, given: Mapping[str, Any]) -> Analysed:
    """Follow the pole, start it where the mean poles meet, and analyse it with the IAU's."""
    import numpy as np

    from earthspin.compare.analysis import PoleAnalysis, shifted_start
    from earthspin.compare.nutation import complex_nutation
    from earthspin.constants import DAY
    from earthspin.progress import progress
    from earthspin.scene.parts.pulls import start_of
    from earthspin.sky import iau

    pulls = given["pulls"]
    low, high = (limit / DAY for limit in pulls.limits)
    days = np.arange(max(low, -HALF_SPAN), min(high, HALF_SPAN), SAMPLING)
    effects = [e for e in scene.effects or () if e != "nonrigid"]
    start, _ = start_of(scene, pulls)

    def follow(start: Any) -> tuple[AxisPath, Any]:
        path = _path(scene, pulls, effects, start, days)
        return path, path.at(days * DAY, semidiurnal=False)["figure"]

    with progress("analysis", 4) as advance:
        analysis = PoleAnalysis(
            days, iau.delaunay_arguments(days), iau.delaunay_rates(), iau.fixed_ecliptic()
        )
        advance(1)
        theirs = analysis.secular(iau.true_pole(days))
        advance(1)
        _, pole = follow(start)
        start = shifted_start(start, analysis.secular(pole), theirs, analysis.ecliptic)
        path, pole = follow(start)
        advance(1)
        their_circles = analysis.circles(complex_nutation(iau.nutation_2000a(days)))
        advance(1)
    return Analysed(
        days=days,
        start=start,
        path=path,
        analysis=analysis,
        ours=analysis.secular(pole),
        theirs=theirs,
        our_circles=analysis.circles(complex_nutation(iau.nutation_of(pole, days))),
        their_circles=their_circles,
    )


def _path(scene: Scene, pulls: Any, effects: Any, start: Any, days: Any) -> AxisPath:
    """Axes over some days, the sky kept for the next run over the same."""
    from earthspin.constants import DAY
    from earthspin.motion.axes import axis_path
    from earthspin.scene.parts.pulls import forces_of, start_of

    _, epoch = start_of(scene, pulls)
    forces = forces_of(scene, pulls, effects, keep=True)
    return axis_path(forces, start, epoch, (days[0] * DAY, days[-1] * DAY), limits=pulls.limits)


def budget(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Rates at J2000.0, effect by effect, each measured by switching it off."""
    from earthspin.compare import budget as book
    from earthspin.dataset import build
    from earthspin.progress import progress
    from earthspin.sky.iau import precession_rates

    iau_rate = precession_rates(0.0).psi_a
    done, pulls = given["pole-analysis"], given["pulls"]
    effects = [e for e in scene.effects or () if e != "nonrigid"]
    psi: dict[str, float] = {}
    omega: dict[str, float] = {}
    with progress("budget", len(effects)) as advance:
        for effect in effects:
            rest = [e for e in effects if e != effect]
            path = _path(scene, pulls, rest, done.start, done.days)
            without = done.analysis.secular(done.pole(path, done.days))
            psi[effect], omega[effect] = without.psi_rate, without.omega_rate
            advance(1)
    psi_by_effect = book.contributions(done.ours.psi_rate, psi)
    omega_by_effect = book.contributions(done.ours.omega_rate, omega)
    # A transfer function leaves what is slow alone: T = 1 at rest in space.
    names = [*psi_by_effect, "nonrigid"]
    return build(
        "iau-budget",
        IAU_BUDGET.gives,
        {
            "psi_rate": [psi_by_effect.get(name, 0.0) for name in names],
            "psi_rate_published": list(book.published_contributions(names).values()),
            "omega_rate": [omega_by_effect.get(name, 0.0) for name in names],
            "psi_rate_total": done.ours.psi_rate,
            "omega_rate_total": done.ours.omega_rate,
            "psi_rate_iau": iau_rate,
            "omega_rate_iau": book.iau_omega_rate(),
            "closure": book.full_closure(done.ours.psi_rate, iau_rate),
            "omega_closure": done.ours.omega_rate - book.iau_omega_rate(),
            "psi_rate_analysis_error": abs(done.theirs.psi_rate - iau_rate),
            "omega_rate_analysis_error": abs(done.theirs.omega_rate - book.iau_omega_rate()),
        },
        coords={"effect": names},
    )


def fit_core(scene: Scene, given: Mapping[str, Any]) -> Response:
    """Resonance form through the ratios of the largest terms."""
    import numpy as np

    from earthspin.compare.response import SUN_SYNCHRONOUS, fit_response

    done = given["pole-analysis"]
    ours, theirs = done.our_circles, done.their_circles
    used = np.any(ours.multiples != SUN_SYNCHRONOUS, axis=1)
    return fit_response(
        ours.frequency[used],
        ours.amplitude[used],
        theirs.amplitude[used],
        float(scene.body.dynamical_flattening),
        float(scene.body.spin_rate),
    )


@dataclass(frozen=True)
class Shift:
    """What the non-rigid response adds to the figure and rotation axes."""

    circles: Circles

    def eta(self, days: NDArray[np.float64]) -> Any:
        """Shift as dpsi sin(eps0) + i deps, rad."""
        from earthspin.sky import iau

        return self.circles.at(iau.delaunay_arguments(days))

    def apply(self, axes: dict[str, NDArray[np.float64]], days: NDArray[np.float64]) -> None:
        """Move the axes of the mantle in place; the angular momentum is not changed."""
        from earthspin.sky.iau import moved_by_nutation

        eta = self.eta(days)
        for name in ("rotation", "figure"):
            axes[name] = moved_by_nutation(axes[name], eta, days)


def nonrigid_shift(scene: Scene, given: Mapping[str, Any]) -> Shift:
    """Non-rigid less rigid nutation, as a sum of circles."""
    from dataclasses import replace

    circles, response = given["pole-analysis"].our_circles, given["core-response"]
    factor = response.transfer(circles.frequency) - 1
    return Shift(replace(circles, amplitude=circles.amplitude * factor))


def residuals(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Our pole less the IAU's in time, for three models, constant and rate removed."""
    import numpy as np

    from earthspin.compare.nutation import complex_nutation, without_line
    from earthspin.dataset import build
    from earthspin.sky import iau
    from earthspin.units import datetime64

    done, pulls, times = given["pole-analysis"], given["pulls"], pole_times(scene)
    days = times.days(0, times.size)
    first, last = times.span()
    ends = np.array([min(first, 0.0), max(last, 0.0)])
    pulls.sky.ephemeris.check_times(ends[[0, 1]], {*pulls.targets.values(), pulls.sky.centre})
    effects = [e for e in scene.effects or () if e != "nonrigid"]
    iau_eta = complex_nutation(iau.nutation_of(iau.true_pole(days), days))

    def eta_of(effects: list[str], axis: str) -> Any:
        path = _path(scene, pulls, effects, done.start, ends)
        return complex_nutation(iau.nutation_of(done.pole(path, days, axis), days))

    rigid = eta_of(effects, "figure")
    models = {
        "first-order": eta_of([], "angular_momentum"),
        "rigid": rigid,
        "nonrigid": rigid + given["nonrigid-shift"].eta(days),
    }
    left = np.stack([model - iau_eta for model in models.values()], axis=1)
    plain = np.stack([left.real, left.imag], axis=-1)
    fitted = without_line(days / 36525.0, plain.reshape(days.size, -1)).reshape(plain.shape)
    chosen = fitted[:, 2 if "nonrigid" in (scene.effects or ()) else 1]
    return build(
        "iau-residuals",
        IAU_RESIDUALS.gives,
        {
            "dpsi_sineps": chosen[:, 0],
            "deps": chosen[:, 1],
            "dpsi_sineps_by_model": fitted[..., 0],
            "deps_by_model": fitted[..., 1],
            "residual_rms": np.sqrt(np.mean(fitted**2, axis=0)),
            "residual_maximum": np.max(np.abs(fitted), axis=0),
            "residual_rms_unfitted": np.sqrt(np.mean(plain**2, axis=0)),
        },
        coords={
            "time": ("time", datetime64(days), dict(TIME)),
            "model": list(models),
            "direction": ["dpsi_sineps", "deps"],
        },
    )


def nutation_table(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """The largest circular terms of both poles, their ratio, and what the response leaves."""
    import numpy as np

    from earthspin.compare.nutation import phases
    from earthspin.dataset import build

    done, response = given["pole-analysis"], given["core-response"]
    ours, theirs = done.our_circles, done.their_circles
    order = np.argsort(-np.abs(ours.amplitude))[:LARGEST]
    rigid, real = ours.amplitude[order], theirs.amplitude[order]
    transfer = response.transfer(ours.frequency[order])
    values: dict[str, Any] = {"period": 2 * np.pi / ours.frequency[order]}
    for name, amplitude in (("rigid", rigid), ("iau", real), ("left", real - transfer * rigid)):
        values[f"{name}_in_phase"], values[f"{name}_out_of_phase"] = phases(amplitude)
    ratio = real / rigid
    values |= {
        "ratio_in_phase": ratio.real,
        "ratio_out_of_phase": ratio.imag,
        "transfer_in_phase": transfer.real,
        "transfer_out_of_phase": transfer.imag,
    }
    labels = [" ".join(f"{m:+d}" for m in multiple) for multiple in ours.multiples[order]]
    return build("nutation-table", NUTATION_TABLE.gives, values, coords={"term": labels})


def core_resonance(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """The free core nutation that the ratios imply."""
    import numpy as np

    from earthspin.dataset import build

    done, response = given["pole-analysis"], given["core-response"]
    ours, theirs = done.our_circles, done.their_circles
    left = theirs.amplitude - response.transfer(ours.frequency) * ours.amplitude
    return build(
        "core-resonance",
        CORE_RESONANCE.gives,
        {
            "core_nutation_period": response.period,
            "core_nutation_quality": response.quality,
            "strength_real": response.strengths.real,
            "strength_imaginary": response.strengths.imag,
            "response_rms": float(np.sqrt(np.mean(np.abs(left) ** 2))),
            "response_maximum": float(np.max(np.abs(left))),
        },
        coords={"mode": ["constant", "chandler", "core", "inner-core"]},
    )


def angles(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """Angles of precession of our mean pole and of the IAU's, as polynomials."""
    import numpy as np

    from earthspin.compare.angles import ANGLES, precession_angles
    from earthspin.compare.nutation import SLOW_DEGREE
    from earthspin.dataset import build
    from earthspin.sky import iau

    done = given["pole-analysis"]
    t = done.days / 36525.0
    psi, omega = done.ours.at(t)
    ours = precession_angles(psi, omega, iau.ecliptic_of_date(done.days))
    powers = t[:, np.newaxis] ** np.arange(SLOW_DEGREE + 1)
    scaled = np.linalg.lstsq(powers, ours, rcond=None)[0].T
    theirs = np.linalg.lstsq(powers, iau.precession_angles(done.days), rcond=None)[0].T
    return build(
        "precession-angles",
        PRECESSION_ANGLES.gives,
        {"angle_coefficient": scaled, "angle_coefficient_iau": theirs},
        coords={"angle": list(ANGLES), "degree": np.arange(SLOW_DEGREE + 1.0)},
    )


def inferred(scene: Scene, given: Mapping[str, Any]) -> xr.Dataset:
    """H and C as the IAU's rate implies them, beside others'."""
    import numpy as np

    from earthspin.compare import flattening as flat
    from earthspin.constants import NORMAL_95, PREM_MEAN_MOMENT, PREM_RADIUS
    from earthspin.dataset import build, si

    rates, body = given["iau-budget"], scene.body
    h, j2 = float(body.dynamical_flattening), float(body.j2)
    share, known = si(rates.psi_rate), si(rates.psi_rate_published)
    compared = [e for e in rates.effect.values if e in flat.COMPARED]
    spread = float(np.sqrt(((share - known).sel(effect=compared) ** 2).sum()))
    # Geodesic precession alone does not grow with H.
    grows = float(share.where(rates.effect != "geodesic", 0.0).sum())
    new = flat.inferred_h(h, grows, float(si(rates.closure)))
    u = flat.inferred_h_uncertainty(h, grows, spread, float(si(rates.psi_rate_analysis_error)))
    u_h = h * body.relative_uncertainty.get("dynamical_flattening", 0.0)
    prem = flat.polar_moment_from_mean(
        PREM_MEAN_MOMENT.value, PREM_RADIUS.value, float(body.radius), j2
    )
    moments = [flat.polar_moment_from_h(j2, h), flat.polar_moment_from_h(j2, new), prem]
    return build(
        "inferred-flattening",
        INFERRED.gives,
        {
            "flattening": [h, new, j2 / prem],
            "flattening_error": [NORMAL_95 * u_h, NORMAL_95 * u, 0.0],
            "polar_moment": moments,
        },
        coords={"origin": ["published", "from the IAU's rate", "PREM"]},
    )


def _needs_iau(scene: Scene) -> str | None:
    if scene.body.pole != IAU_2006:
        return f"no IAU model of the pole of {scene.body.name}"
    return None


def _needs_nonrigid(scene: Scene) -> str | None:
    if scene.compute != "iau" and "nonrigid" not in (scene.effects or ()):
        return "the non-rigid response is switched off"
    return _needs_iau(scene)


_EFFECT = ("effect",)
_TERM = ("term",)
_MODEL = ("model", "direction")

POLE_ANALYSIS = Part(
    name="pole-analysis",
    does="our pole and the IAU's over 150 years, started alike, analysed alike",
    function="earthspin.scene.parts.iau_pole:analyse",
    needs=("pulls",),
    left_out=_needs_nonrigid,
    keys=("body", "perturbers", "effects", "ephemeris", "compute"),
)

CORE_RESPONSE = Part(
    name="core-response",
    does="resonance form fitted to IAU 2000A over our rigid amplitudes",
    function="earthspin.scene.parts.iau_pole:fit_core",
    needs=("pole-analysis",),
    left_out=_needs_nonrigid,
)

NONRIGID_SHIFT = Part(
    name="nonrigid-shift",
    does="what the fluid core and the yielding mantle add to the rigid nutations",
    function="earthspin.scene.parts.iau_pole:nonrigid_shift",
    needs=("core-response",),
    left_out=_needs_nonrigid,
)

IAU_BUDGET = Part(
    name="iau-budget",
    does="rates at J2000.0 effect by effect, beside the published ones; the closure",
    function="earthspin.scene.parts.iau_pole:budget",
    needs=("pole-analysis",),
    gives={
        "psi_rate": Variable(
            _EFFECT, "arcsec/yr", "contribution to the rate of psi_A at J2000.0, by switching"
        ),
        "psi_rate_published": Variable(
            _EFFECT, "arcsec/yr", "published contribution; 0 where the table has none"
        ),
        "omega_rate": Variable(_EFFECT, "arcsec/yr", "contribution to the rate of omega_A"),
        "psi_rate_total": Variable((), "arcsec/yr", "our rate of psi_A at J2000.0"),
        "omega_rate_total": Variable((), "arcsec/yr", "our rate of omega_A at J2000.0"),
        "psi_rate_iau": Variable((), "arcsec/yr", "rate of psi_A at J2000.0, IAU 2006"),
        "omega_rate_iau": Variable((), "arcsec/yr", "rate of omega_A at J2000.0, IAU 2006"),
        "closure": Variable(
            (), "arcsec/yr", "our rate plus the published non-linear term less the IAU's"
        ),
        "omega_closure": Variable((), "arcsec/yr", "our rate of omega_A less the IAU's"),
        "psi_rate_analysis_error": Variable(
            (), "arcsec/yr", "by what the analysis misses the rate of the IAU's own pole"
        ),
        "omega_rate_analysis_error": Variable(
            (), "arcsec/yr", "by what the analysis misses the IAU's rate of omega_A"
        ),
    },
)

IAU_RESIDUALS = Part(
    name="iau-residuals",
    does="our pole less the IAU's in time, for three models",
    function="earthspin.scene.parts.iau_pole:residuals",
    needs=("pole-analysis", "nonrigid-shift"),
    keys=("span", "step", "times"),
    gives={
        "dpsi_sineps": Variable(
            ("time",), "mas", "our pole less the IAU's in longitude times sin(eps), line removed"
        ),
        "deps": Variable(("time",), "mas", "our pole less the IAU's in obliquity, line removed"),
        "dpsi_sineps_by_model": Variable(
            ("time", "model"), "mas", "the same in longitude, for three models"
        ),
        "deps_by_model": Variable(
            ("time", "model"), "mas", "the same in obliquity, for three models"
        ),
        "residual_rms": Variable(_MODEL, "mas", "root mean square after constant and rate"),
        "residual_maximum": Variable(_MODEL, "mas", "largest after constant and rate"),
        "residual_rms_unfitted": Variable(_MODEL, "mas", "root mean square with nothing fitted"),
    },
)

NUTATION_TABLE = Part(
    name="nutation-table",
    does="the thirty largest circular terms of both poles, and their ratio",
    function="earthspin.scene.parts.iau_pole:nutation_table",
    needs=("pole-analysis", "core-response"),
    gives={
        "period": Variable(_TERM, "d", "period of the circle in space, negative if retrograde"),
        "rigid_in_phase": Variable(_TERM, "mas", "our rigid amplitude, in phase"),
        "rigid_out_of_phase": Variable(_TERM, "mas", "our rigid amplitude, out of phase"),
        "iau_in_phase": Variable(_TERM, "mas", "amplitude of IAU 2000A, in phase"),
        "iau_out_of_phase": Variable(_TERM, "mas", "amplitude of IAU 2000A, out of phase"),
        "ratio_in_phase": Variable(_TERM, "1", "IAU 2000A over ours, real part"),
        "ratio_out_of_phase": Variable(_TERM, "1", "IAU 2000A over ours, imaginary part"),
        "transfer_in_phase": Variable(_TERM, "1", "fitted resonance form, real part"),
        "transfer_out_of_phase": Variable(_TERM, "1", "fitted resonance form, imaginary part"),
        "left_in_phase": Variable(_TERM, "uas", "IAU less response times ours, in phase"),
        "left_out_of_phase": Variable(_TERM, "uas", "IAU less response times ours, out of phase"),
    },
)

CORE_RESONANCE = Part(
    name="core-resonance",
    does="period and quality of the free core nutation recovered from IAU 2000A",
    function="earthspin.scene.parts.iau_pole:core_resonance",
    needs=("pole-analysis", "core-response"),
    gives={
        "core_nutation_period": Variable((), "d", "period of the free core nutation in space"),
        "core_nutation_quality": Variable((), "1", "quality factor of the free core nutation"),
        "strength_real": Variable(("mode",), "1", "fitted strength, real part"),
        "strength_imaginary": Variable(("mode",), "1", "fitted strength, imaginary part"),
        "response_rms": Variable((), "uas", "root mean square of what the response leaves"),
        "response_maximum": Variable((), "uas", "largest that the response leaves"),
    },
)

PRECESSION_ANGLES = Part(
    name="precession-angles",
    does="psi_A, omega_A, eps_A, chi_A, p_A as polynomials, with the ecliptic of IAU 2006",
    function="earthspin.scene.parts.iau_pole:angles",
    needs=("pole-analysis",),
    gives={
        name: Variable(("angle", "degree"), "arcsec", f"coefficient of (t/century)^degree, {whose}")
        for name, whose in (
            ("angle_coefficient", "our pole on the ecliptic of IAU 2006"),
            ("angle_coefficient_iau", "IAU 2006, fitted alike"),
        )
    },
)

INFERRED = Part(
    name="inferred-flattening",
    does="H and C/(M a2) that the IAU's rate implies, beside the published ones and PREM",
    function="earthspin.scene.parts.iau_pole:inferred",
    needs=("iau-budget",),
    gives={
        "flattening": Variable(("origin",), "1", "dynamical flattening H"),
        "flattening_error": Variable(
            ("origin",), "1", "95 % half-width of the dynamical flattening H, where it is known"
        ),
        "polar_moment": Variable(("origin",), "1", "C/(M a2)"),
    },
)
