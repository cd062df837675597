"""Pages to play with: a picture that moves, its settings, and numbers, in one file each.

Their formulas stand in ``templates/formulas.js`` and are compared with this library's; what they
start from, the bodies' numbers, comes from the library.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from earthspin._version import __version__
from earthspin.bodies import EARTH, MOON, SUN, Body
from earthspin.bodies.mean_orbits import MOON_ECCENTRICITY, MOON_INCLINATION, SUN_ECCENTRICITY
from earthspin.constants import ARCSEC_PER_YEAR, DAY
from earthspin.engine import drafts
from earthspin.errors import SceneError
from earthspin.interior.love import elastic, softening
from earthspin.interior.named import INTERIORS
from earthspin.scenes import run, run_tree
from earthspin.views.page import environment, source
from earthspin.wobble.ladder import Spin, inputs_of, love_radius

#: One turn of the Earth, s.
EARTH_TURNS = float(np.asarray(EARTH.spin_period))


@dataclass(frozen=True)
class Play:
    """A page to play with.

    Attributes
    ----------
    title, lead : str
        Heading, and the sentence below it.
    alternative : str
        What the picture shows, for those who do not see it.
    notes : tuple of str
        What is drawn otherwise than it is, and what is left out.
    given : callable
        Numbers that its script starts from.
    still : bool
        Whether nothing moves in it.
    """

    title: str
    lead: str
    alternative: str
    notes: tuple[str, ...]
    given: Callable[[], dict[str, object]]
    still: bool = False


def _sky() -> dict[str, object]:
    """The Earth, and Sun and Moon on ellipses with the mean torques of the report."""
    answer = run("precession")
    flattening, spin = EARTH.number("dynamical_flattening"), 2 * math.pi / EARTH_TURNS
    obliquity = math.radians(float(answer.obliquity))

    def ellipse(body: Body, eccentricity: float, inclination: float) -> dict[str, object]:
        rate = float(answer.precession_rate.sel(perturber=body.name)) * ARCSEC_PER_YEAR
        # the closed form of the page, solved for the distance
        tilt = math.cos(obliquity) * (1 - 1.5 * math.sin(inclination) ** 2)
        pull = 1.5 * flattening / spin * body.number("gm") / (1 - eccentricity**2) ** 1.5
        return {
            "gm": body.number("gm"),
            "distance": (pull * tilt / rate) ** (1 / 3),
            "eccentricity": eccentricity,
            "inclination": inclination,
        }

    return {
        "flattening": flattening,
        "spin": spin,
        "obliquity": obliquity,
        "sun": ellipse(SUN, SUN_ECCENTRICITY.value, 0.0),
        "moon": ellipse(MOON, MOON_ECCENTRICITY.value, math.radians(MOON_INCLINATION.value)),
    }


def _interior() -> dict[str, object]:
    """What the upper rungs of the Earth's ladder stand on, and the observed period."""
    interior = INTERIORS["prem"]
    spin = Spin(gm=EARTH.gm, radius=EARTH.radius, period=EARTH.spin_period)
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
        "softening": [of.coef.tolist() for of in soft],
        "softeningRange": soft[0].domain.tolist(),
        "observed": run_tree("wobble", ["observed"])["observed"].observed_period.item(),
    }


PLAYS = {
    "precession": Play(
        "Precession, to play with",
        "What if the Moon were heavier, nearer, or not there? Change it, the obliquity and the "
        "flattening, and see how fast the axis goes round, and where the pole goes.",
        "A spinning planet with its axis, the circle that its pole describes about the pole of the "
        "ecliptic, and the Moon on its way round.",
        (
            "The rate is that of Keplerian orbits, with the node of the Moon averaged. The "
            "distances are those that give the mean torques of the report, which takes Sun and "
            "Moon from an ephemeris, so the page starts at the period of the report. Spin and "
            "month are slowed down to be visible; the flattening of the planet is exaggerated.",
            "A Moon of another mass or distance would change the spin and the obliquity in the "
            "long run; here each can be set by itself.",
        ),
        _sky,
    ),
    "rotor": Play(
        "A free body, to play with",
        "A brick, thrown. About its longest and its shortest side it turns steadily; about the "
        "one between, the least push makes it tumble. Or a planet that wobbles.",
        "A body that tumbles about its fixed angular momentum, with its angular velocity and the "
        "path of the angular velocity on the body.",
        (
            "The angular momentum (L, blue) stays where it is in space; the angular velocity "
            "(omega) moves along the polhode (red), which turns with the body. Of the planet, the "
            "cone about the polhode (red) rolls without slipping on the one that the angular "
            "velocity describes in space (blue).",
        ),
        dict,
    ),
    "top": Play(
        "A heavy top, to play with",
        "Let go, the top nods while it goes round: with a push along it draws waves, with none "
        "cusps, with a push against it loops.",
        "A spinning top on its point, the two circles between which its axis nods, and the curve "
        "that the tip of the axis draws.",
        (
            "A disc of 0.2 kg whose centre of mass is 5 cm from the point, on the Earth, without "
            "friction; drawn eight times slower than it moves, at speed 1.",
        ),
        dict,
    ),
    "wobble": Play(
        "The ladder of the free wobble, to play with",
        "A rigid Earth would wobble in ten months, ours takes fourteen. See what the mantle, the "
        "core and the ocean do to the period.",
        "Bars of the period of the free wobble by five models, and a line at the observed period.",
        (
            "Each rung adds to the one before it. How the inside softens at long periods is that "
            "of PREM, whatever its Love number is set to. The three axes of the Earth are left "
            "out.",
        ),
        _interior,
        still=True,
    ),
}


def play_page(name: str) -> str:
    """Page to play with.

    Parameters
    ----------
    name : str
        ``"precession"``, ``"rotor"``, ``"top"`` or ``"wobble"``.

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
    play = PLAYS[name]
    numbers = json.dumps(play.given(), default=lambda number: np.asarray(number).item())
    return (
        environment()
        .get_template("play.html.j2")
        .render(
            title=play.title,
            lead=play.lead,
            alternative=play.alternative,
            notes=play.notes,
            still=play.still,
            given=numbers.replace("<", "\\u003c"),
            sheet=source("page.css"),
            formulas=source("formulas.js"),
            engine=source("touch.js") + source("play.js"),
            script=source(f"play_{name}.js"),
            footer=f"earthspin {__version__}.",
        )
    )


def write_page(name: str, file: str | Path) -> Path:
    """Write a page to play with.

    Parameters
    ----------
    name : str
        As of `play_page`.
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
    path = Path(file)
    text = play_page(name)
    drafts.check_writable(path.parent)
    with drafts.replacing(path) as draft:
        draft.write_text(text, encoding="utf-8")
    return path
