# The front door. `make demo` and `make test` install what is missing (Debian 12, as root or with sudo), build, and run.
BUILD := build
DEMO := runs/demo
JOBS ?= $(shell nproc)
PYTHON := /usr/bin/python3

.PHONY: help packages build demo test test-long sanitize bench docs clean

help:
	@echo "make demo      a sand slug hits a steel beam: summary and picture (about a minute)"
	@echo "make test      build and run the quick tests"
	@echo "make build     programs in $(BUILD)/bin"
	@echo "make test-long the long tests: convergence, full scenes"
	@echo "make sanitize  quick tests under address and undefined-behaviour sanitizers"
	@echo "make bench     the speed table of bench/README.md"
	@echo "make docs      regenerate the generated pages of docs/"

packages:
	@tools/install-packages build run plot test

build: packages
	@test -f $(BUILD)/build.ninja || cmake --preset release
	@cmake --build --preset release -j $(JOBS)

demo: build
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

sanitize: packages
	@test -f build-sanitize/build.ninja || cmake --preset sanitize
	@cmake --build --preset sanitize -j $(JOBS)
	@ctest --preset sanitize -j $(JOBS)

bench: build
	@$(PYTHON) bench/run --build $(BUILD) $(BENCH_OPTIONS)

docs: build
	@$(BUILD)/bin/grainstep-docs docs/user

clean:
	rm -rf build build-debug build-sanitize
