# Daily commands; `make help` lists them. Everything that is installed goes into .venv and target.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# Python compiles what it imports; to compile all that is installed takes longer than to install it.
PIP := $(BIN)/python -m pip --disable-pip-version-check install --quiet --no-compile
RESOLVE := $(BIN)/uv pip compile pyproject.toml --universal --python-version 3.11 --generate-hashes \
	--no-header --no-annotate --upgrade --quiet --system-certs

# How the extension module is compiled: `release` as users get it, or `checks` as the checks and the demo do, to have it soon.
PROFILE := release
# The demo and the pictures of the documentation take the module that is there, of whatever profile.
DEMO_PROFILE = $(or $(patsubst $(VENV)/.lumencut-%,%,$(firstword $(wildcard $(VENV)/.lumencut-*))),checks)
# What the extension module is built from: it is rebuilt when one of these is newer than the last build.
RUST_SOURCES := Cargo.toml Cargo.lock pyproject.toml $(wildcard crates/*/Cargo.toml) \
	$(wildcard crates/*/build.rs) $(shell find crates/*/src)

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help demo docs page site test test-long lint format settings types fuzz bench bench-gpu bench-dicom results calibration compare-dicom wheel licences lock clean develop tools toolchain

help: ## List the commands.
	@sed -n 's/^\([a-z-]*\):.*## /  make \1\t/p' $(MAKEFILE_LIST) | expand -t 22

# The page and the package are compiled beside each other. By `--jobs` make would hand its slots down to both, and each would
# compile as if the machine had two cores. Neither waits for the other: the pictures are there as soon as the package is.
demo: toolchain ## Build what is needed and render the demo into ./demo; DEVICE=gpu or cpu says what computes.
	@$(PYTHON) scripts/page.py --if-possible & page=$$!; \
	$(MAKE_COMMAND) --no-print-directory develop PROFILE=$(DEMO_PROFILE) && \
	$(BIN)/lumencut demo $(if $(DEVICE),--device $(DEVICE)) demo; pictures=$$?; \
	if kill -0 $$page 2>/dev/null; then echo "The viewer's page is still being built; \`lumencut view\` needs it."; fi; \
	wait $$page && exit $$pictures

page: toolchain ## Build the viewer's page into the package where its sources changed; needs Node.
	@$(PYTHON) scripts/page.py

site: toolchain ## Write the viewer's page into ./site, for any server of files; needs Node.
	@$(PYTHON) scripts/page.py --site site

docs: toolchain $(VENV)/.docs ## Build the site of the documentation into ./docs-site, its pictures anew.
	@$(MAKE_COMMAND) --no-print-directory develop PROFILE=$(DEMO_PROFILE)
	@$(BIN)/python scripts/docs.py

test: ## Run every check; the last line is `N passed, N failed`.
	@$(PYTHON) scripts/check.py

test-long: develop tools page $(VENV)/.docs ## Run what takes minutes by itself: uncertainties in 288 scenes, containers, the site of the documentation, notebooks, long ways through the viewer, and a million damaged files.
	$(BIN)/python -m pytest --quiet --numprocesses=2 tests/long_calibration.py tests/long_cohort.py tests/long_containers.py tests/long_docs.py tests/long_notebook.py
	npm run check-long --silent --prefix web
	@$(PYTHON) scripts/fuzz.py --runs $(or $(RUNS),1000000)

lint: ## Run only format, lint, types and documentation checks.
	@$(PYTHON) scripts/check.py --lint

format: tools ## Format Rust and Python, and apply the safe fixes of the linter.
	cargo fmt --all
	$(BIN)/ruff check --fix --quiet
	$(BIN)/ruff format --quiet

settings: develop ## Write again what repeats the table of settings: the class and docs/settings.md.
	$(BIN)/python scripts/settings.py

results: ## Write docs/results/speed.md and accuracy.md from the JSON files in benches/results.
	@$(PYTHON) scripts/results.py

types: toolchain ## Write again what repeats the table of questions: the types of the page.
	LUMENCUT_WRITE_TYPES=1 cargo test --quiet --profile checks --package lumencut --lib types_of_the_page

fuzz: toolchain ## Feed the readers of centerlines with made-up files; RUNS=1000000 says how many.
	@$(PYTHON) scripts/fuzz.py $(if $(RUNS),--runs $(RUNS))

bench: develop tools ## Measure this machine, VTK beside it; prints tables, keeps nothing.
	cargo bench --locked --package lumencut-core --bench '*'
	$(BIN)/python benches/another_tree.py
	$(BIN)/python benches/context_vs_vtk.py
	$(BIN)/python benches/cpr_vs_vtk.py
	$(BIN)/python benches/measure.py
	$(BIN)/python benches/trace.py
	$(BIN)/python benches/trace_mask.py
	$(BIN)/python benches/find_vessels.py

calibration: develop ## See whether the uncertainty of measured diameters holds, in 288 scenes; prints a table.
	PYTHONPATH=tests $(BIN)/python tests/calibration.py 24

bench-gpu: toolchain ## Measure the GPU, this machine's CPU beside it; QUICK=--quick for slow ones.
	cargo bench --locked --package lumencut-gpu --bench stages -- $(QUICK)

compare-dicom: develop $(VENV)/.peers ## Have other readers read the DICOM cases too; rewrites the table of docs/dicom.md.
	$(BIN)/python scripts/compare_dicom.py --update docs/dicom.md

bench-dicom: develop tools ## Measure how fast long DICOM series are read, the decoder alone beside it.
	$(BIN)/python benches/read_dicom.py

wheel: page $(VENV)/.wheel ## Build the wheels and the source package into ./dist, and try them out; takes minutes.
	@$(PYTHON) scripts/toolchain.py rust targets
	@$(BIN)/python scripts/wheel.py

licences: toolchain ## Write THIRD-PARTY-LICENSES anew: the licence texts of the linked crates.
	@$(PYTHON) scripts/licences.py

lock: $(VENV)/.python ## Resolve the Python requirements anew into requirements/*.lock.
	$(PIP) uv
	$(RESOLVE) --group build --output-file requirements/runtime.lock
	$(RESOLVE) --group dev --constraints requirements/runtime.lock --output-file requirements/dev.lock
	$(RESOLVE) --group docs --constraints requirements/dev.lock --output-file requirements/docs.lock
	$(RESOLVE) --group peers --constraints requirements/dev.lock --output-file requirements/peers.lock
	$(RESOLVE) --group wheel --constraints requirements/runtime.lock --output-file requirements/wheel.lock

clean: ## Remove everything that the other commands made.
	rm -rf $(VENV) target dist demo docs-site site python/lumencut/viewer/page .pytest_cache .mypy_cache .ruff_cache .hypothesis
	rm -f python/lumencut/_lumencut*.so
	find python tests scripts -name __pycache__ -type d -prune -exec rm -rf {} +

develop: $(VENV)/.lumencut-$(PROFILE) ## Install the package into .venv, rebuilding it when Rust sources changed.

tools: $(VENV)/.dev

toolchain:
	@$(PYTHON) scripts/toolchain.py rust

# The stamps: an empty environment, what the package needs, what its developers need, what links its wheels,
# what makes the site of the documentation, what it is compared with, the package itself.
$(VENV)/.python:
	@$(PYTHON) scripts/toolchain.py python
	$(PYTHON) -m venv $(VENV)
	@touch $@

$(VENV)/.runtime: requirements/runtime.lock $(VENV)/.python
	$(PIP) --require-hashes --requirement $<
	@touch $@

$(VENV)/.dev: requirements/dev.lock $(VENV)/.runtime
	$(PIP) --require-hashes --requirement $<
	@touch $@

$(VENV)/.docs: requirements/docs.lock $(VENV)/.dev
	$(PIP) --require-hashes --requirement $<
	@touch $@

$(VENV)/.wheel: requirements/wheel.lock $(VENV)/.runtime
	$(PIP) --require-hashes --requirement $<
	@touch $@

$(VENV)/.peers: requirements/peers.lock $(VENV)/.runtime
	$(PIP) --require-hashes --requirement $<
	@touch $@

# There is one extension module in .venv, so there is one stamp: that of the profile it was compiled with.
$(VENV)/.lumencut-$(PROFILE): $(RUST_SOURCES) $(VENV)/.runtime | toolchain
	PATH="$(abspath $(BIN)):$$PATH" $(PIP) --no-deps --no-build-isolation \
		--config-settings "maturin.build-args=--profile $(PROFILE)" --editable .
	@rm -f $(VENV)/.lumencut-*
	@touch $@
