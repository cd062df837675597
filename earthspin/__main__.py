"""`python -m earthspin`."""

import sys

from earthspin.cli import main

sys.exit(main())
