r"""
The Chandler wobble of a model Earth
====================================

How the interior changes the period of the free wobble.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin.interior.equilibrium import equilibrium
from earthspin.interior.layers import PREM
from earthspin.interior.love import elastic
from earthspin.views.wobble import plot_by_period, plot_ladder

# %%
# From the rigid to the deformable Earth
# --------------------------------------
# The period of the free wobble of a rigid Earth (I.6.7) is far too short. Elastic deformation
# lengthens it most, a fluid core that does not take part shortens it, and the ocean and
# anelasticity lengthen it again. The band is observed; the last step has one adjustable exponent,
# so that it is a check and not a prediction. Error bars contain the uncertainty of the input
# numbers only.
#
# *Next:* ``earthspin.wobble_ladder(ocean="global")`` assumes a global ocean.

fig, ax = plt.subplots(figsize=(7.2, 4.2))
plot_ladder(earthspin.run_tree("wobble", sections=["observed"]), ax=ax)

# %%
# Mass and moment of inertia inside the Earth
# -------------------------------------------
# Density decreases outwards in PREM (Dziewonski & Anderson 1981), with a step at the core. The
# contribution of a shell to the moment of inertia grows with the fourth power of its radius, so
# that the core, half as wide as the Earth, has a small share. This share determines the effect of
# a fluid core on the wobble, and the mean moment is below the 2/5 of a uniform sphere (exercise
# in I.9).
#
# *Next:* compute the share of a uniform Earth and compare the two curves.

radius, bottom, density = [], 0.0, []
for layer in PREM.layers:
    here = np.linspace(bottom, layer.top, 60)
    radius.append(here)
    density.append(np.polynomial.Polynomial(layer.density)(here / PREM.radius))
    bottom = layer.top
radius, density = np.concatenate(radius), np.concatenate(density)
rings = np.diff(radius) * (density * radius**4)[1:]
share = np.append(0, np.cumsum(rings)) / rings.sum()

fig, ax = plt.subplots()
ax.plot(radius / 1e3, density, label="density")
ax.set(xlabel="radius (km)", ylabel="density (kg/m³)", ylim=(0, None))
right = ax.twinx()
right.plot(radius / 1e3, 100 * share, "C1", label="moment inside")
right.set(ylabel="moment of inertia inside (%)", ylim=(0, 101))
right.grid(visible=False)
ax.set_title(f"I = {PREM.moment_factor:.4f} M R²; the core has {100 * PREM.core_fraction:.1f} %")
fig.legend(loc="outside lower center", ncols=2)

# %%
# Love number from a fluid to the real Earth
# ------------------------------------------
# The Love number :math:`k_2` measures the deformation by a tide or by the wobble. All shear
# moduli of PREM (Dziewonski & Anderson 1981) are multiplied by one factor: the softer the mantle,
# the closer :math:`k_2` is to the value of a fluid Earth (dashed), which determines the
# hydrostatic bulge. The dot is the real Earth; the period of its wobble depends on it.
#
# *Next:* change the density of the core, and compute :math:`k_2` again.


def k2(factor):
    scaled = (
        replace(layer, vs=tuple(np.sqrt(factor) * np.array(layer.vs))) for layer in PREM.layers
    )
    return float(elastic(replace(PREM, layers=tuple(scaled))).k)


factors = np.geomspace(1e-3, 1, 25)
fig, ax = plt.subplots()
ax.semilogx(factors, [k2(factor) for factor in factors])
ax.plot(1, k2(1), "o", color="C1", label=f"PREM: {k2(1):.4f}")
liquid = equilibrium(PREM).k
ax.axhline(liquid, color="0.4", ls="--", lw=0.9, label=f"liquid: {liquid:.4f}")
ax.set(xlabel="shear modulus over that of PREM", ylabel="Love number $k_2$")
ax.set_ylim(0, 1)
ax.legend()

# %%
# Love numbers by period
# ----------------------
# The mantle is softer for slow forces than for seismic waves, and its response is delayed. Love
# numbers of tide (solid) and load (dashed) divided by those of the elastic PREM, and their phase
# lag, for a dissipation that varies with a power of the period (Smith & Dahlen 1981; Wahr &
# Bergen 1986). The free wobble of 14 months uses the second mark.
#
# *Next:* ``anelastic_exponent=0.15``.

tree = earthspin.run_tree("love-numbers", sections=["by_period"])
fig = plt.figure(figsize=(7.2, 5))
plot_by_period(tree, figure=fig)
