#!/bin/sh
# SPDX-License-Identifier: MIT
# tools/torture.sh SECONDS: the faults of the machine (tests/faults) with one seed after the other.
set -eu

python3 tests/faults/faults_test.py --kinefile build/release/kinefile \
  --inject build/release/tests/libkinefile_inject.so --num-signals 300 --num-truncations 500 \
  --seconds "$1"
