r"""
The wobble ladder
=================

The free wobble of a rigid Earth (I.6.7) is far too fast. That the Earth yields slows it most, a
liquid core that stays behind gives a part back, oceans that follow and a mantle that lags take
the rest. The band is what is observed; the last rung has a free exponent, so it is a check and
not a prediction. Error bars hold the uncertainty of the input numbers only.

*Next:* ``earthspin.wobble_ladder(ocean="global")`` covers the Earth with water.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.wobble import plot_ladder

fig, ax = plt.subplots(figsize=(7.2, 4.2))
plot_ladder(earthspin.run_tree("wobble", sections=["observed"]), ax=ax)
