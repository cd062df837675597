r"""
Taken apart: the annual and the Chandler circle
===============================================

A sinusoid each way with the year and one with the free period, fitted to the pole of a dozen
years: the free wobble is a circle, with the spin, as the symmetric rotor has it (I.6.5), the year
an ellipse. What air, water and ground push is the year; what is free, the Earth's own.

*Next:* fit the years since 2015.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin

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
