r"""
The free wobble turns one way
=============================

The spectrum of polar motion, with the spin (prograde) and against it laid over each other. The
free wobble stands on one side alone, as the body cone of I.6.7 is run through in one sense for an
oblate body; the year is nearly so, and half a year is on both.

*Next:* cut the record in two halves: the peak of the free wobble is not the same in both.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.polar_motion import plot_spectra

fig, ax = plt.subplots(figsize=(7, 3.8))
plot_spectra(earthspin.run_tree("polar-motion", sections=["spectrum"]), ax=ax)
