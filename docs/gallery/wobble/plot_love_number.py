r"""
From a liquid to the real Earth
===============================

Love's number :math:`k_2` says by how much the Earth yields to a tide or to its own wobble. All
shear moduli of PREM (Dziewonski & Anderson 1981) are scaled down together: the softer the mantle,
the nearer the number comes to that of a liquid, dashed, by which a planet gets its bulge. The dot
is the real Earth; the period of its wobble rests on it.

*Next:* scale the core's density, and see what the mantle makes of it.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

from earthspin.interior.equilibrium import equilibrium
from earthspin.interior.love import elastic
from earthspin.interior.prem import PREM


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
ax.set(xlabel="shear modulus over PREM's (ratio)", ylabel="Love number k2 (ratio of potentials)")
ax.set_ylim(0, 1)
ax.legend()
