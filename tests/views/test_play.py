"""Pages to play with: their formulas against the library, and the pages in a headless browser."""

import json
import re
from collections.abc import Iterator, Mapping
from html import unescape
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from earthspin import EARTH, daily_insolation
from earthspin.constants import DAY, JULIAN_YEAR
from earthspin.errors import UndefinedError
from earthspin.interior.layers import PREM
from earthspin.interior.love import softening
from earthspin.interior.ocean_and_anelasticity import shear_modulus_change
from earthspin.numerics.quaternion import rotate
from earthspin.rotor.triaxial import free_rotation
from earthspin.scenes import run
from earthspin.top.azimuth import mean_precession_rate
from earthspin.top.closed_form import heavy_top_motion
from earthspin.top.height import nutation_of, nutation_period, turning_angles
from earthspin.top.start import HeavyTop
from earthspin.torque.average import precessing_torque
from earthspin.torque.gravity import quadrupole_torque, tidal_tensor
from earthspin.torque.rates import precession_rate
from earthspin.views import PLAYS
from earthspin.views.page import source
from earthspin.views.play import NUMBERS, play_page
from earthspin.wobble.ladder import Inputs, roots
from tests.views.test_browser import browser, opened, title_on_a_phone

__all__ = ["browser"]

SETTINGS, SIX_DIGITS = 100, 1e-6
Case = dict[str, object]
RANDOM = np.random.default_rng(20)
_START = RANDOM.bit_generator.state


@pytest.fixture(autouse=True)
def _same_settings() -> None:
    """The settings of a test do not hang on which tests ran before it."""
    RANDOM.bit_generator.state = _START


def between(low: float, high: float) -> float:
    return float(RANDOM.uniform(low, high))


def computed(browser: str, folder: Path, call: str, cases: list[Case]) -> list[dict[str, list]]:
    """What the pages' own script gives for some settings."""
    page = folder / "formulas.html"
    page.write_text(
        f"<!DOCTYPE html><meta charset='utf-8'><pre></pre><script>{source('formulas.js')}\n"
        f"document.querySelector('pre').textContent = JSON.stringify({json.dumps(cases)}"
        f".map((c) => {call}));</script>",
        encoding="utf-8",
    )
    html, log = opened(browser, page, folder, "--dump-dom")
    assert "CONSOLE" not in log, log
    return json.loads(unescape(re.search(r"<pre>(.*?)</pre>", html, re.DOTALL)[1]))


