"""An ellipse by its elements as a textbook has it, with any number of digits."""

import mpmath as mp

from earthspin.sky.elements import Ellipse

DAY, DIGITS = 86400, 50


def place(one: Ellipse, day: float) -> list[mp.mpf]:
    """Position along the axes of the plane, m."""
    time = mp.mpf(day) * DAY - mp.mpf(one.epoch) * DAY
    e, mean = mp.mpf(one.e), mp.mpf(one.mean_anomaly) + mp.mpf(one.motion) * time
    mean -= 2 * mp.pi * mp.nint(mean / (2 * mp.pi))
    # from above on either side, where Newton's method never misses
    start = mp.sign(mean) * min(mp.pi, abs(mean) + e)
    angle = mp.findroot(lambda x: x - e * mp.sin(x) - mean, start)
    x, y = mp.cos(angle) - e, mp.sqrt(1 - e * e) * mp.sin(angle)
    along = mp.mpf(one.pericentre) + mp.mpf(one.pericentre_rate) * time
    node = mp.mpf(one.node) + mp.mpf(one.node_rate) * time
    return [mp.mpf(one.a) * c for c in turned(x, y, along, node, mp.mpf(one.i))]


def turned(x: mp.mpf, y: mp.mpf, along: mp.mpf, node: mp.mpf, i: mp.mpf) -> list[mp.mpf]:
    """From the plane of the orbit, x to the pericentre, to the plane of its elements."""
    u, v = x * mp.cos(along) - y * mp.sin(along), x * mp.sin(along) + y * mp.cos(along)
    return [
        u * mp.cos(node) - v * mp.cos(i) * mp.sin(node),
        u * mp.sin(node) + v * mp.cos(i) * mp.cos(node),
        v * mp.sin(i),
    ]


def mean_precessing_torque(one: Ellipse, gm: float, tilt: float, count: int = 256) -> mp.mpf:
    """Of a unit of C - A on an axis that leans in x and z, over anomaly and node, s-2.

    The torque r x s (r s) 3 GM/r^5 is summed at even steps of the eccentric anomaly, weighted with
    r/a, and of the node; its part along z x s, over the square of the sine between z and s.
    """
    e, i, along, a = (mp.mpf(v) for v in (one.e, one.i, one.pericentre, one.a))
    sine, cosine = mp.sin(mp.mpf(tilt)), mp.cos(mp.mpf(tilt))
    total = mp.mpf(0)
    for step in range(count):
        angle = 2 * mp.pi * step / count
        x, y = mp.cos(angle) - e, mp.sqrt(1 - e * e) * mp.sin(angle)
        r = 1 - e * mp.cos(angle)
        for quarter in range(4):
            px, _, pz = turned(x, y, along, quarter * mp.pi / 2, i)
            # y component of s x r and of z x s alike point along y, as s stands in x and z
            total += (px * sine + pz * cosine) * (cosine * px - sine * pz) / r**4
    return 3 * mp.mpf(gm) * total / (4 * count) / a**3 / sine
