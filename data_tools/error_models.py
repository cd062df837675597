"""How far each setting of each method is off: the data behind ``accuracy = ...`` in a scene.

What the sky does to an oblate body is linear in the tidal tensor Q = GM r r^T/r5, which does
not depend on the body. So the errors of sampling are measured on Q/GM alone, pair by pair,
and hold for a body of any shape, spin and pole:

- windows of the pole: the integral of Q from the epoch, its value and its derivative, against
  windows of 2 d with 14 nodes;
- averages over orbits: tapered means of Q about many epochs, in the axes of the orbit, against a
  smooth curve through daily means over eight cycles;
- nutation: models and spacings of nodes, against `erfa.nut06a` at every time.

Half the difference of the largest and the smallest eigenvalue bounds how far an error of Q can
turn any axis. Numbers are stored as decimal logarithms, rounded up.
"""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Callable
from typing import Any

import erfa
import numpy as np
from numpy.polynomial import Chebyshev
from numpy.typing import NDArray

from earthspin.bodies import BODIES, EARTH, MARS, PLANETS, Body
from earthspin.choosing.choice import DATA
from earthspin.constants import DAY, J2000_JD, JULIAN_YEAR
from earthspin.motion.effects.geodesic import geodesic_rate
from earthspin.numerics.gauss_windows import Windows, integrated
from earthspin.progress import progress
from earthspin.sky.ephemeris import Ephemeris, open_ephemeris
from earthspin.sky.iau import NUTATION_MODELS, Nutation, precession_angles
from earthspin.torque.average import Window
from earthspin.torque.quadrupole import tidal_tensor

DEGREE, SPACING = 6, 1500 * DAY
FloatArray = NDArray[np.float64]
Positions = Callable[[FloatArray], FloatArray]

#: Windows of the pole: length in days, and the numbers of nodes that are tried in it.
NODES = {
    8: (2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 16),
    16: (4, 5, 6, 7, 8, 9, 10, 12, 14, 16),
    32: (2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16),
    64: (2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16),
    128: (2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16),
    256: (2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16),
}
REACH = (0.1, 1.0, 3.0, 10.0, 20.0, 40.0, 65.0, 100.0)  # Julian years from the epoch
REFERENCE = (2.0, 14)
SAMPLES = 40_000

CYCLES = (3, 4, 5, 6, 7, 8)
#: Days between samples: those that come out best among all to 300 days; the Moon's terms make
#: others (29, 73) worse by orders of magnitude.
STEPS = (1, 2, 5, 9, 19, 25, 31, 47, 56, 88, 97, 103, 129, 135, 157, 168, 201, 217, 233, 257, 293)

NUTATION_STEPS = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 20.0, 36.0, 64.0)  # days
NUTATION_SPAN = (-36525.0, 36525.0)

SPINNING = (EARTH, MARS)


def spread(tensor: FloatArray) -> FloatArray:
    """Half the largest less the smallest eigenvalue, shape (6, ...) to (...)."""
    xx, yy, zz, xy, xz, yz = tensor
    matrix = np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=-1)
    values = np.linalg.eigvalsh(matrix.reshape(*xx.shape, 3, 3))
    return np.asarray((values[..., -1] - values[..., 0]) / 2)


def log_up(value: float) -> float:
    """Decimal logarithm, rounded up to two digits."""
    return math.ceil(100 * math.log10(max(value, 1e-99))) / 100


def place_of(kernel: Ephemeris, body: Body, perturber: Body) -> Positions:
    """Position of a perturber as seen from a body, shape (3, ...), at times in s."""
    centre = kernel.code(body.naif, body.name)
    target = {"it": kernel.code(perturber.naif, perturber.name)}

    def place(times: FloatArray) -> FloatArray:
        positions = kernel.positions(target, centre, times.ravel() / DAY)["it"]
        return np.ascontiguousarray(positions.T).reshape(3, *times.shape)

    return place


# --- windows of the pole -------------------------------------------------------------------------


