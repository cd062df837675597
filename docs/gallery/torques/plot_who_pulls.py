r"""
Who turns the Earth, and how hard
=================================

The torque goes as mass over distance cubed (I.8.7). So the Moon beats the Sun, and the planets
come orders of magnitude behind; Venus leads when it is near, Jupiter by its mass. What is drawn
is the largest torque of eight years, the shortest span in which Venus repeats its places.

*Next:* add the missing planets, and change the span to that of one approach of Mars.
"""

import matplotlib.pyplot as plt

import earthspin

pulls = ["moon", "sun", "venus", "jupiter", "mars", "saturn", "mercury", "uranus", "neptune"]
seen = earthspin.torque_series("2016-01-01", "2024-01-01", "2 d", perturbers=pulls)
largest = seen.torque_magnitude.max("time").sortby(seen.torque_magnitude.max("time"))

fig, ax = plt.subplots()
ax.barh(largest.perturber, largest, color="C0")
for row, value in enumerate(largest.values):
    ax.annotate(f"{value:.1e}", (value, row), (4, 0), textcoords="offset points", va="center")
ax.set(xscale="log", xlabel="largest torque (N m)", xlim=(1e12, 1e25))
ax.grid(axis="y", visible=False)
