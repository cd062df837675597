"""Scenes and long time series."""

import numpy as np
import pytest

from earthspin.questions.free_rotor import free_rotor
from earthspin.questions.top import heavy_top
from tests.extreme import Distances, holds
from tests.processes import printed

#: Program for a new process that prints the extra memory (MB) of a long series.
_GROWTH = """
import sys
import earthspin
from tests.blocks import run_blocks

scene = earthspin.load_scene("torque")

def peak_memory():
    try:  # on Linux, getrusage includes the memory of the parent process
        with open("/proc/self/status") as status:
            return next(int(line.split()[1]) / 1024 for line in status if "VmHWM" in line)
    except OSError:
        import resource
        unit = 1024**2 if sys.platform == "darwin" else 1024
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / unit

def peak(span, step):
    for block in run_blocks(scene.replace(span=span, step=step)):
        pass
    return peak_memory()

short = peak(("1980-01-01", "2020-01-01"), "210 min")
print(peak({span!r}, {step!r}) - short)
"""


def _memory_growth(span: tuple[str, str], step: str) -> float:
    """Peak memory (MB) of a torque series computed in blocks, minus that of 10^5 epochs."""
    return float(printed(_GROWTH.format(span=span, step=step)))


@pytest.mark.slow
@holds(bound=80.0, unit="MB")
def test_hundred_million() -> Distances:
    """memory needed for a torque series of 10^8 epochs

    Hard because: they would take 12 GB if all were stored, and their index alone 0.8 GB
    Compared with: peak of resident memory with 10^5 epochs, in a separate process
    """
    yield _memory_growth(("1900-01-01", "2053-01-01"), "48 s")


@holds(bound=1e-14)
def test_rotor_without_period() -> Distances:
    """free rotors without a period: separatrix, principal axis, equal moments

    Hard because: the polhode has no period, and the herpolhode no advance
    Compared with: energy at the start, relative, in a result without NaN
    """
    for moments, omega in (
        ((3.0, 4.0, 6.0), (2.0, 0.0, 1.0)),
        ((1.0, 2.0, 2.5), (0.0, 1.0, 0.0)),
        ((2.0, 2.0, 2.0), (0.3, 0.4, 0.5)),
    ):
        result = free_rotor(moments, omega, np.linspace(0.0, 50.0, 60))
        yield result.energy / result.energy[0] - 1


@holds(bound=0.0)
def test_still_top() -> Distances:
    """heavy top that is at rest and has no weight

    Hard because: there is no spin, weight or push, so every rate and its scale are zero
    Compared with: initial angles, bit for bit
    """
    moments = {"transverse_moment": 2.0, "axial_moment": 1.0, "weight_moment": 0.0}
    for theta in (0.0, 1.0):
        result = heavy_top([0.0, 1e6], **moments, theta=theta, spin=0.0)
        yield result.theta - theta
        yield result.phi
