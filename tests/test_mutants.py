"""The planted errors themselves: each can be planted, every kernel has some, one is caught."""

from collections import Counter

import pytest

from tests.mutants.catalogue import ROOT, load

pytestmark = pytest.mark.any_version
MUTANTS = load()
#: Packages of which every module is a kernel, except those that only hold names. A question calls
#: formulas of these packages, so it needs no entry of its own.
PACKAGES = (
    *("numerics", "mass", "rotor", "top", "torque", "motion", "interior"),
    *("wobble", "nutation", "sky", "parts"),
)
NO_KERNEL = {"__init__"}
#: Modules between what is given and the kernels, and between the kernels and the answer.
BORDER = (
    *("units", "dates", "bodies/shapes", "bodies/earth_moon_sun", "constants", "scenes"),
    *("engine/question", "engine/run", "engine/variables", "engine/store"),
    *("engine/drafts", "engine/zarr_folder", "engine/blocks", "errors", "process"),
)


def test_each_can_be_planted() -> None:
    wrong = []
    for mutant in MUTANTS:
        try:
            planted = mutant.planted_in((ROOT / mutant.file).read_text(encoding="utf-8"))
            compile(planted, mutant.file, "exec")
        except (OSError, ValueError, SyntaxError) as error:
            wrong.append(str(error))
        for file, _, name in (tests.partition("::") for tests in mutant.tests):
            if not (ROOT / file).exists() or (
                name and f"def {name.partition('[')[0]}(" not in (ROOT / file).read_text("utf-8")
            ):
                wrong.append(f"mutant '{mutant.name}': no test {file}::{name}")
        if mutant.old == mutant.new or not mutant.tests:
            wrong.append(f"mutant '{mutant.name}' changes nothing, or names no test")
    assert not wrong
    assert max(Counter(mutant.name for mutant in MUTANTS).values()) == 1


def test_every_kernel_has_one() -> None:
    kernels = {
        str(path.relative_to(ROOT))
        for package in PACKAGES
        for path in (ROOT / "earthspin" / package).glob("*.py")
        if path.stem not in NO_KERNEL
    } | {f"earthspin/{module}.py" for module in BORDER}
    assert len(kernels) > 70
    assert kernels <= {mutant.file for mutant in MUTANTS}
