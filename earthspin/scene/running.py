"""Run a scene: its parts in order, each timed, their results merged into one dataset."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from earthspin._version import __version__
from earthspin.dataset import CONVENTIONS
from earthspin.errors import SceneError
from earthspin.scene.part import Part
from earthspin.scene.parts import PARTS
from earthspin.scene.parts.choices import CHOOSING
from earthspin.scene.planning import Plan, plan
from earthspin.scene.questions import QUESTIONS
from earthspin.scene.spec import Scene, load_scene

if TYPE_CHECKING:
    import xarray as xr

#: A series longer than this is written block by block, never held whole (0.5 GB in memory).
LONGEST_IN_MEMORY = 4_000_000
BLOCK = 1 << 17


class Session:
    """Parts that have run, so that several scenes can share them."""

    def __init__(self) -> None:
        self._done: dict[tuple[Any, ...], tuple[Any, float]] = {}
        self._kept: list[Scene] = []  # so that no identity in a key is ever used again

    def result(self, part: Part, scene: Scene, given: Mapping[str, Any]) -> tuple[Any, float]:
        """What a part gives, and the seconds that it took when it ran."""
        key = self._key(part, scene)
        if key not in self._done:
            begun = time.perf_counter()
            value = part.run(scene, given)
            self._kept.append(scene)
            self._done[key] = (value, time.perf_counter() - begun)
        return self._done[key]

    def _key(self, part: Part, scene: Scene) -> tuple[Any, ...]:
        keys = sorted(_keys_with_needs(part))
        return (part.name, *(_identity(getattr(scene, key)) for key in keys))


def run(scene: Scene | str | Path, *, session: Session | None = None) -> xr.Dataset:
    """Run a scene.

    Parameters
    ----------
    scene : Scene, str or Path
        A scene, the name of a shipped one, or a file.
    session : Session, optional
        Where results of parts are kept for other scenes.

    Returns
    -------
    Dataset
        The variables of the question; the plan and its cost along `part`.

    Raises
    ------
    EarthspinError
        Whatever is wrong with the scene, the kernel or the body, in one line.
    """
    scene = scene if isinstance(scene, Scene) else load_scene(scene)
    planned = plan(scene)
    refuse_what_does_not_fit(scene)
    given, seconds = _run_parts(planned, session or Session())
    wanted = [given[p.name] for p in planned.parts if p.gives]
    return _merge(planned, wanted, given, seconds)


def run_blocks(scene: Scene) -> Iterator[xr.Dataset]:
    """Run a series block by block, for times that do not fit into memory.

    Parameters
    ----------
    scene : Scene
        One that computes ``torque``.

    Yields
    ------
    Dataset
        Consecutive stretches of the series; the first also carries the plan.
    """
    from earthspin.scene.parts.torque_at_times import torque_block

    planned = plan(scene)
    series = PARTS["torque-series"]
    before = Plan(scene, tuple(p for p in planned.parts if p is not series), planned.left_out)
    given, seconds = _run_parts(before, Session())
    size = given["times"].size
    for first in range(0, size, BLOCK):
        begun = time.perf_counter()
        block = torque_block(scene, given, first, min(first + BLOCK, size))
        # The cost of the first block stands for all: the rest is not known when it is written.
        seconds["torque-series"] = (time.perf_counter() - begun) * size / block.sizes["time"]
        yield _merge(planned, [block], given, seconds)


def chosen(planned: Plan) -> list[str]:
    """What a plan chooses for the accuracy that its scene asks for, in words.

    Whether the numbers of the body and the kernel allow it shows when it runs.

    Parameters
    ----------
    planned : Plan
        Only the parts that choose run, and what they need.
    """
    names = [part.name for part in planned.parts if part.name in CHOOSING]
    needed: set[str] = set()
    for name in names:
        needed |= {name, *_below(PARTS[name])}
    few = Plan(planned.scene, tuple(p for p in planned.parts if p.name in needed), {})
    given, _ = _run_parts(few, Session())
    choices = (given[name] for name in names)
    first = (next(iter(c), None) if isinstance(c, list) else c for c in choices)
    return [choice.words if choice is not None else "the finest settings" for choice in first]


def series_length(scene: Scene) -> int:
    """How many times a scene asks for; 0 if it is no series."""
    if "torque-series" not in QUESTIONS[scene.compute].wants:
        return 0
    from earthspin.scene.parts.torque_at_times import series_times

    return series_times(scene).size


def refuse_what_does_not_fit(scene: Scene) -> None:
    """Refuse to hold a series in memory that is too long for it."""
    size = series_length(scene)
    if size > LONGEST_IN_MEMORY:
        raise SceneError(
            "step",
            scene.step,
            f"{size} times do not fit into memory (up to {LONGEST_IN_MEMORY}); write them by "
            f"region with write_series(scene, 'series.zarr') or run --out",
            source=scene.source,
        )


def _run_parts(planned: Plan, session: Session) -> tuple[dict[str, Any], dict[str, float]]:
    given: dict[str, Any] = {}
    seconds: dict[str, float] = {}
    for part in planned.parts:
        given[part.name], seconds[part.name] = session.result(part, planned.scene, given)
    return given, seconds


def _merge(
    planned: Plan, pieces: list[xr.Dataset], given: Mapping[str, Any], seconds: Mapping[str, float]
) -> xr.Dataset:
    import xarray as xr

    result = xr.merge(pieces, join="exact", combine_attrs="override")
    names = [*seconds, *planned.left_out]
    result = result.assign_coords(part=("part", names, {"long_name": "part of the plan"}))
    result["part_run_time"] = (
        "part",
        [seconds.get(name, 0.0) for name in names],
        {"units": "s", "long_name": "run time of the part"},
    )
    result["part_status"] = (
        "part",
        ["ran" if name in seconds else "left out" for name in names],
        {"long_name": "whether the part ran"},
    )
    result["part_reason"] = (
        "part",
        [planned.left_out.get(name, PARTS[name].does) for name in names],
        {"long_name": "what the part does, or why it was left out"},
    )
    result.attrs = _attributes(planned, given)
    return result


def _attributes(planned: Plan, given: Mapping[str, Any]) -> dict[str, str | float]:
    """Global attributes: strings and numbers, the same from run to run."""
    from importlib.metadata import version

    scene = planned.scene
    used = set().union(*(part.keys for part in planned.parts))
    bodies = [scene.body] * ("body" in used) + list(scene.perturbers) * ("perturbers" in used)
    attributes: dict[str, str | float] = {
        "Conventions": CONVENTIONS,
        "title": scene.title,
        "source": f"earthspin {__version__}",
        "history": f"earthspin {__version__}: compute = {scene.compute}",
        "references": "; ".join(dict.fromkeys(b.reference for b in bodies if b.reference)),
        "earthspin_version": __version__,
        "numpy_version": version("numpy"),
        "compute": scene.compute,
    }
    if "body" in used:
        attributes["body"] = scene.body.name
    if scene.effects:
        attributes["effects"] = " ".join(scene.effects)
    if "perturbers" in used:
        attributes["perturbers"] = " ".join(p.name for p in scene.perturbers)
    if "ephemeris" in given:
        ephemeris = given["ephemeris"].ephemeris
        attributes |= {
            "ephemeris": ephemeris.name,
            "ephemeris_sha256": ephemeris.sha256,
            "jplephem_version": version("jplephem"),
            "pyerfa_version": version("pyerfa"),
        }
    for key in ("equator", "span", "step", "accuracy"):
        if key in used and getattr(scene, key) is not None:
            attributes[key] = str(getattr(scene, key))
    return attributes


def _below(part: Part) -> set[str]:
    """Names of all parts that a part stands on."""
    return set(part.needs).union(*(_below(PARTS[name]) for name in part.needs))


def _keys_with_needs(part: Part) -> set[str]:
    """Scene keys that a part depends on, those of the parts that it stands on included."""
    below = (PARTS[name] for name in part.needs + part.uses)
    return set(part.keys).union(*(_keys_with_needs(p) for p in below))


def _identity(value: Any) -> Any:
    """Something hashable that is equal only for the same setting."""
    try:
        hash(value)
    except TypeError:
        return id(value)
    return value
