"""A Zarr store in a folder that says when something is missing, or is no longer what was opened.

Zarr reads a chunk that is not there as its fill value, zeros or the year 2000, and a folder that
is replaced while it is read as half of the one and half of the other.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from zarr.storage import LocalStore

from earthspin.errors import OutputError

#: Name of a chunk of format 2: ``torque/0.1.0``.
_CHUNK = re.compile(r"(.*/)?\d+(\.\d+)*")


class ZarrFolder(LocalStore):
    """A folder that is read, and only read.

    Parameters
    ----------
    root : Path
    read_only : bool
        True; Zarr passes it when it makes a store again.
    """

    def __init__(self, root: Path, *, read_only: bool = True) -> None:
        super().__init__(root, read_only=read_only)
        self._opened = self._identity()

    def _identity(self) -> tuple[int, int, int] | None:
        try:
            found = Path(self.root).stat()
        except OSError:
            return None
        return found.st_dev, found.st_ino, found.st_mtime_ns

    async def get(self, key: str, prototype: Any = None, byte_range: Any = None) -> Any:
        """Read a file of the store.

        Raises
        ------
        OutputError
            If it is a chunk that is not there, or the store has been replaced.
        """
        found = await super().get(key, prototype, byte_range)
        if self._identity() != self._opened:
            raise OutputError(self.root, "it was replaced while it was read", "open it again")
        if found is None and _CHUNK.fullmatch(key):
            raise OutputError(self.root, f"the chunk '{key}' is missing", "write it again")
        return found
