"""Layered bodies from names, tables of layers and samples, and what is told of them."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

import earthspin
from earthspin import EARTH, MARS, SceneError, UndefinedError
from earthspin.bodies.kinds import Layers
from earthspin.errors import Where
from earthspin.interior.layers import PREM, Layer, LayeredBody, from_samples
from earthspin.interior.love import elastic
from earthspin.interior.mars import MARS as MARS_LAYERS
from tests import shipped
from tests.refusals import refused

TWO = [
    {"top": "3000 km", "density": 8000, "vp": "8 km/s"},
    {"top": "6000 km", "density": [4500, -500], "vp": 10000.0, "vs": 5500.0, "shear_q": 300},
]


def test_a_table_of_layers_reads_itself_again() -> None:
    found = earthspin.love_numbers({"name": "two", "layers": TWO})
    again = earthspin.run(found)
    assert found.identical(again)
    assert 0.2 < float(found.love_number.sel(love="k2")) < 0.6


def samples_of_prem(count: int) -> dict[str, list[float]]:
    columns: dict[str, list[float]] = {n: [] for n in ("radius", "density", "vp", "vs", "shear_q")}
    below = 0.0
    for layer in PREM.layers:
        r = np.linspace(below, layer.top, count)
        x = r / PREM.radius
        of = (layer.density, layer.vp, layer.vs or (0.0,))
        rho, vp, vs = (np.polyval(series[::-1], x) for series in of)
        q = np.full(count, layer.shear_q)
        for name, column in zip(columns, (r, rho, vp, vs, q), strict=True):
            columns[name] += column.tolist()
        below = layer.top
    return columns


def test_samples_come_to_the_polynomials() -> None:
    """Straight lines between 33 samples a layer: k2 and the moment to a part in 10,000."""
    sampled = from_samples("prem", **samples_of_prem(33))
    assert np.isclose(sampled.moment_factor, PREM.moment_factor, rtol=1e-4, atol=0)
    assert np.isclose(elastic(sampled).k, elastic(PREM).k, rtol=3e-4, atol=0)


def test_love_numbers_of_a_table_of_samples() -> None:
    table = {"name": "prem by samples", "samples": samples_of_prem(9)}
    found = earthspin.love_numbers(table).love_number
    ours = shipped.answer("love-numbers").love_number
    assert np.allclose(found, ours, rtol=0.01, atol=1e-3)


SIZE = st.floats(0.1, 1e4)
SERIES = st.lists(SIZE, min_size=1, max_size=4).map(tuple)


@given(st.lists(st.tuples(SIZE, SERIES, SERIES, SERIES | st.just(()), SIZE), min_size=1))
def test_what_layers_write_they_read_to_the_bit(given: list) -> None:
    tops = np.cumsum([1e3 * thick for thick, *_ in given]).tolist()
    layers = tuple(
        Layer(top, density, vp, vs, q if vs else np.inf)
        for top, (_, density, vp, vs, q) in zip(tops, given, strict=True)
    )
    body = LayeredBody("any", layers, "made up")
    assert Layers().read(Layers().write(body), Where("interior")) == body


# --- layers of a body ----------------------------------------------------------------------------


CORES = {"layers": [{"top": "1000 km", "density": 9000, "vp": 9e3, "vs": 3e3}, *TWO]}


def compliances(**keys: object) -> xr.DataArray:
    tree = earthspin.run_tree(earthspin.Scene(compute="love-numbers", **keys), "compliances")
    return tree["compliances"].number_value


def planet() -> earthspin.Body:
    return earthspin.Body.from_layers({"name": "two", "layers": TWO}, spin_period="20 h", name="p")


def test_a_body_made_of_layers_has_them_inside() -> None:
    body = planet()
    assert np.isclose(body.mass, body.interior.mass, rtol=1e-14, atol=0)
    alone = earthspin.love_numbers({"name": "two", "layers": TWO}).love_number
    assert np.array_equal(earthspin.love_numbers(body=body).love_number, alone)
    by_body = compliances(body=body)
    given = compliances(interior=body.interior, body=body)
    assert np.array_equal(by_body, given)
    # what an inner core would do is not among them
    names = ["kappa", "xi", "gamma", "beta", "e", "e_f", "fluid"]
    assert by_body.number.values.tolist() == names
    # the figure is that of its own layers in equilibrium
    e = body.dynamical_flattening / (1 - body.dynamical_flattening)
    assert np.isclose(by_body.sel(number="e"), e, rtol=1e-12, atol=0)


def test_a_body_of_layers_wobbles_as_its_compliances_say() -> None:
    """Mantle and fluid core: the ladder's own roots beside those of the system of all parts."""
    body = planet()
    rungs = earthspin.wobble_ladder(body=body)
    assert rungs.rung.attrs["left_out"] == "ocean: interior 'two' has no ocean"
    tree = earthspin.run_tree(earthspin.Scene(compute="love-numbers", body=body), "modes")
    period = tree["modes"].compliance_mode_period.sel(free_mode="chandler_wobble")
    # the ladder has A/(M R2) of J2 and H, the system that of the layers: 2.6e-5 measured
    assert np.isclose(rungs.period_solar.sel(rung="fluid-core"), period, rtol=1e-4, atol=0)
    # nothing is known to be uncertain but the exponent
    half = rungs.period_solar_error
    assert np.all(half[:-1] < 1e-12)
    assert float(half[-1]) > 0


