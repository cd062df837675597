r"""
Terms of nutation
=================

Amplitudes of nutation, the response of the interior, and three axes.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.views.pole import plot_nutation_ratio

# %%
# Largest terms of nutation
# -------------------------
# The path of the pole as a sum of circular motions, with the period of the node, half a year,
# half a month and so on, each with a prograde and a retrograde part. The largest terms of a rigid
# Earth (as in Souchay et al. 1999) are beside those of IAU 2000A; at this scale they look alike.
#
# *Next:* divide one by the other: the quotient is the response of the Earth's interior.

terms = earthspin.run_tree(earthspin.load_scene("iau"), sections=["nutation"])["nutation"]
terms = terms.to_dataset().isel(term=slice(0, 14))
rows = np.arange(terms.term.size)

fig, ax = plt.subplots(figsize=(6.4, 4.4))
ax.barh(rows - 0.2, np.abs(terms.rigid_in_phase), 0.38, label="ours, rigid")
ax.barh(rows + 0.2, np.abs(terms.iau_in_phase), 0.38, color="C4", label="IAU 2000A")
ax.set_yticks(rows, [f"{period:+.2f} d".replace("-", "−") for period in terms.period.values])
ax.set(xscale="log", xlabel="amplitude in phase (mas)", ylabel="period, negative if retrograde")
ax.invert_yaxis()
ax.legend(loc="lower right")
ax.grid(axis="y", visible=False)

# %%
# Resonance of the free core nutation
# -----------------------------------
# Each dot is a term of nutation: its amplitude in IAU 2000A divided by that of a rigid Earth.
# Near the dashed line the mantle moves relative to its fluid core, and the ratio grows as in a
# driven oscillator. The crosses are the resonance formula of Mathews, Herring & Buffett (2002),
# fitted to the dots.
#
# *Next:* compare with the free core nutation that the Earth's layers predict, in the next section
# of the gallery.

tree = earthspin.run_tree(earthspin.load_scene("iau"), sections=["nutation", "core"])

fig, ax = plt.subplots(figsize=(6.8, 4.2))
plot_nutation_ratio(tree, ax=ax)

# %%
# Three axes, milliarcseconds apart
# ---------------------------------
# The Earth has three axes: of figure, of rotation, and of angular momentum (the three lines of
# I.6.31). In a rigid Earth under torques the figure axis departs from the angular momentum by some
# milliarcseconds with the period of half a month; the rotation axis stays closer by a factor of
# hundreds.
#
# *Next:* add the response of the interior, ``effects="all"``.

path = earthspin.pole("2006-01-01", "2006-07-01", "6 h", effects="rigid")
vectors = np.stack([path.X, path.Y, path.Z], axis=-1)  # time, axis, component
axes = dict(zip(path.axis.values, np.moveaxis(vectors, 1, 0), strict=True))

fig, ax = plt.subplots()
for name in ("figure", "rotation"):
    apart = np.linalg.norm(axes[name] - axes["angular_momentum"], axis=-1)
    ax.semilogy(path.time, np.degrees(apart) * 3.6e6, label=f"{name} axis")
ax.set(xlabel="time (TDB)", ylabel="angle from the angular momentum (mas)")
ax.set_ylim(1e-4, 100)
ax.legend()
