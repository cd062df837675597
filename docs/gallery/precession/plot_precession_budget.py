r"""
Precession beside that of the IAU
=================================

Which effects make up the observed rate, and what remains.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.views.pole import plot_budget

# %%
# Contributions to the rate of precession
# ---------------------------------------
# Each effect beside the torque on the bulge is switched off in turn; the change of the rate is
# its contribution (blue), beside the published one (orange; Capitaine, Wallace & Chapront 2003).
# The red line is the closure: the total and the published non-linear term, minus IAU 2006.
#
# *Next:* ask for two effects alone, ``earthspin.compare_iau(effects=["planets", "geodesic"])``.

fig, ax = plt.subplots(figsize=(6.8, 3.6))
plot_budget(earthspin.compare_iau("1990-01-01", "2010-01-01", "10 d"), ax=ax)
ax.set_xlabel("contribution to the rate (mas per century)")

# %%
# Difference from IAU 2006
# ------------------------
# Angles that locate the equator, from torques and from IAU 2006, as polynomials in time; the
# figure shows the differences. The slope of :math:`\psi_A` is the remainder of the budget and a
# term that no rigid body has; the constants are the mean square of the nutation (Capitaine,
# Wallace & Chapront 2003).
#
# *Next:* the kernel DE440 covers a longer span; the slope hardly changes.

tree = earthspin.run_tree(earthspin.load_scene("iau", {"step": "10 d"}), sections=["angles"])
angles = tree.earthspin.section("angles")
centuries = np.linspace(-0.75, 0.53, 100)
names = {"psi_A": "$\\psi_A$", "omega_A": "$\\omega_A$", "eps_A": "$\\varepsilon_A$"}

fig, ax = plt.subplots()
for (angle, label), style in zip(names.items(), ("-", "-", "--"), strict=True):
    of = angles.sel(angle=angle)
    off = (of.angle_coefficient - of.angle_coefficient_iau).values * 1e3
    ax.plot(2000 + 100 * centuries, np.polynomial.Polynomial(off)(centuries), style, label=label)
ax.set(xlabel="time (TDB, years)", ylabel="difference (mas)")
ax.legend()
