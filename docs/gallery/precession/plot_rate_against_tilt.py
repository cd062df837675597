r"""
The more upright, the faster
============================

Averaged over an orbit, the torque gives a rate that goes as the cosine of the obliquity (I.8.7
averaged). Here each obliquity is a body of its own, tilted and run through the real sky; the line
is the cosine laid through the first of them. An axis that lies in the orbit does not precess at
all.

*Next:* tilt beyond a right angle, as Venus and Uranus do.
"""

import matplotlib.pyplot as plt
import numpy as np

import earthspin
from earthspin import MARS
from earthspin.sky.poles import FixedPole

normal = MARS.orbit_pole
tilts = np.radians([1.0, 10, 20, 30, 40, 50, 60, 70, 80, 89])
poles = [FixedPole(normal.right_ascension, normal.declination - tilt) for tilt in tilts]
answers = [earthspin.precession(body=MARS.replace(pole=p), perturbers=["sun"]) for p in poles]
obliquity = np.array([float(answer.obliquity) for answer in answers])
rate = np.array([float(answer.precession_rate.isel(perturber=-1)) for answer in answers])
cosine = np.cos(np.radians(obliquity))

fig, ax = plt.subplots()
ax.plot(obliquity, rate, "o", label="Mars, tilted")
line = np.linspace(0, 90, 91)
ax.plot(line, rate[0] / cosine[0] * np.cos(np.radians(line)), "k--", lw=0.9, label="cosine")
ax.set(xlabel="obliquity (deg)", ylabel="rate of precession (arcsec/yr)", xticks=range(0, 91, 15))
ax.legend()
