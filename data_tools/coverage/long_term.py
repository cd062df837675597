"""Coverage of the half-widths of `long_term`: solutions with all causes changed, drawn afresh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import earthspin
from data_tools.coverage import Row
from data_tools.long_term import solution
from earthspin.bodies import EARTH, MARS, Body
from earthspin.constants import ARCSEC, JULIAN_YEAR, NORMAL_95
from earthspin.secular.budget import changed
from earthspin.secular.reading import angle, followed_perihelion, moved_by, read
from earthspin.secular.trajectory import solve

FloatArray = NDArray[np.float64]

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
    """By body, quantity and million years: fresh members inside the half-widths."""
    return [row for body, reach in ((EARTH, 10), (MARS, 10)) for row in of_body(body, reach)]


def of_body(body: Body, reach: int, members: int = MEMBERS, seed: int = SEED) -> list[Row]:
    """Rows of a body, `reach` million years either way."""
    claimed = earthspin.long_term(
        f"-{reach} Myr", f"{reach} Myr", f"{STEP} kyr", body=body, perturbers=_pulling(body)
    )
    times = claimed.epoch.values * JULIAN_YEAR
    solved = solution(body, times)
    fixed = body.needed("pole").orbit_axes(body.orbit_pole)
    perihelion = followed_perihelion(solved.setting.orbit, np.append(times, 0.0), fixed)
    mine = read(solved.path, solved.setting, times, fixed, perihelion)
    half = {name: claimed[f"{name}_error"].values * unit for name, unit in QUANTITIES.items()}
    worst = {name: np.zeros(times.size) for name in QUANTITIES}
    inside = {name: np.zeros(times.size) for name in QUANTITIES}
    draws = np.random.default_rng(seed).standard_normal((members, len(solved.uncertainty.causes)))
    for amounts in draws / NORMAL_95:
        setting = changed(solved.setting, solved.uncertainty, amounts)
        span = float(times[0]), float(times[-1])
        path = solve(setting.strength, setting.orbit, setting.start, span)
        member = read(path, setting, times, fixed, perihelion)
        for name, width in half.items():
            apart = (
                angle(member.pole, mine.pole)
                if name == "pole"
                else np.abs(moved_by(member, mine, name))
            )
            ratio = apart / width
            worst[name] = np.maximum(worst[name], ratio)
            inside[name] += ratio <= 1
    years = np.abs(claimed.epoch.values) / 1e3
    found = []
    for name in QUANTITIES:
        for first in range(0, 1000 * reach, BIN):
            for sign, word in ((-1, "before"), (1, "after")):
                at = (years > first) & (years <= first + BIN)
                at &= np.sign(claimed.epoch.values) == sign
                stretch = f"{first // 1000} to {(first + BIN) // 1000} Myr {word} J2000.0"
                found.append(
                    Row(
                        f"`{name}` of {body.name.title()}",
                        stretch,
                        "members with all causes drawn afresh",
                        float(worst[name][at].max()),
                        float(inside[name][at].mean() / members),
                        members * int(at.sum()),
                    )
                )
    return found


def _pulling(body: Body) -> tuple[str, ...]:
    return ("sun", "moon") if body == EARTH else ("sun",)
