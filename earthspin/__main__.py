"""Entry point of the command line when it is started by `python -m earthspin`."""

import sys

from earthspin.cli import main

sys.exit(main())
