"""The questions that a scene can ask, and the words of its grammar.

A new question is one row here and its parts in `earthspin.scene.parts`.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Question:
    """What one word after ``compute =`` stands for.

    Attributes
    ----------
    wants : tuple of str
        The parts whose results make up the answer.
    effects : tuple of str
        The effects that it can switch on.
    unless_named : tuple of str
        Those of them that are off unless a scene names them.
    tables : tuple of str
        Tables of settings that belong to it.
    accuracy : str or None
        What accuracy can be asked of it: "relative", "angle", or none.
    """

    wants: tuple[str, ...]
    effects: tuple[str, ...] = ()
    unless_named: tuple[str, ...] = ()
    tables: tuple[str, ...] = ()
    accuracy: str | None = None


#: Words for physical effects, in the grammar of scenes.
EFFECTS = (
    "planets",
    "j3",
    "j4",
    "triaxiality",
    "geodesic",
    "j2-rate",
    "second-order",
    "nonrigid",
)

QUESTIONS: dict[str, Question] = {
    "precession": Question(
        wants=(
            "mean-rates",
            "rate-accuracy",
            "convergence",
            "earth-models",
            "free-wobble",
            "observed-wobble",
            "seasons",
            "iau-2006",
            "standstills",
        ),
        accuracy="relative",
    ),
    "torque": Question(wants=("torque-series", "series-accuracy"), accuracy="angle"),
    "free-rotor": Question(
        wants=("free-rotation", "rotation-accuracy", "poinsot"),
        tables=("rotor",),
        accuracy="relative",
    ),
    "top": Question(wants=("heavy-top", "top-accuracy"), tables=("top",), accuracy="relative"),
    "spheroid": Question(
        wants=("spheroid-field", "field-accuracy"), tables=("spheroid",), accuracy="relative"
    ),
    "wobble": Question(
        wants=("wobble-ladder", "interior-response", "wobble-sensitivity", "observed-wobble"),
        tables=("wobble",),
    ),
    "polar-motion": Question(wants=("polar-motion", "chandler"), tables=("polar_motion",)),
    "pole": Question(
        wants=("pole", "pole-accuracy", "pole-angles"),
        effects=EFFECTS,
        unless_named=("nonrigid",),
        accuracy="angle",
    ),
    "iau": Question(
        wants=(
            "iau-budget",
            "iau-residuals",
            "nutation-table",
            "core-resonance",
            "precession-angles",
            "inferred-flattening",
        ),
        effects=EFFECTS,
        unless_named=("nonrigid",),
    ),
}

#: Every table that some question has.
TABLES = tuple(sorted({table for question in QUESTIONS.values() for table in question.tables}))
