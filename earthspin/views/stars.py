"""Bright stars near the path of the pole, for drawing.

Right ascension and declination (ICRF, J2000.0, degrees) and visual magnitude, rounded from
the Hipparcos catalogue (ESA 1997, SP-1200). Proper motion is left out: it moves the nearest of
them by a few degrees in a whole turn.
"""

from __future__ import annotations

#: Name, right ascension, declination, magnitude.
STARS: tuple[tuple[str, float, float, float], ...] = (
    ("Polaris", 37.95, 89.26, 2.0),
    ("Kochab", 222.68, 74.16, 2.1),
    ("Pherkad", 230.18, 71.83, 3.0),
    ("Thuban", 211.10, 64.38, 3.7),
    ("Edasich", 231.23, 58.97, 3.3),
    ("Eltanin", 269.15, 51.49, 2.2),
    ("Errai", 354.84, 77.63, 3.2),
    ("Alfirk", 322.16, 70.56, 3.2),
    ("Alderamin", 319.64, 62.59, 2.5),
    ("Deneb", 310.36, 45.28, 1.3),
    ("Delta Cygni", 296.24, 45.13, 2.9),
    ("Vega", 279.23, 38.78, 0.0),
    ("Tau Herculis", 244.94, 46.31, 3.9),
    ("Alkaid", 206.89, 49.31, 1.9),
    ("Mizar", 200.98, 54.93, 2.2),
    ("Alioth", 193.51, 55.96, 1.8),
    ("Dubhe", 165.93, 61.75, 1.8),
)
