"""Forecast of the pole with a known excitation: made from the observed pole itself."""

from typing import Any

import numpy as np
import pytest
import xarray as xr

import earthspin

ORIGIN, DAYS, KNOWN = "2018-06-01", 60, 20
#: Standard deviation of the error of the known excitation, mas per coordinate and day.
NOISE = 10.0


@pytest.fixture(scope="module")
def pole() -> xr.Dataset:
    return earthspin.polar_motion(span=("2003-01-01", "2019-06-01"))


@pytest.fixture(scope="module")
def chi(pole: xr.Dataset) -> xr.Dataset:
    """Excitation that produced the observed pole, with noise, known for `KNOWN` days."""
    true = earthspin.excitation(pole, period="433 d", quality_factor=80)
    noise = np.random.default_rng(1).standard_normal((2, true.time.size))
    last = np.datetime64(ORIGIN) + np.timedelta64(KNOWN, "D")
    noisy = true.assign(
        chi1=true.chi1.copy(data=true.chi1 + NOISE * noise[0]),
        chi2=true.chi2.copy(data=true.chi2 + NOISE * noise[1]),
    )
    return noisy.sel(time=slice(None, last + np.timedelta64(12, "h")))


@pytest.fixture(scope="module")
def ahead(chi: xr.Dataset) -> xr.Dataset:
    return earthspin.forecast(DAYS, origin=ORIGIN, file="c04", excitation=chi)


def test_the_pole_moves_as_the_known_excitation_drives_it(
    ahead: xr.Dataset, pole: xr.Dataset
) -> None:
    """Noise of 10 mas moves the pole by 10 s mas in a day, s = 0.0145/d, in a random walk.

    Without the excitation the errors of this origin are 3 mas at 10 days and 5 mas at 20.
    """
    later = pole.sel(time=ahead.time[:KNOWN])
    walk = 2 * np.pi / 433 * NOISE * np.sqrt(np.arange(1, KNOWN + 1))
    for name in ("x", "y"):
        error = 1e3 * abs(ahead[name][:KNOWN] - later[name]).values
        assert np.all(error <= 3 * walk + 0.3)


@pytest.mark.parametrize(
    "origin",
    ["2015-03-01", *(pytest.param(d, marks=pytest.mark.slow) for d in ("2016-09-09", ORIGIN))],
)
def test_excitation_without_noise(pole: xr.Dataset, origin: str) -> None:
    """The known excitation drives the pole of its own days: 0.1 to 0.2 mas, a day off 0.7 to 1."""
    true = earthspin.excitation(pole, period="433 d", quality_factor=80)
    ahead = earthspin.forecast(KNOWN, origin=origin, file="c04", excitation=true)
    later = pole.sel(time=ahead.time)
    for name in ("x", "y"):
        assert float(abs(ahead[name] - later[name]).max()) < 0.3e-3


def test_half_widths_hold_and_grow(ahead: xr.Dataset, pole: xr.Dataset) -> None:
    later = pole.sel(time=ahead.time)
    for name in ("x", "y"):
        width = ahead[f"{name}_error"].values
        assert np.all(np.diff(width) > 0)
        assert np.mean(abs(ahead[name] - later[name]).values <= width) >= 0.9
    plain = earthspin.forecast(DAYS, origin=ORIGIN, file="c04")
    assert float(ahead.x_error[9]) < 0.5 * float(plain.x_error[9])


@pytest.mark.slow
def test_days_beyond_the_forecast_change_no_bit(chi: xr.Dataset) -> None:
    """An excitation that is known longer than the forecast reaches is not used to its end."""
    whole = earthspin.forecast(5, origin=ORIGIN, file="c04", excitation=chi)
    short = earthspin.forecast(
        5, origin=ORIGIN, file="c04", excitation=chi.isel(time=slice(None, -8))
    )
    assert np.array_equal(whole.x, short.x)
    assert np.array_equal(whole.x_error, short.x_error)


@pytest.mark.slow
def test_days_before_the_pole_change_no_bit(chi: xr.Dataset, pole: xr.Dataset) -> None:
    """Pole and excitation are used from the first day that both cover."""
    short = pole.sel(time=slice("2005-01-01", ORIGIN))
    began = short.time.values[0]
    whole = earthspin.forecast(5, file=short, excitation=chi)
    begun = earthspin.forecast(5, file=short, excitation=chi.sel(time=slice(began, None)))
    assert np.array_equal(whole.x, begun.x)
    assert np.array_equal(whole.x_error, begun.x_error)


def test_the_scene_and_the_sections(ahead: xr.Dataset) -> None:
    tree = earthspin.run_tree(ahead)
    assert np.array_equal(tree.x, ahead.x)
    assert "components" not in tree.children
    assert "fitted" in ahead.x.attrs["parameters"]


def test_refusals(chi: xr.Dataset) -> None:
    cases: list[tuple[dict[str, Any], str]] = [
        ({"parameters": "shipped"}, "fitted"),
        ({"excitation": chi.isel(time=slice(None, None, 2))}, "each day"),
        ({"excitation": chi.sel(time=slice(None, "2018-05-20"))}, "too early"),
        ({"excitation": chi.sel(time=slice("2012-01-01", None))}, "10 years"),
        ({"excitation": chi.assign_coords(time=chi.time + np.timedelta64(6, "h"))}, "0h to 0h"),
        ({"excitation": 3.0}, "read_excitation"),
    ]
    for keys, words in cases:
        with pytest.raises(earthspin.EarthspinError, match=words) as error:
            earthspin.forecast(
                **({"days": 30, "origin": ORIGIN, "file": "c04", "excitation": chi} | keys)
            )
        assert "\n" not in str(error.value)
