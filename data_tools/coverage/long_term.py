"""Coverage of the half-widths of `long_term`: IAU 2006, and solutions drawn afresh."""

from __future__ import annotations

import erfa
import numpy as np
from astropy import units

import earthspin
from data_tools.coverage import Row
from earthspin.bodies import EARTH, MARS, MOON, SUN, Body
from earthspin.constants import ARCSEC, DAYS_PER_YEAR, J2000_JD, JULIAN_YEAR, NORMAL_95
from earthspin.numerics.arrays import FloatArray
from earthspin.questions import averages, long_term
from earthspin.questions import long_term as question
from earthspin.questions import sky as skies
from earthspin.scenes import load_scene
from earthspin.secular.derived_angles import angle, change, derive, followed_perihelion
from earthspin.secular.error_budget import AxisFamily, changed
from earthspin.secular.trajectory import solve

#: Members, their seed, and the step between epochs, kyr.
MEMBERS, SEED, STEP = 1000, 20260101, 10
#: What is compared, and the unit of its half-width.
DEGREES = np.pi / 180
QUANTITIES = {
    "obliquity": DEGREES,
    "climatic_precession": 1.0,
    "longitude_of_perihelion": DEGREES,
    "general_precession": DEGREES,
    "psi_A": DEGREES,
    "eccentricity": 1.0,
    "pole": ARCSEC,
}
#: Epochs, kyr, are counted in bins as long as this.
BIN = 1000


def rows() -> list[Row]:
    """Beside IAU 2006; by body, quantity and million years, fresh members."""
    return [*beside_iau(), *of_body(EARTH, 10), *of_body(MARS, 10)]


def beside_iau() -> list[Row]:
    """Angles and poles beside ERFA's p06e, pmat06 and ecm06, every ten years."""
    years = np.arange(-1000.0, 1001.0, 10.0)
    claimed = earthspin.long_term(times=years * units.yr)
    days = DAYS_PER_YEAR * years
    angles = erfa.p06e(J2000_JD, days)
    apart = {
        name: np.abs(claimed[name].values - np.degrees(angles[place]))
        for name, place in (
            ("psi_A", 1),
            ("omega_A", 2),
            ("obliquity", 7),
            ("general_precession", 12),
        )
    }
    for name, matrix in (("pole", erfa.pmat06), ("ecliptic_pole", erfa.ecm06)):
        published = matrix(J2000_JD, days)[:, 2]
        apart[name] = np.linalg.norm(claimed[name].values - published, axis=1) / ARCSEC
    return [
        Row.comparing(
            f"`{name}` of Earth",
            "1,000 years either way",
            "IAU 2006 (ERFA)",
            difference,
            claimed[f"{name}_error"].values,
        )
        for name, difference in apart.items()
    ]


def solution(body: Body, times: FloatArray) -> AxisFamily:
    """The axis of a body at times (s), and with each cause changed, as the question solves it."""
    scene = load_scene("long-term")
    assert isinstance(scene, question.LongTerm)
    perturbers = (SUN, MOON) if body == EARTH else (SUN,)
    sky = skies.sky(scene.ephemeris, skies.places(body, perturbers), scene.source)
    samples = averages.torque_samples(sky, question.interval(sky), body, perturbers)
    means = averages.mean_torques(averages.window_means(samples, perturbers))
    rates = averages.mean_rates(means, body, perturbers)
    table = long_term.orbit_table("own", body)
    numbers = question.inputs(rates, body, perturbers, 1.0, 1.0, None, 0.0, 0.0)
    strength = question.precession_constant(numbers, means, body, table)
    return question.solved_axes(strength, numbers, table, times, body, rates)


def of_body(body: Body, reach: int, members: int = MEMBERS, seed: int = SEED) -> list[Row]:
    """Rows of a body, `reach` million years either way."""
    claimed = earthspin.long_term(
        f"-{reach} Myr", f"{reach} Myr", f"{STEP} kyr", body=body, perturbers=_pulling(body)
    )
    times = claimed.epoch.values * JULIAN_YEAR
    solved = solution(body, times)
    fixed = body.needed("pole").orbit_axes(body.orbit_pole)
    perihelion = followed_perihelion(solved.setting.orbit, np.append(times, 0.0), fixed)
    mine = derive(solved.path, solved.setting, times, fixed, perihelion)
    half = {name: claimed[f"{name}_error"].values * unit for name, unit in QUANTITIES.items()}
    ratios = {name: np.empty((members, times.size), np.float32) for name in QUANTITIES}
    draws = np.random.default_rng(seed).standard_normal((members, len(solved.uncertainty.causes)))
    for row, amounts in enumerate(draws / NORMAL_95):
        setting = changed(solved.setting, solved.uncertainty, amounts)
        span = float(times[0]), float(times[-1])
        path = solve(setting.precession, setting.orbit, setting.start, span)
        member = derive(path, setting, times, fixed, perihelion)
        for name, width in half.items():
            apart = (
                angle(member.pole, mine.pole)
                if name == "pole"
                else np.abs(change(member, mine, name))
            )
            ratios[name][row] = apart / width
    years = np.abs(claimed.epoch.values) / 1e3
    rows = []
    for name in QUANTITIES:
        for first in range(0, 1000 * reach, BIN):
            for sign, word in ((-1, "before"), (1, "after")):
                at = (years > first) & (years <= first + BIN)
                at &= np.sign(claimed.epoch.values) == sign
                stretch = f"{first // 1000} to {(first + BIN) // 1000} Myr {word} J2000.0"
                rows.append(
                    Row.comparing(
                        f"`{name}` of {body.name.title()}",
                        stretch,
                        "members with all causes drawn afresh",
                        ratios[name][:, at].ravel(),
                        1.0,
                    )
                )
    return rows


def _pulling(body: Body) -> tuple[str, ...]:
    return ("sun", "moon") if body == EARTH else ("sun",)
