"""The body that questions are about unless another is given."""

from __future__ import annotations

from earthspin.bodies import Body
from earthspin.engine.question import keys_of
from earthspin.parts.sky import Pulled


def default_body() -> Body:
    """What spins if a question does not say."""
    found: Body = keys_of(Pulled)["body"].default
    return found
