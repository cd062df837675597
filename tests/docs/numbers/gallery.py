"""Numbers in the words of the scripts of docs/gallery; what they find they draw."""

from __future__ import annotations

from tests.docs.numbers.sentence import Sentence, Told


def script(name: str) -> str:
    """Path of a script."""
    section, picture = name.split("/")
    return f"docs/gallery/{section}/plot_{picture}.py"


MEASURED: list[Sentence] = []
TOLD = [
    Told(
        script("bodies/spheroids_and_rings"),
        "masses of {} kg",
        "given: what the script begins with",
    ),
    Told(
        script("rotation/moons"),
        "# semi-axes 180, {} and {} km",
        "published: 360 × 266 × 205 km, Tarnopolski 2015, Astrophys. Space Sci. 357, 160",
    ),
    Told(
        script("rotation/moons"),
        "PHOBOS.moments  # semi-axes {}, {} and {} km",
        "published: IAU, as on docs/rotation.md",
    ),
]
