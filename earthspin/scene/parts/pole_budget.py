"""Rates of our pole effect by effect, beside the IAU's, and the H that they imply."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Variable
from earthspin.scene.part import Part
from earthspin.scene.parts.pole_analysis import path_over

if TYPE_CHECKING:
    import xarray as xr

    from earthspin.scene.spec import Scene


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
            path = path_over(scene, pulls, rest, done.start, done.days)
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


_EFFECT = ("effect",)

IAU_BUDGET = Part(
    name="iau-budget",
    does="rates at J2000.0 effect by effect, beside the published ones; the closure",
    function="earthspin.scene.parts.pole_budget:budget",
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

INFERRED = Part(
    name="inferred-flattening",
    does="H and C/(M a2) that the IAU's rate implies, beside the published ones and PREM",
    function="earthspin.scene.parts.pole_budget:inferred",
    needs=("iau-budget",),
    gives={
        "flattening": Variable(("origin",), "1", "dynamical flattening H"),
        "flattening_error": Variable(
            ("origin",), "1", "95 % half-width of the dynamical flattening H, where it is known"
        ),
        "polar_moment": Variable(("origin",), "1", "C/(M a2)"),
    },
)
