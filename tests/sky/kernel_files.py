"""Small kernels, written by hand: the layout of a DAF file and of its segments in plain sight."""

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jplephem.daf import FTPSTR

from earthspin.numerics.arrays import FloatArray
from earthspin.sky.ephemeris import find_kernel

RECORD = 1024  # bytes
SUMMARY = 40  # bytes: two times, six whole numbers
FIRST_SUMMARY = 24  # bytes: next, previous, count


@dataclass(frozen=True)
class Piece:
    """One segment: Chebyshev series of position in km, shape (records, components, terms)."""

    centre: int
    target: int
    start: float  # s from J2000.0
    length: float  # s
    series: FloatArray

    def words(self) -> FloatArray:
        """All that stands in the file: records, then the directory."""
        count = len(self.series)
        rows = np.empty((count, 2 + self.series[0].size))
        rows[:, 0] = self.start + (np.arange(count) + 0.5) * self.length
        rows[:, 1] = self.length / 2
        rows[:, 2:] = self.series.reshape(count, -1)
        return np.append(rows.ravel(), [self.start, self.length, rows.shape[1], count])


def write_kernel(path: Path, pieces: Sequence[Piece]) -> Path:
    """Write segments as a file: file record, summaries, names, data, little end first."""
    word = 3 * RECORD // 8 + 1
    summaries, data = b"", b""
    for piece in pieces:
        words = piece.words()
        end = piece.start + len(piece.series) * piece.length
        kind = {3: 2, 6: 3}[piece.series.shape[1]]
        whole = (piece.target, piece.centre, 1, kind, word, word + len(words) - 1)
        summaries += struct.pack("<2d6i", piece.start, end, *whole)
        data += words.astype("<f8").tobytes()
        word += len(words)
    head = struct.pack("<8s2I60s3I8s", b"DAF/SPK ", 2, 6, b"small", 2, 2, word, b"LTL-IEEE")
    head = head.ljust(699, b"\0") + FTPSTR
    block = struct.pack("<3d", 0, 0, len(pieces)) + summaries
    path.write_bytes(
        head.ljust(RECORD, b"\0")
        + block.ljust(RECORD, b"\0")
        + (b"small".ljust(SUMMARY) * len(pieces)).ljust(RECORD, b" ")
        + data
    )
    return path


def from_de421(days: float = 128.0) -> list[Piece]:
    """Sun, Earth and Moon of DE421 from 1 January 2000 on, as its records give them."""
    from jplephem.spk import SPK

    pieces = []
    with SPK.open(find_kernel("de421")) as kernel:
        for centre, target in ((0, 10), (0, 3), (3, 399), (3, 301)):
            segment = kernel[centre, target]
            init, length, size, count = segment.daf.read_array(segment.end_i - 3, segment.end_i)
            rows = segment.daf.map_array(segment.start_i, segment.end_i - 4)
            rows = rows.reshape(int(count), int(size))
            first = int(-init // (32 * 86400)) * int(32 * 86400 // length)
            used = np.array(rows[first : first + round(days * 86400 / length), 2:])
            series = used.reshape(len(used), 3, -1)
            pieces.append(Piece(centre, target, init + first * length, length, series))
    return pieces
