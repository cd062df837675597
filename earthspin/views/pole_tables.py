"""Tables of the pole in time and of what separates it from the IAU's."""

from __future__ import annotations

import numpy as np
import xarray as xr

from earthspin.views.tables import Table

MAS_PER_CENTURY = 1e5  # of an arcsec/yr

MODELS = {
    "first-order": "first order, angular-momentum axis",
    "rigid": "all effects switched on, figure axis",
    "nonrigid": "the same with the non-rigid response",
}


def path(result: xr.Dataset) -> Table:
    """Where the axes stand at the ends of a path."""
    rows = []
    for index in (0, -1):
        at = result.isel(time=index)
        for axis in result.axis.values:
            of = at.sel(axis=axis)
            row = [
                f"{np.datetime_as_string(at.time.values, unit='s')} {axis.replace('_', ' ')}",
                f"{float(of.X):+.12f}",
                f"{float(of.Y):+.12f}",
            ]
            if "psi" in result:
                row += [f"{float(of.psi):.6f}", f"{float(of.eps):.6f}"]
            rows.append(tuple(row))
    headers: tuple[str, ...] = ("TDB, axis", "X", "Y")
    if "psi" in result:
        headers += ("psi, arcsec", "eps, arcsec")
    return Table(
        "The axes in the GCRS",
        headers,
        rows,
        f"{result.time.size} times. The method is good to "
        f"{float(result.direction_error_method.max()):.2g} uas; the uncertainty of H moves the "
        f"axes by up to {float(result.direction_error_input.max()):.2g} uas on this span (95 %).",
        ("pulls", "axis-path", "pole", "pole-angles"),
    )


def budget(result: xr.Dataset) -> Table:
    """Rates by effect, the sum, and what is left."""
    rates = result[["psi_rate", "psi_rate_published", "omega_rate"]] * MAS_PER_CENTURY
    rows = []
    for effect in result.effect.values:
        of = rates.sel(effect=effect)
        published = float(of.psi_rate_published)
        rows.append(
            (
                str(effect),
                f"{float(of.psi_rate):+.3f}",
                f"{published:+.3f}" if published else "",
                f"{float(of.omega_rate):+.3f}",
            )
        )
    scaled = {
        name: float(result[name]) * MAS_PER_CENTURY
        for name in (
            "psi_rate_total",
            "psi_rate_iau",
            "omega_rate_total",
            "omega_rate_iau",
            "closure",
            "omega_closure",
            "psi_rate_analysis_error",
        )
    }
    rows += [
        (
            "sum",
            f"{scaled['psi_rate_total']:.3f}",
            f"{scaled['psi_rate_iau']:.3f}",
            f"{scaled['omega_rate_total']:+.3f}",
        ),
        (
            "closure, after the published non-linear term",
            f"{scaled['closure']:+.3f}",
            "",
            f"{scaled['omega_closure']:+.3f}",
        ),
    ]
    return Table(
        "Rates at J2000.0, effect by effect",
        ("effect", "psi_A, mas/cy", "published", "omega_A, mas/cy"),
        rows,
        "Each share is measured by switching the effect off; the first order is what remains. "
        "Published: Capitaine, Wallace & Chapront 2003, table 3; in the row of the sum, IAU 2006. "
        "H is fixed, not fitted. H itself comes from observed precession, so that closure tests "
        "consistency, not the theory. The same analysis of the IAU's own pole misses its published "
        f"rate by {scaled['psi_rate_analysis_error']:.2f} mas/cy.",
        ("pole-analysis", "iau-budget"),
    )


