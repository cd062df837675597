r"""
What an Earth that is not rigid adds
====================================

Our pole less IAU 2000A for four models. Better celestial mechanics leaves the first remainder as
it is; the response of the inside of the Earth takes it away (Mathews, Herring & Buffett 2002),
fitted in the third panel, predicted from the layers of the Earth in the last. To the third belongs
what the IAU's series holds and no response makes, such as an atmospheric tide of a year.

*Next:* ``effects=[...]`` in ``earthspin.compare_iau`` switches each part by itself.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.iau import plot_pole_residuals

sections = ["residuals_by_model", "residual_sizes"]
tree = earthspin.run_tree(earthspin.load_scene("iau"), sections=sections)

fig = plt.figure(figsize=(6.4, 8.0), layout="constrained")
plot_pole_residuals(tree, figure=fig)
