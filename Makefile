# `make` prints the targets. Each target works as the very first command: it sets up .venv itself.

PYTHON ?= python3
VENV := .venv
PY := $(VENV)/bin/python
READY := $(VENV)/.ready
READY_WITH_HOSTS := $(VENV)/.ready_with_hosts
INSTALL := $(PY) -m pip install --quiet --disable-pip-version-check --editable

.DEFAULT_GOAL := help
.PHONY: help setup build validate test lint bench ci hosts interop clean

help: ## print this list
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "  make %-10s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

setup: $(READY) ## create .venv and install everything into it (PYTHON=python3.12 picks another interpreter)

$(PY):
	@command -v $(PYTHON) >/dev/null || { \
	  echo "make: no '$(PYTHON)' here; install Python 3.11 or newer, or name one: make $(MAKECMDGOALS) PYTHON=python3.12" >&2; exit 2; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	  echo "make: Python 3.11 or newer is needed, but $(PYTHON) is $$($(PYTHON) -V 2>&1); name a newer one: make $(MAKECMDGOALS) PYTHON=python3.12" >&2; exit 2; }
	@$(PYTHON) -m venv $(VENV)

$(READY): pyproject.toml | $(PY)
	$(INSTALL) '.[dev]'
	@touch $@

$(READY_WITH_HOSTS): pyproject.toml | $(PY)
	$(INSTALL) '.[dev,hosts]'
	@touch $(READY) $@

build: $(READY) ## build both FMUs into dist
	$(PY) build_fmu.py

validate: build ## build both FMUs, run every built-in scene and compare them with the references
	$(PY) -m harness validate

test: lint ## lint, check types, run the tests that take seconds; SLOW=1 runs the slow ones too
	$(PY) -m pytest -n 2 $(if $(SLOW),--dist worksteal -m "not interop",--dist loadfile)

ci: SLOW := 1
ci: test ## make test SLOW=1

hosts: $(READY_WITH_HOSTS) .venv-hosts/.ready ## install the simulators that the FMUs are tried in, Wine and valgrind (apt-get)
	.ci/install-tools.sh

.venv-hosts/.ready:
	@test -x .venv-hosts/bin/python || $(PYTHON) -m venv .venv-hosts
	.venv-hosts/bin/python -m pip install --quiet --disable-pip-version-check cofmupy==1.0.0
	@touch $@

interop: hosts ## run table 1 in all of them
	$(PY) -m pytest -n 2 --dist loadfile -m interop

lint: $(READY) ## check style, formatting and types
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	$(PY) -m mypy

bench: build ## measure the cost of a step in a C host
	$(PY) -m harness bench

clean: ## remove .venv, dist and every cache
	rm -rf $(VENV) .venv-hosts dist build *.egg-info .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
