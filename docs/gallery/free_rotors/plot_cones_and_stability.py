r"""
Stable and unstable rotation
============================

A symmetric body wobbles in cones; rotation about the middle principal axis is unstable.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.rotor.axisymmetric import SymmetricRotor
from earthspin.rotor.euler import axis_stability

# %%
# Body cone and space cone of a football and of a plate
# -----------------------------------------------------
# The axis of a symmetric body circles the angular momentum at a constant angle (I.6.25). For a
# prolate body the angular velocity lies between figure axis and angular momentum (I.6.30), for an
# oblate one the angular momentum lies between the other two (I.6.31): :math:`\tan\theta =
# (I_1/I_3)\tan\alpha` (I.6.20). Both cones are seen from above, for the same angle between axis
# and angular velocity.
#
# *Next:* let the difference of the moments approach that of the Earth.

turn = np.linspace(0, 2 * np.pi, 181)
circle = np.array([np.sin(turn), -np.cos(turn)])
fig, panels = plt.subplots(1, 2, figsize=(6.8, 3.8))
for ax, name, difference in zip(panels, ("long", "flat"), (-0.5, 0.8), strict=True):
    rotor = SymmetricRotor(1.0, difference, 1.0, np.radians(20))
    theta, space = np.degrees(rotor.theta), np.degrees(rotor.tilt)
    ax.plot(*theta * circle, "C0", label="figure axis")
    ax.plot(*abs(space) * circle, "C1", label="spin")
    ax.plot([0, theta, -space], [0, 0, 0], "0.4", lw=0.8)
    ax.plot(0, 0, "k+", ms=9, label="angular momentum")
    ax.plot(theta, 0, "o", color="C0")
    ax.plot(-space, 0, "o", color="C1")
    ax.set(title=f"{name}: I3/I1 = {1 + difference:g}", xlabel="tilt (deg)", ylabel="tilt (deg)")
    edge = 1.15 * max(theta, abs(space))
    ax.set(aspect="equal", xlim=(-edge, edge), ylim=(-edge, edge))
fig.legend(*ax.get_legend_handles_labels(), loc="outside lower center", ncols=3)

# %%
# The tennis racket theorem
# -------------------------
# A racket is spun about its middle axis. Euler's equations (I.4.4) make a small deviation grow:
# the racket flips, and flips back, again and again, and the rotation about the middle axis (y)
# changes sign at each flip. The solution is Jacobi's closed form, valid for any length of time.
#
# *Next:* start about the axis of the greatest moment: the rotation is stable.

racket = earthspin.free_rotor([1, 2, 2.8], [0.01, 1, 0], duration="80 s", points=801)

fig, ax = plt.subplots(figsize=(6.4, 3.2))
for axis, name in zip("xyz", ("least", "middle", "greatest"), strict=True):
    moving = racket.omega_body.sel(component=axis)
    ax.plot(racket.time, moving, label=f"{axis}, {name} moment")
ax.set(xlabel="time (s)", ylabel="angular velocity\nalong the axes of the body (rad/s)")
ax.legend(ncols=3, loc="lower right", bbox_to_anchor=(1, 1))

# %%
# Growth of a deviation from the middle axis
# ------------------------------------------
# Near the middle axis a deviation grows as :math:`e^{\gamma t}` with :math:`\gamma =
# \omega\sqrt{(C-B)(B-A)/(AC)}`, which follows from Euler's equations (I.4.4). A start a thousand
# times closer to the axis delays the flip by a constant time. Dashed: linear growth; solid: exact
# motion until the flip.
#
# *Next:* compare with a body whose middle moment is closer to the least.

moments, times = [1.0, 2.0, 2.8], np.linspace(0, 45, 451)
rate = float(axis_stability(moments, 1.0).growth_rate[1])

fig, ax = plt.subplots()
for number, push in enumerate((1e-2, 1e-5, 1e-8)):
    racket = earthspin.free_rotor(moments, [push, 1.0, 0.0], times)
    ax.semilogy(
        times, racket.omega_body.sel(component="x"), color=f"C{number}", label=f"{push:g} rad/s"
    )
    early = times < np.log(0.5 / push) / rate
    ax.semilogy(times[early], push * np.cosh(rate * times[early]), "k--", lw=0.8)
ax.set(xlabel="time (s)", ylabel="spin about the axis of least moment (rad/s)")
ax.set_title(f"growth rate {rate:.3f} per second")
ax.legend(title="at the start", loc="lower right")
