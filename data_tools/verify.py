"""The kernels must be the ones that everything was measured with."""

from earthspin.errors import MissingExtraError
from earthspin.sky.ephemeris import open_ephemeris
from earthspin.sky.kernel import PUBLISHED


def main() -> int:
    """Compare each kernel that is installed with its known hash."""
    failed = 0
    for name, known in PUBLISHED.items():
        try:
            digest = open_ephemeris(name).sha256
        except MissingExtraError as error:
            print(f"{name}: {error}")
            continue
        failed += digest != known
        print(f"{name}: {digest} {'as known' if digest == known else 'NOT the known ' + known}")
    return int(failed > 0)
