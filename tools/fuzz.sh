#!/bin/sh
# SPDX-License-Identifier: MIT
# tools/fuzz.sh SECONDS: runs every fuzz target for so long, two at a time, from the fixtures and
# what earlier runs found, and then random command lines. Inputs that break something are left in
# build/fuzz/TARGET. Where KINEFILE_TEST_DATA names a folder, mutants are made of its files, too.
# FUZZ_TARGETS names single ones. 0 seconds run what is there, and look for nothing new.
set -eu

# Each line: a target, the folders that its inputs are made from, its dictionary.
targets='
journey_fuzz         build/fuzz/journey_fuzz/seeds,fuzz/found  all
bvh_read_fuzz        tests/formats/bvh         bvh
bvh_round_trip_fuzz  tests/formats/bvh         bvh
asf_read_fuzz        tests/formats/acclaim     asf
amc_read_fuzz        tests/formats/acclaim     amc
seq_read_fuzz        tests/formats/choreonoid  seq
yaml_differential_fuzz  tests/formats/choreonoid  seq
body_read_fuzz       tests/formats/body        body
urdf_read_fuzz       tests/formats/urdf        urdf
wrl_read_fuzz        tests/formats/wrl         wrl
table_read_fuzz      tests/formats/csv         csv
robovie_read_fuzz    tests/formats/robovie     robovie
flow_run_fuzz        tests/formats/robovie     robovie
servo_map_fuzz       tests/formats/servo_map   seq
command_lines        -                         -
'

run_fuzzer() {
  folder=build/fuzz/$1
  program=${FUZZ_BUILD:-build/sanitize}/fuzz/$1
  mkdir -p "$folder/corpus"
  words=$folder/words.dict
  if [ "$3" = all ]; then
    cat fuzz/dictionaries/*.dict >"$words"
  else
    cp "fuzz/dictionaries/$3.dict" "$words"
  fi
  limit=-max_total_time=$seconds
  [ "$seconds" != 0 ] || limit=-runs=0
  # shellcheck disable=SC2046 # one word a folder
  if "$program" "$limit" -max_len=16384 -timeout=10 \
    -rss_limit_mb=2048 -print_final_stats=1 -dict="$words" -artifact_prefix="$folder/" \
    "$folder/corpus" $(find $(echo "$2" | tr ',' ' ') -type d) >"$program.log" 2>&1; then
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$program.log")
    echo "$1: $runs executions in $seconds s, nothing found"
    sed -n '/^journey: /p' "$program.log"
  else
    tail -n 40 "$program.log" >&2
    return 1
  fi
}

seconds=$1
shift
if [ $# -eq 0 ]; then
  rm -rf build/fuzz/journey_fuzz/seeds
  python3 fuzz/make_seeds.py build/fuzz/journey_fuzz/seeds >/dev/null
  echo "$targets" | grep -E "^(${FUZZ_TARGETS:-[a-z_]*}) " | xargs -P 2 -L 1 "$0" "$seconds"
elif [ "$1" = command_lines ]; then
  [ "$seconds" = 0 ] ||
    python3 fuzz/command_lines.py --kinefile build/sanitize/kinefile --seconds "$seconds" --jobs 1
else
  run_fuzzer "$@"
fi
