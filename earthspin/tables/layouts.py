"""Layouts of published tables, as data.

A layout is recognised by words above its rows. Only tables without a header are recognised by their
number of columns, and such a reading must be confirmed by comparison with known numbers.
"""

from __future__ import annotations

from typing import NamedTuple


class TableLayout(NamedTuple):
    """Layout of published files.

    Attributes
    ----------
    name : str
    columns : str
        Declaration of its columns.
    head : str
        Pattern in the name of the file or above the rows; layouts without it have no header.
    row : str
        Pattern of its rows, if these do not begin with a number and a delimiter.
    until : str
        Pattern of the line where its rows end, if not at the end of the file.
    edges : tuple of tuple of int
        Where its columns begin and end, if these are not separated.
    """

    name: str
    columns: str
    head: str = ""
    row: str = ""
    until: str = ""
    edges: tuple[tuple[int, int], ...] = ()


# --- polar motion and celestial pole offsets ------------------------------------------------------

_XY, _DXY = "x (arcsec), y (arcsec)", "dx (arcsec), dy (arcsec)"
_ERRORS, _OFFSET_ERRORS = "e_x (arcsec), e_y (arcsec)", "e_dx (arcsec), e_dy (arcsec)"
_DAY, _DAY_ERRORS = "ut1 (s), lod (s)", "e_ut1 (s), e_lod (s)"
_IVS = f"mjd, {_XY},, {{offsets}}, {_ERRORS},, {{errors}}, ..."
_C01_YEAR = "year, x (arcsec), e_x (arcsec), y (arcsec), e_y (arcsec)"
#: Tables by Besselian years and of C04 without a header, told apart by their first cell.
C04 = (
    TableLayout("c04", f"year, month, day, mjd, {_XY}, {_DAY}, {_DXY}, {_ERRORS}, {_DAY_ERRORS}, "
                f"{_OFFSET_ERRORS}"),
    TableLayout("c04", f"year, month, day, hour, mjd, {_XY}, ut1 (s), {_DXY},,, lod (s), "
                f"{_ERRORS}, e_ut1 (s), {_OFFSET_ERRORS},,, e_lod (s)"),
)  # fmt: skip
C01_BY_MJD = TableLayout(
    "c01", f"mjd, {_XY},, {_DXY}, {_ERRORS},, {_OFFSET_ERRORS},,,,,,,,,,,,,,,,,,"
)
C01_BY_YEAR = (
    TableLayout("c01", f"{_C01_YEAR},,, dx (arcsec), e_dx (arcsec), dy (arcsec), e_dy (arcsec)"),
    TableLayout("c01", f"{_C01_YEAR}, ..."),
    TableLayout("c01", _C01_YEAR),
)
#: Layouts of the pole without a header, by the kind that names them.
POLE_BY_KIND = {"c04": C04, "c01": (C01_BY_MJD, *C01_BY_YEAR)}
#: Of the columns "type" of finals2000A, "I" if observed and "P" if predicted, the second belongs to
#: UT1 and the third to dX, dY, here as in the CSV.
FINALS2000A = TableLayout(
    "finals2000A",
    "year, month, day, mjd, type, x (arcsec), e_x (arcsec), y (arcsec), e_y (arcsec), type, "
    "ut1 (s), e_ut1 (s), lod (ms), e_lod (ms), type, dx (mas), e_dx (mas), dy (mas), e_dy (mas)",
    row=r".{16}[IP]|[\d ]{6} \d{5}\.\d\d\s*$",
    edges=(
        (0, 2), (2, 4), (4, 6), (7, 15), (16, 17), (18, 27), (27, 36), (37, 46), (46, 55), (57, 58),
        (58, 68), (68, 78), (79, 86), (86, 93), (95, 96), (97, 106), (106, 115), (116, 125),
        (125, 134),
    ),
)  # fmt: skip
_EOP2 = (
    "mjd, x (mas), y (mas),, e_x (mas), e_y (mas),,,,, dx (mas), dy (mas), e_dx (mas), e_dy (mas)"
)
_BULLETIN_B = (
    "year, month, day, mjd, x (mas), y (mas),, dx (mas), dy (mas), e_x (mas), e_y (mas),, "
    "e_dx (mas), e_dy (mas)"
)
_EOXY = _IVS.format(offsets="dx (mas), dy (mas)", errors="e_dx (mas), e_dy (mas)")
POLE_BY_HEAD = (
    TableLayout("EOP2", f"{_EOP2},,", head=r"(?m)^\s*EOP2"),
    TableLayout("EOP-All.txt", f"year, month, day, mjd, {_XY},,,,, {_DXY},",
                head="NUM_OBSERVED_POINTS", until="^END OBSERVED"),
    TableLayout("Bulletin B", _BULLETIN_B,
                head=r"(?i)BULLETIN\s+B\b|B\s+U\s+L\s+L\s+E\s+T\s+I\s+N\s+B\b",
                row=r"\s*\d{4}\s+\d+\s+\d+\s+\d{5}\s", until=r"(?i)^\W*(2 - |preliminary)"),
    TableLayout("IGS ERP", "mjd, x (uas), y (uas),,, e_x (uas), e_y (uas), ...",
                head=r"(?im)^\W*mjd\s+x-?pole\s+y-?pole\s+UT1"),
    TableLayout("EOP-MOD", "jd, x (0.1 arcsec), y (0.1 arcsec), ...", head=r"(?m)^EOP-MOD Ver"),
    TableLayout("IVS eoxy", _EOXY, head=r"\.eoxy|%=IVS-EOP(?s:.*)\bdX\b"),
    TableLayout("IVS eops", _IVS.format(offsets=",", errors=","), head=r"\.eops|%=IVS-EOP"),
    FINALS2000A,
)  # fmt: skip