def off_by_turns(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    return np.abs((one - other + np.pi) % (2 * np.pi) - np.pi)


def averaged_rate(case: dict) -> float:
    """Rate of precession from the library's torque, sampled over orbits and nodes.

    The mean over an orbit is taken in steps of the true anomaly, each as long as it lasts; the
    torque is then a polynomial of low degree in sines, so that 16 steps are exact.
    """
    tilt = case["obliquity"]
    axis, pole = np.array([0.0, np.sin(tilt), np.cos(tilt)]), np.array([0.0, 0.0, 1.0])
    anomaly, node = np.meshgrid(*(2 * np.pi * np.arange(16) / 16,) * 2, indexing="ij")
    total = 0.0
    for of in case["pulls"]:
        e, i = of["eccentricity"], of["inclination"]
        distance = of["distance"] * (1 - e**2) / (1 + e * np.cos(anomaly))
        lasts = (distance / of["distance"]) ** 2 / np.sqrt(1 - e**2)
        x, y, z = np.cos(anomaly), np.sin(anomaly) * np.cos(i), np.sin(anomaly) * np.sin(i)
        place = distance * np.array(
            [x * np.cos(node) - y * np.sin(node), x * np.sin(node) + y * np.cos(node), z]
        )
        axes = np.broadcast_to(axis[:, None, None], place.shape)
        torque = quadrupole_torque(tidal_tensor([(of["gm"], place)]), axes)
        mean = np.mean(torque * lasts, axis=(1, 2))
        total += float(precessing_torque(mean[None], axis, pole)[0])
    return float(precession_rate(total, case["flattening"], case["spin"]))


def test_precession_is_the_librarys_torque_averaged(browser: str, tmp_path: Path) -> None:
    cases: list[Case] = [
        {
            "flattening": between(1e-4, 1e-2),
            "spin": between(1e-5, 3e-4),
            "obliquity": between(0.02, 1.55),
            "pulls": [
                {
                    "gm": between(1e12, 1e14),
                    "distance": between(2e8, 8e8),
                    "eccentricity": between(0, 0.2),
                    "inclination": between(0, 0.5),
                }
                for _ in range(2)
            ],
        }
        for _ in range(SETTINGS)
    ]
    found = computed(browser, tmp_path, "formulas.precession(c)", cases)
    for case, one in zip(cases, found, strict=True):
        # measured: below 1e-12
        assert one["rate"] == pytest.approx(averaged_rate(case), rel=SIX_DIGITS, abs=0)
        assert one["period"] == pytest.approx(2 * np.pi / abs(one["rate"]), rel=1e-14, abs=0)


def test_the_free_rotor_is_the_librarys(browser: str, tmp_path: Path) -> None:
    cases: list[Case] = []
    for _ in range(SETTINGS):
        x, y, z = (between(0.4, 3.0) for _ in range(3))
        cases.append(
            {
                "moments": [(y * y + z * z) / 12, (x * x + z * z) / 12, (x * x + y * y) / 12],
                "omega": [between(-3, 3) for _ in range(3)],
                "times": [0.0, *(between(0, 60) for _ in range(4))],
            }
        )
    # bodies of revolution, oblate and prolate, and a cube
    special = ([1.0, 1.0, 1.5], [1.0, 1.0, 0.5], [1.0, 1.0, 1.0])
    for case, moments in zip(cases, special, strict=False):
        case["moments"] = moments
    # the exact separatrix, on its four branches
    for case, signs in zip(cases[-4:], ((1, 1), (-1, 1), (1, -1), (-1, -1)), strict=True):
        case["moments"] = [4.0, 5.0, 9.0]
        case["omega"] = [3.0 * signs[0], 2.0, 1.0 * signs[1]]
        case["times"] = [0.0, 0.3, 1.0, 3.0, 6.0]
    call = """(() => {
      const motion = formulas.rotor(c.moments, c.omega);
      return { omega: c.times.map(motion.omega), attitude: c.times.map(motion.attitude) };
    })()"""
    for case, one in zip(cases, computed(browser, tmp_path, call, cases), strict=True):
        whole = free_rotation(case["moments"], case["omega"], np.array(case["times"]))
        speed = np.linalg.norm(case["omega"])
        # measured: below 1e-8 at a thousand settings
        assert np.allclose(one["omega"], whole.omega_body, rtol=0, atol=SIX_DIGITS * speed)
        body = [rotate(np.broadcast_to(q, (3, 4)), np.eye(3)) for q in whole.attitude]
        frames = [np.array(rows) @ axes for rows, axes in zip(one["attitude"], body, strict=True)]
        for frame in frames[1:]:  # the library's space, seen from the page's, stays where it is
            assert np.allclose(frame, frames[0], rtol=0, atol=SIX_DIGITS)


def test_the_top_is_the_librarys(browser: str, tmp_path: Path) -> None:
    names = ("transverse", "axial", "weight", "theta", "spin", "phiRate")
    bounds = ((0.5, 2.0), (0.2, 1.0), (0.2, 5.0), (0.09, 2.1), (2.0, 30.0), (-3.0, 3.0))
    cases: list[Case] = [
        {name: between(*ends) for name, ends in zip(names, bounds, strict=True)}
        | {"times": [0.0, *(between(0, 60) for _ in range(4))]}
        for _ in range(SETTINGS)
    ]
    cases[0] |= {"spin": 0.0, "phiRate": 0.0}  # it swings in a plane
    cases[1]["phiRate"] = 0.0
    cases[2] |= {"theta": 0.0}
    call = """(() => {
      const { at, ...others } = formulas.top(c);
      return { ...others, angles: c.times.map(at) };
    })()"""
    for case, one in zip(cases, computed(browser, tmp_path, call, cases), strict=True):
        top = HeavyTop(
            transverse_moment=case["transverse"],
            axial_moment=case["axial"],
            weight_moment=case["weight"],
            theta=case["theta"],
            spin=case["spin"],
            phi_rate=case["phiRate"],
        )
        whole, angles = heavy_top_motion(top, np.array(case["times"])), np.array(one["angles"]).T
        assert one["pattern"] == whole.pattern
        if case["theta"] == 0:
            assert np.allclose(angles[0], 0, rtol=0, atol=0)
            continue
        # measured: below 1e-6 at two thousand settings
        assert np.max(np.abs(angles[0] - whole.theta)) < SIX_DIGITS
        assert np.max(off_by_turns(angles[1], whole.phi)) < SIX_DIGITS
        assert np.max(off_by_turns(angles[2], whole.psi)) < SIX_DIGITS
        assert one["period"] == pytest.approx(
            float(nutation_period(nutation_of(top))), rel=SIX_DIGITS, abs=0
        )
        assert one["meanRate"] == pytest.approx(
            float(mean_precession_rate(top, nutation_of(top))), rel=SIX_DIGITS, abs=0
        )
        assert np.allclose(
            np.sort(one["turning"]),
            np.sort(turning_angles(nutation_of(top))),
            rtol=SIX_DIGITS,
            atol=0,
        )


def test_the_wobble_is_the_librarys(browser: str, tmp_path: Path) -> None:
    names = ("flattening", "unitStrain", "k2", "coreK", "kPressure", "coreKPressure")
    bounds = ((2.5e-3, 6e-3), (1e-3, 4e-3), (0.05, 0.5), (0.02, 0.1), (0.02, 0.1), (0.01, 0.05))
    names += ("coreFraction", "coreEllipticity", "ocean")
    bounds += ((0.01, 0.4), (1e-3, 5e-3), (0.0, 0.1))
    soft, day = softening(PREM), 86164.1
    layers = {"softening": [of.coef.tolist() for of in soft], "range": soft[0].domain.tolist()}
    cases: list[Case] = [
        {name: between(*ends) for name, ends in zip(names, bounds, strict=True)}
        | {"anelastic": {"exponent": between(0.0, 0.3), "day": day} | layers}
        for _ in range(SETTINGS)
    ]
    for case, one in zip(
        cases, computed(browser, tmp_path, "formulas.wobble(c)", cases), strict=True
    ):
        inputs = {
            "dynamical_flattening": case["flattening"],
            "j2": 1e-3,
            "triaxiality": 0.0,
            "k2": case["k2"],
            "core_ellipticity": case["coreEllipticity"],
            "ocean": case["ocean"],
            "anelastic_exponent": case["anelastic"]["exponent"],
        }
        inner = tuple(case[name] for name in names[2:6])
        water = case["ocean"] * case["unitStrain"] * np.eye(2)
        unit, core = case["unitStrain"], case["coreFraction"]
        elastic = roots(Inputs(**inputs, core_fraction=0.0), unit, (case["k2"], 0.0, 0.0, 0.0))
        fluid = roots(Inputs(**inputs, core_fraction=core), unit, inner)
        wet = roots(Inputs(**inputs, core_fraction=core), unit, inner, water)
        slow = wet.rotations
        try:
            for _ in range(3):
                mu_change = shear_modulus_change(slow * day, inputs["anelastic_exponent"])
                ratios = (ratio(mu_change) for ratio in soft)
                softer = tuple(v * ratio for v, ratio in zip(inner, ratios, strict=True))
                slow = roots(Inputs(**inputs, core_fraction=core), unit, softer, water).rotations
        except UndefinedError:
            assert one["anelastic"] is None  # the body would turn over
            slow = None
        for name, turns in (
            *((("anelastic", slow),) if slow is not None else ()),
            ("elastic", elastic.rotations),
            ("fluidCore", fluid.rotations),
            ("ocean", wet.rotations),
            ("coreNutation", wet.core_rotations),
        ):
            # measured: 1e-12
            assert one[name] == pytest.approx(float(turns), rel=SIX_DIGITS, abs=0), name


def by_library(case: Mapping[str, float], **key: str) -> float:
    """Mean insolation (W/m2) of one setting of the page on sunlight (deg), by the library."""
    elements = {
        "obliquity": case["obliquity"],
        "eccentricity": case["eccentricity"],
        "longitude_of_perihelion": case["perihelion"],
    }
    orbit = xr.Dataset(
        {name: ("epoch", [value]) for name, value in elements.items()}, {"epoch": [0]}
    )
    for name in ("obliquity", "longitude_of_perihelion"):
        orbit[name].attrs["units"] = "deg"
    latitude = f"{case['latitude']} deg"
    answer = daily_insolation(orbit, latitude, solar_constant="1361 W/m2", **key)
    return float(answer["annual_mean" if "mean" in key else "insolation"].item())


SUNLIGHT = {
    "obliquity": (0.0, 90.0),
    "eccentricity": (0.0, 0.3),
    "perihelion": (0.0, 360.0),
    "latitude": (-90.0, 90.0),
    "season": (0.0, 360.0),
}


def test_sunlight_is_the_librarys(browser: str, tmp_path: Path) -> None:
    cases: list[dict] = [
        {name: between(*ends) for name, ends in SUNLIGHT.items()} for _ in range(SETTINGS)
    ]
    for case, latitude in zip(cases, (90.0, -90.0, 0.0), strict=False):
        case["latitude"] = latitude
    call = """(() => {
      const rad = (name) => (c[name] * Math.PI) / 180, eccentricity = c.eccentricity;
      const [obliquity, perihelion] = ["obliquity", "perihelion"].map(rad);
      const { at, year } = formulas.insolation({ obliquity, eccentricity, perihelion });
      return { day: at(rad("season"))(rad("latitude")), year: year(rad("latitude")) };
    })()"""
    for case, one in zip(cases, computed(browser, tmp_path, call, cases), strict=True):
        day = by_library(case, longitude=f"{case['season']} deg") / 1361
        year = by_library(case, mean="year") / 1361
        assert one["day"] == pytest.approx(day, rel=0, abs=1e-13)  # measured: 2e-15
        # measured: 4e-9, from the edges of polar day and night between the steps of the sum
        assert one["year"] == pytest.approx(year, rel=0, abs=1e-7)


# --- the pages -----------------------------------------------------------------------------------

#: A slider, where it is moved to, and the reading to be told.
MOVED = {
    "precession": ("mass", 0, "once round in"),
    "rotor": ("x", 1.5, "period of the polhode"),
    "sunlight": ("eccentricity", 0.1, "insolation"),
    "top": ("spin", 150, "mean precession"),
    "wobble": ("k2", 0.2, "elastic mantle"),
}


#: Pages without motion.
STILL = ("sunlight", "wobble")


def played(browser: str, folder: Path, name: str, script: str) -> dict:
    """Open a page, do something in it, and give what it tells."""
    page = folder / f"{name}.html"
    tell = f"<pre></pre><script>(async () => {{ const told = {{}}; {script}"
    tell += (
        "document.querySelector('pre').textContent = JSON.stringify(told); })();</script></body>"
    )
    page.write_text(play_page(name).replace("</body>", tell), encoding="utf-8")
    html, log = opened(browser, page, folder, "--dump-dom")
    assert "CONSOLE" not in log, log
    assert 'data-painted="yes"' in html
    return json.loads(unescape(re.search(r"<pre>(.*?)</pre>", html, re.DOTALL)[1]))


READ = """
  const picture = document.getElementById("picture");
  const read = (words) =>
    [...document.querySelectorAll("dt")].find((e) => e.textContent === words)
      .nextSibling.textContent;
"""


def first_number(words: str) -> float:
    return float(words.replace(",", "").replace("\u2212", "-").split()[0])


def expected(name: str) -> Iterator[float]:
    """Readings by the library, before and after a slider is moved."""
    given = NUMBERS.get(name, dict)()
    if name == "precession":
        pulls = [given["sun"], given["moon"]]
        period = 2 * np.pi / averaged_rate({**given, "pulls": pulls}) / JULIAN_YEAR
        assert period == pytest.approx(
            float(run("precession").precession_period[-1]), rel=1e-12, abs=0
        )
        for some in (pulls, pulls[:1]):
            yield 2 * np.pi / averaged_rate({**given, "pulls": some}) / JULIAN_YEAR
    elif name == "rotor":
        for x in (2.0, 1.5):
            y, z, off = 1.3, 0.45, np.radians(1.5)
            moments = [(y * y + z * z) / 12, (x * x + z * z) / 12, (x * x + y * y) / 12]
            omega = 3 * np.array([0.6 * np.sin(off), np.cos(off), 0.8 * np.sin(off)])
            from earthspin.rotor.poinsot import polhode

            yield float(polhode(moments, omega).period)
    elif name == "top":
        for spin in (210.0, 150.0):
            disc, lever = 0.2 * 0.035**2, 0.2 * 0.05**2
            top = HeavyTop(
                transverse_moment=disc / 4 + lever,
                axial_moment=disc / 2,
                weight_moment=0.2 * 9.80665 * 0.05,
                theta=np.radians(35.0),
                spin=spin,
            )
            yield float(mean_precession_rate(top, nutation_of(top)))
    elif name == "sunlight":
        case = {**given["epochs"][1], "latitude": 65.0}
        for e in (case["eccentricity"], 0.1):
            yield by_library({**case, "eccentricity": e}, longitude="90 deg")
    else:
        e = EARTH.dynamical_flattening / (1 - EARTH.dynamical_flattening)
        for k2 in (given["k2"], 0.2):
            kappa = given["strain"] * e * k2
            yield (1 + kappa) / (e - kappa) * EARTH.spin_period / DAY


@pytest.mark.slow
@pytest.mark.parametrize("name", PLAYS)
def test_a_slider_changes_the_picture_and_a_number(browser: str, name: str, tmp_path: Path) -> None:
    slider, value, words = MOVED[name]
    told = played(
        browser,
        tmp_path,
        name,
        f"""{READ}
        told.before = read("{words}");
        const first = picture.toDataURL(), slider = document.getElementById("{slider}");
        slider.value = {value};
        slider.dispatchEvent(new Event("input"));
        told.after = read("{words}");
        told.changed = picture.toDataURL() !== first;
        const playback = document.getElementById("playback");
        if (playback) playback.value = 2;
        document.getElementById("again").click();
        told.again = picture.toDataURL() === first && read("{words}") === told.before;
        told.playback = playback ? Number(playback.value) : 0;
        const names = [...document.querySelectorAll("[id]")].map((e) => e.id);
        told.once = new Set(names).size === names.length;
        """,
    )
    before, after = expected(name)
    assert first_number(told["before"]) == pytest.approx(before, rel=1e-5, abs=0)
    assert first_number(told["after"]) == pytest.approx(after, rel=1e-5, abs=0)
    assert told["changed"]
    assert told["again"]
    assert told["playback"] == 0
    assert told["once"]


@pytest.mark.slow
def test_the_planet_has_its_own_moments(browser: str, tmp_path: Path) -> None:
    """The planet brings its own axes, (2, 2, 1.6), and turns about the third."""
    told = played(
        browser,
        tmp_path,
        "rotor",
        f"""{READ}
        const first = picture.toDataURL(), shape = document.getElementById("shape");
        told.before = read("period of the polhode");
        shape.value = 1;
        shape.dispatchEvent(new Event("input"));
        told.after = read("period of the polhode");
        told.changed = picture.toDataURL() !== first;
        """,
    )
    assert told["changed"]
    moments, off = np.array([2**2 + 1.6**2, 2**2 + 1.6**2, 2 * 2**2]) / 20, np.radians(20.0)
    omega = 3 * np.array([0.8 * np.sin(off), 0.6 * np.sin(off), np.cos(off)])
    wobble = 2 * np.pi / abs((moments[2] / moments[0] - 1) * omega[2])
    assert first_number(told["after"]) == pytest.approx(wobble, rel=1e-5, abs=0)


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in PLAYS if name not in STILL])
def test_a_page_is_played_by_clock_and_keys(browser: str, name: str, tmp_path: Path) -> None:
    told = played(
        browser,
        tmp_path,
        name,
        f"""{READ}
        const send = (kind, what) =>
          picture.dispatchEvent(new kind(what.type, {{ cancelable: true, ...what }}));
        const key = (key) => send(KeyboardEvent, {{ type: "keydown", key }});
        const scrolls = () => send(WheelEvent, {{ type: "wheel", deltaY: 9 }});
        told.scrolls = scrolls();
        picture.click();
        told.zooms = !scrolls();
        key("Escape");
        told.scrollsAgain = scrolls();
        const first = picture.toDataURL();
        key("ArrowLeft");
        told.turns = picture.toDataURL() !== first;
        const begun = performance.now();
        key(" ");
        await new Promise((done) => setTimeout(done, 700));
        key(" ");
        told.lasted = (performance.now() - begun) / 1000;
        told.time = read("time");
        key(".");
        told.later = read("time");
        """,
    )
    assert told["scrolls"] and told["zooms"] and told["scrollsAgain"] and told["turns"]  # noqa: PT018
    pace = float(re.search(r"pace: ([\d.]+)", source(f"play_{name}.js"))[1])  # units of the reading
    assert first_number(told["time"]) == pytest.approx(pace * told["lasted"], rel=0.15, abs=0)
    step = first_number(told["later"]) - first_number(told["time"])
    assert step == pytest.approx(pace / 30, rel=0.1, abs=0)


