r"""
The wobble all but died
=======================

The amplitude of the Chandler wobble in sliding windows, from the daily pole of the IERS (C04)
since the sixties. The circle of the source text (end of I.6, dashed) was true in its best
decades; about 2018 the wobble nearly vanished, while the annual motion went on.

*Next:* a longer window, ``earthspin.polar_motion(window="13 yr")``, smooths the collapse.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.polar_motion import plot_amplitude

tree = earthspin.run_tree("polar-motion", sections=["chandler"])
found = tree["chandler"].to_dataset()
lowest = found.chandler_amplitude.isel(middle=int(found.chandler_amplitude.argmin("middle")))

fig, ax = plt.subplots(figsize=(7, 3.8))
plot_amplitude(tree, ax=ax)
when = lowest.middle.dt.strftime("%B %Y").item()
ax.set_title(f"least in {when}: {float(lowest):.0f} mas")
