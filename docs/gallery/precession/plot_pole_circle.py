r"""
The pole's circle through the stars
===================================

The mean torque of Sun and Moon turns the axis once round the pole of the ecliptic in the time
that the title says (I.8, "Precession of the equinoxes"). The sky is seen from inside, with stars
where they stand today; Thuban, Polaris and Vega take turns near the pole. Rate and obliquity are
held at their present values.

*Next:* let the Sun pull alone, ``perturbers=["sun"]``.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.precession import plot_pole_circle

fig, ax = plt.subplots(figsize=(6.5, 6.1))
plot_pole_circle(earthspin.precession(), ax=ax)
ax.set(xlim=(-34, 32), ylim=(-28.5, 27.5))
