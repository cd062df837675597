r"""
The pole on the ground
======================

The path of the rotation pole over the Earth's crust, as in figure I.6.32. Free and annual wobble
run at nearly the same rate; their sum swells and shrinks as they come into and out of step, so
the path is a spiral in and out, and its middle drifts. The years shown hold one such beat.

*Next:* the years about 2018, when the free wobble was gone: the annual circle alone.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.polar_motion import plot_polhode

seen = earthspin.polar_motion(span=("1993-01-01", "2000-01-01"))

fig, ax = plt.subplots(figsize=(6.4, 5.2))
plot_polhode(seen, years=None, ax=ax)
fig.axes[-1].set_ylabel("TDB (year)")
