r"""
From the Earth to Saturn
========================

One turn of precession takes twenty-six thousand years for the Earth and almost two million for
Saturn (I.8). The Sun's pull falls with the cube of the distance; Jupiter and Saturn would be slower
still, did their satellites not pull with them. Rings are published values, those of Jupiter and
Saturn not verified; error bars hold the uncertainty of the input numbers only. The moments of
Venus, the Earth and Mars come from the observed rates, so that these comparisons are circular.

*Next:* ask for Uranus with a moment of your own, ``URANUS.replace(dynamical_flattening=...)``: it
is not known.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.bodies import giants, inner, mars, proper
from earthspin.constants import PSI_A_RATE
from earthspin.views.drawing import note

published = {
    "venus": inner.VENUS_PRECESSION, "earth": PSI_A_RATE, "mars": mars.PRECESSION,
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
    words = f"{round(period, digits):,.{max(digits, 0)}f} years"
    note(ax, words, (period, row), (12, 10), va="center")
ax.set_xscale("log")
ax.set_yticks(range(len(published)), map(proper, published))
ax.set(xlabel="one turn of precession (years)", xlim=(1.5e4, 2e7), ylim=(4.6, -0.7))
