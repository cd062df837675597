r"""
Half the sine of twice the declination
======================================

Every instant of nineteen years as one dot: the size of the torque against the declination. The
law is :math:`\sin\delta\cos\delta` (I.8.7), a curve that is almost straight at such declinations;
the Moon's dots spread into a band because its distance swings, and the torque with the inverse
cube of it. The dashed line has the mean of that inverse cube.

*Next:* colour the dots by distance.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin import EARTH, MOON, SUN
from earthspin.constants import G
from earthspin.mass.inertia import moment_difference

seen = earthspin.torque_series("2000-01-01", "2019-01-01", "1 d")
bulge = moment_difference(EARTH.j2, EARTH.gm / G.value, EARTH.radius)  # C - A, kg m2
delta = np.radians(np.linspace(-29, 29, 100))

fig, ax = plt.subplots()
for body, colour in ((MOON, "C0"), (SUN, "C4")):
    of = seen.sel(perturber=body.name)
    size = of.torque_magnitude / 1e22
    ax.plot(of.declination, size, ".", ms=1.2, color=colour, label=body.name)
    law = 3 * body.gm * bulge * float((of.distance**-3.0).mean()) * np.sin(delta) * np.cos(delta)
    ax.plot(np.degrees(delta), np.abs(law) / 1e22, "k--", lw=0.8)
ax.set(xlabel="declination (deg)", ylabel="torque (10$^{22}$ N m)", ylim=(0, None))
ax.legend(markerscale=8)
