"""How an oblate, spinning body answers to what pulls on it.

Public names are handed on when they are first used, so that importing the package costs
nothing and a question loads only what it needs.
"""

from __future__ import annotations

from importlib import import_module as _import_module

from earthspin._version import __version__ as __version__

_HOME = {
    "earthspin.bodies": ("BODIES", "EARTH", "MARS", "MOON", "SUN", "Body", "Orbit"),
    "earthspin.questions.precession": ("precession",),
    "earthspin.questions.torque": ("torque_series",),
    "earthspin.questions.pole": ("pole",),
    "earthspin.questions.iau": ("compare_iau",),
    "earthspin.questions.nutation": ("nutation_ladder",),
    "earthspin.questions.love_numbers": ("love_numbers",),
    "earthspin.questions.compliances": ("compliances",),
    "earthspin.questions.long_term": ("long_term",),
    "earthspin.questions.cassini": ("cassini_states",),
    "earthspin.questions.rotation": ("rotation",),
    "earthspin.sky.orbit_files": ("read_orbit",),
    "earthspin.parts.insolation": ("daily_insolation",),
    "earthspin.questions.wobble": ("wobble_ladder",),
    "earthspin.questions.polar_motion": (
        "excitation",
        "fit_chandler",
        "polar_motion",
        "polar_motion_from",
        "read_excitation",
    ),
    "earthspin.questions.free_rotor": ("free_rotor",),
    "earthspin.questions.top": ("heavy_top",),
    "earthspin.questions.spheroid": ("spheroid_field",),
    "earthspin.checks.stability": ("stability",),
    "earthspin.checks.work_precision": ("accuracy",),
    "earthspin.errors": (
        "AccuracyError",
        "ApartError",
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
    "earthspin.scenes": (
        "Scene",
        "VersionWarning",
        "load_scene",
        "plan",
        "run",
        "run_tree",
        "write_series",
    ),
    "earthspin.many": ("ensemble",),
    "earthspin.engine.store": ("open", "read", "verify", "write"),
}
_MODULE_OF = {name: module for module, names in _HOME.items() for name in names}

__all__ = ["__version__", *sorted(_MODULE_OF)]


def __getattr__(name: str) -> object:
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'earthspin' has no attribute '{name}'")
    value = getattr(_import_module(_MODULE_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return list(__all__)
