r"""
The budget of precession, effect by effect
==========================================

Each effect beside the pull on the bulge is switched off in turn, and what the rate then lacks is
its size (blue), beside the published one (orange; Capitaine, Wallace & Chapront 2003). The red
line is what is left between our sum and IAU 2006 when all is added up.

*Next:* ask for two effects alone, ``earthspin.compare_iau(effects=["planets", "geodesic"])``.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.iau import plot_budget

fig, ax = plt.subplots(figsize=(6.8, 3.6))
plot_budget(earthspin.compare_iau("1990-01-01", "2010-01-01", "10 d"), ax=ax)
ax.set_xlabel("contribution to the rate (mas per century)")
