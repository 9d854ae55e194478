#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs the Debian packages that are missing, and says which. Does nothing when all are there.
#   tools/setup.sh demo    what building and running the command needs
#   tools/setup.sh web     also what building the page needs
#   tools/setup.sh test    also what the tests, the fuzzers and the browser build need
#   tools/setup.sh bench   also what the benchmarks need
# Before it uses sudo it asks, unless -y follows, or the variable CI is set.
# Where there is no apt-get, or no way to be root, it says what is needed and fails only if a tool is
# not there: CMake finds the libraries, or names the one that it does not find.
set -eu

demo='make cmake ninja-build g++ pkg-config libeigen3-dev libfmt-dev libcli11-dev
  libfast-float-dev libexpected-dev libhwy-dev nlohmann-json3-dev
  zlib1g-dev'
web="$demo emscripten"
bench="$demo libbenchmark-dev libyaml-dev python3"
test="$bench python3-numpy chromium fonts-vlgothic valgrind googletest clang-14 llvm-14 libclang-rt-14-dev clang-format-14 clang-tidy-14
  emscripten"

demo_tools='cmake ninja c++'
demo_libraries='Eigen 3.4, fmt, CLI11, fast_float, tl-expected, Highway, nlohmann-json, zlib'
bench_libraries="$demo_libraries, Google Benchmark, libyaml"
bench_tools="$demo_tools python3"
web_tools="$demo_tools emcc node npm"
test_tools="$web_tools chromium g++ pkg-config clang++-14 clang-format-14 python3"
test_libraries="$bench_libraries, NumPy, GoogleTest's sources in /usr/src/googletest, compiler-rt of clang 14"

case "${1:-}" in
  demo) wanted=$demo tools=$demo_tools libraries=$demo_libraries ;;
  test) wanted=$test tools=$test_tools libraries=$test_libraries ;;
  web) wanted=$web tools=$web_tools libraries=$demo_libraries ;;
  # What only a measurement needs is not for the tests, which compile the rest of them.
  bench) wanted="$bench libassimp-dev" tools=$bench_tools libraries=$bench_libraries ;;
  *) echo "usage: tools/setup.sh demo|web|test|bench" >&2; exit 2 ;;
esac

# Says what is needed, in the words of no distribution; fails if a tool is not there.
go_on_without_installing() {
  absent=''
  for tool in $tools; do
    command -v "$tool" >/dev/null || absent="$absent $tool"
  done
  echo "$1 What is needed:" >&2
  echo "  tools      $tools (CMake 3.25 or later, a C++20 compiler)" >&2
  echo "  libraries  $libraries, with their headers" >&2
  if [ -n "$absent" ]; then
    echo "These tools are missing:$absent" >&2
    exit 1
  fi
  echo "The tools are there; CMake looks for the libraries." >&2
  exit 0
}

for installer in apt-get dpkg-query; do
  command -v "$installer" >/dev/null ||
    go_on_without_installing "There is no $installer here, so nothing is installed."
done

missing=''
for package in $wanted; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
    missing="$missing $package"
done
# A machine may have a Node.js of its own.
case $1 in
  web | test)
    command -v node >/dev/null || missing="$missing nodejs"
    command -v npm >/dev/null || missing="$missing npm"
    ;;
esac
[ -n "$missing" ] || exit 0

as_root=''
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || go_on_without_installing \
    "Debian packages are missing, and installing them needs root or sudo:$missing."
  if [ "${2:-}" != -y ] && [ -z "${CI:-}" ]; then
    [ -t 0 ] || go_on_without_installing \
      "Debian packages are missing; 'tools/setup.sh $1 -y' installs them with sudo:$missing."
    printf 'These Debian packages are missing:%s\nInstall them with sudo? [y/N] ' "$missing"
    read -r answer
    case $answer in
      y* | Y*) ;;
      *) go_on_without_installing "Nothing is installed." ;;
    esac
  fi
  as_root=sudo
fi
echo "Installing with apt-get:$missing"
$as_root env DEBIAN_FRONTEND=noninteractive apt-get update -qq
# shellcheck disable=SC2086 # one word a package
$as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends $missing >/dev/null
