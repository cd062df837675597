r"""
Nutation predicted from the interior
====================================

Which part of the Earth changes the nutation by how much.
"""

import matplotlib.pyplot as plt
from earthspin.views.compliances import plot_compliances

import earthspin
from earthspin.views.nutation import plot_nutation_ladder, plot_rung_residuals, plot_transfer

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
# Residuals in time
# -----------------
# Predicted pole minus that of the IAU for each step. A rigid Earth errs in the terms of half a
# year, a month and the Moon's node; with a fluid core the annual term remains, near the core's
# resonance, until the core has the flattening that its observed free nutation requires (Mathews,
# Herring & Buffett 2002).
#
# *Next:* ``anelastic_exponent=0.0`` makes the mantle stiffer.

tree = earthspin.run_tree("nutation", sections=["residuals"])
fig = plt.figure(figsize=(6.4, 7.6), layout="constrained")
plot_rung_residuals(tree, figure=fig)

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

# %%
# Compliances of mantle, core and inner core
# ------------------------------------------
# A wobble of the mantle, of the fluid core or of the inner core deforms all three. Compliances
# give the size of the deformations, beside the flattening and the moment of each region. Dots:
# integrated from the layers of PREM. Rings: published values (Mathews, Buffett, Herring & Shapiro
# 1991). They span eight orders of magnitude; :math:`\zeta` and :math:`\theta`, which belong to
# the inner core, are the least certain.
#
# *Next:* leave the inner core out: ask for the interior ``"mars-layers"``.

tree = earthspin.run_tree("compliances", sections=["published"])
fig, ax = plt.subplots(figsize=(7.2, 5))
plot_compliances(tree, ax=ax)
