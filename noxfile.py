#!/usr/bin/env -S uv run --script
# /// script
# dependencies = ["nox>=2025.2.9"]
# ///
"""Sessions of nox: the checks of the Makefile, each in an environment of its own.

``nox`` runs the quick tests and the lint; ``nox -s docs`` builds the pages.
"""

import nox

nox.needs_version = ">=2025.2.9"
nox.options.default_venv_backend = "uv|virtualenv"


@nox.session(python=["3.11", "3.12", "3.13", "3.14"])
def tests(session: nox.Session) -> None:
    """Run the quick tests; further words go to pytest."""
    session.install("--editable", ".[test]")
    workers = ("--numprocesses=auto", "--dist=worksteal")
    session.run("pytest", *workers, *session.posargs, env={"OPENBLAS_NUM_THREADS": "1"})


@nox.session
def lint(session: nox.Session) -> None:
    """Check style, types and import rules."""
    session.install("--editable", ".[test,check,docs]")
    session.run("ruff", "check", ".")
    session.run("ruff", "format", "--check", ".")
    session.run("mypy")
    session.run("lint-imports")


@nox.session(default=False)
def docs(session: nox.Session) -> None:
    """Build the documentation; each warning is an error."""
    session.install("--editable", ".[docs]")
    session.run("sphinx-build", "-W", "--keep-going", "-j", "auto", "docs", "docs/_build/html")


if __name__ == "__main__":
    nox.main()
