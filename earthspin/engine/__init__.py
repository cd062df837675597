"""Machinery of all computations: inputs (questions), functions, runs, ensembles, result files.

Functions of the packages above the engine that answers call are registered here by their names, by
``earthspin/__init__.py``. A module is imported when its function is first called.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

#: Modules of the registered functions, by the names of the functions.
FUNCTIONS: dict[str, str] = {}
#: Modules of the functions of an answer that are methods of its accessor, by their names.
METHODS: dict[str, str] = {}


def registered(name: str) -> Any:
    """Import the module of a function in `FUNCTIONS` or `METHODS`, and return the function."""
    return getattr(import_module((FUNCTIONS | METHODS)[name]), name)
