"""Error against run time: ladders of methods, one file a quantity.

`python -m tests.benchmarks.accuracy` measures them and writes the tables and figures of
docs/work_precision.md.
"""

from collections.abc import Callable
from functools import partial

from tests.benchmarks.accuracy import (
    chandler,
    compliances,
    elements,
    ensemble,
    excitation,
    forecast,
    free_rotor,
    long_term,
    mean_orbit,
    pole,
    precession,
    rotation,
    spheroid,
    top,
    torque,
)
from tests.benchmarks.accuracy.ladder import Ladder

LADDERS: dict[str, Callable[[], Ladder]] = {
    "torque": torque.ladder,
    "pole": pole.ladder,
    "precession": precession.ladder,
    "rotation": rotation.ladder,
    "free-rotor": free_rotor.ladder,
    "top": top.ladder,
    "spheroid": spheroid.ladder,
    "long-term": long_term.ladder,
    "elements": elements.ladder,
    "mean-orbit": mean_orbit.ladder,
    "compliances": compliances.ladder,
    "excitation": excitation.to_excitation,
    "polar-motion": excitation.from_excitation,
    "chandler": chandler.ladder,
    "forecast-30": partial(forecast.ladder, 30),
    "forecast-90": partial(forecast.ladder, 90),
    "ensemble": ensemble.ladder,
}
