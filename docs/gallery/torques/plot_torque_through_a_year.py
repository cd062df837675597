r"""
A year of torque
================

Sun and Moon pull on the Earth's bulge whenever they stand off the equator (I.8.7). The torque
towards the equinox goes nearly with the square of the declination, so it has the same sign in
summer and in winter and does not average out: the dashed means are what makes the axis precess.
The Moon's month and its larger pull stand out.

*Next:* take a year nine years later, when the Moon's declinations are smallest.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.torque import plot_declination, plot_torque

year = earthspin.torque_series("2006-01-01", "2007-01-01", "6 h")

fig, (upper, lower) = plt.subplots(2, 1, figsize=(6.4, 4.8), sharex=True)
plot_declination(year, ax=upper)
plot_torque(year, ax=lower)
lower.set_ylabel("torque towards\nthe equinox (10$^{22}$ N m)")
