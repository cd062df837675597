"""Numbers in docs/examples."""

from __future__ import annotations

from tests.docs.numbers.sentence import Told

TOLD = [
    Told(
        "docs/examples/tidal_tilt.py",
        "#: Obliquity grows by {} mas a century",
        "published: Williams 1994, as the comment says",
    ),
]
