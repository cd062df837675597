r"""
From a rigid Earth to half a milliarcsecond
===========================================

What is left of the nutation, against IAU 2000A, as one part of the Earth after the other is put in:
a mantle that yields, a fluid core, an inner core, the sea, softer rocks. The last step takes one
observed number, the period of the core's own nutation (Mathews, Herring & Buffett 2002).

*Next:* ``earthspin.nutation_ladder(coupling="inferred")`` adds the coupling of the core that was
inferred from nutation itself.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.nutation import plot_nutation_ladder

fig, ax = plt.subplots(figsize=(7.2, 4.2))
plot_nutation_ladder(earthspin.nutation_ladder(), ax=ax)
