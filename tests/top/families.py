"""Random tops that try each kind of motion; the same ones in every run."""

from collections.abc import Callable, Iterator

import numpy as np

Start = dict[str, float]
Generator = np.random.Generator


def cases(family: str, count: int) -> Iterator[Start]:
    """Starts of a family: the fields of a HeavyTop."""
    rng = np.random.default_rng([ord(letter) for letter in family])
    for _ in range(count):
        yield {name: float(value) for name, value in FAMILIES[family](rng).items()}


def _body(rng: Generator) -> Start:
    """Moments and weight of any size, from a needle to a disc."""
    i1 = 10 ** rng.uniform(-6, 3)
    return {
        "transverse_moment": i1,
        "axial_moment": i1 * rng.uniform(0.02, 2),
        "weight_moment": i1 * 10 ** rng.uniform(-2, 3),
    }


def _swing(body: Start) -> float:
    """Rate of the top as a pendulum, the natural unit of its rates."""
    return float(np.sqrt(body["weight_moment"] / body["transverse_moment"]))


def _spin(body: Start, a: float) -> float:
    """Spin that gives the constant a."""
    return a * body["transverse_moment"] / body["axial_moment"]


def _small(rng: Generator, least: float, most: float = 0.0) -> float:
    return float(10 ** rng.uniform(least, most))


def _sign(rng: Generator) -> float:
    return float(rng.choice([-1.0, 1.0]))


def generic(rng: Generator) -> Start:
    """Any start, standing or hanging."""
    body = _body(rng)
    rate = _swing(body)
    body["weight_moment"] *= _sign(rng)
    return body | {
        "theta": rng.uniform(0, np.pi),
        "spin": _spin(body, rate * rng.normal() * 3),
        "phi_rate": rate * rng.normal() * 2,
        "theta_rate": rate * rng.normal() * 2,
    }


def fast(rng: Generator) -> Start:
    """A fast top, nutating by 1e-4 to 1e-12."""
    body = _body(rng)
    rate = _swing(body)
    faster = _small(rng, 2, 6)
    body["weight_moment"] *= _sign(rng)
    return body | {
        "theta": rng.uniform(0.05, np.pi - 0.05),
        "spin": _spin(body, rate * faster * _sign(rng)),
        "phi_rate": rate / faster * rng.normal(),
        "theta_rate": rate / faster * rng.normal(),
    }


def near_steady(rng: Generator) -> Start:
    """Slow or fast precession, off the steady rate by 1e-3 to 1e-15 of it."""
    body = _body(rng)
    theta = rng.uniform(0.05, np.pi - 0.05)
    cosine, beta = np.cos(theta), 2 * body["weight_moment"] / body["transverse_moment"]
    a = np.sqrt(max(2 * beta * cosine, 0) + beta * _small(rng, -2, 4)) * _sign(rng)
    root = np.sqrt(a * a - 2 * beta * cosine) * np.sign(a)
    steady = rng.choice([beta / (a + root), (a + root) / (2 * cosine)])
    return body | {
        "theta": theta,
        "spin": _spin(body, a),
        "phi_rate": steady * (1 + _sign(rng) * _small(rng, -15, -3)),
        "theta_rate": abs(steady) * rng.choice([0, _small(rng, -15, -3)]),
    }


def _near_sleeping(rng: Generator, excess: float) -> Start:
    body = _body(rng)
    theta = _small(rng, -8, -1)
    a = 2 * _swing(body) * (1 + excess) * _sign(rng)
    return body | {
        "theta": theta,
        "spin": _spin(body, a),
        "phi_rate": abs(a) * rng.normal(),
        "theta_rate": abs(a) * theta * rng.normal() * rng.choice([0, 1]),
    }


def sleeping_above(rng: Generator) -> Start:
    """Nearly upright, above the critical spin by 1 to 1e-8 of it."""
    return _near_sleeping(rng, _small(rng, -8))


def sleeping_below(rng: Generator) -> Start:
    """Nearly upright, below the critical spin by 0.9 to 1e-8 of it."""
    return _near_sleeping(rng, -0.9 * _small(rng, -8))


def cusp(rng: Generator) -> Start:
    """Let go at rest."""
    body = _body(rng)
    body["weight_moment"] *= _sign(rng)
    return body | {
        "theta": rng.uniform(0.02, np.pi - 0.02),
        "spin": _spin(body, np.sqrt(abs(body["weight_moment"])) * rng.normal())
        / np.sqrt(body["transverse_moment"])
        * 3,
    }


def near_separatrix(rng: Generator) -> Start:
    """On its way to come just short of the upright, or just past it."""
    body = _body(rng)
    rate = _swing(body)
    a = 2 * rate * rng.uniform(-0.95, 0.95)
    lowest = np.arccos(a * a / (2 * rate * rate) - 1)
    theta = lowest * rng.uniform(0.1, 0.95)
    phi_rate = a / (1 + np.cos(theta))
    # On the separatrix a = b and alpha = beta.
    left = 4 * rate**2 * np.sin(theta / 2) ** 2 - (phi_rate * np.sin(theta)) ** 2
    return body | {
        "theta": theta,
        "spin": _spin(body, a),
        "phi_rate": phi_rate * (1 + _sign(rng) * _small(rng, -15, -2)),
        "theta_rate": _sign(rng) * np.sqrt(left) * (1 + _sign(rng) * _small(rng, -15, -2)),
    }


def near_pole(rng: Generator) -> Start:
    """Passing either pole at a distance of 1e-1 to 1e-9."""
    start = generic(rng)
    a = start["axial_moment"] * start["spin"] / start["transverse_moment"]
    cosine = np.cos(start["theta"])
    past = rng.choice([a / (1 + cosine), -a / (1 - cosine)])
    return start | {"phi_rate": past * (1 + _sign(rng) * _small(rng, -9, -1))}


def weightless(rng: Generator) -> Start:
    """No weight: a free rotor seen from axes that its angular momentum is not along."""
    return generic(rng) | {"weight_moment": 0.0}


def pendulum(rng: Generator) -> Start:
    """No spin: the spherical pendulum, from nearly plane to conical."""
    start = generic(rng)
    return start | {"spin": 0.0, "phi_rate": start["phi_rate"] * _small(rng, -10)}


FAMILIES: dict[str, Callable[[Generator], Start]] = {
    "generic": generic,
    "fast": fast,
    "near-steady": near_steady,
    "sleeping, above": sleeping_above,
    "sleeping, below": sleeping_below,
    "cusp": cusp,
    "near-separatrix": near_separatrix,
    "near-pole": near_pole,
    "weightless": weightless,
    "pendulum": pendulum,
}
