"""Mean rate of precession: tapers, lengths of the window and steps beside plain means."""

import math
from dataclasses import dataclass
from functools import cache, partial

import numpy as np

import earthspin
from earthspin.bodies import EARTH, MOON, SUN
from earthspin.constants import ARCSEC, DAY, JULIAN_YEAR
from earthspin.numerics.arrays import FloatArray
from earthspin.torque.average import TAPERS, Window
from tests.benchmarks.accuracy.ladder import Ladder, public_call
from tests.reference import model_sky

#: Central epochs of the averages, d from J2000.0, at different phases of the Moon.
EPOCHS = np.arange(-6, 7) * 1237.0
#: Points along the four angles for the mean over infinite time; fewer change it by 1e-14.
TORUS = (24, 16, 24, 16)
#: Length of the window in periods of the node, and days between samples, from coarse to fine.
WINDOWS = ((3, 6), (3, 3), (3, 2), (4, 2), (5, 2), (6, 2), (7, 2), (8, 2), (8, 1))
#: Lengths of plain means, years.
PLAIN_YEARS = (1.0, 18.0, 18.6, 19.0, 150.0)


@dataclass(frozen=True)
class ModelPlace:
    """Position of Sun or Moon in the model sky, relative to the Earth, along ICRF axes."""

    name: str
    centre: int = 399
    coverage: tuple[float, float] = (-math.inf, math.inf)

    def positions(self, days: FloatArray) -> FloatArray:
        """Positions at days from J2000.0, m, shape (n, 3)."""
        x, y, z = model_sky.positions(model_sky.arguments(days * DAY))[self.name].T
        sine, cosine = math.sin(model_sky.OBLIQUITY), math.cos(model_sky.OBLIQUITY)
        return np.stack([x, cosine * y - sine * z, sine * y + cosine * z], axis=-1)


@cache
def by_public_call() -> float:
    """Mean torque that causes precession, per C - A, s-2, from a public answer on the model sky.

    Its node turns in 18.597 years, since the Sun's perigee is fixed; the real one in 18.613.
    """
    equator = {"pole": ("0 deg", "90 deg"), "pole_uncertainty": "0 deg"}
    normal = (math.radians(270), math.pi / 2 - model_sky.OBLIQUITY)
    cycle = model_sky.node_period()
    sky = [body.replace(position=ModelPlace(body.name), cycle=cycle) for body in (SUN, MOON)]
    body = EARTH.replace(**equator, orbit_pole=normal)
    answer = earthspin.precession(body=body, perturbers=sky)
    rate = float(answer.precession_rate.sel(perturber="total")) * ARCSEC / JULIAN_YEAR
    return rate * float(EARTH.spin_rate) / EARTH.number("dynamical_flattening")


def ladder() -> Ladder:
    """Methods for the mean rate of precession under a model Sun and Moon.

    The bound of tapers is the long-period variation that is claimed for the real Moon. The model
    also has one: 4.1e-8 in 184 years, the period of the perigee relative to twice the node
    (3D + 3l' - l - 2F), which is longer than any window.
    """
    true, cycle = model_sky.torus_mean(TORUS), model_sky.node_period()

    def mean(taper: str, length: float, step: int, case: int = 0) -> tuple[float, int]:
        window = Window(float(EPOCHS[case]) * DAY, 1.0, length, taper)
        times = window.sample_times(step * DAY)
        return float(window.mean(times, model_sky.precessing_at(times))), times.size

    return Ladder(
        title="Precession: mean rate under a model Sun and Moon",
        problem="mean rate of precession under a model Sun and Moon (Kepler's ellipse; main terms "
        f"of ELP2000-82), from torques in a window; the error is the largest of {EPOCHS.size} "
        "epochs, relative",
        reference="mean over the torus of the four angles of the model, by the trapezoid rule, "
        "without any window",
        unit="1",
        floor=1e-14,
        error=lambda means: np.max(np.abs(np.asarray(means) / true - 1)),
        runs={
            f"{taper} window": {
                f"{turns} turns, {step} d": partial(mean, taper, turns * cycle, step)
                for turns, step in WINDOWS
            }
            for taper in TAPERS
        }
        | {
            "precession(), first and later": public_call(
                "earthspin.precession()", lambda answer: by_public_call()
            ),
            "plain mean over years": {
                f"{years:g} yr, 1 d": partial(mean, "plain", years * JULIAN_YEAR, 1)
                for years in PLAIN_YEARS
            },
        },
        bounds={f"{taper} window": 1e-3 if taper == "plain" else 2e-7 for taper in TAPERS}
        | {"precession(), first and later": 2e-7},
        cases=EPOCHS.size,
    )