@pytest.mark.slow
@pytest.mark.parametrize("name", PLAYS)
def test_a_page_is_one_file_and_no_wider_than_a_phone(
    browser: str, name: str, tmp_path: Path
) -> None:
    page = play_page(name)
    assert "http" not in page
    assert not re.search(r"(?:src|href)\s*=\s*\"", page)
    assert title_on_a_phone(browser, tmp_path, page, "document.title = wide;") == "390"


@pytest.mark.slow
def test_readings_of_sunlight_are_the_librarys(browser: str, tmp_path: Path) -> None:
    cases = [{name: between(*ends) for name, ends in SUNLIGHT.items()} for _ in range(5)]
    told = played(
        browser,
        tmp_path,
        "sunlight",
        f"""{READ}
        told.cases = {json.dumps(cases)}.map((settings) => {{
          for (const [name, value] of Object.entries(settings)) {{
            const slider = document.getElementById(name);
            slider.value = value;
            slider.dispatchEvent(new Event("input"));
          }}
          const shown = Object.keys(settings).map((name) =>
            [name, document.getElementById(name).getAttribute("aria-valuetext")]);
          const day = ["insolation", "difference from today"];
          const words = [...day, "annual mean", "annual mean, difference"];
          return {{ shown: Object.fromEntries(shown), told: words.map(read) }};
        }});
        """,
    )
    today = NUMBERS["sunlight"]()["epochs"][0]
    for one in told["cases"]:
        case = {name: first_number(words) for name, words in one["shown"].items()}
        then = {
            **case,
            **{name: today[name] for name in ("obliquity", "eccentricity", "perihelion")},
        }
        day, year = {"longitude": f"{case['season']} deg"}, {"mean": "year"}
        numbers = [(by_library(case, **key), by_library(then, **key)) for key in (day, year)]
        expected = [value for now, past in numbers for value in (now, now - past)]
        # six digits are shown, five of a difference (at most 5e-5 of it)
        assert [first_number(words) for words in one["told"]] == pytest.approx(
            expected, rel=5e-5, abs=1e-3
        )


