"""Effects that a rigid body of three moments leaves out, by body, and how far each turns it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from earthspin.constants import ARCSEC

#: Days after the start at which the sizes were measured.
DAYS = (1.0, 10.0, 30.0, 100.0, 365.0, 1000.0, 3650.0, 14000.0)
