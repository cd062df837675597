r"""
What a place on an ellipse costs
================================

Kepler's equation gives the places by which an orbit pulls in I.8.7: here on three ellipses, the
longest nearly a parabola. Started at the mean anomaly, Newton's method is lost on it. From
Danby's start (1988) it needs a few steps, and less time than what ``earthspin.Orbit`` stands on,
which keeps its digits next to a parabola, too.

*Next:* ``earthspin.accuracy("mean-orbit")`` shows the closed mean of such a pull beside windows.
"""

import matplotlib.pyplot as plt

import earthspin
from earthspin.views.work_precision_views import plot_accuracy

fig, ax = plt.subplots(figsize=(7.6, 4.0))
plot_accuracy(earthspin.accuracy("elements", quick=True), ax=ax)
