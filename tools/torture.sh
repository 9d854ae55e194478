#!/bin/sh
# SPDX-License-Identifier: MIT
# tools/torture.sh SECONDS: all unit tests on each instruction set and with several numbers of
# threads, and under the thread sanitizer; then the faults of the machine (tests/faults) with one
# seed after the other, for so long.
set -eu

unit_tests() {
  echo "unit tests: $*"
  log=build/torture.log
  env "$@" --gtest_brief=1 >"$log" 2>&1 || {
    tail -n 40 "$log" >&2
    exit 1
  }
}

for target in none ssse3 sse4 avx2; do
  unit_tests KINEFILE_TEST_TARGET=$target build/release/tests/kinefile_tests
done
for threads in 1 2 7; do
  unit_tests KINEFILE_TEST_THREADS=$threads build/release/tests/kinefile_tests
done
tools/build.sh tsan kinefile_tests
unit_tests KINEFILE_TEST_THREADS=7 build/tsan/tests/kinefile_tests

python3 tests/faults/faults_test.py --kinefile build/release/kinefile \
  --inject build/release/tests/libkinefile_inject.so --num-signals 300 --num-truncations 500 \
  --seconds "$1"
