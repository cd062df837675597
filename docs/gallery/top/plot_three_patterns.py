r"""
Wave, cusp and loop
===================

One top, three starts: pushed forward, let go, pushed back. The path of its tip, seen here as
azimuth against inclination, is a wave, a row of cusps or a row of loops, the three patterns of
figure I.7.19. Which one follows from the sign of :math:`\dot\varphi = (b -
a\cos\theta)/\sin^2\theta` (I.7.9) at the turning points.

*Next:* find the push that lets the tip move on a level line, without any nodding.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin

fig, panels = plt.subplots(3, 1, figsize=(6.4, 5.2), sharex=True, sharey=True)
for ax, scene in zip(panels, ("top-wave", "top-cusp", "top-loop"), strict=True):
    top = earthspin.run(earthspin.load_scene(scene))
    ax.plot(np.degrees(top.phi), np.degrees(top.theta))
    nods = 2 * np.pi / float(top.nutation_period)
    ax.set_title(f"{top.pattern.item()}: nods at {nods:.2f} rad/s")
    ax.set_ylabel("inclination (deg)")
ax.invert_yaxis()
ax.set_xlabel("azimuth of the axis (deg)")