def test_a_scene_states_layers_once(tmp_path: Path) -> None:
    layers = ", ".join(
        "{" + ", ".join(f"{k} = {v!r}".replace("'", '"') for k, v in one.items()) + "}"
        for one in TWO
    )
    scene = tmp_path / "planet.toml"
    scene.write_text(
        'compute = "wobble"\n[body]\nfrom = "layers"\nname = "p"\nspin_period = "20 h"\n'
        f'[body.interior]\nname = "two"\nlayers = [{layers}]\n'
    )
    found = earthspin.run(scene)
    assert found.equals(earthspin.wobble_ladder(body=planet()))
    assert earthspin.run(found).identical(found)
    assert earthspin.Body.read(planet().write(), Where("body")) == planet()


def test_an_earth_of_other_layers_keeps_its_sea() -> None:
    """PREM by nine samples a layer, where PREM was: wobble and nutation are nearly the same."""
    own = EARTH.replace(interior={"name": "sampled", "samples": samples_of_prem(9)})
    assert "interior = sampled, 96 layers to 6371 km" in own.changes
    found, ours = earthspin.wobble_ladder(body=own), shipped.answer("wobble")
    off = abs(found.period_solar - ours.period_solar)
    assert np.all(off < 0.1)  # days; 0.03 measured
    assert not np.array_equal(found.period_solar, ours.period_solar)
    ladder = earthspin.nutation_ladder(body=own).rms_deps - shipped.answer("nutation").rms_deps
    assert float(abs(ladder).max()) < 0.02  # mas; 0.0176 measured
    other = own.replace(spin_period="20 h")
    assert earthspin.wobble_ladder(body=other).rung.values.tolist()[-1] == "anelastic"
    assert "ocean" not in earthspin.wobble_ladder(body=other).rung


test_what_has_no_layers_is_told_in_one_line = refused(
    (lambda: EARTH.replace(interior=3), "give a name"),
    (lambda: earthspin.Body(name="x", gm=1.0, interior=3), "either layers .* or samples"),
    (lambda: EARTH.replace(interior={"layers": []}), "centre outwards"),
    (lambda: earthspin.love_numbers(body=EARTH.replace(interior="permm")), "'prem'"),
    (lambda: earthspin.nutation_ladder(body=EARTH.replace(interior=CORES)), "another mass"),
    (lambda: earthspin.love_numbers(body="mars"), "published numbers, but no layers"),
    (lambda: earthspin.love_numbers(body="venus"), "no interior of Venus is known; give layers"),
    (lambda: earthspin.wobble_ladder(body={"from": "layers", "name": "x"}), "needs more"),
)


test_what_is_no_layered_body_is_one_line = refused(
    ("permm", "did you mean 'prem'"),
    (3, "give the name of an interior"),
    ({"name": "none"}, "either layers or samples"),
    ({"layers": [{"top": "1 km"}]}, "top, density, vp"),
    ({"layers": [{**TWO[0], "rho": 3}]}, "a layer has"),
    ({"layers": TWO[::-1]}, "centre outwards"),
    ({"samples": {"radius": [0, 1]}}, "columns of one length"),
    ({"samples": {"radius": [1, 2], "density": [1, 1], "vp": [1, 1], "vs": [1, 1]}}, "at 0"),
    call=earthspin.love_numbers,
    kind=SceneError,
)


def test_a_liquid_surface_is_refused() -> None:
    with pytest.raises(UndefinedError, match="solid surface"):
        earthspin.love_numbers({"layers": TWO[:1]})


def test_a_long_period_softens_and_lags() -> None:
    firm = shipped.answer("love-numbers")
    soft = earthspin.love_numbers("prem", "430 d")
    assert float(soft.love_number[0]) > float(firm.love_number[0])
    assert float(soft.love_number_imaginary[0]) < 0 == float(firm.love_number_imaginary[0])


def test_mars_with_a_fluid_core() -> None:
    """Mass and moment are met; beside what is observed (Le Maistre 2023, Konopliv 2020)."""
    assert np.isclose(MARS_LAYERS.mass * 6.6743e-11, MARS.gm, rtol=1e-6, atol=0)
    # C/(M a2) = 0.36367, J2 = 1.9566e-3 with a = 3396 km, over the mean radius of 3389.5 km
    assert np.isclose(MARS_LAYERS.moment_factor, 0.363757, rtol=2e-6, atol=0)  # measured: 7e-7
    tree = earthspin.run_tree(
        earthspin.Scene(compute="love-numbers", interior="mars-layers", body="mars"),
        ["compliances", "modes"],
    )
    assert "e_s" not in tree["compliances"].number
    period = tree["modes"].compliance_mode_period
    # observed: -242 d; a hydrostatic core is rounder, or the mantle bears a load (same paper)
    assert float(period.sel(free_mode="free_core_nutation")) == pytest.approx(-237, abs=1)
    # 207 d observed, of which the mantle's loss makes seven (notes on the exponent: 0.15)
    assert float(period.sel(free_mode="chandler_wobble")) == pytest.approx(201.1, abs=0.5)
    tide = earthspin.love_numbers("mars-layers", "5.55 h", anelastic_exponent=0.15)
    assert abs(float(tide.love_number.sel(love="k2")) - 0.174) < 0.008
