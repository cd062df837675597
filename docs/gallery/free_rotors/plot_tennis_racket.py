r"""
The tennis racket turns over
============================

Spin a racket about its middle axis. Euler's equations (I.4.4) let a small error grow, the racket
turns over, and back again, for ever: the rotation about the middle axis (y) changes sign at each
flip. The solution is Jacobi's closed form, good for any length of time.

*Next:* start about the axis of the greatest moment: nothing happens, however long one waits.
"""

import matplotlib.pyplot as plt

import earthspin

racket = earthspin.free_rotor([1, 2, 2.8], [0.01, 1, 0], duration="80 s", points=801)

fig, ax = plt.subplots(figsize=(6.4, 3.2))
for axis, name in zip("xyz", ("least", "middle", "greatest"), strict=True):
    moving = racket.omega_body.sel(component=axis)
    ax.plot(racket.time, moving, label=f"{axis}, {name} moment")
ax.set(xlabel="time (s)", ylabel="angular velocity\nalong the axes of the body (rad/s)")
ax.legend(ncols=3, loc="lower right", bbox_to_anchor=(1, 1))
