"""Every number of the pages that is measured, and what makes it again; one module a subject.

A sentence of a page stands here with `{}` for each of its numbers, beside what gives them. The
test finds the sentence, reads the numbers and compares; a sentence that is gone is an error.
Numbers that no test makes again stand here too, with where they come from.
"""

PAGES = (
    "accuracy",
    "pole",
    "iau",
    "nutation",
    "wobble",
    "observed_pole",
    "trust",
    "rotors",
    "skyfield",
    "work_precision",
    "frames",
    "long_term",
    "worlds",
    "rotation",
    "ensembles",
    "course",
    "howto",
    "gallery",
)
