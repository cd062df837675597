"""Stiff and extreme cases of scenes: what may be asked, and long series."""

from __future__ import annotations

import subprocess
import sys

import numpy as np

from earthspin.bodies import MOON
from earthspin.checks.case import Cases
from earthspin.checks.default_body import default_body
from earthspin.errors import UndefinedError
from earthspin.questions.free_rotor import free_rotor
from earthspin.questions.spheroid import spheroid_field
from earthspin.questions.top import heavy_top
from earthspin.questions.torque import torque_series
from earthspin.scenes import Scene, run, run_blocks

CASES = Cases("scene")

#: In a fresh process: how much more memory (MB) a long series needs than a short one.
_GROWTH = """
import sys
import earthspin
from earthspin.scenes import run_blocks

scene = earthspin.load_scene("torque")

def most_so_far():
    try:  # what getrusage says on Linux begins with the memory of the parent
        with open("/proc/self/status") as status:
            return next(int(line.split()[1]) / 1024 for line in status if "VmHWM" in line)
    except OSError:
        import resource
        unit = 1024**2 if sys.platform == "darwin" else 1024
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / unit

def peak(span, step):
    for block in run_blocks(scene.replace(span=span, step=step)):
        pass
    return most_so_far()

short = peak(("1980-01-01", "2020-01-01"), "210 min")
print(peak({span!r}, {step!r}) - short)
"""


def _memory_growth(span: tuple[str, str], step: str) -> float:
    """Resident memory of a torque series, made block by block, beyond that of 10^5 epochs, MB."""
    program = _GROWTH.format(span=span, step=step)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise UndefinedError(f"the process that measures its memory ended early: {last}")
    return float(done.stdout)


@CASES.hold(
    "10^6 epochs in bounded memory",
    because="they take 120 MB if they are kept",
    against="the peak of resident memory with 10^5 epochs, in a process of its own",
    unit="MB",
    bound=80.0,
    slow=True,
)
def _million() -> float:
    return _memory_growth(("1980-01-01", "2020-01-01"), "21 min")


@CASES.hold(
    "10^8 epochs in bounded memory",
    because="they take 12 GB if they are kept; an index of them alone 0.8 GB",
    against="the peak of resident memory with 10^5 epochs, in a process of its own",
    unit="MB",
    bound=80.0,
    slow=True,
    long=True,
)
def _hundred_million() -> float:
    return _memory_growth(("1900-01-01", "2053-01-01"), "48 s")


@CASES.refuse(
    "10^8 epochs held at once",
    because="the machine would swap for hours before it fails",
    saying="do not fit into memory",
)
def _too_long() -> None:
    torque_series("1900-01-01", "2053-01-01", "48 s")


@CASES.hold(
    "a series in blocks",
    because="a block may begin where another's arithmetic would have rounded otherwise",
    against="the series in one piece, bit for bit",
    bound=0.0,
    slow=True,
)
def _blocks() -> float:
    scene = Scene(compute="torque", span=("2000-01-01", "2000-02-05"), step="20 s")
    joined = np.concatenate([block.torque.values for block in run_blocks(scene)])
    return float(np.max(np.abs(joined - run(scene).torque.values)))


@CASES.hold(
    "the same question twice, and backwards",
    because="caches, orders of sums and shared arrays would show",
    against="the same numbers, bit for bit",
    bound=0.0,
)
def _twice() -> float:
    dates = ["2000-01-01", "2003-07-01T06:00", "1999-05-05", "2000-01-01"]
    one, two = torque_series(times=dates), torque_series(times=dates)
    back = torque_series(times=dates[::-1])
    off = [abs(one.torque.values - two.torque.values)]
    off.append(abs(one.torque.values - back.torque.values[::-1]))
    return float(np.max(off))


@CASES.hold(
    "a free rotor on the separatrix, at rest about an axis, and a sphere",
    because="its polhode has no period and its herpolhode no advance",
    against="energy at the start, relative, in a labelled result without a NaN",
    bound=1e-14,
)
def _rotor_without_period() -> float:
    worst = 0.0
    for moments, omega in (
        ((3.0, 4.0, 6.0), (2.0, 0.0, 1.0)),
        ((1.0, 2.0, 2.5), (0.0, 1.0, 0.0)),
        ((2.0, 2.0, 2.0), (0.3, 0.4, 0.5)),
    ):
        found = free_rotor(moments, omega, np.linspace(0.0, 50.0, 60))
        worst = max(worst, float(abs(found.energy / found.energy[0] - 1).max()))
    return worst


@CASES.hold(
    "a top that does nothing",
    because="no spin, no weight and no push: every rate is zero, and so is their scale",
    against="angles as they were, bit for bit",
    bound=0.0,
)
def _still_top() -> float:
    worst = 0.0
    for theta in (0.0, 1.0):
        found = heavy_top(
            [0.0, 1e6],
            transverse_moment=2.0,
            axial_moment=1.0,
            weight_moment=0.0,
            theta=theta,
            spin=0.0,
        )
        worst = max(worst, float(abs(found.theta - theta).max() + abs(found.phi).max()))
    return worst


@CASES.refuse(
    "a field beyond what floats can hold",
    because="the square of the distance overflows, and the potential becomes zero",
    saying="beyond what can be computed",
)
def _too_far() -> None:
    spheroid_field([[1e300, 0.0, 1e300]])


@CASES.refuse(
    "a question that does not exist",
    because="a typing error must not pick the nearest",
    saying="did you mean 'torque'",
)
def _unknown_question() -> None:
    Scene(compute="torqe")


@CASES.refuse(
    "a perturber that does not exist",
    because="a typing error must not pick the nearest",
    saying="did you mean 'moon'",
)
def _unknown_perturber() -> None:
    Scene(compute="torque", perturbers=("sun", "mooon"))


@CASES.refuse(
    "a key that does not exist",
    because="a key that is overlooked changes the answer without a word",
    saying="has no such key; did you mean 'step'",
)
def _unknown_key() -> None:
    Scene(compute="torque", steps="1 h")


@CASES.refuse(
    "a mass that is not a number",
    because="NaN would go through every formula to the end",
    saying="it must be a finite number",
)
def _nan_mass() -> None:
    MOON.replace(gm=float("nan"))


@CASES.refuse(
    "an infinite radius",
    because="torques and densities would be infinite, or zero",
    saying="it must be a finite number",
)
def _infinite_radius() -> None:
    default_body().replace(radius=float("inf"))


@CASES.refuse(
    "a mass beyond all that is",
    because="the squares of its torques overflow",
    saying="give at most",
)
def _largest_mass() -> None:
    MOON.replace(gm=1e300)


@CASES.refuse(
    "flatter than a disc",
    because="C above A + B: no such body, yet all formulas give numbers",
    saying="at most 0.5",
)
def _too_flat() -> None:
    default_body().replace(dynamical_flattening=0.5 + 1e-9, j2=0.1)


@CASES.refuse(
    "J2 and H of different sign",
    because="oblate by one number, prolate by the other",
    saying="it has the sign of",
)
def _mixed_signs() -> None:
    default_body().replace(dynamical_flattening=-1e-3, j2=1e-3)


@CASES.refuse(
    "a body that pulls on itself",
    because="its distance is zero",
    saying="does not pull on itself",
)
def _itself() -> None:
    Scene(compute="torque", body="mars", perturbers=("sun", "mars"))


@CASES.refuse(
    "an accuracy of nothing",
    because="no computation ends there",
    saying="greater than zero",
)
def _no_error() -> None:
    Scene(compute="precession", accuracy=0.0)
