#!/bin/sh
# SPDX-License-Identifier: MIT
# tools/build.sh PRESET [TARGET...]: configures where that was not done, and builds. Quiet unless
# something fails.
set -eu

preset=$1
shift
log=build/$preset.log
mkdir -p build
targets=''
[ $# -eq 0 ] || targets="--target $*"
echo "Building ($preset); the log is $log"
# shellcheck disable=SC2086 # one word a target
if ! { cmake --preset "$preset" && cmake --build --preset "$preset" $targets; } >"$log" 2>&1; then
  tail -n 60 "$log" >&2
  exit 1
fi
