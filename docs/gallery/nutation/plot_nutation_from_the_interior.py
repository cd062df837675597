r"""
Nutation predicted from the interior
====================================

Which part of the Earth changes the nutation by how much.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.pole import plot_nutation_ladder, plot_transfer

# %%
# From a rigid Earth to half a milliarcsecond
# -------------------------------------------
# Difference of the nutation from IAU 2000A as the parts of the Earth are added: an elastic
# mantle, a fluid core, an inner core, the ocean, anelasticity. The last step uses one observed
# number, the period of the free core nutation (Mathews, Herring & Buffett 2002).
#
# *Next:* ``earthspin.nutation_ladder(coupling="inferred")`` adds the coupling at the core's
# boundaries that was inferred from nutation.

fig, ax = plt.subplots(figsize=(7.2, 4.2))
plot_nutation_ladder(earthspin.nutation_ladder(), ax=ax)

# %%
# Resonances in the transfer function
# -----------------------------------
# Nutation of the Earth divided by that of a rigid Earth, over frequency. An elastic mantle alone
# changes little; a fluid core has a free nutation, and terms near its frequency are amplified.
# The dots are terms of IAU 2000A (Mathews, Herring & Buffett 2002), the line is predicted.
#
# *Next:* the small resonance to the right belongs to the inner core; zoom with ``ax.set_xlim(0.5,
# 1.1)``.

tree = earthspin.run_tree("nutation", sections=["transfer", "terms"])
fig, ax = plt.subplots(figsize=(7.2, 4.4))
plot_transfer(tree, ax=ax)
