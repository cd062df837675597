r"""
Angles, longitudes and years: what is counted from where
========================================================

Definitions that differ between communities, drawn to be compared.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.views.drawing import RED, note
from earthspin.views.star_chart import year_words

# %%
# Angles that locate the equator
# ------------------------------
# The sky along the ecliptic, with the motion of the ecliptic enlarged. The equator of date
# crosses the *fixed* ecliptic (of ``J2000.0``) :math:`\psi_A` west of the equinox of ``J2000.0``,
# at the angle :math:`\omega_A`: these two follow from the torques. It crosses the ecliptic *of
# date* at the equinox of date, at the obliquity :math:`\varepsilon`; the general precession
# :math:`p_A` is counted along that ecliptic (Capitaine, Wallace & Chapront 2003).
#
# *Next:* how far apart are ``psi_A`` and ``general_precession`` after ten thousand years?

along = np.linspace(-70, 20, 181)


def circle(node, tilt):
    return np.degrees(np.arctan(np.tan(np.radians(tilt)) * np.sin(np.radians(along - node))))


fig, ax = plt.subplots(figsize=(7.2, 3.9))
fixed, then, moved = circle(0, 23.4), circle(-45, 23.4), circle(15, -12)
ax.plot(along, 0 * along, "k", label="ecliptic of J2000.0")
ax.plot(along, moved, "k--", label="ecliptic of date")
ax.plot(along, fixed, "C0", label="equator of J2000.0")
ax.plot(along, then, "C1", label="equator of date")
meet = int(np.argmin(np.abs(then - moved)))
note(ax, r"$\varepsilon$", (along[meet], moved[meet]), (-5, 11), fontsize=11)
note(ax, r"$\omega_A$", (-45, 0), (26, 3), fontsize=11)
ax.plot([along[meet], 0], [moved[meet], 0], "o", color="0.2", ms=5)
note(ax, "equinox of date", (along[meet], moved[meet]), (-10, -5), ha="right")
note(ax, "equinox of J2000.0", (0, 0), (6, -24))
ax.annotate("", (-45, -2.5), (0, -2.5), arrowprops={"arrowstyle": "->"})
note(ax, r"$\psi_A$", (-36, -2.5), (0, -13), fontsize=11)
ax.set(xlabel="longitude from the equinox of J2000.0 (deg)", ylabel="latitude (deg)")
ax.legend(ncols=4, loc="lower right", bbox_to_anchor=(1, 1))

# %%
# Longitude of perihelion
# -----------------------
# The orbit seen from the north, its eccentricity enlarged. The longitude of perihelion
# :math:`\varpi` is counted in the direction of the Earth's motion, from the equinox of date to
# the point where the *Earth* is nearest to the Sun, as in (Berger 1978) and (Laskar et al. 2004).
# Seen from that point the Sun is in the opposite direction: the longitude of the Sun's perigee
# differs by half a turn, and its :math:`e\sin\varpi`, the climatic precession, has the opposite
# sign.
#
# *Next:* eleven thousand years ago, ``sel(epoch=-11000)``: in which season was the Sun nearest?

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

# %%
# Three ways to count years
# -------------------------
# Answers count Julian years from ``J2000.0``, negative before. Palaeoclimatology counts years
# "before present", where the present is 1950: a table that is read with the wrong zero is shifted
# by fifty years. Dates such as ``"-3000-01-01"`` belong to the proleptic Gregorian calendar with
# a year 0, so that 3001 BC is the year -3000. In this calendar the equinox drifts by a day in
# three thousand years; in the Julian calendar, which historians use for antiquity, by three weeks
# (Meeus 1998).
#
# *Next:* ``earthspin.long_term(times=["-3000-01-01"])``, and its ``epoch``.

of = earthspin.long_term("-7 kyr", "1 kyr", "50 yr")

fig, ax = plt.subplots(figsize=(7.0, 4.2))
ax.plot(of.epoch, of.obliquity)
ax.set(xlabel="Julian years from J2000.0 (years)", ylabel="obliquity (deg)", xlim=(-7000, 1000))
before = ax.secondary_xaxis(-0.24, functions=(lambda t: -50 - t, lambda bp: -50 - bp))
before.set_xlabel("years before 1950, BP (years)")
calendar = [-4999, -3999, -2999, -1999, -999, 1, 1000, 2000, 3000]
years = ax.secondary_xaxis("top", functions=(lambda t: t + 2000, lambda year: year - 2000))
years.set_xticks(calendar, [year_words(year) for year in calendar])
