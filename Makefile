# Daily commands; CONTRIBUTING.md lists the plain ones too. Everything is installed into .venv and target.

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
.PHONY: help demo develop page docs test test-long platforms lint format generate fuzz wheel lock tools rust $(FUZZED)

help: ## List the commands.
	@sed -n 's/^\([a-z-]*\):.*## /  make \1\t/p' $(MAKEFILE_LIST) | expand -t 20

# Page and package are compiled in parallel, 3.5 min on two cores; with `--jobs`, both would take all job slots.
# A lower priority for the page makes it 24 s slower: at its end one core compiles alone.
demo: rust ## Build what is needed and render the demo into ./demo; DEVICE=gpu or cpu selects the device.
	@$(PYTHON) scripts/page.py --if-possible & page=$$!; \
	$(MAKE_COMMAND) --no-print-directory develop PROFILE=$(DEMO_PROFILE) && \
	$(BIN)/lumencut demo $(if $(DEVICE),--device $(DEVICE)) demo; pictures=$$?; \
	if kill -0 $$page 2>/dev/null; then echo "The viewer's page is still being built; \`lumencut view\` needs it."; fi; \
	wait $$page && exit $$pictures

develop: $(VENV)/.lumencut-$(PROFILE) ## Install the package into .venv, rebuilding it when Rust sources changed.

page: rust ## Build the viewer's page into the package if its sources changed; needs Node.
	@$(PYTHON) scripts/page.py

# Takes 34 s on two cores once MkDocs is installed; needs the CT of the demo.
docs: $(VENV)/.docs ## Build the documentation site into ./docs-site, including its pictures.
	@$(MAKE_COMMAND) --no-print-directory develop PROFILE=$(DEMO_PROFILE)
	@NO_MKDOCS_2_WARNING=true $(BIN)/mkdocs build --strict --quiet

test: ## Run every check; the last line is `N passed, N failed`.
	@$(PYTHON) scripts/check.py

test-long: develop tools page platforms $(VENV)/.docs ## Run the tests that take minutes, and fuzz with a million inputs.
	$(BIN)/python -m pytest --quiet --numprocesses=2 --dist=worksteal tests/long_*.py
	$(BIN)/python -m pytest --quiet --numprocesses=2 --dist=worksteal --wide -m each_value
	LUMENCUT_FUZZ_EXAMPLES=10 $(BIN)/python -m pytest --quiet --numprocesses=2 --dist=worksteal tests/test_*_fuzz.py
	npm run check-long --silent --prefix web
	$(MAKE_COMMAND) --no-print-directory --jobs=2 fuzz RUNS=70000

# The page covers browsers. macOS covers ARM, as no code is specific to ARM under Linux. The extension module needs the
# Python of its target.
platforms: rust ## Compile everything but the extension module for Windows and macOS.
	@$(PYTHON) scripts/toolchain.py targets
	cargo check --quiet --locked --profile checks --workspace --exclude lumencut-python \
		--target x86_64-pc-windows-gnu --target aarch64-apple-darwin

lint: ## Run only the checks of format, lint, types, words and documentation.
	@$(PYTHON) scripts/check.py --lint

format: tools ## Format Rust, Python and the page, and apply the safe fixes of the linters.
	cargo fmt --all
	$(BIN)/ruff check --fix --quiet
	$(BIN)/ruff format --quiet
	@test ! -d web/node_modules || npm run format --silent --prefix web

generate: develop ## Write the files that repeat tables: settings, types of the page, results, gestures, licences.
	$(BIN)/python scripts/settings.py
	LUMENCUT_WRITE_TYPES=1 cargo test --quiet --profile checks --package lumencut --lib of_the_page
	$(PYTHON) benches/result_pages.py
	$(PYTHON) scripts/licences.py
	@test ! -d web/node_modules || npm run notebook --silent --prefix web

fuzz: $(FUZZED) ## Fuzz the readers of centerlines and volumes; RUNS=100000 sets the number of inputs of each format.

# The targets limit memory and time themselves; these limits end a process that hangs on a busy machine.
$(FUZZED): CRATE = $(word 1,$(subst /seeds, ,$@))
$(FUZZED):
	@mkdir -p target/fuzz/found target/fuzz/corpus/$(@F)
	@cargo run --quiet --locked --release --config crates/fuzz.toml --manifest-path $(CRATE)/Cargo.toml --bin $(@F) -- \
		-runs=$(RUNS) -timeout=60 -rss_limit_mb=1024 -max_len=65536 -print_final_stats=1 \
		-artifact_prefix=target/fuzz/found/$(@F)- $(addprefix -dict=,$(wildcard $(CRATE)/dictionaries/$(@F).dict)) \
		target/fuzz/corpus/$(@F) $@ > target/fuzz/$(@F).log 2>&1 || { tail -n 40 target/fuzz/$(@F).log; exit 1; }
	@echo "$(@F): `sed -n 's/.*executed_units: *//p' target/fuzz/$(@F).log` inputs"

wheel: page $(VENV)/.wheel ## Build the wheels and the source package into ./dist, and try them; takes minutes.
	@$(PYTHON) scripts/toolchain.py targets
	@$(BIN)/python scripts/wheel.py

lock: $(VENV)/.python ## Resolve the Python requirements again into requirements/*.lock.
	$(PIP) uv
	$(RESOLVE) --group build --output-file requirements/runtime.lock
	$(RESOLVE) --group dev --constraints requirements/runtime.lock --output-file requirements/dev.lock
	$(RESOLVE) --group docs --constraints requirements/dev.lock --output-file requirements/docs.lock
	$(RESOLVE) --group peers --constraints requirements/dev.lock --output-file requirements/peers.lock
	$(RESOLVE) --group wheel --constraints requirements/runtime.lock --output-file requirements/wheel.lock

tools: $(VENV)/.dev

rust:
	@$(PYTHON) scripts/toolchain.py rust

# Stamps of installed sets: empty environment, package requirements, developer tools, documentation, wheels.
$(VENV)/.python:
	$(PYTHON) -m venv $(VENV)
	@touch $@

$(VENV)/.runtime: requirements/runtime.lock $(VENV)/.python
$(VENV)/.dev: requirements/dev.lock $(VENV)/.runtime
$(VENV)/.docs: requirements/docs.lock $(VENV)/.dev
$(VENV)/.wheel: requirements/wheel.lock $(VENV)/.runtime
$(VENV)/.runtime $(VENV)/.dev $(VENV)/.docs $(VENV)/.wheel:
	$(PIP) --require-hashes --requirement $<
	@touch $@

# .venv holds one extension module, so there is one stamp, named after its profile.
$(VENV)/.lumencut-$(PROFILE): $(RUST_SOURCES) $(VENV)/.runtime | rust
	PATH="$(abspath $(BIN)):$$PATH" $(PIP) --no-deps --no-build-isolation \
		--config-settings "maturin.build-args=--profile $(PROFILE)" --editable .
	@rm -f $(VENV)/.lumencut-*
	@touch $@
