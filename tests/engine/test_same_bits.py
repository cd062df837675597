"""The same question has the same bits in every process of one machine.

What may differ from one to the next is tried at once: where arrays begin in memory, the order of
sets, and how many threads the BLAS has. Other instructions of another processor round otherwise,
and so may other versions of numpy.
"""

from __future__ import annotations

import os

import pytest

from tests.processes import printed

#: Prints a digest of every number of each shipped scene with all sections, and of what solvers
#: give that go step by step; arrays begin elsewhere with another first argument.
PROGRAM = """
import hashlib, sys
import numpy as np

rng = np.random.default_rng(int(sys.argv[1]))
in_the_way = [np.empty(n, dtype=np.uint8) for n in rng.integers(1, 5000, 2000)]
del in_the_way[::2]

import earthspin
from tests.reference.sky import SPIN, H, Tide
from earthspin.constants import DAY
from tests.reference.attitude import attitude_motion
from tests.reference.momentum_and_figure import axisymmetric_motion
from earthspin.rotor.euler import integrate_rotation

def digest(arrays):
    whole = hashlib.sha256()
    for array in arrays:
        whole.update(np.ascontiguousarray(array).tobytes())
    return whole.hexdigest()

def numbers(tree):
    for node in sorted(tree.subtree, key=lambda node: node.path):
        if node.path != "/plan":
            data = node.to_dataset(inherit=False)
            yield from (data[name].values for name in sorted(data.variables)
                        if data[name].dtype.kind in "fciM")

for scene in ("iau", "pole", "precession", "torque", "wobble", "polar-motion", "sleeping-top"):
    print(scene, digest(numbers(earthspin.run_tree(scene))))

long = earthspin.pole("1910-01-01", "2050-01-01", "17 d")
print("pole over 140 years", digest(long[c].values for c in "XYZ"))
times, tide = np.linspace(0.0, 3 * DAY, 7), Tide(3 * DAY)
upright, turned = np.array([0.0, 0.0, 1.0]), np.array([0.8, 0.0, 0.0, 0.6])
print("(L, F) step by step", digest(axisymmetric_motion(tide, H, SPIN, upright, upright, times)))
print("attitude step by step",
      digest(attitude_motion(tide, H, 1e-5, SPIN, upright, turned, times)))
spun = integrate_rotation([1.0, 2.0, 3.0], [0.1, 1.0, 0.1], np.linspace(0.0, 50.0, 9))
print("free rotor step by step", digest([spun.attitude, spun.omega_body]))
"""
SURROUNDINGS = {
    "one thread": {"PYTHONHASHSEED": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"},
    "four threads": {"PYTHONHASHSEED": "2", "OPENBLAS_NUM_THREADS": "4", "MKL_NUM_THREADS": "4"},
}


def digests(surroundings: str) -> dict[str, str]:
    """Digest of each answer, by name."""
    which = list(SURROUNDINGS).index(surroundings)
    said = printed(PROGRAM, str(which), env=os.environ | SURROUNDINGS[surroundings])
    return dict(line.rsplit(" ", 1) for line in said.splitlines())


@pytest.mark.slow
def test_the_same_question_has_the_same_bits() -> None:
    one, other = (digests(surroundings) for surroundings in SURROUNDINGS)
    assert len(one) == 11
    assert one == other
