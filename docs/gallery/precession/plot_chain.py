r"""
From declination to the period
==============================

The method in one figure. Skyfield gives the declinations of Sun and Moon (top), equation I.8.7
turns them into torques on the equatorial bulge (middle; dashed: their means over the year), and the
torque averaged over whole turns of the Moon's node gives the rate and the period of precession
(bottom).

*Next:* leave the Moon out, ``perturbers="sun"``, and read off 81,000 years.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.precession import plot_chain

precession = earthspin.run_tree("precession", sections=["convergence"])
year = earthspin.torque_series("2000-01-01", "2001-01-01", "6 h", source="skyfield")

fig = plt.figure(figsize=(6.8, 6.4), layout="constrained")
plot_chain(precession, year, figure=fig)