# --- solutions of obliquity, eccentricity and precession ------------------------------------------

_E, _OBLIQUITY, _VARPI = "eccentricity", "obliquity", "longitude_of_perihelion"
SOLUTIONS = (
    TableLayout("La2010, ZB18a", f"epoch (kyr), {_E}"),
    TableLayout("ZB20a", f"epoch (kyr), {_E},"),
    TableLayout("La2004, La93", f"epoch (kyr), {_E}, {_OBLIQUITY} (rad), {_VARPI} (rad)"),
    # files of snvec (with the angle of precession), and of paleoinsolation
    TableLayout("snvec", f"epoch (kyr), {_OBLIQUITY} (rad),, climatic_precession"),
    TableLayout("snvec", f"epoch (kyr), {_E}, {_OBLIQUITY} (rad),, {_VARPI} (rad), "
                "climatic_precession"),
    TableLayout("ZB18a", f"epoch (kyr), {_E}, {_OBLIQUITY} (deg), {_VARPI} (deg),"),
    TableLayout("Berger & Loutre 1991", f"epoch (kyr from 1950), {_E}, {_VARPI} (deg), "
                f"{_OBLIQUITY} (deg), climatic_precession,,,,", head=r"ECC\s+OMEGA\s+OBL\s+PREC"),
    TableLayout("astrochron getLaskar", f"epoch (ka), {_VARPI} (rad), {_OBLIQUITY} (rad), {_E}",
                head=r"Time_ka\W+prec_angle_\w+\W+tilt_\w+\W+ecc_\w+"),
)  # fmt: skip
#: Its rows may all lie far from J2000.0, so that nothing is known of them; no other layout has as
#: many columns.
ASTROGEO22 = TableLayout("AstroGeo22", "epoch (Gyr ago),,,,,,, obliquity (deg),,,,,")

# --- orbits ---------------------------------------------------------------------------------------

ORBITS = (
    TableLayout("HNBody", "t (d), a, e, inc, varpi, Omega"),
    TableLayout("La2010", "t (kyr), a, l, k, h, q, p"),
    TableLayout("HNBody", "t (d), a, e, inc, varpi, Omega,,"),
    TableLayout("Mercury6", "t (yr), a, e, inc (deg), omega (deg), Omega (deg), ...",
                head=r"(?m)^\s*Time \(years\)\s+a\s+e\s+i\s+peri\s+node"),
)  # fmt: skip

# --- effective angular momentum functions ---------------------------------------------------------

ANGULAR_MOMENTUM = (
    TableLayout("mass and motion", "year, month, day, hour, mjd, mass1, mass2, mass3, "
                "motion1, motion2, motion3"),
    TableLayout("mass", "year, month, day, hour, mjd, mass1, mass2, mass3"),
)  # fmt: skip
