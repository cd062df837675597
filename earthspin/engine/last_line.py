"""The last line of a netCDF file of ours: a checksum of every byte before it.

The library that reads the file trusts the file's own tables: damaged ones can keep it busy without
end, before anything that stands inside can be checked. So the bytes are checked before it opens
them. The line stands behind what the format counts as the file, where other readers of netCDF do
not look, and it can be checked by hand::

    head -c -110 answer.nc | sha256sum; tail -n 1 answer.nc
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from typing import BinaryIO

_WORDS = b"\nearthspin: SHA-256 of all before this line: "
_DIGITS = 64
LENGTH = len(_WORDS) + _DIGITS + 1
#: Bytes that are read at once.
_AT_ONCE = 1 << 20


def append(path: Path) -> None:
    """Append the checksum to a file that is complete.

    Parameters
    ----------
    path : Path
    """
    with path.open("r+b") as file:
        size = file.seek(0, os.SEEK_END)
        line = _line(file, size)
        file.seek(size)
        file.write(line)


def is_broken(path: Path) -> bool:
    """Whether a file ends in a checksum that does not match, or in what is left of one.

    Parameters
    ----------
    path : Path

    Returns
    -------
    bool
        False too for a file without one: another program's, or one that it has written to.
    """
    with path.open("rb") as file:
        size = file.seek(0, os.SEEK_END) - LENGTH
        if size < 0:
            return False
        file.seek(size)
        line = file.read(LENGTH)
        # Damaged words are ours still: by chance three of them in four agree nowhere.
        agree = sum(one == other for one, other in zip(line, _WORDS, strict=False))
        return agree > 3 * len(_WORDS) // 4 and line != _line(file, size)


def _line(file: BinaryIO, size: int) -> bytes:
    """The line that belongs behind the first `size` bytes of a file."""
    total = hashlib.sha256()
    file.seek(0)
    while size and (read := file.read(min(size, _AT_ONCE))):
        total.update(read)
        size -= len(read)
    return _WORDS + total.hexdigest().encode("ascii") + b"\n"
