"""Interactive HTML pages, one file each: an animated picture with sliders and numbers.

Their words stand in ``templates/play_NAME.html.j2``; their formulas stand in
``templates/formulas.js`` and are compared with this library's; what they start from, the bodies'
numbers, comes from the library.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np

from earthspin._version import __version__
from earthspin.bodies import EARTH, MOON, SUN, Body
from earthspin.bodies.planets import MOON_ECCENTRICITY, MOON_INCLINATION, SUN_ECCENTRICITY
from earthspin.constants import ARCSEC_PER_YEAR, DAY, SOLAR_CONSTANT
from earthspin.engine import atomic_writes
from earthspin.errors import SceneError
from earthspin.interior.love import elastic, softening
from earthspin.interior.named import INTERIORS
from earthspin.scenes import load_scene, run, run_tree
from earthspin.views import PLAYS
from earthspin.views.page import rendered, source
from earthspin.wobble.ladder import Rotator, inputs_of, love_radius

#: One turn of the Earth, s.
EARTH_TURNS = float(np.asarray(EARTH.spin_period))


def _sky() -> dict[str, object]:
    """Constants of Earth, Sun and Moon (SI, rad) for the interactive page on precession.

    The distances are such that the page's formula gives the computed precession rates.
    """
    answer = run("precession")
    flattening, spin = EARTH.number("dynamical_flattening"), 2 * math.pi / EARTH_TURNS
    obliquity = math.radians(float(answer.obliquity))

    def ellipse(body: Body, e: float, i: float) -> dict[str, object]:
        rate = float(answer.precession_rate.sel(perturber=body.name)) * ARCSEC_PER_YEAR
        # the closed form of the page, solved for the distance
        tilt, gm = math.cos(obliquity) * (1 - 1.5 * math.sin(i) ** 2), body.number("gm")
        distance = (1.5 * flattening / spin * gm / (1 - e**2) ** 1.5 * tilt / rate) ** (1 / 3)
        return {"gm": gm, "distance": distance, "eccentricity": e, "inclination": i}

    return {
        "flattening": flattening,
        "spin": spin,
        "obliquity": obliquity,
        "sun": ellipse(SUN, SUN_ECCENTRICITY.value, 0.0),
        "moon": ellipse(MOON, MOON_ECCENTRICITY.value, math.radians(MOON_INCLINATION.value)),
    }


def _interior() -> dict[str, object]:
    """Constants of the Earth's interior, and observed wobble period, for the page on the wobble."""
    interior = INTERIORS["prem"]
    spin = Rotator(gm=EARTH.gm, radius=EARTH.radius, period=EARTH.spin_period)
    figure = {"dynamical_flattening": EARTH.dynamical_flattening, "j2": EARTH.j2}
    inputs = inputs_of(interior, spin, {**figure, "triaxiality": 0.0})
    assert interior.layers is not None
    assert interior.observed_core_ellipticity is not None
    love, soft = elastic(interior.layers), softening(interior.layers)
    return {
        "flattening": EARTH.dynamical_flattening,
        "strain": spin.centrifugal(love_radius(interior, spin)) / EARTH.j2,
        "day": EARTH_TURNS / DAY,
        "k2": love.k,
        "coreK": love.core_k,
        "kPressure": love.k_pressure,
        "coreKPressure": love.core_k_pressure,
        "coreFraction": inputs.core_fraction,
        "coreEllipticity": interior.observed_core_ellipticity.value,
        "ocean": inputs.ocean,
        "exponent": inputs.anelastic_exponent,
        "softening": [polynomial.coef.tolist() for polynomial in soft],
        "softeningRange": soft[0].domain.tolist(),
        "observed": run_tree("wobble", ["observed"])["observed"].observed_period.item(),
    }


#: Years from J2000.0 whose orbits the page on sunlight offers, and their names.
ORBITS = {
    0: "today",
    -9_000: "9 kyr ago: early Holocene",
    -21_000: "21 kyr ago: last glacial maximum",
    -116_000: "116 kyr ago: glacial inception",
    -125_000: "125 kyr ago: last interglacial",
}


def _sunlight() -> dict[str, object]:
    """Solar constant, and elements of the Earth's orbit today and in the past (deg)."""
    past = run(load_scene("long-term", {"times": [f"{year} yr" for year in ORBITS]}))
    names = ("obliquity", "eccentricity", "longitude_of_perihelion")
    rows = zip(*(past[name].values for name in names), strict=True)
    return {
        "solarConstant": SOLAR_CONSTANT.value,
        "epochs": [
            {"words": words, "obliquity": tilt, "eccentricity": e, "perihelion": perihelion % 360}
            for words, (tilt, e, perihelion) in zip(ORBITS.values(), rows, strict=True)
        ],
    }


#: Functions that return the numbers from which the script of a page starts, if it needs any.
NUMBERS = {"precession": _sky, "sunlight": _sunlight, "wobble": _interior}


def play_page(name: str) -> str:
    """HTML text of the interactive page on one of the topics of `PLAYS`.

    Parameters
    ----------
    name : str
        ``"precession"``, ``"rotor"``, ``"sunlight"``, ``"top"`` or ``"wobble"``.

    Returns
    -------
    str
        HTML, self-contained.

    Raises
    ------
    SceneError
        If there is no such page.
    """
    if name not in PLAYS:
        raise SceneError("play", name, f"take one of {', '.join(PLAYS)}")
    given = json.dumps(NUMBERS.get(name, dict)(), default=lambda number: np.asarray(number).item())
    return rendered(
        f"play_{name}.html.j2",
        given=given.replace("<", "\\u003c"),
        formulas=source("formulas.js"),
        engine=source("touch.js") + source("play.js"),
        script=source(f"play_{name}.js"),
        footer=f"earthspin {__version__}.",
    )


def write_page(name: str, file: str | Path) -> Path:
    """Write an interactive page to an HTML file.

    Parameters
    ----------
    name : str
        See `play_page`.
    file : str or Path

    Returns
    -------
    Path

    Raises
    ------
    SceneError
        If there is no such page.
    OutputError
        If the file cannot be written.
    """
    path, text = Path(file), play_page(name)
    with atomic_writes.replacing(path) as draft:
        draft.write_text(text, encoding="utf-8")
    return path
