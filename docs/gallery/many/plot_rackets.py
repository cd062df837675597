r"""
Three hundred rackets thrown at once
====================================

Starts may be arrays too: here rackets spin about the middle axis (I.5, the rubber-banded book),
each with another small tilt drawn at random. In step at first, they flip at times of their own;
the mean of all (black) forgets that there was a common start, though no one of them loses
anything.

*Next:* take the axis of the greatest moment: all stay together.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin

rng = np.random.default_rng(4)
starts = np.column_stack([rng.normal(0, 0.02, 300), np.ones(300), rng.normal(0, 0.02, 300)])
rackets = earthspin.free_rotor([1, 2, 2.8], starts, np.linspace(0, 120, 601))
spin = rackets.omega_body.sel(component="y").transpose("time", ...)

fig, ax = plt.subplots()
ax.plot(rackets.time, spin, color="C0", lw=0.3, alpha=0.12)
ax.plot(rackets.time, spin.mean(spin.dims[1]), "k", label="mean of all")
ax.set(xlabel="time (s)", ylabel="spin about the middle axis (rad/s)")
ax.legend(loc="lower right", bbox_to_anchor=(1, 1))
