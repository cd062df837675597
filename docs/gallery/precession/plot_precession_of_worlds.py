r"""
Precession of other worlds
==========================

Periods and obliquities of planets and moons, beside published values.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin import EARTH, MARS
from earthspin.bodies import BODIES, earth_moon_sun, giants, inner, moons, planets, proper
from earthspin.constants import PSI_A_RATE
from earthspin.sky.poles import FixedPole
from earthspin.torque.cassini import strengths
from earthspin.views.drawing import note
from earthspin.views.tables import measured

# %%
# Earth, Earth without Moon, and Mars
# -----------------------------------
# The period of precession depends on the perturbers and on the spin and flattening of the body
# (I.8). Without the Moon the Earth's period is three times as long, because the Sun exerts a
# third of the torque. Mars, with small moons and at half again the distance from the Sun, has a
# longer period still. The errors come from the inputs and are smaller than the dots.
#
# *Next:* give Mars the Earth's day, ``MARS.replace(spin_period=...)``.

worlds = {
    "Earth": earthspin.precession(body=EARTH),
    "Earth\nwithout Moon": earthspin.precession(body=EARTH, perturbers=["sun"]),
    "Mars": earthspin.precession(body=MARS, perturbers=["sun"]),
}

fig, ax = plt.subplots()
for row, found in enumerate(worlds.values()):
    all_of_it = found.isel(perturber=-1)
    period, error = all_of_it.precession_period / 1e3, all_of_it.precession_period_error / 1e3
    ax.errorbar(period, row, xerr=error, fmt="o", color=f"C{row}", capsize=3)
    words = measured(all_of_it, "precession_period") + " years"
    note(ax, words, (float(period), row), (8, 0), va="center")
ax.set_yticks(range(3), worlds)
ax.set(xlabel="period of precession (1000 years)", xlim=(0, 230), ylim=(2.6, -0.6))

# %%
# Rate against obliquity
# ----------------------
# Averaged over an orbit, the rate is proportional to the cosine of the obliquity (I.8.7
# averaged). Each dot is a body with its own obliquity under the torques of the real Sun and Moon;
# the line is the cosine through the first dot. An axis in the orbital plane does not precess.
#
# *Next:* tilt beyond a right angle, as Venus and Uranus are.

normal = MARS.orbit_pole
tilts = np.radians([1.0, 10, 20, 30, 40, 50, 60, 70, 80, 89])
poles = [FixedPole(normal.right_ascension, normal.declination - tilt) for tilt in tilts]
answers = [earthspin.precession(body=MARS.replace(pole=p), perturbers=["sun"]) for p in poles]
obliquity = np.array([float(answer.obliquity) for answer in answers])
rate = np.array([float(answer.precession_rate.isel(perturber=-1)) for answer in answers])
cosine = np.cos(np.radians(obliquity))

fig, ax = plt.subplots()
ax.plot(obliquity, rate, "o", label="Mars, tilted")
line = np.linspace(0, 90, 91)
ax.plot(line, rate[0] / cosine[0] * np.cos(np.radians(line)), "k--", lw=0.9, label="cosine")
ax.set(xlabel="obliquity (deg)", ylabel="rate of precession (arcsec/yr)", xticks=range(0, 91, 15))
ax.legend()

# %%
# Periods from the Earth to Saturn
# --------------------------------
# The period of precession is twenty-six thousand years for the Earth and almost two million for
# Saturn (I.8). The Sun's torque falls with the cube of the distance; Jupiter and Saturn would
# precess still more slowly without the torques on their satellites. Rings are published values,
# those of Jupiter and Saturn not verified; error bars contain the uncertainty of the input
# numbers only. The moments of Venus, the Earth and Mars come from the observed rates, so that
# these comparisons are circular.
#
# *Next:* ask for Uranus with an assumed moment, ``URANUS.replace(dynamical_flattening=...)``:
# none was measured.

published = {
    "venus": inner.VENUS_PRECESSION, "earth": PSI_A_RATE, "mars": inner.MARS_PRECESSION,
    "jupiter": giants.JUPITER_CONSTANT, "saturn": giants.SATURN_CONSTANT,
}  # fmt: skip

fig, ax = plt.subplots()
for row, (name, rate) in enumerate(published.items()):
    found = earthspin.precession(body=name).isel(perturber=-1)
    period, error = float(found.precession_period), float(found.precession_period_error)
    ax.errorbar(period, row, xerr=error, fmt="o", color=f"C{row}", capsize=3)
    # of the giants the constant is published: the rate is less by the cosine of the obliquity
    along = np.cos(np.radians(float(found.obliquity))) if hasattr(giants, name.upper()) else 1.0
    ax.plot(1296e3 / abs(rate.value * along), row, "o", ms=12, mfc="none", color="0.5")
    digits = -int(np.log10(error))
    words = f"{round(period, digits):.{max(digits, 0)}f} years"
    note(ax, words, (period, row), (12, 10), va="center")
ax.set_xscale("log")
ax.set_yticks(range(len(published)), map(proper, published))
ax.set(xlabel="period of precession (years)", xlim=(1.5e4, 2e7), ylim=(4.6, -0.7))

# %%
# Obliquities in Cassini states
# -----------------------------
# In a Cassini state the axis precesses at the rate of the orbit's node. To first order its
# obliquity is :math:`i/|w - 1|`, with :math:`i` the inclination of the orbit and :math:`w` the
# number of turns that the torque would give the axis during one turn of the node (Peale 1969).
# For the Moon :math:`w` is below one, for the others above. Rings are observed values: the shell
# of Titan is decoupled by an ocean (Baland et al. 2011). The moment of Mercury comes from its
# observed obliquity, so that this comparison is circular.
#
# *Next:* give Iapetus a bulge, ``IAPETUS.replace(j2=..., dynamical_flattening=...)``: none was
# measured.

observed = {
    "moon": earth_moon_sun.MOON_OBLIQUITY.value, "titan": moons.TITAN_OBLIQUITY.value,
    "mercury": inner.MERCURY_OBLIQUITY.value / 60, "phobos": None,
}  # fmt: skip

fig, ax = plt.subplots()
for often in np.geomspace(0.05, 0.97, 200), np.geomspace(1.03, 5000, 500):
    ax.plot(often, 1 / np.abs(often - 1), "0.7")
for name, seen in observed.items():
    body, orbit = BODIES[name], planets.PRECESSING_ORBITS[name]
    motion, polar = 2 * np.pi / orbit.period, body.j2 / body.dynamical_flattening
    all_of_it = (motion, body.spin_rate, body.j2, body.triaxiality / 4, polar, orbit.e)
    axial, locked = strengths(*all_of_it)
    turns = 1.5 * (axial + 2 * locked) * abs(orbit.node_period) / (2 * np.pi)
    leans = earthspin.cassini_states(name).obliquity[0] / np.degrees(orbit.i)
    (point,) = ax.plot(turns, leans, "o")
    if seen is not None:
        ax.plot(turns, seen / np.degrees(orbit.i), "o", ms=12, mfc="none", color="0.5")
    note(ax, proper(name), (turns, float(leans)), (10, 6), color=point.get_color())
ax.set(xscale="log", yscale="log", xlabel="turns of the axis per turn of the node, $w$ (number)")
ax.set_ylabel("obliquity over inclination of the orbit")
