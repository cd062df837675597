"""Machinery of all computations: inputs (questions), functions, runs, ensembles, result files.

Questions import from here what they declare and run; other packages import the modules.
"""

from earthspin.engine.origin import scene_of
from earthspin.engine.public_calls import public_call
from earthspin.engine.question import Block, Question, key, part, setting
from earthspin.engine.run import Run, in_range
from earthspin.engine.variables import Neglected, Variables, labels, measured, number, si, words

__all__ = [
    "Block", "Neglected", "Question", "Run", "Variables", "in_range", "key", "labels",
    "measured", "number", "part", "public_call", "scene_of", "setting", "si", "words",
]  # fmt: skip
