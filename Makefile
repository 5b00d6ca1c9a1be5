# Daily commands; `make help` lists them. Everything is installed into .venv and target.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# --no-compile: compiling everything takes longer than installing it.
PIP := $(BIN)/python -m pip --disable-pip-version-check install --quiet --no-compile
RESOLVE := $(BIN)/uv pip compile pyproject.toml --universal --python-version 3.11 --generate-hashes \
	--no-header --no-annotate --upgrade --quiet --system-certs

# Profile of the extension module: `release` for users, `checks` compiles faster.
PROFILE := release
# The demo and the documentation use the existing module, of any profile.
DEMO_PROFILE = $(or $(patsubst $(VENV)/.lumencut-%,%,$(firstword $(wildcard $(VENV)/.lumencut-*))),checks)
# The extension module is rebuilt when one of these is newer than the last build.
RUST_SOURCES := Cargo.toml Cargo.lock pyproject.toml $(wildcard crates/*/Cargo.toml) \
	$(wildcard crates/*/build.rs) $(shell find crates/*/src)

# The seeds of each fuzz target, and the number of inputs of each.
FUZZED := $(wildcard crates/*/fuzz/seeds/*)
RUNS := 20000

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: $(FUZZED) help demo docs page site test test-long lint format settings results types fuzz bench bench-gpu bench-dicom calibration compare-dicom wheel licences lock clean develop tools toolchain

help: ## List the commands.
	@sed -n 's/^\([a-z-]*\):.*## /  make \1\t/p' $(MAKEFILE_LIST) | expand -t 22

# Page and package are compiled in parallel, 3.5 min on two cores; with `--jobs`, both would take all job slots.
# A lower priority for the page makes it 24 s slower: at its end one core compiles alone.
demo: toolchain ## Build what is needed and render the demo into ./demo; DEVICE=gpu or cpu selects the device.
	@$(PYTHON) scripts/page.py --if-possible & page=$$!; \
	$(MAKE_COMMAND) --no-print-directory develop PROFILE=$(DEMO_PROFILE) && \
	$(BIN)/lumencut demo $(if $(DEVICE),--device $(DEVICE)) demo; pictures=$$?; \
	if kill -0 $$page 2>/dev/null; then echo "The viewer's page is still being built; \`lumencut view\` needs it."; fi; \
	wait $$page && exit $$pictures

page: toolchain ## Build the viewer's page into the package if its sources changed; needs Node.
	@$(PYTHON) scripts/page.py

site: toolchain ## Write the viewer's page into ./site, for a static file server; needs Node.
	@$(PYTHON) scripts/page.py --site site

# Takes 34 s on two cores once MkDocs is installed; needs the CT of the demo.
docs: toolchain $(VENV)/.docs ## Build the documentation site into ./docs-site, including its pictures.
	@$(MAKE_COMMAND) --no-print-directory develop PROFILE=$(DEMO_PROFILE)
	@$(BIN)/python scripts/docs.py

test: ## Run every check; the last line is `N passed, N failed`.
	@$(PYTHON) scripts/check.py

test-long: develop tools page $(VENV)/.docs ## Run the tests that take minutes: uncertainties in 288 scenes, containers, cohorts, the documentation site, notebooks, the viewer, a million damaged files.
	$(BIN)/python -m pytest --quiet --numprocesses=2 tests/long_calibration.py tests/long_cohort.py tests/long_containers.py tests/long_docs.py tests/long_notebook.py
	npm run check-long --silent --prefix web
	@$(PYTHON) scripts/fuzz.py --runs $(or $(RUNS),1000000)

lint: ## Run only the checks of format, lint, types, words and documentation.
	@$(PYTHON) scripts/check.py --lint

format: tools ## Format Rust and Python, and apply the safe fixes of the linter.
	cargo fmt --all
	$(BIN)/ruff check --fix --quiet
	$(BIN)/ruff format --quiet

settings: develop ## Write the files that repeat the table of settings: the class and docs/settings.md.
	$(BIN)/python scripts/settings.py

results: ## Write docs/results/speed.md and accuracy.md from the JSON files in benches/results.
	@$(PYTHON) scripts/results.py

types: toolchain ## Write the files that repeat tables of the facade: types and tables of the page, gestures of the notebook.
	LUMENCUT_WRITE_TYPES=1 cargo test --quiet --profile checks --package lumencut --lib of_the_page
	@test ! -d web/node_modules || npm run notebook --silent --prefix web

fuzz: $(FUZZED) ## Fuzz the readers of centerlines and volumes; RUNS=100000 sets the number of inputs of each format.

# The targets limit memory and time themselves; these limits end a process that hangs on a busy machine.
$(FUZZED): %: | target/fuzz/found
	@mkdir -p target/fuzz/corpus/$(@F)
	@cargo run --quiet --locked --release --config crates/fuzz.toml --manifest-path $(word 1,$(subst /seeds, ,$@))/Cargo.toml \
		--bin $(@F) -- -runs=$(RUNS) -timeout=60 -rss_limit_mb=1024 -max_len=65536 -verbosity=0 -print_final_stats=1 \
		-artifact_prefix=target/fuzz/found/$(@F)- $(addprefix -dict=,$(wildcard $(subst seeds,dictionaries,$@).dict)) \
		target/fuzz/corpus/$(@F) $@

target/fuzz/found:
	@mkdir -p $@

bench: develop tools ## Measure this machine and VTK; prints tables, keeps nothing.
	cargo bench --locked --package lumencut-core --bench '*'
	$(BIN)/python benches/another_tree.py
	$(BIN)/python benches/context_vs_vtk.py
	$(BIN)/python benches/cpr_vs_vtk.py
	$(BIN)/python benches/measure.py
	$(BIN)/python benches/trace.py
	$(BIN)/python benches/trace_mask.py
	$(BIN)/python benches/find_vessels.py

calibration: develop ## Check the uncertainty of measured diameters in 288 scenes; prints a table.
	PYTHONPATH=tests $(BIN)/python tests/calibration.py 24

bench-gpu: toolchain ## Measure GPU and CPU of this machine; QUICK=--quick for slow ones.
	cargo bench --locked --package lumencut-gpu --bench stages -- $(QUICK)

compare-dicom: develop $(VENV)/.peers ## Read the DICOM cases with other readers too; rewrites the table of docs/clinic.md.
	$(BIN)/python scripts/compare_dicom.py --update docs/clinic.md

bench-dicom: develop tools ## Measure the reading of long DICOM series and of the decoder alone.
	$(BIN)/python benches/read_dicom.py

wheel: page $(VENV)/.wheel ## Build the wheels and the source package into ./dist, and try them; takes minutes.
	@$(PYTHON) scripts/toolchain.py rust targets
	@$(BIN)/python scripts/wheel.py

licences: toolchain ## Write THIRD-PARTY-LICENSES: the licence texts of the linked crates.
	@$(PYTHON) scripts/licences.py

lock: $(VENV)/.python ## Resolve the Python requirements again into requirements/*.lock.
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

# Stamps of installed sets: empty environment, package requirements, developer tools, documentation, wheels, other DICOM readers.
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

# .venv holds one extension module, so there is one stamp, named after its profile.
$(VENV)/.lumencut-$(PROFILE): $(RUST_SOURCES) $(VENV)/.runtime | toolchain
	PATH="$(abspath $(BIN)):$$PATH" $(PIP) --no-deps --no-build-isolation \
		--config-settings "maturin.build-args=--profile $(PROFILE)" --editable .
	@rm -f $(VENV)/.lumencut-*
	@touch $@
