"""Python code in processes of their own."""

import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]


def printed(program: str, *words: str, **settings: Any) -> str:
    """Standard output of a program, which must end well and without a warning.

    Parameters
    ----------
    program : str
        Python code.
    *words : str
        Its arguments.
    **settings
        Of `subprocess.run`.
    """
    old = "ignore:days count from the newest row:UserWarning"  # the tables of astropy age
    command = [sys.executable, "-X", "utf8", "-W", "error", "-W", old, "-c", program, *words]
    settings = {"cwd": ROOT, "encoding": "utf-8"} | settings
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, **settings).stdout
