r"""
Where the moment of inertia sits
================================

Density falls outwards in PREM (Dziewonski & Anderson 1981), and with a step at the core. A shell
counts in the moment of inertia with the fourth power of its radius, so the core, half of the
Earth across, holds little of it. This share is why a core that stays behind matters for the
wobble, and the mean moment is less than the 2/5 of a uniform sphere (exercise in I.9).

*Next:* compute the share of a uniform Earth and compare the two curves.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.interior.prem import PREM

radius, bottom, density = [], 0.0, []
for layer in PREM.layers:
    here = np.linspace(bottom, layer.top, 60)
    radius.append(here)
    density.append(np.polynomial.Polynomial(layer.density)(here / PREM.radius))
    bottom = layer.top
radius, density = np.concatenate(radius), np.concatenate(density)
rings = np.diff(radius) * (density * radius**4)[1:]
share = np.append(0, np.cumsum(rings)) / rings.sum()

fig, ax = plt.subplots()
ax.plot(radius / 1e3, density, label="density")
ax.set(xlabel="radius (km)", ylabel="density (kg/m³)", ylim=(0, None))
right = ax.twinx()
right.plot(radius / 1e3, 100 * share, "C1", label="moment inside")
right.set(ylabel="moment of inertia inside (%)", ylim=(0, 101))
right.grid(visible=False)
ax.set_title(f"I = {PREM.moment_factor:.4f} M R²; the core has {100 * PREM.core_fraction:.1f} %")
fig.legend(loc="outside lower center", ncols=2)
