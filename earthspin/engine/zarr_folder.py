"""A Zarr store in a folder, each file of which is held to the ledger when it is read.

Zarr reads a chunk that is not there as its fill value, and a folder that is replaced while it is
read as half of the one and half of the other.
"""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

from zarr.storage import LocalStore

from earthspin.engine import checksums
from earthspin.engine.drafts import check_identity, identity


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
        self._opened, self._ledger = identity(root), checksums.ledger_of(root)

    async def get(self, key: str, prototype: Any = None, byte_range: Any = None) -> Any:
        """Read a file of the store.

        Raises
        ------
        OutputError
            If it is not what was written, or the store has been replaced.
        """
        content = await super().get(key, prototype, byte_range)
        check_identity(self.root, self._opened)
        if self._ledger is not None and byte_range is None:
            digest = "" if content is None else hashlib.sha256(content.to_bytes()).hexdigest()
            checksums.check_file(self.root, key, digest, self._ledger)
        return content
