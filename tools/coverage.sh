#!/bin/sh
# SPDX-License-Identifier: MIT
# tools/coverage.sh: how much of each reader and writer the inputs of the fuzz targets run: those of
# the repository, and what `make fuzz` found before. Its build is one of its own (build/coverage).
set -eu

targets=$(sed -n 's/^\([a-z_]*_fuzz\) .*/\1/p' tools/fuzz.sh)
# shellcheck disable=SC2086 # one word a target
tools/build.sh coverage $targets
rm -rf build/coverage/profiles
FUZZ_BUILD=build/coverage LLVM_PROFILE_FILE="$PWD/build/coverage/profiles/%p.profraw" \
  tools/fuzz.sh 0 >build/coverage/log
llvm-profdata-14 merge -sparse -o build/coverage/all.profdata build/coverage/profiles/*.profraw
objects=''
for target in $targets; do objects="$objects -object build/coverage/fuzz/$target"; done
# shellcheck disable=SC2086 # two words a target
llvm-cov-14 export -summary-only -instr-profile build/coverage/all.profdata $objects |
  python3 tools/coverage_table.py
