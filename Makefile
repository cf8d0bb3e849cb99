# `make demo` shows what it does, `make test` shows that it can be believed. Needs Python 3.11 to 3.13 and nothing else.
SHELL := bash
.SHELLFLAGS := -euo pipefail -c
MAKEFLAGS += --no-print-directory
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.NOTPARALLEL:

PYTHON ?= python3.11 python3.12 python3.13 python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip -qq --disable-pip-version-check --no-input
BASE := $(VENV)/base.done
DEV := $(VENV)/dev.done
PAPER := reports/paper
export PATH := $(CURDIR)/$(BIN):$(PATH)
unexport PYTHONPATH PYTHONHOME

.PHONY: help demo test check lint docs dist bench proofs reports debian lock clean

help:  ## this list
	@sed -nE 's/^([a-z]+):.*## (.*)/  make \1\t\2/p' Makefile | expand -t 16

demo: $(BASE)  ## the paper's design: decided, certified, checked, reported (reports/paper)
	@mkdir -p $(PAPER)
	@verify-design prove examples/paper.toml -o $(PAPER)/certificate.json
	@verify-design check $(PAPER)/certificate.json --design examples/paper.toml
	@verify-design report examples/paper.toml -o $(PAPER)

test: debian lint docs  ## everything: lint, types, contracts, documentation, all tests, proofs
	pytest -n 2 --dist worksteal
	@$(MAKE) proofs

check: lint  ## the quick part of it, below three minutes
	pytest -n 2 --dist worksteal -m "not slow"

lint: $(DEV)  ## format, lint, strict types, import contracts
	ruff format --check .
	ruff check .
	mypy
	lint-imports --no-logo

docs: $(DEV)  ## the documentation site, into site/; a warning is an error
	@NO_MKDOCS_2_WARNING=1 mkdocs build --strict  # not --quiet: it would not count warnings

dist: $(BASE)  ## wheel, sdist and bill of materials, into dist/; the same sources give the same bytes
	@rm -rf dist
	@python -m hatchling build
	@python -m tools.sbom dist/*.whl

bench: $(VENV)/bench.done  ## speed and memory as ratios, side by side in one run
	python -m benchmarks

proofs:  ## compile the Coq proofs and check their axioms
	@if [ ! -f proofs/Makefile ]; then echo "left out: proofs (there is no proofs/Makefile)"; \
	elif ! command -v coqc >/dev/null; then echo "left out: proofs (coqc is missing)"; \
	else $(MAKE) -j 2 -C proofs all check assumptions; fi

reports: $(BASE)  ## regenerate the committed reports
	@for name in paper repaired; do verify-design report examples/$$name.toml -o reports/$$name; done

debian:  # Coq, LaTeX and Chromium, where they are missing and can be installed
	@tools/debian.sh

lock:  ## resolve requirements/*.txt anew (needs uv)
	@tools/lock.sh

clean:  ## remove what make made (not reports/)
	rm -rf $(VENV) build dist site htmlcov .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis .coverage*
	find fomas_verify tests benchmarks examples -name __pycache__ -type d -prune -exec rm -rf {} + 2>/dev/null || true
	@if [ -f proofs/Makefile ]; then $(MAKE) -C proofs clean; fi

$(BIN)/python:
	@for python in $(PYTHON); do \
	    if $$python -c 'import sys, venv, ensurepip; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 13))' 2>/dev/null; \
	    then echo "making $(VENV) with $$($$python --version)"; rm -rf $(VENV); exec $$python -m venv $(VENV); fi; \
	done; \
	echo "no Python 3.11 to 3.13 with venv among: $(PYTHON) (name one: make PYTHON=/path/to/python3)" >&2; exit 2

# The package is installed as a link to this folder, with what the lock files pin and nothing else.
define install
	@echo "installing requirements/$(1).txt"
	@$(PIP) install --require-hashes --no-deps --requirement requirements/$(1).txt
	@$(PIP) install --no-deps --no-build-isolation --editable .
	@touch $@
endef

$(BASE): requirements/base.txt pyproject.toml | $(BIN)/python
	$(call install,base)

# fodeint is released as source only: it is built here, by the locked setuptools, and its tests are left out where that fails.
$(DEV): requirements/dev.txt requirements/peers.txt $(BASE)
	$(call install,dev)
	@$(PIP) install --require-hashes --no-deps --no-build-isolation --requirement requirements/peers.txt 2>/dev/null \
	    || echo "left out: comparison with fodeint (its source could not be had or built)"

$(VENV)/guided.done: requirements/guided.txt $(DEV)
	@$(PIP) install --require-hashes --no-deps --requirement requirements/guided.txt
	@touch $@

$(VENV)/bench.done: requirements/bench.txt $(DEV)
	$(call install,bench)
