"""A pytest plugin that notes the first test that fails, and that the copy is what is tested."""

import os
from pathlib import Path

import pytest
from hypothesis import Phase, settings

#: Environment variable with the file to write to.
NOTE = "EARTHSPIN_MUTANT_NOTE"


def pytest_configure() -> None:
    """Refuse to run on any package but that of the folder pytest runs in."""
    import earthspin

    if not Path(earthspin.__file__).is_relative_to(Path.cwd()):
        pytest.exit(f"{earthspin.__file__} is not the copy with the error in it", 3)


@pytest.hookimpl(tryfirst=True)
def pytest_collection() -> None:
    """Let Hypothesis draw the same examples each time, and stop at the first that fails."""
    phases = (Phase.explicit, Phase.generate)
    settings.register_profile("witness", settings.get_profile("ci"), phases=phases)
    settings.load_profile("witness")


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Note the first failure, be it of the test or of what it builds on."""
    note = Path(os.environ[NOTE])
    if report.failed and not note.exists():
        note.write_text(report.nodeid, encoding="utf-8")
