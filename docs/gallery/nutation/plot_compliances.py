r"""
How the parts of the Earth answer to one another
================================================

A wobble of the mantle, of the fluid core or of the inner core bulges all three. These numbers say
by how much, and with them go the flattening of each part and its moment. Dots: integrated from
the layers of PREM. Rings: as published (Mathews, Buffett, Herring & Shapiro 1991). They span
eight powers of ten; :math:`\zeta` and :math:`\theta`, what the inner core has to do with the whole,
are the least certain.

*Next:* leave the inner core out: ask for the interior ``"mars-layers"``, and see what remains.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.compliances import plot_compliances

tree = earthspin.run_tree("compliances", sections=["published"])
fig, ax = plt.subplots(figsize=(7.2, 5))
plot_compliances(tree, ax=ax)
