"""Files that hold no table of text, told by their first bytes or words, and how to read them."""

from __future__ import annotations

import re

from earthspin.errors import SeriesError

#: Name of a format, and what to do instead, by a pattern of the first bytes of a file.
_FORMATS = {
    rb"version https://git-lfs": ("a pointer of Git LFS, not the file", "run 'git lfs pull'"),
    rb"(?i)\s*(<!doctype html|<html|<\?xml|<head)": (
        "a web page, not a table",
        "download the file itself, such as its 'raw' form",
    ),
    rb"%=SNX": (
        "a SINEX file",
        "give its pole as a table: import pandas as pd; from pathlib import Path; r = [s.split() "
        "for s in Path('{file}').read_text().splitlines() if s[7:10] in ('XPO', 'YPO')]; "
        "t = pd.DataFrame(r).pivot(index=5, columns=1, values=8).astype(float); "
        "t.columns = ['x', 'y']; t.index = pd.to_datetime(t.index.str[:6], format='%y:%j') + "
        "pd.to_timedelta(t.index.str[7:].astype(int), 's'); t.attrs['units'] = 'mas'",
    ),
    rb"(?i)stk\.v\.": (
        "a file of STK",
        "give its rows as a table: import pandas as pd; t = pd.read_csv('{file}', sep=r'\\s+', "
        "skiprows={rows}, skipfooter=1, engine='python', names=['t', ...])",
    ),
    rb"PK\x03\x04": ("a ZIP archive or a workbook", "unpack it, or use pandas.read_excel"),
    rb"%PDF": ("a PDF document", "take the table itself as text"),
    rb"CDF[\x01\x02\x05]|\x89HDF": ("a NetCDF or HDF5 file", "open it with xarray.open_dataset"),
    rb"\s*[{\[]\s*[\"{\[]": ("a JSON file", "give its rows as a table: pandas.read_json('{file}')"),
    rb"(BZh|\xfd7zXZ|\x28\xb5\x2f\xfd)": ("compressed, but not by gzip", "unpack it"),
    rb"(?s).{0,600}B +U +L +L +E +T +I +N *-? *A\b": (
        "the text of a bulletin",
        "take finals2000A.all, or its CSV, which have the same rows",
    ),
}  # fmt: skip


def refuse(file: object, data: bytes) -> None:
    """Refuse a file that is known to hold no table of text, by the name of its format.

    Raises
    ------
    SeriesError
        The message says what to do instead.
    """
    for pattern, (name, remedy) in _FORMATS.items():
        if re.match(pattern, data):
            row = re.search(rb"(?m)^[ \t]*[-+]?\d\S*[ \t]+[-+]?\d\S*[ \t]+[-+]?\d", data)
            above = data[: row.start() if row else 0].count(b"\n")
            remedy = remedy.replace("{rows}", str(above)).replace("{file}", str(file))
            raise SeriesError(file, f"it is {name}", remedy)
