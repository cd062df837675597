"""docs/pole_offsets.md."""

from __future__ import annotations

from functools import cache, partial

import xarray as xr

import earthspin
from tests.docs.numbers.sentence import Sentence, Told

PAGE = "docs/pole_offsets.md"
YEARS = (1990, 1998, 2006, 2012, 2018, 2020, 2022, 2024)
MODELS = {
    "iau": "IAU 2006/2000A",
    "nonrigid": "`nonrigid`: response fitted to IAU 2000A",
    "predicted": "`predicted`: response from the layers",
}


@cache
def offsets() -> xr.DataTree:
    return earthspin.run_tree("pole-offsets", sections=["core_nutation", "period"])


@cache
def sizes() -> xr.Dataset:
    scene = earthspin.load_scene("iau", {"span": ["1990-01-01", "2025-12-31"]})
    return earthspin.run_tree(scene, sections=["observed"])["observed"].to_dataset()


def window(year: int) -> list[float]:
    fit = offsets()["core_nutation"].to_dataset()
    row = fit.sel(middle=f"{year}-07-02", method="nearest")
    names = "core_nutation_amplitude", "core_nutation_amplitude_error", "detection_limit"
    return [float(row[name]) for name in names]


def last_detected() -> float:
    fit = offsets()["core_nutation"].to_dataset()
    return float(fit.middle[fit.detected.values == 1].dt.year[-1])


def period(name: str = "") -> list[float]:
    fit = offsets()["period"].to_dataset()
    return [float(fit.core_nutation_period), float(fit.core_nutation_period_error)]


def rms(model: str) -> list[float]:
    row = sizes().sel(model=model)
    names = "observed_rms", "observed_rms_without_core", "observed_rms_unfitted"
    return [float(value) for name in names for value in row[name].values]


MEASURED = [
    *(Sentence(PAGE, f"| {year} | {{}} ± {{}} | {{}} |", partial(window, year)) for year in YEARS),
    Sentence(PAGE, "has its middle in March {}", last_detected),
    Sentence(PAGE, "since 1984: {} ± {} d", period),
    *(
        Sentence(
            PAGE, f"| {words} | {{}} / {{}} | {{}} / {{}} | {{}} / {{}} |", partial(rms, model)
        )
        for model, words in MODELS.items()
    ),
]
TOLD = [
    Told(PAGE, "stated errors are above {} mas", "given: errors of C04 in September 2026"),
    Told(
        PAGE,
        "the published\n{} d, {} ± {} sidereal days",
        "published: Krasna, Boehm & Schuh 2013, A&A 555, A29",
    ),
    Told(PAGE, "noise alone exceeds in {} % of the windows", "given: the test"),
    Told(PAGE, "in radians, with {} %\nhalf-widths", "given: the claim"),
    Told(PAGE, "dX, dY up to {} days after", "given: `LONGEST` of offset_prediction"),
    Told(PAGE, "fades in {} days", "given: a constant of the prediction"),
]
