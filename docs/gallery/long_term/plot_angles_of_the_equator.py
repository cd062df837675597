r"""
The angles that locate an equator
=================================

The sky along the ecliptic, with the motion of the ecliptic much enlarged. The equator of date
crosses the *fixed* ecliptic (of ``J2000.0``) by :math:`\psi_A` west of the equinox of ``J2000.0``,
under the angle :math:`\omega_A`: these two follow from the torques. It crosses the ecliptic *of
date*, which has moved, at the equinox of date, under the obliquity :math:`\varepsilon`; along that
ecliptic the general precession :math:`p_A` is counted (Capitaine, Wallace & Chapront 2003).

*Next:* how far apart are ``psi_A`` and ``general_precession`` after ten thousand years?
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.views.drawing import note

along = np.linspace(-70, 20, 181)


def circle(node, tilt):
    return np.degrees(np.arctan(np.tan(np.radians(tilt)) * np.sin(np.radians(along - node))))


fig, ax = plt.subplots(figsize=(7.2, 3.9))
fixed, then, moved = circle(0, 23.4), circle(-45, 23.4), circle(15, -12)
ax.plot(along, 0 * along, "k", label="ecliptic of J2000.0")
ax.plot(along, moved, "k--", label="ecliptic of date")
ax.plot(along, fixed, "C0", label="equator of J2000.0")
ax.plot(along, then, "C1", label="equator of date")
meet = int(np.argmin(np.abs(then - moved)))
note(ax, r"$\varepsilon$", (along[meet], moved[meet]), (-5, 11), fontsize=11)
note(ax, r"$\omega_A$", (-45, 0), (26, 3), fontsize=11)
for words, at in (("equinox of date", (along[meet], moved[meet])), ("equinox of J2000.0", (0, 0))):
    ax.plot(*at, "o", color="0.2", ms=5)
    note(ax, words, at, (14, 5) if at[0] else (6, -24))
ax.annotate("", (-45, -2.5), (0, -2.5), arrowprops={"arrowstyle": "->"})
note(ax, r"$\psi_A$", (-36, -2.5), (0, -13), fontsize=11)
ax.set(xlabel="longitude from the equinox of J2000.0 (deg)", ylabel="latitude (deg)")
ax.legend(ncols=4, loc="lower right", bbox_to_anchor=(1, 1))
