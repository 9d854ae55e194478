# The front door. Each target installs what it needs, builds what it needs, and does nothing twice.
.DEFAULT_GOAL := help
PREFIX ?= /usr/local
FUZZ_SECONDS ?= 600
TORTURE_SECONDS ?= 3600

# 0: the demo makes no page, and needs nothing for it.
WEB ?= 1

.PHONY: help demo web test bench bench-check install fuzz coverage torture lint format clean

help:
	@echo 'make demo     build kinefile and show what it does on a walk that it makes itself'
	@echo 'make web      build the page that shows motion, build/web/page.html'
	@echo 'make test     build and run all tests; what CI runs'
	@echo 'make bench    measure against named baselines in one run'
	@echo 'make bench-check  compare the instructions that jobs take with a table'
	@echo 'make install  install the command, the library, the man page (PREFIX=$(PREFIX))'
	@echo 'make fuzz     fuzz readers, conversions and command lines (FUZZ_SECONDS=$(FUZZ_SECONDS) each)'
	@echo 'make coverage how much of each reader the inputs of the fuzzers run'
	@echo 'make torture  faults of the machine, one seed after the other (TORTURE_SECONDS=$(TORTURE_SECONDS))'
	@echo 'make lint     clang-tidy over the library and the command'
	@echo 'make format   lay out the code with clang-format'
	@echo 'make clean    remove build/'

demo:
	@tools/setup.sh demo
	@WEB='$(WEB)' tools/web_if_possible.sh
	@tools/build.sh demo kinefile_command make_walk
	@tools/demo.sh build/release build/demo

web:
	@tools/setup.sh web
	@tools/web.sh

test:
	@tools/setup.sh test
	@tools/test.sh

bench:
	@tools/setup.sh bench
	@tools/build.sh bench kinefile_bench kinefile make_walk
	@tools/build.sh plain kinefile
	@build/release/kinefile_bench
	@python3 bench/hardening.py build/release build/plain

bench-check:
	@tools/setup.sh test
	@tools/build.sh demo kinefile_command make_walk
	@python3 bench/instructions.py build/release

install:
	@tools/setup.sh demo
	@tools/build.sh demo
	@tools/install.sh '$(PREFIX)'

fuzz:
	@tools/setup.sh test
	@tools/build.sh fuzz
	@tools/fuzz.sh $(FUZZ_SECONDS)

coverage:
	@tools/setup.sh test
	@tools/coverage.sh

torture:
	@tools/setup.sh test
	@tools/build.sh release
	@tools/torture.sh $(TORTURE_SECONDS)

lint:
	@tools/setup.sh test
	@tools/lint.sh

format:
	@tools/setup.sh test
	@tools/sources.sh . | xargs clang-format-14 -i

clean:
	@rm -rf build
