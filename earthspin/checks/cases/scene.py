"""Stiff and extreme cases of scenes: what may be asked, and long series."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import xarray as xr

from earthspin.bodies import MOON
from earthspin.checks.case import Cases, Distances, hard_because, held_against, refused
from earthspin.checks.sky import BODY
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


@CASES.case("10^6 epochs in bounded memory", slow=True)
@hard_because("they take 120 MB if they are kept")
@held_against(
    "the peak of resident memory with 10^5 epochs, in a process of its own", bound=80.0, unit="MB"
)
def _million() -> Distances:
    yield _memory_growth(("1980-01-01", "2020-01-01"), "21 min")


@CASES.case("10^8 epochs in bounded memory", slow=True, long=True)
@hard_because("they take 12 GB if they are kept; an index of them alone 0.8 GB")
@held_against(
    "the peak of resident memory with 10^5 epochs, in a process of its own", bound=80.0, unit="MB"
)
def _hundred_million() -> Distances:
    yield _memory_growth(("1900-01-01", "2053-01-01"), "48 s")


@CASES.case("10^8 epochs held at once")
@hard_because("the machine would swap for hours before it fails")
@refused("do not fit into memory")
def _too_long() -> None:
    torque_series("1900-01-01", "2053-01-01", "48 s")


@CASES.case("a series in blocks", slow=True)
@hard_because("a block may begin where another's arithmetic would have rounded otherwise")
@held_against("the series in one piece, bit for bit", bound=0.0)
def _blocks() -> Distances:
    scene = Scene(compute="torque", span=("2000-01-01", "2000-02-05"), step="20 s")
    joined = np.concatenate([block.torque.values for block in run_blocks(scene)])
    yield joined - run(scene).torque.values


@CASES.case("the same question twice, and backwards")
@hard_because("caches, orders of sums and shared arrays would show")
@held_against("the same numbers, bit for bit", bound=0.0)
def _twice() -> Distances:
    dates = ["2000-01-01", "2003-07-01T06:00", "1999-05-05", "2000-01-01"]
    one, two = torque_series(times=dates), torque_series(times=dates)
    back = torque_series(times=dates[::-1])
    yield one.torque.values - two.torque.values
    yield one.torque.values - back.torque.values[::-1]


@CASES.case("a free rotor on the separatrix, at rest about an axis, and a sphere")
@hard_because("its polhode has no period and its herpolhode no advance")
@held_against("energy at the start, relative, in a labelled result without a NaN", bound=1e-14)
def _rotor_without_period() -> Distances:
    for moments, omega in (
        ((3.0, 4.0, 6.0), (2.0, 0.0, 1.0)),
        ((1.0, 2.0, 2.5), (0.0, 1.0, 0.0)),
        ((2.0, 2.0, 2.0), (0.3, 0.4, 0.5)),
    ):
        found = free_rotor(moments, omega, np.linspace(0.0, 50.0, 60))
        yield found.energy / found.energy[0] - 1


@CASES.case("a top that does nothing")
@hard_because("no spin, no weight and no push: every rate is zero, and so is their scale")
@held_against("angles as they were, bit for bit", bound=0.0)
def _still_top() -> Distances:
    moments = {"transverse_moment": 2.0, "axial_moment": 1.0, "weight_moment": 0.0}
    for theta in (0.0, 1.0):
        found = heavy_top([0.0, 1e6], **moments, theta=theta, spin=0.0)
        yield found.theta - theta
        yield found.phi


@CASES.case("a field beyond what floats can hold")
@hard_because("the square of the distance overflows, and the potential becomes zero")
@refused("beyond what can be computed")
def _too_far() -> None:
    spheroid_field([[1e300, 0.0, 1e300]])


@CASES.case("39449 epochs of a thousand members held at once")
@hard_because("each alone fits: the guard must count both")
@refused("do not fit into memory")
def _times_of_members() -> None:
    radius = xr.DataArray(np.linspace(6.3e6, 6.4e6, 1000), dims="member")
    body = BODY.replace(radius=radius)
    torque_series("2000-01-01", "2027-01-01", "6 h", body=body)


@CASES.case("a microsecond through 150 years")
@hard_because("counted, not made: a list of the times would end the process")
@refused("606 PB")
def _microseconds() -> None:
    torque_series("1900-01-01", "2050-01-01", "1 us")


@CASES.case("a number of five thousand digits")
@hard_because("Python refuses to write it, and so does every message that repeats it")
@refused("step = <int>")
def _many_digits() -> None:
    torque_series("2000-01-01", "2001-01-01", 10**5000)


@CASES.case("lists in lists, a hundred thousand deep")
@hard_because("whatever walks through them runs out of its stack")
@refused("moments = <list>")
def _deep_lists() -> None:
    inner: list[object] = []
    for _ in range(100_000):  # Python 3.13 and later put ten thousand into words
        inner = [inner]
    free_rotor(moments=inner, omega=[1, 0, 1], duration="1 s")


@CASES.case("a scene that is a device without an end")
@hard_because("/dev/zero is read until the memory is full")
@refused("a device or a pipe")
def _endless() -> None:
    run("/dev/zero")


@CASES.case("a name that would clear the terminal")
@hard_because("what is given is repeated in the message, its escapes with it")
@refused("\\x1b[2J")
def _escapes() -> None:
    run("\x1b[2J\x07")


@CASES.case("a question that does not exist")
@hard_because("a typing error must not pick the nearest")
@refused("did you mean 'torque'")
def _unknown_question() -> None:
    Scene(compute="torqe")


@CASES.case("a perturber that does not exist")
@hard_because("a typing error must not pick the nearest")
@refused("did you mean 'moon'")
def _unknown_perturber() -> None:
    Scene(compute="torque", perturbers=("sun", "mooon"))


@CASES.case("a key that does not exist")
@hard_because("a key that is overlooked changes the answer without a word")
@refused("has no such key; did you mean 'step'")
def _unknown_key() -> None:
    Scene(compute="torque", steps="1 h")


@CASES.case("a mass that is not a number")
@hard_because("NaN would go through every formula to the end")
@refused("it must be a finite number")
def _nan_mass() -> None:
    MOON.replace(gm=float("nan"))


@CASES.case("an infinite radius")
@hard_because("torques and densities would be infinite, or zero")
@refused("it must be a finite number")
def _infinite_radius() -> None:
    BODY.replace(radius=float("inf"))


@CASES.case("a mass beyond all that is")
@hard_because("the squares of its torques overflow")
@refused("give at most")
def _largest_mass() -> None:
    MOON.replace(gm=1e300)


@CASES.case("flatter than a disc")
@hard_because("C above A + B: no such body, yet all formulas give numbers")
@refused("at most 0.5")
def _too_flat() -> None:
    BODY.replace(dynamical_flattening=0.5 + 1e-9, j2=0.1)


@CASES.case("J2 and H of different sign")
@hard_because("oblate by one number, prolate by the other")
@refused("it has the sign of")
def _mixed_signs() -> None:
    BODY.replace(dynamical_flattening=-1e-3, j2=1e-3)


@CASES.case("a body that pulls on itself")
@hard_because("its distance is zero")
@refused("does not pull on itself")
def _itself() -> None:
    Scene(compute="torque", body="mars", perturbers=("sun", "mars"))


@CASES.case("an accuracy of nothing")
@hard_because("no computation ends there")
@refused("greater than zero")
def _no_error() -> None:
    Scene(compute="precession", accuracy=0.0)
