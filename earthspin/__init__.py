"""Precession, nutation and Chandler wobble of the Earth and other bodies, with errors.

A module is imported when one of its public names is first used, so that importing the package
costs nothing and a question loads only what it needs.
"""

from __future__ import annotations

from importlib import import_module as _import_module

from earthspin import _lazy
from earthspin import errors as _errors
from earthspin._version import __version__ as __version__
from earthspin.questions import MODULES as _QUESTIONS

#: Public names besides the questions, by their modules.
_HOME = {
    "earthspin.bodies": ("BODIES", "EARTH", "MARS", "MOON", "SUN", "Body", "Orbit"),
    "earthspin.sky.orbit_files": ("read_orbit",),
    "earthspin.questions.insolation": ("daily_insolation",),
    "earthspin.stars_near_pole": ("pole_stars",),
    "earthspin.solutions": ("read_solution",),
    "earthspin.questions.polar_motion": (
        "excitation",
        "fit_chandler",
        "polar_motion_from",
        "read_excitation",
    ),
    "earthspin.errors": tuple(name for name in vars(_errors) if name.endswith("Error")),
    "earthspin.scenes": (
        "Scene",
        "VersionWarning",
        "ensemble",
        "load_scene",
        "plan",
        "run",
        "run_tree",
        "write_series",
    ),
    "earthspin.engine.store": ("open", "read", "verify", "write"),
}
_MODULE_OF = _QUESTIONS | {name: module for module, names in _HOME.items() for name in names}

# What answers call in packages above the engine, which knows none of these.
_lazy.FUNCTIONS |= dict.fromkeys(
    ("QUESTIONS", "load_scene", "plan", "run_tree"), "earthspin.scenes"
)
_lazy.METHODS |= {
    "plot": "earthspin.views.rendering",
    "to_iers_table": "earthspin.questions.forecast",
    "to_pck": "earthspin.frames",
}

#: Without `open`, so that ``from earthspin import *`` leaves that of Python alone.
__all__ = ["__version__", *sorted(_MODULE_OF.keys() - {"open"})]


def __getattr__(name: str) -> object:
    if name in _MODULE_OF:
        value = getattr(_import_module(_MODULE_OF[name]), name)
        if not isinstance(value, type) and callable(value) and name not in _QUESTIONS:
            value = _errors.checked(value)
            value.__module__, value.__qualname__ = __name__, name  # where pickle finds it
        globals()[name] = value
        return value
    return _lazy.submodule(__name__, name)


def __dir__() -> list[str]:
    return [*__all__, "open"]
