"""Draw the picture of the README: declination, torque, average, period."""

from pathlib import Path

import earthspin
from earthspin.views.drawing import style
from earthspin.views.precession import plot_chain

PICTURE = Path(__file__).parents[1] / "docs" / "_static" / "chain.png"


def main() -> int:
    """Write the picture."""
    precession = earthspin.run_tree("precession", ["convergence"])
    year = earthspin.torque_series("2000-01-01", "2001-01-01", "6 h", source="skyfield")
    with style():
        plot_chain(precession, year).savefig(PICTURE, dpi=100)
    return 0
