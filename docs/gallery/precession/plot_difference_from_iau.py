r"""
Our precession less the IAU's
=============================

The angles that locate the equator, from torques alone and from IAU 2006, as polynomials in time;
what is drawn is the difference. The slope of :math:`\psi_A` is the closure of the budget and a
term that no rigid body has; the constants are the mean square of the nutation (Capitaine, Wallace
& Chapront 2003).

*Next:* the kernel DE440 reaches further; the slope hardly changes.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin

tree = earthspin.run_tree(earthspin.load_scene("iau", {"step": "10 d"}), sections=["angles"])
angles = tree["angles"].to_dataset(inherit=False)
centuries = np.linspace(-0.75, 0.53, 100)
names = {"psi_A": "$\\psi_A$", "omega_A": "$\\omega_A$", "eps_A": "$\\varepsilon_A$"}

fig, ax = plt.subplots()
for (angle, label), style in zip(names.items(), ("-", "-", "--"), strict=True):
    of = angles.sel(angle=angle)
    off = (of.angle_coefficient - of.angle_coefficient_iau).values * 1e3
    ax.plot(2000 + 100 * centuries, np.polynomial.Polynomial(off)(centuries), style, label=label)
ax.set(xlabel="TDB (year)", ylabel="difference (mas)")
ax.legend()
