r"""
Observed polar motion
=====================

The daily pole of the IERS since 1962: its path, spectrum and Chandler wobble.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.views.observed_pole import plot_amplitude, plot_polhode, plot_spectra

# %%
# Path of the pole on the ground
# ------------------------------
# Path of the celestial intermediate pole relative to the Earth's crust, as in figure I.6.32. The
# Chandler and the annual wobble have nearly the same period; their sum grows and shrinks as they
# come into and out of phase, so that the path is a spiral, and its centre drifts. The years shown
# cover one beat.
#
# *Next:* the years about 2018, when the Chandler wobble was weak: the annual wobble alone.

seen = earthspin.polar_motion(span=("1993-01-01", "2000-01-01"))

fig, ax = plt.subplots(figsize=(6.4, 5.2))
plot_polhode(seen, years=None, ax=ax)

# %%
# Annual and Chandler wobble
# --------------------------
# Prograde and retrograde annual terms and a term with the free period, fitted to the pole of a
# dozen years: the Chandler wobble is a circle, prograde as for the symmetric rotor (I.6.5), the
# annual wobble an ellipse. Atmosphere, ocean and water on land force the annual wobble; the
# Chandler wobble is free.
#
# *Next:* fit the years since 2015.

seen = earthspin.polar_motion(span=("1986-01-01", "1998-01-01"))
period = float(earthspin.fit_chandler(earthspin.polar_motion()).chandler_period)
days = ((seen.time - seen.time[0]) / np.timedelta64(1, "D")).values
pole = (seen.x - 1j * seen.y).values * 1e3  # mas
year, free = 2j * np.pi / 365.25, 2j * np.pi / period
waves = [np.exp(rate * days) for rate in (free, year, -year)]
columns = np.stack([*waves, np.ones_like(days), days], axis=1)
size = np.linalg.lstsq(columns, pole)[0]

fig, ax = plt.subplots(figsize=(5.2, 5))
turn = np.linspace(0, 2j * np.pi, 181)
circles = {
    f"free, {period:.1f} d": size[0] * np.exp(turn),
    "annual": size[1] * np.exp(turn) + size[2] * np.exp(-turn),
}
for name, path in circles.items():
    ax.plot(-path.imag, path.real, label=f"{name}: {np.abs(path).max():.0f} mas")
ax.set(xlabel="y, towards 90° west (mas)", ylabel="x, towards the prime meridian (mas)")
ax.set(aspect="equal", xlim=(-220, 220), ylim=(-220, 260))
ax.legend(loc="upper left")

# %%
# Prograde and retrograde spectrum
# --------------------------------
# Spectrum of polar motion, prograde and retrograde. The Chandler wobble is prograde only, since
# the body cone of I.6.7 is traversed in one direction for an oblate body; the annual peak is
# mainly prograde, and the semiannual peak is on both sides.
#
# *Next:* divide the record into halves: the Chandler peak differs.

fig, ax = plt.subplots(figsize=(7, 3.8))
plot_spectra(earthspin.run_tree("polar-motion", sections=["spectrum"]), ax=ax)

# %%
# Amplitude of the Chandler wobble
# --------------------------------
# Amplitude of the Chandler wobble in sliding windows, from the daily pole of the IERS (C04) since
# 1962. The amplitude that the source text states (end of I.6, dashed) was reached in the best
# decades; about 2018 the wobble nearly vanished, while the annual wobble continued.
#
# *Next:* a longer window, ``earthspin.polar_motion(window="13 yr")``, shows slower changes.

tree = earthspin.run_tree("polar-motion", sections=["chandler"])
found = tree.earthspin.section("chandler")
lowest = found.chandler_amplitude.isel(middle=int(found.chandler_amplitude.argmin("middle")))

fig, ax = plt.subplots(figsize=(7, 3.8))
plot_amplitude(tree, ax=ax)
when = lowest.middle.dt.strftime("%B %Y").item()
ax.set_title(f"minimum {float(lowest):.0f} mas in {when}")
