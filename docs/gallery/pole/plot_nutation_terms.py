r"""
The largest terms of nutation
=============================

The pole's path, taken apart into circles: a turn of the node, half a year, a fortnight and so on,
each a pair of circles, one each way. The largest of a rigid Earth
(as in Souchay et al. 1999) stand beside those of IAU 2000A; on this scale the two look alike.

*Next:* divide one by the other: that is the response of the Earth's inside.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin

terms = earthspin.run_tree(earthspin.load_scene("iau"), sections=["nutation"])["nutation"]
terms = terms.to_dataset().isel(term=slice(0, 14))
rows = np.arange(terms.term.size)

fig, ax = plt.subplots(figsize=(6.4, 4.4))
ax.barh(rows - 0.2, np.abs(terms.rigid_in_phase), 0.38, label="ours, rigid")
ax.barh(rows + 0.2, np.abs(terms.iau_in_phase), 0.38, color="C4", label="IAU 2000A")
ax.set_yticks(rows, [f"{period:+.2f} d" for period in terms.period.values])
ax.set(xscale="log", xlabel="amplitude in phase (mas)", ylabel="period; − is retrograde")
ax.invert_yaxis()
ax.legend(loc="lower right")
ax.grid(axis="y", visible=False)
