"""What a part is: one thing to compute, with what it needs and what it gives."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import TYPE_CHECKING, Any

from earthspin.dataset import Schema

if TYPE_CHECKING:
    from earthspin.scene.spec import Scene


def always(scene: Scene) -> str | None:
    """Leave a part in, whatever the scene says."""
    return None


@dataclass(frozen=True)
class Part:
    """One thing to compute.

    Attributes
    ----------
    name : str
        Label in plans and results.
    does : str
        What it does, in one line.
    function : str
        ``"module:function"``, imported only when it runs; called with the scene and what
        the parts it needs gave. A part with a schema returns values by variable name, a
        part without one returns anything that other parts can use.
    needs : tuple of str
        Parts that must run before.
    uses : tuple of str
        Parts that run before unless they are left out.
    gives : Schema
        The variables that it adds to the result; empty for an intermediate part.
    keys : tuple of str
        The scene keys that its result depends on.
    left_out : callable
        Scene to the reason for leaving it out, or None.
    """

    name: str
    does: str
    function: str
    needs: tuple[str, ...] = ()
    uses: tuple[str, ...] = ()
    gives: Schema = field(default_factory=dict)
    keys: tuple[str, ...] = ()
    left_out: Callable[[Scene], str | None] = always

    def run(self, scene: Scene, given: Mapping[str, Any]) -> Any:
        """Import the function and call it."""
        module, function = self.function.split(":")
        return getattr(import_module(module), function)(scene, given)
