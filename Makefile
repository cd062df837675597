# Each target makes .venv if it is missing and installs what it needs there.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
LOWEST := .venv-lowest
NEWEST := .venv-newest
# Another Python than that of $(VENV), by name or by path.
PYTHON_NEWEST ?= python3.14
# What test-lowest and test-newest repeat: the quick tests of what uses more than numpy and SciPy.
# They run the formulas as well, whose own tests are left out.
VERSIONED := $(addprefix tests/,docs engine extreme force fuzz numerics questions sky views) tests/test_*.py
SPHINX := $(BIN)/python -m sphinx -q -W --keep-going -j auto -b html docs docs/_build/html

# One thread of the BLAS for each process: those of two would wait for each other on the same cores.
test slow test-lowest test-newest check docs kills extreme: export OPENBLAS_NUM_THREADS := 1

.PHONY: report test slow test-lowest test-newest check docs accuracy bench fuzz kills mutants extreme clean

report: $(VENV)/.core
	$(BIN)/earthspin report --out report

test: $(VENV)/.test
	$(BIN)/python -m pytest -q --numprocesses=auto --dist=worksteal

# What takes some seconds each: random scenes, clusters, other processes, simulated records.
slow: $(VENV)/.test
	$(BIN)/python -m pytest -q -m slow --numprocesses=auto --dist=worksteal

# The oldest versions that pyproject.toml allows; what they themselves need is the newest.
test-lowest: $(LOWEST)/.test
	$(LOWEST)/bin/python -m pytest -q --numprocesses=auto --dist=worksteal $(or $(TESTS),$(VERSIONED))

# The newest Python and the newest of all that runs on it, sought again each time.
test-newest: $(NEWEST)/bin/python
	$(NEWEST)/bin/python -m pip install --quiet --upgrade --upgrade-strategy eager --editable '.[test]'
	$(NEWEST)/bin/python -m pytest -q --numprocesses=auto --dist=worksteal $(or $(TESTS),$(VERSIONED))

check: $(VENV)/.check
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/bandit --quiet --configfile pyproject.toml --recursive earthspin
	$(BIN)/python -m data_tools audit
	$(BIN)/python -m data_tools cf
	$(SPHINX)

docs: $(VENV)/.check
	$(SPHINX)

# Runs, their workers and their schedulers, each killed after every so many blocks.
kills: $(VENV)/.test
	$(BIN)/python -m pytest -q -m every_kill tests/engine

fuzz: $(VENV)/.test
	$(BIN)/python -m tests.fuzz $(or $(SEED),1) $(or $(COUNT),20000)

# Random changes of the physics; those that no test notices are printed.
mutants: $(VENV)/.test
	$(BIN)/python -m tests.mutants $(or $(N),100) $(or $(SEED),1)

# Error against run time of every method: the tables and figures of the page and of the README.
accuracy: $(VENV)/.test
	OPENBLAS_NUM_THREADS=1 $(BIN)/python -m tests.benchmarks.accuracy

# All extreme cases, also those that take minutes, and their table.
extreme: $(VENV)/.test
	$(BIN)/python -m pytest -q -m "" -p tests.extreme.table tests/extreme

bench: $(VENV)/.test
	$(BIN)/python tests/benchmarks/chebyshev.py
	$(BIN)/python tests/benchmarks/side_by_side.py
	$(BIN)/python tests/benchmarks/call_overhead.py
	$(BIN)/python tests/benchmarks/ensemble.py
	$(BIN)/python -m tests.benchmarks.repeated
	$(BIN)/python -m tests.benchmarks.first_calls
	$(BIN)/python -m tests.benchmarks.earth_rotation
	$(BIN)/python -m tests.benchmarks.how_large

clean:
	rm -rf $(VENV) $(LOWEST) $(NEWEST) report build dist docs/_build

$(VENV)/bin/python:
	$(PYTHON) -m venv $(VENV)

$(VENV)/.core: pyproject.toml | $(VENV)/bin/python
	@echo "Installing earthspin and the libraries that it needs into $(VENV); this takes one to two minutes"
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .
	@touch $@

$(VENV)/.test: pyproject.toml | $(VENV)/bin/python
	$(BIN)/python -m pip install --quiet --editable '.[test]'
	@touch $@

$(VENV)/.check: pyproject.toml | $(VENV)/bin/python
	$(BIN)/python -m pip install --quiet --editable '.[test,check,docs]'
	@touch $@

$(LOWEST)/.test: pyproject.toml | $(VENV)/bin/python
	$(BIN)/python -m pip install --quiet uv
	$(PYTHON) -m venv --clear $(LOWEST)
	$(BIN)/uv pip install --quiet --python $(LOWEST)/bin/python --resolution lowest-direct --editable '.[test]'
	@touch $@

$(NEWEST)/bin/python:
	$(PYTHON_NEWEST) -m venv --clear $(NEWEST)
