"""Compute the stored references again: `python -m tests.reference [NAME ...]`."""

import json
import sys

from tests.reference.makers import MAKERS, pairs
from tests.reference.stored import FOLDER

for name in sys.argv[1:] or MAKERS:
    inputs, values = MAKERS[name]()
    stored = {"inputs": inputs, "values": {key: pairs(value) for key, value in values.items()}}
    text = json.dumps(stored).replace('"values"', '\n"values"')
    (FOLDER / f"{name}.json").write_text(text + "\n", encoding="utf-8")
    print(f"wrote {name}.json")
