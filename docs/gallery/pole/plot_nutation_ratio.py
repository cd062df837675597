r"""
Near the free core nutation the core is left behind
===================================================

Each dot is a term of nutation: its amplitude in IAU 2000A over the one a rigid Earth would have.
Near the dashed line the mantle slides over its liquid core, and the ratio runs away as in a
driven oscillator. The crosses are the resonance form of Mathews, Herring & Buffett (2002), fitted
to the dots.

*Next:* compare with the free core nutation that the Earth's layers give, in the gallery's
wobbles.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.iau import plot_nutation_ratio

tree = earthspin.run_tree(earthspin.load_scene("iau"), sections=["nutation", "core"])

fig, ax = plt.subplots(figsize=(6.8, 4.2))
plot_nutation_ratio(tree, ax=ax)
ax.set_ylabel("IAU 2000A over ours, in phase (ratio)")
