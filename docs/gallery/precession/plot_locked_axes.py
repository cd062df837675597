r"""
Where locked axes stand
=======================

An axis that is locked keeps in step with its orbit: to first order it leans by :math:`i/|w - 1|`,
with :math:`i` the inclination of the orbit and :math:`w` how often the torque would turn the axis
while the node goes round once (Peale 1969). The Moon's orbit is too fast for it, the others' are
not. Rings are observed: the shell of Titan slips on an ocean (Baland et al. 2011). The moment of
Mercury comes from its observed obliquity, so that this comparison is circular.

*Next:* give Iapetus a bulge, ``IAPETUS.replace(j2=..., dynamical_flattening=...)``: none was ever
measured.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.bodies import BODIES, inner, mean_orbits, moon, moons, proper
from earthspin.torque.cassini import strengths
from earthspin.views.drawing import note

observed = {
    "moon": moon.OBLIQUITY.value, "titan": moons.TITAN_OBLIQUITY.value,
    "mercury": inner.MERCURY_OBLIQUITY.value / 60, "phobos": None,
}  # fmt: skip

fig, ax = plt.subplots()
for often in np.geomspace(0.05, 0.97, 200), np.geomspace(1.03, 5000, 500):
    ax.plot(often, 1 / np.abs(often - 1), "0.7")
for name, seen in observed.items():
    body, orbit = BODIES[name], mean_orbits.PRECESSING_ORBITS[name]
    motion, polar = 2 * np.pi / orbit.period, body.j2 / body.dynamical_flattening
    all_of_it = (motion, body.spin_rate, body.j2, body.triaxiality / 4, polar, orbit.e)
    axial, locked = strengths(*all_of_it)
    turns = 1.5 * (axial + 2 * locked) * abs(orbit.node_period) / (2 * np.pi)
    leans = earthspin.cassini_states(name).obliquity[0] / np.degrees(orbit.i)
    (point,) = ax.plot(turns, leans, "o")
    if seen is not None:
        ax.plot(turns, seen / np.degrees(orbit.i), "o", ms=12, mfc="none", color="0.5")
    note(ax, proper(name), (turns, float(leans)), (10, 6), color=point.get_color())
ax.set(xscale="log", yscale="log", xlabel="how often the axis would turn, $w$ (number)")
ax.set_ylabel("obliquity over inclination of the orbit (ratio)")
