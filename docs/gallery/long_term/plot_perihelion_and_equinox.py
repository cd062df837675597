r"""
Where the longitude of perihelion is counted from
=================================================

The orbit from the north, its eccentricity much enlarged. The longitude of perihelion
:math:`\varpi` runs with the Earth's motion, from the equinox of date to the place where the
*Earth* is nearest to the Sun, as in (Berger 1978) and (Laskar et al. 2004). Seen from that place,
the Sun stands in the opposite direction: who counts to the Sun's perigee is half a turn away, and
has :math:`e\sin\varpi`, climatic precession, with the other sign.

*Next:* eleven thousand years ago, ``sel(epoch=-11000)``: which season was nearest to the Sun?
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.views.drawing import RED, note

now = earthspin.long_term("-1 kyr", "0 kyr", "1 kyr").sel(epoch=0)
perihelion, e = np.radians(float(now.longitude_of_perihelion)), 0.25


def orbit(longitude):
    return (1 - e**2) / (1 + e * np.cos(longitude - perihelion)) * np.exp(1j * longitude)


fig, ax = plt.subplots(figsize=(6.4, 5.4))
for line in (orbit(np.linspace(0, 2 * np.pi, 361)), np.array([0, 1.45])):
    ax.plot(line.real, line.imag, color="0.3", lw=1)
ax.plot(0, 0, "o", color="C4", ms=12)
note(ax, "equinox of date", (1.45, 0), (0, 6), ha="right")
for quarter, season in enumerate(("September", "December", "March", "June")):
    at = orbit(quarter * np.pi / 2)
    ax.plot(at.real, at.imag, "o", color="C0")
    note(ax, f"Earth in {season}", (at.real, at.imag), (7, 7 if season == "December" else -12))
nearest = orbit(perihelion)
for line in (0.3 * np.exp(1j * np.linspace(0, perihelion)), np.array([nearest, 0, -0.5 * nearest])):
    ax.plot(line.real, line.imag, color=RED)
note(ax, f"$\\varpi$ = {np.degrees(perihelion):.0f} deg", (0.25, 0.25), (0, 0), color=RED)
note(ax, "perihelion", (nearest.real, nearest.imag), (-6, 6), ha="right", color=RED)
note(ax, "to the Sun's perigee", (0.1, -0.4), (6, 0), color=RED)
ax.set(aspect="equal", xlim=(-1.3, 1.6))
ax.axis("off")
