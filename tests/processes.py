"""Python code in processes of their own."""

import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
#: Begin of the warning of an old table: those that astropy carries age.
OLD_TABLE = "days count from the newest row"


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
    strict = ["-W", "error", "-W", f"ignore:{OLD_TABLE}:UserWarning"]
    command = [sys.executable, "-X", "utf8", *strict, "-c", program, *words]
    settings = {"cwd": ROOT, "encoding": "utf-8"} | settings
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, **settings).stdout
