"""How an oblate, spinning body answers to what pulls on it.

Public names are handed on when they are first used, so that importing the package costs
nothing and a question loads only what it needs.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from earthspin._version import __version__

if TYPE_CHECKING:
    from earthspin.bodies import BODIES as BODIES
    from earthspin.bodies import EARTH as EARTH
    from earthspin.bodies import MARS as MARS
    from earthspin.bodies import MOON as MOON
    from earthspin.bodies import SUN as SUN
    from earthspin.bodies import Body as Body
    from earthspin.calls import compare_iau as compare_iau
    from earthspin.calls import excitation as excitation
    from earthspin.calls import fit_chandler as fit_chandler
    from earthspin.calls import free_rotor as free_rotor
    from earthspin.calls import heavy_top as heavy_top
    from earthspin.calls import polar_motion as polar_motion
    from earthspin.calls import polar_motion_from as polar_motion_from
    from earthspin.calls import pole as pole
    from earthspin.calls import precession as precession
    from earthspin.calls import read_excitation as read_excitation
    from earthspin.calls import spheroid_field as spheroid_field
    from earthspin.calls import torque_series as torque_series
    from earthspin.calls import wobble_ladder as wobble_ladder
    from earthspin.calls import write_series as write_series
    from earthspin.checks.gauntlet import stability as stability
    from earthspin.checks.work_precision import accuracy as accuracy
    from earthspin.errors import AccuracyError as AccuracyError
    from earthspin.errors import BodyError as BodyError
    from earthspin.errors import CoverageError as CoverageError
    from earthspin.errors import EarthspinError as EarthspinError
    from earthspin.errors import KernelError as KernelError
    from earthspin.errors import MissingExtraError as MissingExtraError
    from earthspin.errors import OutputError as OutputError
    from earthspin.errors import SceneError as SceneError
    from earthspin.errors import SeriesError as SeriesError
    from earthspin.errors import UndefinedError as UndefinedError
    from earthspin.errors import UnitsError as UnitsError
    from earthspin.scene.planning import plan as plan
    from earthspin.scene.running import run as run
    from earthspin.scene.spec import Scene as Scene
    from earthspin.scene.spec import load_scene as load_scene
    from earthspin.storage import read as read
    from earthspin.storage import write as write

_HOME = {
    "earthspin.bodies": ("BODIES", "EARTH", "MARS", "MOON", "SUN", "Body"),
    "earthspin.calls": (
        "free_rotor",
        "heavy_top",
        "precession",
        "spheroid_field",
        "excitation",
        "fit_chandler",
        "polar_motion",
        "polar_motion_from",
        "read_excitation",
        "compare_iau",
        "pole",
        "torque_series",
        "wobble_ladder",
        "write_series",
    ),
    "earthspin.checks.gauntlet": ("stability",),
    "earthspin.checks.work_precision": ("accuracy",),
    "earthspin.errors": (
        "AccuracyError",
        "BodyError",
        "CoverageError",
        "EarthspinError",
        "KernelError",
        "MissingExtraError",
        "OutputError",
        "SceneError",
        "SeriesError",
        "UndefinedError",
        "UnitsError",
    ),
    "earthspin.scene.planning": ("plan",),
    "earthspin.scene.running": ("run",),
    "earthspin.scene.spec": ("Scene", "load_scene"),
    "earthspin.storage": ("read", "write"),
}
_MODULE_OF = {name: module for module, names in _HOME.items() for name in names}

__all__ = ["__version__", *sorted(_MODULE_OF)]


def __getattr__(name: str) -> Any:
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'earthspin' has no attribute '{name}'")
    value = getattr(import_module(_MODULE_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_MODULE_OF})
