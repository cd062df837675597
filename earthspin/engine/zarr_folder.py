"""Read a Zarr store in a folder, and compare each file with its checksum.

Zarr itself reads a missing chunk as the fill value, and mixes two stores without notice if a folder
is replaced while it is read.
"""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

from zarr.storage import LocalStore

from earthspin.engine import checksums
from earthspin.engine.drafts import check_identity, identity


class ZarrFolder(LocalStore):
    """A read-only Zarr store that compares each file with its checksum when it is read.

    Parameters
    ----------
    root : Path
    read_only : bool
        Always True; Zarr passes it when it copies a store.
    """

    def __init__(self, root: Path, *, read_only: bool = True) -> None:
        super().__init__(root, read_only=read_only)
        self._opened, self._ledger = identity(root), checksums.ledger_of(root)

    async def get(self, key: str, prototype: Any = None, byte_range: Any = None) -> Any:
        """Read a file of the store and compare it with its checksum.

        Raises
        ------
        OutputError
            If the file differs from what was written, or the store was replaced.
        """
        content = await super().get(key, prototype, byte_range)
        check_identity(self.root, self._opened)
        if self._ledger is not None and byte_range is None:
            digest = "" if content is None else hashlib.sha256(content.to_bytes()).hexdigest()
            checksums.check_file(self.root, key, digest, self._ledger)
        return content
