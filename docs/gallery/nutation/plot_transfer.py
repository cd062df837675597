r"""
Through the resonance of the core
=================================

How much larger the nutation of the Earth is than that of a rigid one, over frequency. A mantle that
yields, by itself, does next to nothing; a fluid core has a nutation of its own, and what is near it
is amplified. The dots are the terms of IAU 2000A (Mathews, Herring & Buffett 2002), the line
is predicted.

*Next:* the small kink to the right is the inner core; put ``ax.set_xlim(0.5, 1.1)``.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.nutation import plot_transfer

tree = earthspin.run_tree("nutation", sections=["transfer", "terms"])
fig, ax = plt.subplots(figsize=(7.2, 4.4))
plot_transfer(tree, ax=ax)
