# Shortcuts; each works alone on a fresh machine. The recipes themselves are CMakePresets.json and tools/.
.PHONY: help setup build demo test bench lint format fuzz clean

help:
	@echo "make setup   install what is missing: Debian packages, .venv with the landfall package"
	@echo "make build   setup, then the library and its tests (preset dev)"
	@echo "make demo    a drawn building relocalized from nothing: .venv/bin/landfall demo"
	@echo "make test    all tests, C++ and Python; real data where there is some (LANDFALL_DATA)"
	@echo "make bench   benchmarks (preset bench); results under build/bench/results"
	@echo "make lint    clang-format, clang-tidy, ruff, mypy, structure rules"
	@echo "make format  lay out every source file: clang-format, ruff"
	@echo "make fuzz    every fuzzer for a minute (preset fuzz)"
	@echo "make clean   remove build/"

setup:
	@tools/setup

build: setup
	@cmake --preset dev
	@cmake --build --preset dev

demo: setup
	@.venv/bin/landfall demo

test: build
	@tools/test

bench:
	@tools/setup --bench
	@cmake --workflow --preset bench
	@tools/bench

lint: setup
	@tools/lint

format: setup
	@tools/format

fuzz: setup
	@cmake --workflow --preset fuzz
	@tests/fuzz/run 60

clean:
	@rm -rf build
