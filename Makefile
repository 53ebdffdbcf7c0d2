# `make` lists the targets. Everything runs in .venv, which `make` sets up and keeps up to date.
# PYTHON=/path/to/python3.12 make test   uses another interpreter (3.11 or newer).

.DEFAULT_GOAL := help
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DELETE_ON_ERROR:
.ONESHELL:

PYTHON ?=
PY := .venv/bin/python
RUN := .venv/bin/symboslam
# The stamp's name holds the folder's path, so that a copied or moved tree is installed anew.
STAMP := .venv/.installed-$(shell pwd -P | cksum | cut -d ' ' -f 1)
BENCHMARK ?= ../shared/benchmark
UPSTREAM ?= ../shared/upstream
SEED ?= 7
DEMO ?= demo
ARGS ?=

.PHONY: help demo sample test test-slow lint format bench query-page docs knowledge pitfalls results slam-results sim-results picture proofs acceptance system wheel clean

help: ## list the targets
	@grep -E '^[a-z.][a-z.-]*:.*## ' Makefile | sed -E 's/^([a-z.-]+):.*## /\1\t/' | expand -t 14

.venv: $(STAMP) ## set up or update the environment

.venv/.created:
	@scripts/make-venv "$(PYTHON)"

$(STAMP): .venv/.created pyproject.toml constraints.txt service/page/yasgui.sha512
	@echo "Installing SymboSLAM and its tools into .venv (about a minute the first time) ..."
	$(PY) -m pip install --quiet --disable-pip-version-check -c constraints.txt \
	  hatchling setuptools
	$(PY) -m pip install --quiet --disable-pip-version-check -c constraints.txt \
	  --no-build-isolation -e '.[dev]'
	scripts/query-page --if-possible
	rm -f .venv/.installed-*
	touch $@

demo: $(STAMP) ## three simulated robots search and map a small town: figures and a map, about a minute
	@mkdir -p $(DEMO)
	$(RUN) sim run demo --time-limit 2 --seed $(SEED) --out $(DEMO)/map.html \
	  --out $(DEMO)/map.geojson --out $(DEMO)/map.png
	echo "Open in a browser, offline: $$(realpath $(DEMO))/map.html"

sample: $(STAMP) ## make a sample town of landmarks, classify it, write an explained map
	@mkdir -p demo/town
	$(RUN) sample --seed $(SEED) --out demo/town/landmarks.geojson
	$(RUN) classify demo/town/landmarks.geojson --out demo/town/map.geojson \
	  --out demo/town/map.html --out demo/town/map.png
	echo "Open in a browser: $$(pwd)/demo/town/map.html"

test: $(STAMP) ## run the tests (some minutes), but for the proofs
	@$(PY) -m pytest -n 2 --dist loadfile -m "not slow and not network and not proof and not robot"

test-slow: $(STAMP) ## run all tests, the long ones at full length, and the proofs
	@$(PY) -m pytest -m "not network"

lint: $(STAMP) ## ruff, its formatter as a check, and mypy --strict
	@$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	$(PY) -m mypy src/symboslam tests bench scripts

format: $(STAMP) ## mend what ruff can mend
	@$(PY) -m ruff check --fix .
	$(PY) -m ruff format .

bench: $(STAMP) ## measure speed and memory, write bench/RESULTS.md (some minutes)
	@BENCHMARK="$(BENCHMARK)" $(PY) -m bench --out bench/RESULTS.md

slam-results: $(STAMP) ## measure map building, write its part of docs/map-building.md (10 minutes)
	@BENCHMARK="$(BENCHMARK)" $(PY) -m bench --only slam --into docs/map-building.md

sim-results: $(STAMP) ## fly all areas of the paper, write their part of docs/results.md (about an hour; goes on where it was)
	@$(RUN) sim table --record build/sim-table $(ARGS)

query-page: ## fetch YASGUI for the query page (needs npm; `make .venv` does it where it can)
	@scripts/query-page

docs: $(STAMP) ## write docs/cli.md anew, and pages about the ontology into build/docs
	@$(PY) scripts/cli_docs.py
	@$(PY) scripts/glossary.py
	$(PY) scripts/ontology_docs.py

knowledge: $(STAMP) ## reason over the bundled ontology anew
	@$(PY) -m symboslam.reasoning.bundle

pitfalls: $(STAMP) ## scan our ontology for pitfalls, write pitfall_reports/ (and docs/upstream-pitfalls.md)
	@$(PY) scripts/pitfall_reports.py --upstream "$(UPSTREAM)"

results: $(STAMP) ## score against the benchmark in $(BENCHMARK), write docs/results.md
	@$(PY) scripts/results.py --benchmark "$(BENCHMARK)"

picture: sample ## take the picture in the README anew (needs Chromium)
	@scripts/readme-picture

proofs: $(STAMP) ## prove the ontology sound, by reasoners (needs Java; with Maven ROBOT checks it as well)
	@$(PY) -m pytest -n 2 --dist loadfile -m "proof or robot"

acceptance: $(STAMP) ## ask the ontology all questions, write build/acceptance/report.html (needs Java)
	@$(PY) -m robot --outputdir build/acceptance --console dotted competency_questions/acceptance.robot

system: ## install Chromium, Java, Maven and WordNet for the tests that need them (Debian, as root)
	@scripts/install-system

wheel: $(STAMP) ## build wheel and sdist into dist/ and try the wheel in a fresh environment
	@scripts/check-wheel

clean: ## remove .venv and everything built
	@rm -rf .venv build dist demo service/page/built .mypy_cache .pytest_cache .ruff_cache .hypothesis
	find . -name __pycache__ -not -path './.git/*' -type d -prune -exec rm -rf {} +
