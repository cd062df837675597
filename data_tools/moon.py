"""Measure how far the rotation of the Moon is from the librations of DE421, effect by effect.

    python -m data_tools moon FOLDER     (pip download --no-deps de421==2008.1, unpacked)

For docs/rotation.md, with the angles of DE421 for the picture of its gallery. The motion starts as
by default, from a tabulated state and the motion since then, at dates that are not in the table.
Differences are those of the Euler angles as arcs.
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

DOCS = Path(__file__).parent.parent / "docs"
PAGE = DOCS / "measured" / "moon.inc"
#: Table for a picture, of 18.6 years from 2008: first date, TDB Julian date, and interval, d.
PICTURED = DOCS / "gallery" / "rotation" / "de421_librations.txt"
PICTURED_FROM, PICTURED_YEARS, PICTURED_STEP = 2454466.5, 18.61, 10.0
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


def differences(librations: Librations, jd: FloatArray, effects: tuple[str, ...]) -> FloatArray:
    """Angle and differences of phi sin(theta), theta and phi + psi, arcsec, shape (4, t)."""
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


def dates(start: float, years: float, step: float) -> FloatArray:
    """Julian dates of a span, within the kernel."""
    end = min(start + years * DAYS_PER_YEAR, 2471000.0)
    return np.asarray(np.arange(start, end + step, step))


def write_pictured(librations: Librations) -> None:
    """Write the angles of DE421 and, with each effect left out alone, the differences from them."""
    jd = dates(PICTURED_FROM, PICTURED_YEARS, PICTURED_STEP)
    columns, names = [jd, *librations.at(jd)[0].T], "TDB Julian date, phi, theta, psi (rad)"
    for left_out in ATTITUDE_EFFECTS:
        effects = tuple(name for name in ATTITUDE_EFFECTS if name != left_out)
        columns.append(1e3 * differences(librations, jd, effects)[0])
        names += f", without {left_out} (mas)"
    formats = ["%.1f", *["%.11f"] * 3, *["%.4g"] * len(ATTITUDE_EFFECTS)]
    np.savetxt(PICTURED, np.transpose(columns), fmt=formats, header=names)


def main(folder: str) -> int:
    """Measure, and write the table, and the angles for the picture."""
    librations = Librations(Path(folder))
    write_pictured(librations)
    lines = []
    for words, (effects, longest) in CASES.items():
        series = [differences(librations, dates(s, longest, STEP), effects) for s in STARTS]
        for years in (span for span in SPANS if span <= longest):
            rows = int(years * DAYS_PER_YEAR / STEP) + 1
            largest = np.max([np.abs(one[:, :rows]).max(axis=1) for one in series], axis=0)
            cells = " | ".join(f"{size:.2g}" for size in largest)
            lines.append(f"| {words} | {years} yr | {cells} |\n")
            print(lines[-1], end="", flush=True)
    PAGE.write_text(HEAD + "".join(lines), encoding="utf-8")
    print(f"{PAGE}: written")
    return 0
