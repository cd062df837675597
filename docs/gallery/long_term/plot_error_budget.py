r"""
What limits the longitude of perihelion
=======================================

Each thing that the solution stands on is changed by its half-width, and the equation is solved
again; what the longitude of perihelion then differs by is the share of that cause. Near the present
it is the orbit, whose short-period part is left out; from some ten thousand years on the present
rate of :math:`J_2`, which cannot go on; from a hundred thousand on the unknown Earth, its
flattening and its tides (Quinn, Tremaine & Duncan 1991). The error of the method is below the
frame for most of the way.

*Next:* ten million years, ``earthspin.run_tree(scene)`` with ``span = ["-10 Myr", "0 kyr"]``.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.long_term import plot_budget

tree = earthspin.run_tree(
    earthspin.load_scene("long-term", {"span": ["-2 Myr", "0 kyr"], "step": "500 yr"}), ["budget"]
)

fig, ax = plt.subplots(figsize=(7.4, 4.0))
plot_budget(tree, ax=ax)