def residuals(result: xr.Dataset) -> Table:
    """What is left in time, model by model."""
    rows = []
    for model in result.model.values:
        cells = [MODELS[str(model)]]
        for name in ("residual_rms", "residual_maximum", "residual_rms_unfitted"):
            pair = result[name].sel(model=model)
            cells.append(f"{float(pair[0]):.3f} / {float(pair[1]):.3f}")
        rows.append(tuple(cells))
    first, last = (np.datetime_as_string(t, unit="D") for t in result.time.values[[0, -1]])
    return Table(
        "Our pole less that of IAU 2006/2000A",
        ("model", "rms, mas", "largest, mas", "rms, nothing fitted"),
        rows,
        f"dpsi sin(eps) / deps, {first} to {last}. Fitted and taken away: a constant and a rate in "
        "each. What no integrator can remove is that the body is not rigid.",
        ("iau-residuals",),
    )


def nutation(result: xr.Dataset) -> Table:
    """Circular terms of both poles."""
    rows = []
    for term in result.term.values:
        of = result.sel(term=term)
        rows.append(
            (
                str(term),
                f"{float(of.period):.2f}",
                f"{float(of.rigid_in_phase):.3f}",
                f"{float(of.iau_in_phase):.3f}",
                f"{float(of.iau_out_of_phase):+.3f}",
                f"{float(of.ratio_in_phase):.5f}",
                f"{float(of.ratio_out_of_phase):+.5f}",
                f"{np.hypot(float(of.left_in_phase), float(of.left_out_of_phase)):.1f}",
            )
        )
    return Table(
        "The largest nutations",
        ("l l' F D node", "period, d", "ours", "IAU", "out", "ratio", "out", "left, uas"),
        rows,
        "Circular amplitudes in mas, in phase unless marked 'out'; a negative period is "
        "retrograde. Ours is rigid; the ratio is IAU 2000A over ours, and 'left' is what the "
        "fitted resonance form does not explain. The prograde year is not fitted: IAU 2000A holds "
        "an atmospheric tide of 0.11 mas there.",
        ("pole-analysis", "core-response", "nutation-table"),
    )


def core(result: xr.Dataset) -> Table:
    """The free core nutation."""
    return Table(
        "Free core nutation in IAU 2000A",
        ("", "recovered", "built in"),
        [
            ("period in space, d", f"{float(result.core_nutation_period):.2f}", "-430.21"),
            ("quality factor", f"{float(result.core_nutation_quality):.0f}", "20,000"),
        ],
        "IAU 2000A is a response times a rigid series: the fit recovers what was built into it and "
        f"measures nothing anew. All terms: {float(result.response_rms):.1f} uas rms left, at most "
        f"{float(result.response_maximum):.0f}.",
        ("core-response", "core-resonance"),
    )


def angles(result: xr.Dataset) -> Table:
    """Polynomials of the angles."""
    rows = []
    for angle in result.angle.values:
        for whose, name in (("ours", "angle_coefficient"), ("IAU", "angle_coefficient_iau")):
            of = result[name].sel(angle=angle)
            rows.append(
                (f"{angle}, {whose}", *(f"{float(of.sel(degree=d)):.6f}" for d in range(4)))
            )
    return Table(
        "Angles of precession",
        ("angle", "arcsec", "t", "t2", "t3"),
        rows,
        "Coefficients in arcsec, t in Julian centuries from J2000.0, over the stretch that was "
        "analysed. eps_A, chi_A and p_A need the ecliptic of date, which torques cannot give: it "
        "is that of IAU 2006. The IAU's line is its own angles, fitted alike.",
        ("precession-angles",),
    )


def flattening(result: xr.Dataset) -> Table:
    """H and C from three origins."""
    rows = []
    for origin in result.origin.values:
        of = result.sel(origin=origin)
        error = float(of.flattening_error)
        rows.append(
            (
                str(origin),
                f"{float(of.flattening):.10f}" + (f" ± {error:.10f}" if error else ""),
                f"{float(of.polar_moment):.7f}",
            )
        )
    return Table(
        "H and C that the rate implies",
        ("origin", "H = (C-A)/C", "C/(M a2)"),
        rows,
        "PREM gives C from densities and not from the pole, though the observed moment was among "
        "its data; its H is J2 over that C.",
        ("inferred-flattening",),
    )
