r"""
A football and a plate wobble on different sides
================================================

A symmetric body carries its axis round the angular momentum at a fixed distance (I.6.25). For a
long body the spin lies between figure axis and angular momentum (I.6.30), for a flat one the
angular momentum lies between the other two (I.6.31): :math:`\tan\theta = (I_1/I_3)\tan\alpha`
(I.6.20). What is seen are these two cones from above, from the same angle between axis and spin.

*Next:* let the difference of the moments go to that of the Earth.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.rotor.axisymmetric import SymmetricRotor

turn = np.linspace(0, 2 * np.pi, 181)
circle = np.array([np.sin(turn), -np.cos(turn)])
fig, panels = plt.subplots(1, 2, figsize=(6.8, 3.8), sharey=True)
for ax, name, difference in zip(panels, ("long", "flat"), (-0.5, 0.8), strict=True):
    rotor = SymmetricRotor(1.0, difference, 1.0, np.radians(20))
    theta, space = np.degrees(rotor.theta), np.degrees(rotor.tilt)
    ax.plot(*theta * circle, "C0", label="figure axis")
    ax.plot(*abs(space) * circle, "C1", label="spin")
    ax.plot([0, theta, -space], [0, 0, 0], "0.4", lw=0.8)
    ax.plot(0, 0, "k+", ms=9, label="angular momentum")
    ax.plot(theta, 0, "o", color="C0")
    ax.plot(-space, 0, "o", color="C1")
    ax.set(title=f"{name}: I3/I1 = {1 + difference:g}", xlabel="tilt (deg)")
    ax.set(aspect="equal", xlim=(-40, 40), ylim=(-40, 40))
panels[0].set_ylabel("tilt (deg)")
fig.legend(*ax.get_legend_handles_labels(), loc="outside lower center", ncols=3)
