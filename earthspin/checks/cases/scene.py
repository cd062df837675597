"""Stiff and extreme cases of scenes: what may be asked, and long series."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import xarray as xr

from earthspin.bodies import MOON
from earthspin.checks.case import Distances, holds, refused
from earthspin.checks.sky import BODY
from earthspin.errors import UndefinedError
from earthspin.questions.free_rotor import free_rotor
from earthspin.questions.spheroid import spheroid_field
from earthspin.questions.top import heavy_top
from earthspin.questions.torque import torque_series
from earthspin.scenes import Scene, run, run_blocks

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


@holds(bound=80.0, unit="MB", slow=True)
def _million() -> Distances:
    """10^6 epochs in bounded memory

    Hard because: they take 120 MB if they are kept
    Held against: the peak of resident memory with 10^5 epochs, in a process of its own
    """
    yield _memory_growth(("1980-01-01", "2020-01-01"), "21 min")


@holds(bound=80.0, unit="MB", slow=True, long=True)
def _hundred_million() -> Distances:
    """10^8 epochs in bounded memory

    Hard because: they take 12 GB if they are kept; an index of them alone 0.8 GB
    Held against: the peak of resident memory with 10^5 epochs, in a process of its own
    """
    yield _memory_growth(("1900-01-01", "2053-01-01"), "48 s")


@refused("do not fit into memory")
def _too_long() -> None:
    """10^8 epochs held at once

    Hard because: the machine would swap for hours before it fails
    """
    torque_series("1900-01-01", "2053-01-01", "48 s")


@holds(bound=0.0, slow=True)
def _blocks() -> Distances:
    """a series in blocks

    Hard because: a block may begin where another's arithmetic would have rounded otherwise
    Held against: the series in one piece, bit for bit
    """
    scene = Scene(compute="torque", span=("2000-01-01", "2000-02-05"), step="20 s")
    joined = np.concatenate([block.torque.values for block in run_blocks(scene)])
    yield joined - run(scene).torque.values


@holds(bound=0.0)
def _twice() -> Distances:
    """the same question twice, and backwards

    Hard because: caches, orders of sums and shared arrays would show
    Held against: the same numbers, bit for bit
    """
    dates = ["2000-01-01", "2003-07-01T06:00", "1999-05-05", "2000-01-01"]
    one, two = torque_series(times=dates), torque_series(times=dates)
    back = torque_series(times=dates[::-1])
    yield one.torque.values - two.torque.values
    yield one.torque.values - back.torque.values[::-1]


@holds(bound=1e-14)
def _rotor_without_period() -> Distances:
    """a free rotor on the separatrix, at rest about an axis, and a sphere

    Hard because: its polhode has no period and its herpolhode no advance
    Held against: energy at the start, relative, in a labelled result without a NaN
    """
    for moments, omega in (
        ((3.0, 4.0, 6.0), (2.0, 0.0, 1.0)),
        ((1.0, 2.0, 2.5), (0.0, 1.0, 0.0)),
        ((2.0, 2.0, 2.0), (0.3, 0.4, 0.5)),
    ):
        found = free_rotor(moments, omega, np.linspace(0.0, 50.0, 60))
        yield found.energy / found.energy[0] - 1


@holds(bound=0.0)
def _still_top() -> Distances:
    """a top that does nothing

    Hard because: no spin, no weight and no push: every rate is zero, and so is their scale
    Held against: angles as they were, bit for bit
    """
    moments = {"transverse_moment": 2.0, "axial_moment": 1.0, "weight_moment": 0.0}
    for theta in (0.0, 1.0):
        found = heavy_top([0.0, 1e6], **moments, theta=theta, spin=0.0)
        yield found.theta - theta
        yield found.phi


@refused("beyond what can be computed")
def _too_far() -> None:
    """a field beyond what floats can hold

    Hard because: the square of the distance overflows, and the potential becomes zero
    """
    spheroid_field([[1e300, 0.0, 1e300]])


@refused("do not fit into memory")
def _times_of_members() -> None:
    """39449 epochs of a thousand members held at once

    Hard because: each alone fits: the guard must count both
    """
    radius = xr.DataArray(np.linspace(6.3e6, 6.4e6, 1000), dims="member")
    body = BODY.replace(radius=radius)
    torque_series("2000-01-01", "2027-01-01", "6 h", body=body)


@refused("606 PB")
def _microseconds() -> None:
    """a microsecond through 150 years

    Hard because: counted, not made: a list of the times would end the process
    """
    torque_series("1900-01-01", "2050-01-01", "1 us")


@refused("step = <int>")
def _many_digits() -> None:
    """a number of five thousand digits

    Hard because: Python refuses to write it, and so does every message that repeats it
    """
    torque_series("2000-01-01", "2001-01-01", 10**5000)


@refused("moments = <list>")
def _deep_lists() -> None:
    """lists in lists, a hundred thousand deep

    Hard because: whatever walks through them runs out of its stack
    """
    inner: list[object] = []
    for _ in range(100_000):  # Python 3.13 and later put ten thousand into words
        inner = [inner]
    free_rotor(moments=inner, omega=[1, 0, 1], duration="1 s")


@refused("a device or a pipe")
def _endless() -> None:
    """a scene that is a device without an end

    Hard because: /dev/zero is read until the memory is full
    """
    run("/dev/zero")


@refused("\\x1b[2J")
def _escapes() -> None:
    """a name that would clear the terminal

    Hard because: what is given is repeated in the message, its escapes with it
    """
    run("\x1b[2J\x07")


@refused("did you mean 'torque'")
def _unknown_question() -> None:
    """a question that does not exist

    Hard because: a typing error must not pick the nearest
    """
    Scene(compute="torqe")


@refused("did you mean 'moon'")
def _unknown_perturber() -> None:
    """a perturber that does not exist

    Hard because: a typing error must not pick the nearest
    """
    Scene(compute="torque", perturbers=("sun", "mooon"))


@refused("has no such key; did you mean 'step'")
def _unknown_key() -> None:
    """a key that does not exist

    Hard because: a key that is overlooked changes the answer without a word
    """
    Scene(compute="torque", steps="1 h")


@refused("it must be a finite number")
def _nan_mass() -> None:
    """a mass that is not a number

    Hard because: NaN would go through every formula to the end
    """
    MOON.replace(gm=float("nan"))


@refused("it must be a finite number")
def _infinite_radius() -> None:
    """an infinite radius

    Hard because: torques and densities would be infinite, or zero
    """
    BODY.replace(radius=float("inf"))


@refused("give at most")
def _largest_mass() -> None:
    """a mass beyond all that is

    Hard because: the squares of its torques overflow
    """
    MOON.replace(gm=1e300)


@refused("at most 0.5")
def _too_flat() -> None:
    """flatter than a disc

    Hard because: C above A + B: no such body, yet all formulas give numbers
    """
    BODY.replace(dynamical_flattening=0.5 + 1e-9, j2=0.1)


@refused("it has the sign of")
def _mixed_signs() -> None:
    """J2 and H of different sign

    Hard because: oblate by one number, prolate by the other
    """
    BODY.replace(dynamical_flattening=-1e-3, j2=1e-3)


@refused("does not pull on itself")
def _itself() -> None:
    """a body that pulls on itself

    Hard because: its distance is zero
    """
    Scene(compute="torque", body="mars", perturbers=("sun", "mars"))


@refused("greater than zero")
def _no_error() -> None:
    """an accuracy of nothing

    Hard because: no computation ends there
    """
    Scene(compute="precession", accuracy=0.0)
