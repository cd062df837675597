r"""
Why a top nods between two angles
=================================

With azimuth and spin gone from the equations, the inclination moves like a ball in the valley of
the effective potential (I.7.18). The energy of each start is a level in it, and the top swings
between the two points where the level meets the valley's sides. Both tops start without any
swing, so at one of these points; the one that is let go at rest draws cusps.

*Next:* double the spin. The valley narrows and the nodding shrinks.
"""

import matplotlib.pyplot as plt
import numpy as np

from earthspin.top.start import HeavyTop
from earthspin.top.turning import effective_potential, turning_angles

angle = np.radians(np.linspace(10, 120, 300))
fig, ax = plt.subplots()
for number, (name, push) in enumerate({"let go": 0.0, "pushed back": -0.6}.items()):
    top = HeavyTop(
        transverse_moment=1.0,
        axial_moment=1.2,
        weight_moment=1.5,
        theta=np.radians(40),
        spin=3.0,
        phi_rate=push,
    )
    ax.plot(np.degrees(angle), effective_potential(top, angle), color=f"C{number}", label=name)
    ends = turning_angles(top)
    level = effective_potential(top, ends)
    ax.plot(np.degrees(ends), level, "o--", color=f"C{number}", lw=0.9)
    print(f"{name}: between {np.degrees(ends[0]):.2f} and {np.degrees(ends[1]):.2f} deg")
ax.set(xlabel="inclination (deg)", ylabel="effective potential (rad²/s²)", ylim=(1.5, 6))
ax.legend()
