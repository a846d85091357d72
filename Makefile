# The front door. `make demo` and `make test` install what is missing (Debian 12, as root or with sudo), build, and run.
BUILD := build
DEMO := runs/demo
JOBS ?= $(shell nproc)
PYTHON := /usr/bin/python3

.PHONY: help packages configured build demo demo-programs test test-long verify sanitize fuzz soak drill golden bench \
  bench-plates accuracy figures docs containers clean

help:
	@echo "make demo      a sand slug hits a steel beam: summary and picture (about a minute)"
	@echo "make test      build and run the quick tests"
	@echo "make build     programs in $(BUILD)/bin"
	@echo "make test-long the long tests: convergence, full scenes"
	@echo "make verify    closed forms, orders and benchmarks: writes docs/verification.md and its pages (under 30 minutes)"
	@echo "make sanitize  quick tests under address and undefined-behaviour sanitizers"
	@echo "make soak      runs that are killed, stopped, out of space, and go on (SOAK_OPTIONS='--trials 1000')"
	@echo "make fuzz      lies to both sides of the protocol under sanitizers, with libFuzzer (FUZZ_RUNS=20000)"
	@echo "make drill     faults put into a copy of the sources: which tests see them (docs/drill.md, about an hour)"
	@echo "make golden    do short runs of every kind still give the bits of this results version"
	@echo "make bench     the speed table of bench/README.md"
	@echo "make bench-plates  the same for slugs of spheres, two MPI ranks included"
	@echo "make accuracy  speed against error again, with quiet timings: docs/accuracy.md and what check recommends (half an hour)"
	@echo "make figures   the paper's figures again: docs/benchmarks (half an hour; finished runs are kept)"
	@echo "make docs      regenerate the generated pages of docs/"
	@echo "make containers  images, and runs in three containers compared with local ones (as root, without Docker)"

packages:
	@tools/install-packages build run plot test

configured: packages
	@test -f $(BUILD)/build.ninja || cmake --preset release

build: configured
	@cmake --build --preset release -j $(JOBS)

# The three programs of a run are half of all build steps; what only tests use is neither built nor installed.
demo-programs:
	@tools/install-packages build run plot
	@test -f $(BUILD)/build.ninja || { echo "configuring in $(BUILD)/" && mkdir -p $(BUILD) && \
	  { cmake --preset release >$(BUILD)/configure.log 2>&1 || { cat $(BUILD)/configure.log; exit 1; }; }; }
	@echo "building grainstep, grainstep-dem and grainstep-fe, $(JOBS) at a time: minutes the first time, seconds later"
	@cmake --build --preset release -j $(JOBS) --target grainstep grainstep-dem grainstep-fe

demo: demo-programs
	@$(MAKE) --no-print-directory $(DEMO)/pictures/history.png
	@$(BUILD)/bin/grainstep show $(DEMO)
	@echo "pictures: $(DEMO)/pictures/history.png $(DEMO)/pictures/snapshots.png"

# Only rebuilt when the scene has changed: a finished run is not computed twice.
$(DEMO)/summary.json: configs/small/beam-monolithic.yaml configs/liu2013/beam-monolithic.yaml
	@$(BUILD)/bin/grainstep run configs/small/beam-monolithic.yaml --out $(DEMO) --force

$(DEMO)/pictures/history.png: $(DEMO)/summary.json tools/plot
	@$(PYTHON) tools/plot $(DEMO)

test: build
	@ctest --preset release -j $(JOBS)

test-long: build
	@ctest --test-dir $(BUILD) -L long --output-on-failure -j 1

# The page is written whatever the tests say: it shows what failed or did not run, and its exit code counts.
VERIFICATION := $(abspath $(BUILD))/verification
verify: build
	@rm -rf $(VERIFICATION)
	@mkdir -p $(VERIFICATION)
	@GRAINSTEP_VERIFICATION_DIR=$(VERIFICATION) ctest --test-dir $(BUILD) -L verify -j $(JOBS) --output-on-failure \
	  --output-junit $(VERIFICATION)/ctest.xml || true
	@$(PYTHON) tools/verification-page --build $(BUILD)

sanitize: packages
	@test -f build-sanitize/build.ninja || cmake --preset sanitize
	@cmake --build --preset sanitize -j $(JOBS)
	@ctest --preset sanitize -j $(JOBS)

# FUZZ_RUNS: scripts for each target, times its share. FUZZ_OPTIONS='--page tests/fuzz/README.md' writes what was done into
# the page, --keep adds to the corpus, --only NAME runs one target (tests/fuzz/README.md).
FUZZ_RUNS ?= 20000
FUZZ_TARGETS := $(addprefix fuzz-,frame checks session recorder participant structure impactor grains)
fuzz:
	@tools/install-packages build fuzz
	@test -f build-fuzz/build.ninja || cmake --preset fuzz
	@cmake --build --preset fuzz -j $(JOBS) --target $(FUZZ_TARGETS)
	@$(PYTHON) tools/fuzz --runs $(FUZZ_RUNS) $(FUZZ_OPTIONS)

# Runs that are hit by faults and must go on (docs/reliability.md). SOAK_OPTIONS='--trials 1000 --page docs/reliability.md'.
soak: build
	@$(PYTHON) tools/soak --build $(BUILD) $(SOAK_OPTIONS)

# DRILL_OPTIONS=--only NAME tries one fault, --list shows them all, --keep keeps the scratch copy and its build.
drill: packages
	@$(PYTHON) tools/drill $(DRILL_OPTIONS)

golden: build
	@$(PYTHON) tools/golden --build $(BUILD)

bench: build
	@$(PYTHON) bench/run --build $(BUILD) $(BENCH_OPTIONS)
	@$(PYTHON) bench/engines --build $(BUILD) $(BENCH_OPTIONS)

bench-plates: build
	@$(PYTHON) bench/plates --build $(BUILD)

# One run at a time, so that wall times are those of a run alone. ACCURACY_OPTIONS=--long adds the paper's resolution;
# ACCURACY_REPEAT= keeps finished runs and their times.
ACCURACY := runs/studies/speed-error
ACCURACY_REPEAT ?= --repeat
accuracy: build
	@$(BUILD)/bin/grainstep study configs/studies/speed-error.yaml --out $(ACCURACY) --jobs 1 $(ACCURACY_REPEAT) $(ACCURACY_OPTIONS) \
	  --page docs/accuracy.md
	@cp $(ACCURACY)/series.csv orchestrator/command/fidelity.csv

# The paper's figures. A statement that does not hold (exit code 3) is a result; anything else stops.
FIGURES := fig04 fig05 fig06 fig07 fig08 fig09 fig10 fig11 fig12 fig13 fig14 fig17a fig17b fig18 figA1 figA2 contact
figures: build
	@mkdir -p runs/studies
	@for figure in $(FIGURES); do \
	  $(BUILD)/bin/grainstep study configs/studies/liu2013-$$figure.yaml --reuse runs/studies $(FIGURES_OPTIONS) \
	    --page docs/benchmarks/$$figure.md || [ $$? -eq 3 ] || exit 1; \
	done

docs: build
	@$(BUILD)/bin/grainstep-docs docs/user

containers:
	@$(PYTHON) tools/containers --local $(BUILD)/bin

clean:
	rm -rf build build-debug build-sanitize