@pytest.mark.slow
def test_sunlight_is_chosen_on_the_map_and_by_keyboard(browser: str, tmp_path: Path) -> None:
    told = played(
        browser,
        tmp_path,
        "sunlight",
        """
        const picture = document.getElementById("picture");
        const { width, height } = picture.getBoundingClientRect();
        const value = (name) => Number(document.getElementById(name).value);
        const click = (offsetX, offsetY) => {
          const event = new MouseEvent("click");
          for (const [name, value] of Object.entries({ offsetX, offsetY }))
            Object.defineProperty(event, name, { value });
          picture.dispatchEvent(event);
        };
        const [left, right] = [46, width - 66];
        click(0.25 * left + 0.75 * right, 26 + (height - 78) / 2 / 4);
        told.place = [value("season"), value("latitude")];
        click(2, 2);
        told.same = value("season") === told.place[0];
        const controls = [...document.querySelectorAll("input, select, button")];
        const named = (e) => (e.labels?.[0] ?? e).textContent.trim() !== "";
        told.reached = controls.every((e) => e.tabIndex === 0 && named(e));
        told.requests = performance.getEntriesByType("resource").length;
        """,
    )
    assert told["place"] == pytest.approx([270, 45], rel=0, abs=1)
    assert told["same"]
    assert told["reached"]
    assert told["requests"] == 0


@pytest.mark.slow
def test_sunlight_is_printed_with_its_maps(browser: str, tmp_path: Path) -> None:
    page, printed = tmp_path / "sunlight.html", tmp_path / "sunlight.pdf"
    page.write_text(play_page("sunlight"), encoding="utf-8")
    opened(browser, page, tmp_path, f"--print-to-pdf={printed}")
    # the maps are wide enough for paper
    widths = [int(n) for n in re.findall(rb"/Width (\d+)", printed.read_bytes())]
    assert max(widths) > 400
