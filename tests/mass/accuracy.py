"""Accuracy of the closed forms.

Relative errors against fifty digits and more, of numbers taken as exact.
"""

from typing import NamedTuple

import mpmath as mp
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from earthspin.mass import figure, multipoles, spheroid
from earthspin.mass.tensor import PrincipalAxes, change_frame
from tests.mass.spheroid_reference import FAMILIES, PLACES, draw, one_ulp, textbook

DIGITS = 50
#: Errors up to this are as good as asked for; beyond, they are set against the input's last place.
GOOD = 1e-14


class Errors(NamedTuple):
    """Worst error, where the input's last place does no more; and over what that does, if it does.

    The second is 0 where every error is good.
    """

    error: float
    ulps: float


def spheroid_errors(family: str, place: str, count: int) -> Errors:
    """Potential, both integrals and the torque's factor."""
    rng = np.random.default_rng([FAMILIES.index(family), PLACES.index(place)])
    worst, ulps = 0.0, 0.0
    for _ in range(count):
        body = draw(rng, family, place)
        a, f, *point = body
        integrals = spheroid.attraction_integrals(a, f, point)
        found = [
            spheroid.spheroid_potential(1.0, a, f, point),
            integrals.a1,
            integrals.a3,
            1.5 * integrals.difference * point[2],
        ]
        exact = textbook(body)
        off = [abs(float((mp.mpf(float(v)) - e) / e)) for v, e in zip(found, exact, strict=True)]
        effect = one_ulp(body, exact) if max(off) > GOOD else [0.0] * len(off)
        for one, of_input in zip(off, effect, strict=True):
            if of_input > GOOD:
                ulps = max(ulps, one / of_input)
            else:
                worst = max(worst, one)
    return Errors(worst, ulps)


def random_tensor(rng: np.random.Generator) -> NDArray[np.float64]:
    """A body whose moments differ by 1 to 1e-9 of themselves, turned at random."""
    b, c = 1 + 10 ** rng.uniform(-9, -0.3, size=2)
    diagonal = np.diag(np.sort([1.0, b, c])) * 10 ** rng.uniform(-5, 40)
    return change_frame(diagonal, Rotation.from_quat(rng.normal(size=4)).as_matrix())


class Axes(NamedTuple):
    """Errors of moments (relative), differences (over the largest) and axes (over the estimate)."""

    moments: float
    differences: float
    axes: float


def axes_errors(tensor: NDArray[np.float64], result: PrincipalAxes) -> Axes:
    """Moments, differences and axes of a tensor; an estimate allows for rounding in the tensor."""
    with mp.workdps(DIGITS):
        values, columns = mp.eigsy(mp.matrix(tensor.tolist()))
        exact = [values[i] for i in range(3)]
        gaps = [exact[1] - exact[0], exact[2] - exact[0], exact[2] - exact[1]]
        found = (result.b_minus_a, result.c_minus_a, result.c_minus_b)
        differences = [abs(mp.mpf(v) - g) / gaps[1] for g, v in zip(gaps, found, strict=True)]
        moments = [
            abs(mp.mpf(float(v)) / e - 1) for e, v in zip(exact, result.moments, strict=True)
        ]
        sines = [mp.mpf(0)]
        if result.shape == "triaxial":
            for i in range(3):
                one = [mp.mpf(float(c)) for c in result.axes[i]]
                other = [columns[k, i] for k in range(3)]
                sines += [
                    abs(one[j] * other[k] - one[k] * other[j]) for j, k in ((0, 1), (1, 2), (2, 0))
                ]
        estimate = result.angle_error + 1e-15
        return Axes(float(max(moments)), float(max(differences)), float(max(sines) / estimate))


def inverse_distance(count: int, degree: int = 180) -> float:
    """1/R where one distance is at most 0.8 of the other."""
    rng = np.random.default_rng(4)
    one, other = rng.normal(size=(2, count, 3))
    one *= (rng.uniform(0.01, 0.8, count) / np.linalg.norm(one, axis=-1))[:, None]
    other /= np.linalg.norm(other, axis=-1)[:, None]
    found = multipoles.inverse_distance(one, other, degree)
    assert np.array_equal(found, multipoles.inverse_distance(other, one, degree))
    with mp.workdps(DIGITS):
        exact = [
            1 / mp.norm(mp.matrix([mp.mpf(a) - mp.mpf(b) for a, b in zip(r, s, strict=True)]))
            for r, s in zip(one, other, strict=True)
        ]
        return max(float(abs(mp.mpf(float(v)) / e - 1)) for v, e in zip(found, exact, strict=True))


def maccullagh_torque(count: int) -> float:
    """Torque on moments that differ by 1e-3 to 1e-9 of themselves, given as differences.

    Relative to its size, in which C - B alone is a difference of what was given.
    """
    rng = np.random.default_rng(0)
    worst = 0.0
    for _ in range(count):
        b, c = 10 ** rng.uniform(-9, -3, size=2) * 8e37
        point = rng.normal(size=3) * 10 ** rng.uniform(8, 12)
        found = figure.maccullagh_torque(1.3e20, np.diag([0.0, b, c]), point)
        with mp.workdps(DIGITS):
            x, y, z = map(mp.mpf, map(float, point))
            factor = 3 * mp.mpf(1.3e20) / mp.sqrt(x * x + y * y + z * z) ** 5
            b_, c_ = mp.mpf(float(b)), mp.mpf(float(c))
            exact = [factor * t for t in ((c_ - b_) * y * z, -c_ * x * z, b_ * x * y)]
            sizes = [factor * (b_ + c_) * abs(y * z), abs(exact[1]), abs(exact[2])]
            off = [
                abs(mp.mpf(float(v)) - e) / size
                for v, e, size in zip(found, exact, sizes, strict=True)
            ]
            worst = max(worst, float(max(off)))
    return worst
