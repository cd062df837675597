"""Bounds on the torques of J3, J4 and triaxiality, which a model with only J2 neglects.

The torque on J_n is (G M m / r) J_n (a/r)^n P_n'(u) times the sine of the angle from the axis
(`torque.harmonics`); the torque on the equatorial ellipticity is at most 3/2 G m (B - A) / r3,
about the axis.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

#: Largest |P_n'(u)| sqrt(1 - u2): for n = 3 at u2 = 11/15, for n = 4 at u2 = (27 + sqrt(393))/56.
_STEEPEST = {3: 2.065591117977289, 4: 2.6400655581640695}


def largest_torque_on_figure(
    pulls: Sequence[tuple[float, float]],
    mass: float,
    radius: float,
    zonal: Mapping[int, float],
    triaxiality: float,
) -> dict[str, float]:
    """Largest torques of J3, J4 and triaxiality, which a model with only J2 neglects.

    Parameters
    ----------
    pulls : sequence of (gm, distance)
        Of each perturber, m3 s-2 and smallest distance, m.
    mass, radius : float
        Mass and equatorial radius of the body, kg and m.
    zonal : mapping of int to float
        J3 and J4.
    triaxiality : float
        (B - A) / (M a2).

    Returns
    -------
    dict of str to float
        By effect, N m; effects of size zero are omitted.
    """
    moment = mass * radius * radius
    torques = {
        f"j{n}": sum(
            gm / r**3 * moment * abs(j) * (radius / r) ** (n - 2) * _STEEPEST[n] for gm, r in pulls
        )
        for n, j in zonal.items()
    }
    torques["triaxiality"] = sum(1.5 * gm / r**3 * moment * triaxiality for gm, r in pulls)
    return {effect: size for effect, size in torques.items() if size}
