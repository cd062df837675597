r"""
Which number the answer hangs on
================================

Ten thousand Earths within what is published of :math:`H`, :math:`J_2`, radius and masses. The rate
of precession hangs on :math:`H` alone, the torque on :math:`J_2` and the radius (I.8): the torque
turns the axis by its ratio to the spin, and :math:`C` stands in both.

*Next:* draw :math:`J_2` and :math:`H` with a correlation, and look at the sum of the shares.
"""

import matplotlib.pyplot as plt

import earthspin

earths = earthspin.ensemble("precession", 10_000).sel(perturber="total")
shares = earths.earthspin.sensitivity()

fig, (left, right) = plt.subplots(1, 2, figsize=(8, 4), layout="constrained")
for ax, name, given in (
    (left, "precession_rate", "body_dynamical_flattening"),
    (right, "mean_torque", "body_j2"),
):
    x, y = earths[given], earths[name]
    ax.plot((x / x.mean() - 1) * 1e6, (y / y.mean() - 1) * 1e6, ".", ms=1, alpha=0.3)
    share = float(shares[f"{name}_share"].sel(input=x.attrs["input"]))
    ax.set_title(f"{name.replace('_', ' ')}: {100 * share:.1f} % by it")
    ax.set_ylabel("departure (10$^{-6}$, ratio)")
left.set_xlabel("departure of $H$ (10$^{-6}$, ratio)")
right.set_xlabel("departure of $J_2$ (10$^{-6}$, ratio)")
