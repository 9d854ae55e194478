#!/bin/sh
# SPDX-License-Identifier: MIT
# tools/fuzz.sh SECONDS: runs every fuzz target for so long, two at a time, from the fixtures and
# what earlier runs found. Inputs that break something are left in build/fuzz/TARGET.
set -eu

seconds=$1
run_target() {
  target=$1
  format=$2
  folder=build/fuzz/$target
  mkdir -p "$folder/corpus"
  fixtures=$(find "tests/formats/$format" -type d)
  # shellcheck disable=SC2086 # one word a folder
  if build/sanitize/fuzz/"$target" -max_total_time="$seconds" -max_len=16384 -timeout=10 \
    -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="$folder/" \
    "$folder/corpus" $fixtures >"$folder/log" 2>&1; then
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$folder/log")
    echo "$target: $runs executions in $seconds s, nothing found"
  else
    tail -n 40 "$folder/log" >&2
    return 1
  fi
}

failed=0
run_pair() {
  run_target "$1" "$2" &
  first=$!
  run_target "$3" "$4" &
  second=$!
  wait $first || failed=1
  wait $second || failed=1
}

run_pair bvh_read_fuzz bvh bvh_round_trip_fuzz bvh
run_pair asf_read_fuzz acclaim amc_read_fuzz acclaim
run_pair seq_read_fuzz choreonoid yaml_differential_fuzz choreonoid
run_pair body_read_fuzz body urdf_read_fuzz urdf
run_pair wrl_read_fuzz wrl robovie_read_fuzz robovie
run_pair flow_run_fuzz robovie servo_map_fuzz servo_map
exit $failed
