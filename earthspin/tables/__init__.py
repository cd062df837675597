"""Tables of text and data frames of others, read into columns whose meaning is declared."""

from earthspin.tables.calendar_dates import DATES, MJD_0, dates_of
from earthspin.tables.columns import (
    BLANK,
    Meaning,
    column_of,
    declared,
    fits,
    places,
    with_words,
    written,
)
from earthspin.tables.meaning import CHANGE, FEWEST, NEAR, guessed, refuse_other_meaning
from earthspin.tables.sheet import FRAME, Sheet, is_frame, of_frame, series_of, split, typed
from earthspin.tables.text import checksum, is_number, is_table

__all__ = [
    "BLANK", "CHANGE", "DATES", "FEWEST", "FRAME", "MJD_0", "NEAR", "Meaning", "Sheet", "checksum",
    "column_of", "dates_of", "declared", "fits", "guessed", "is_frame", "is_number", "is_table",
    "of_frame", "places", "refuse_other_meaning", "series_of", "split", "typed", "with_words",
    "written",
]  # fmt: skip
