"""Numbers, units and colours of pages: set as journals do, and to be read in light and dark."""

import re
from itertools import product

import pytest

from earthspin.views.page import anchor, source, typeset

SHEET = source("page.css")


@pytest.mark.parametrize(
    ("plain", "set_"),
    [
        ("5.71015(25)e21", "5.71015(25)\u00a0×\u00a010²¹"),
        ("2.63028e+35 kg m2", "2.63028\u00a0×\u00a010³⁵ kg m²"),
        ("at most 2e-06 deg", "at most 2\u00a0×\u00a010⁻⁶ deg"),
        ("-28.7374", "−28.7374"),
        ("from -3 to -1", "from −3 to −1"),
        ("2000-01-01T12:00", "2000-01-01T12:00"),
        ("H = (C-A)/C", "H = (C−A)/C"),
        ("0.330698 M a2", "0.330698 M a²"),
        ("psi_A, mas/cy", "ψ<sub>A</sub>, mas/cy"),
        ("12.3 uas", "12.3 µas"),
        ("insolation, W m-2", "insolation, W/m²"),
        ("sin4 taper over a < b & 5 cycles", "sin4 taper over a &lt; b &amp; 5 cycles"),
        ("earth2e3 de421", "earth2e3 de421"),
    ],
)
def test_words_are_set(plain: str, set_: str) -> None:
    assert typeset(plain) == set_


def test_a_name_in_links_is_plain() -> None:
    assert anchor("Rates at J2000.0, effect by effect") == "rates-at-j2000-0-effect-by-effect"


def _luminance(colour: str) -> float:
    """Relative luminance of sRGB as WCAG 2.1 defines it."""
    parts = [int(pair, 16) / 255 for pair in re.findall("..", colour)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return sum(w * p for w, p in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def _contrast(one: str, other: str) -> float:
    low, high = sorted((_luminance(one), _luminance(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize(
    ("theme", "name"), list(product((0, 1), ("ink", "soft", "blue", "red", "green", "pink")))
)
def test_words_and_lines_stand_out_in_light_and_dark(theme: int, name: str) -> None:
    """4.5 for words (level AA)."""
    root = re.findall(r":root \{(.*?)\}", SHEET, re.DOTALL)[theme]
    colours = {key: 2 * c if len(c) == 3 else c for key, c in re.findall(r"--(\w+): #(\w+)", root)}
    assert _contrast(colours[name], colours["paper"]) >= 4.5
    assert min(_contrast(colours[n], colours["paper"]) for n in ("orange", "sky")) >= 3