class Integral:
    """A function of time on windows: its values, its derivative, its integral from t = 0."""

    def __init__(self, rate: Callable[[Windows], FloatArray], days: float, nodes: int) -> None:
        count = math.ceil(REACH[-1] * JULIAN_YEAR / DAY / days) + 1
        self.windows = Windows(days * DAY * np.arange(-count, count + 1.0), nodes)
        values = rate(self.windows)
        _, whole = self.windows.integral(values)
        starts = np.cumsum(whole, axis=1) - whole
        starts -= starts[:, count : count + 1]  # nothing has been gathered at t = 0
        self.series = self.windows.coefficients(values)
        self.gathered = integrated(self.series, self.windows.half, starts)
        self.slope = self.windows.coefficients(self.windows.derivative(values))

    def at(self, times: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Integral, value and derivative, each of shape (k, t)."""
        w = self.windows
        return (
            w.evaluate(self.gathered, times),
            w.evaluate(self.series, times),
            w.evaluate(self.slope, times),
        )


def window_errors(
    rate: Callable[[Windows], FloatArray], size: Callable[[FloatArray], FloatArray]
) -> dict[str, Any]:
    """Errors of each setting: of the integral within each reach, of value and of derivative."""
    rng = np.random.default_rng(2000)
    reach = np.array(REACH) * JULIAN_YEAR
    scale = 10 ** rng.uniform(-4, 0, SAMPLES) * reach[-1]
    times = np.sort(scale * rng.choice([-1, 1], SAMPLES))
    best = Integral(rate, *REFERENCE).at(times)
    rows: dict[str, Any] = {"integral": [], "value": [], "derivative": []}
    rows["mean"] = log_up(float(size(best[1]).mean()))
    for days, nodes in settings():
        values = Integral(rate, days, nodes).at(times)
        off = [size(a - b) for a, b in zip(values, best, strict=True)]
        rows["integral"].append([log_up(off[0][np.abs(times) <= r].max()) for r in reach])
        rows["value"].append(log_up(off[1].max()))
        rows["derivative"].append(log_up(off[2].max()))
    return rows


def settings() -> list[tuple[int, int]]:
    """Every window with every number of nodes."""
    return [(days, nodes) for days, orders in NODES.items() for nodes in orders]


def tensor_rate(place: Positions) -> Callable[[Windows], FloatArray]:
    """Tidal tensor of a unit GM at the nodes of windows, shape (6, w, n)."""
    return lambda windows: tidal_tensor([(1.0, place(windows.times))])


def geodesic_of_sun(place: Positions) -> Callable[[Windows], FloatArray]:
    """Geodesic rate about a Sun of unit GM at the nodes of windows, rad/s, shape (3, w, n)."""

    def rate(windows: Windows) -> FloatArray:
        at = place(windows.times)
        return geodesic_rate({"sun": 1.0}, {"sun": at}, {"sun": windows.derivative(at)}, "sun")

    return rate


def pole_models(kernel: Ephemeris) -> dict[str, Any]:
    """Errors of the windows of the pole, by body and perturber."""
    models: dict[str, Any] = {
        "settings": settings(),
        "reach": REACH,
        "tensor": {},
        "geodesic": {},
    }
    pulls = {
        body: [BODIES[n] for n in ("sun", "moon", *PLANETS) if n != body.name] for body in SPINNING
    }
    with progress("windows", sum(map(len, pulls.values()))) as advance:
        for body, perturbers in pulls.items():
            rows = models["tensor"].setdefault(str(body.naif[0]), {})
            for perturber in perturbers:
                if body is not EARTH and perturber.name == "moon":
                    continue
                place = place_of(kernel, body, perturber)
                rows[str(perturber.naif[0])] = window_errors(tensor_rate(place), spread)
                if perturber.name == "sun":
                    rate = geodesic_of_sun(place)
                    errors = window_errors(rate, lambda v: np.linalg.norm(v, axis=0))
                    models["geodesic"][str(body.naif[0])] = errors["integral"]
                advance(1)
    return models


# --- averages over orbits ------------------------------------------------------------------------


def orbit_frame(body: Body, days: FloatArray) -> FloatArray:
    """Axes with z along the normal of the orbit and x along the equinox of date, (n, 3, 3).

    The equinox matters: the cycle of the node is that of its return to it.
    """
    fixed = body.needed("pole").orbit_axes(body.orbit_pole)
    if not body.needed("pole").of_the_iau:
        return np.broadcast_to(fixed, (days.size, 3, 3))
    moved = precession_angles(days)[:, -1]
    cosine, sine, zero, one = np.cos(moved), np.sin(moved), 0 * moved, 1 + 0 * moved
    turn = np.array([[cosine, -sine, zero], [sine, cosine, zero], [zero, zero, one]])
    return np.asarray(np.moveaxis(turn, 2, 0) @ fixed)


def uneven(tensor: FloatArray) -> tuple[float, float]:
    """Largest Qxx - Qzz over all x in the plane, and largest Qxz: what tilts and turns an axis."""
    xx, yy, zz, xy, xz, yz = tensor
    bulge = np.abs((xx + yy) / 2 - zz) + np.hypot((xx - yy) / 2, xy)
    return float(np.max(bulge)), float(np.max(np.hypot(xz, yz)))


def average_errors(tensor: FloatArray, cycle: float, centres: NDArray[np.int64]) -> dict[str, Any]:
    """Largest errors of the mean tensor by cycles and step, and the mean of Qxx - Qzz.

    Parameters
    ----------
    tensor : ndarray, shape (6, n)
        Daily.
    cycle : float
        d.
    centres : ndarray of int
        Days at which windows are centred.
    """

    def means(cycles: int, step: int) -> FloatArray:
        half = int(cycles * cycle / 2 / step)
        offsets = step * np.arange(-half, half + 1)
        weights = Window(0.0, cycles, cycle, "sin4").weights(offsets.astype(float))
        return np.stack([tensor[:, c + offsets] @ weights for c in centres], axis=1)

    best = means(CYCLES[-1], 1)
    smooth = np.stack([Chebyshev.fit(centres, row, DEGREE)(centres) for row in best])
    off = [[uneven(means(cycles, step) - smooth) for step in STEPS] for cycles in CYCLES]
    along, across, up = smooth[:3].mean(axis=1)
    return {
        "mean": float(f"{(along + across) / 2 - up:.6g}"),
        "in_plane": [[log_up(pair[0]) for pair in row] for row in off],
        "out_of_plane": [[log_up(pair[1]) for pair in row] for row in off],
    }


def average_models(kernel: Ephemeris) -> dict[str, Any]:
    """Errors of tapered means, by body, cycle and perturber."""
    models: dict[str, Any] = {"cycles": CYCLES, "steps": STEPS, "normal": {}, "tensor": {}}
    models["moving"] = [str(body.naif[0]) for body in SPINNING if body.needed("pole").of_the_iau]
    moon, sun = BODIES["moon"], BODIES["sun"]
    tasks = ((EARTH, moon, (sun, moon)), (EARTH, sun, (sun,)), (MARS, sun, (sun,)))
    with progress("averages", sum(len(task[2]) for task in tasks)) as advance:
        for body, slowest, perturbers in tasks:
            cycle, code = slowest.cycle / DAY, str(body.naif[0])
            normal = body.needed("pole").orbit_normal(body.orbit_pole)
            models["normal"][code] = [round(float(x), 9) for x in normal]
            for perturber in perturbers:
                codes = (kernel.code(b.naif, b.name) for b in (body, perturber))
                start, end = kernel.coverage(codes)
                days = np.arange(math.ceil(start), math.floor(end), dtype=float)
                place = place_of(kernel, body, perturber)(days * DAY)
                daily = tidal_tensor(
                    [(1.0, np.einsum("tij,jt->it", orbit_frame(body, days), place))]
                )
                margin = math.ceil(CYCLES[-1] * cycle / 2) + 1
                centres = np.arange(margin, days.size - margin, int(SPACING / DAY))
                by_cycle = models["tensor"].setdefault(code, {}).setdefault(f"{cycle:.2f}", {})
                by_cycle[str(perturber.naif[0])] = average_errors(daily, cycle, centres)
                advance(1)
    return models


# --- nutation ------------------------------------------------------------------------------------


def nutation_models() -> list[dict[str, Any]]:
    """Errors of nutation by model and spacing of nodes, with the terms evaluated at a node."""
    days = np.sort(np.random.default_rng(2000).uniform(*NUTATION_SPAN, SAMPLES))
    exact = np.stack(erfa.nut06a(J2000_JD, days), axis=-1)

    def error(angles: FloatArray) -> float:
        return log_up(float(np.linalg.norm(angles - exact, axis=1).max()))

    found = [{"model": "none", "step": 0.0, "terms": 0, "error": error(np.zeros_like(exact))}]
    for model, (_, terms) in NUTATION_MODELS.items():
        found += [
            {
                "model": model,
                "step": step,
                "terms": terms,
                "error": error(Nutation(*NUTATION_SPAN, model=model, spacing=step).angles(days)),
            }
            for step in NUTATION_STEPS
        ]
    return found


def main(arguments: argparse.Namespace) -> int:
    """Measure everything and write the file."""
    kernel = open_ephemeris(arguments.kernel)
    models: dict[str, Any] = {
        "made by": f"python -m data_tools error-models --kernel {kernel.name}",
        "pole": pole_models(kernel),
        "average": average_models(kernel),
        "nutation": nutation_models(),
    }
    text = json.dumps(models, separators=(",", ":"))
    DATA.write_text(text.replace('],"', '],\n"').replace('},"', '},\n"') + "\n", encoding="utf-8")
    print(f"wrote {DATA} ({len(text) / 1e3:.0f} kB)")
    return 0
