SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.NOTPARALLEL:
.PHONY: help demo quick test kill browser verify bench setup

# Mesa complains where there is no desktop; tests that need an adapter must not pass without one.
export XDG_RUNTIME_DIR ?= /tmp
test: export LITHOSPH_NEED_GPU = 1

help: ## Say what there is to make
	@sed -n 's/^\([a-z]*\):.*## /make \1|/p' Makefile | column -t -s '|' 2>/dev/null || sed -n 's/^\([a-z]*\):.*## /make \1: /p' Makefile

demo: ## Build, let two rubber rings collide, and say where the pictures are
	@.ci/setup build
	cargo build --release
	cargo run --release --quiet -- run scenes/colliding_rings.toml --force
	@echo "Pictures: out/colliding_rings/frames/*.png; for ParaView: out/colliding_rings/particles.vtkhdf"

# Parts of names in tests/ that take seconds.
FAST := cli:: contact::list conservation::no_particle material::laws material::maxwell mirror:: observable:: obstacle:: \
    pass:: shaders:: step::eulerian step::lagrangian

quick: ## While working: format, lints, unit tests, fast tests. Leaves out runs of scenes, studies, atlas, parity, and builds without HDF5
	@.ci/setup build
	cargo fmt --check
	cargo clippy --all-targets --quiet -- -D warnings
	cargo test --quiet --lib
	cargo test --quiet --test tests -- $(FAST)
	cargo test --quiet --test scenes -- reads_with_each_variant

test: ## Format, lints, all tests, and VTK's reader on what a run wrote
	@.ci/setup test
	cargo fmt --check
	cargo clippy --release --all-targets --quiet -- -D warnings
	cargo clippy --release --all-targets --quiet --no-default-features -- -D warnings
	@# Without HDF5 the program still has to run, not only to compile.
	cargo test --release --no-default-features --test tests cli:: 2>&1 | tee target/test-without-hdf5.log
	@status=0; cargo test --release --all-features --no-fail-fast 2>&1 | tee target/test.log || status=$$?; \
	cargo run --release --quiet -- run scenes/colliding_rings.toml --backend cpu --set duration=100 --out target/vtk --force --quiet \
	    && target/python/bin/python tests/vtk_reads_output.py target/vtk/particles.vtkhdf || status=1; \
	grep -h '^test .* FAILED$$' target/test.log || true; \
	awk '/^test result:/ { passed += $$4; failed += $$6 } END { print passed + 0 " passed, " failed + 0 " failed" }' \
	    target/test-without-hdf5.log target/test.log; \
	exit $$status

kill: ## Kill small runs at every system call, fail every write, and compare what is resumed with unbroken runs
	@.ci/setup kill
	cargo build --release
	python3 tests/killed_at_every_call.py target/release/lithosph --scene line
	python3 tests/killed_at_every_call.py target/release/lithosph --scene plane
	python3 tests/killed_at_every_call.py target/release/lithosph --scene solid
	python3 tests/killed_at_every_call.py target/release/lithosph --scene plane --resumed
	python3 tests/killed_at_every_call.py target/release/lithosph --scene plane --backend gpu --every 10

browser: ## Make a report of each kind, small, and look at it in headless Chromium at two widths
	@.ci/setup browser
	cargo build --release
	@rm -rf target/browser
	cargo run --release --quiet -- study accuracy scenes/sheared_plate.toml --vary time.cfl=0.2,0.4 --out target/browser/accuracy.csv
	cargo run --release --quiet -- study stability scenes/tension_square.toml --simulate 4 --out target/browser/stability.csv
	cargo run --release --quiet -- study atlas tensile_instability contact_zones --out target/browser/atlas
	cargo run --release --quiet -- study tensile partition edge --out target/browser/tensile
	cargo run --release --quiet -- study ablate scenes/sheared_plate.toml --out target/browser/ablate.csv
	cargo run --release --quiet -- study cost scenes/rod_impact.toml --out target/browser/cost.csv --force
	python3 tests/report_in_browser.py $$(find target/browser -name '*.html' | sort)

# Seconds after which a slow variant is given up and stands in the table as not run.
WITHIN ?= 7200
verify: ## Run every scene and variant, write docs/verification.txt; goes on where it was stopped. SLOW=no: only what takes seconds
	@.ci/setup build
	cargo build --release
	@mkdir -p docs target; status=0; \
	cargo run --release --quiet -- check scenes/*.toml --backend cpu --quiet --within $(WITHIN) --record target/verify.jsonl \
	    $(if $(filter no,$(SLOW)),--ci) >target/verification.txt || status=$$?; \
	[ $$status -le 1 ] || exit $$status; \
	{ echo "$$(date -u +%F), commit $$(git describe --always --dirty), CPU path in f64. * marks what takes longer than seconds;"; \
	  echo "CONTRIBUTING.md says what pass, failure, shortfall and pinned mean."; echo; cat target/verification.txt; } \
	    >docs/verification.txt.part; \
	mv docs/verification.txt.part docs/verification.txt; cat docs/verification.txt; exit $$status

bench: ## Time each pass of a step on this machine
	@.ci/setup build
	cargo bench --bench passes

setup:
	@.ci/setup test
