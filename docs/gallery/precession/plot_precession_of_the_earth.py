r"""
From the torque to the period of precession
===========================================

The method of this package, the convergence of its average, and the path of the pole.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.precession import plot_chain, plot_convergence, plot_pole_circle

# %%
# The path of the pole among the stars
# ------------------------------------
# The mean torque of Sun and Moon moves the axis once around the pole of the ecliptic in the time
# that the title gives (I.8, "Precession of the equinoxes"). The sky is seen from inside, with the
# stars at their present positions; Thuban, Polaris and Vega are close to the path. Rate and
# obliquity have their present values.
#
# *Next:* leave the Moon out, ``perturbers=["sun"]``.

fig, ax = plt.subplots(figsize=(6.5, 6.1))
plot_pole_circle(earthspin.precession(), ax=ax)
ax.set(xlim=(-34, 32), ylim=(-28.5, 27.5))

# %%
# From declinations to the period
# -------------------------------
# Skyfield gives the declinations of Sun and Moon (top). Equation I.8.7 gives the torques on the
# equatorial bulge (middle; dashed: means over the year). The torque averaged over whole periods
# of the Moon's node gives the rate and the period of precession (bottom).
#
# *Next:* leave the Moon out, ``perturbers="sun"``: the period is three times as long.

precession = earthspin.run_tree("precession", sections=["convergence"])
year = earthspin.torque_series("2000-01-01", "2001-01-01", "6 h", source="skyfield")

fig = plt.figure(figsize=(6.8, 6.4), layout="constrained")
plot_chain(precession, year, figure=fig)

# %%
# Convergence of the average
# --------------------------
# The torque (I.8.7) varies with half a month, half a year and the period of the Moon's node. A
# plain mean over an arbitrary span gives a rate that is wrong by arcseconds per century. A
# weighted mean over whole periods of the node converges to the dashed line, the error that the
# answer claims for its average.
#
# *Next:* average the Sun alone: how many years does it take?

tree = earthspin.run_tree("precession", sections=["convergence"])

fig, ax = plt.subplots(figsize=(6.8, 4.0))
plot_convergence(tree, ax=ax)
ax.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=4, fontsize=7.5)
ax.set_ylabel("error of the averaged rate (arcsec per year)")
