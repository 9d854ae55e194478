#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs the Debian packages that are missing, and says which. Does nothing when all are there.
#   tools/setup.sh demo    what building and running the command needs
#   tools/setup.sh test    also what the tests, the fuzzers and the browser build need
#   tools/setup.sh bench   also what the benchmarks need
set -eu

demo='make cmake ninja-build g++ pkg-config libeigen3-dev libfmt-dev libcli11-dev
  libfast-float-dev libexpected-dev libhwy-dev libtinyxml2-dev nlohmann-json3-dev'
bench="$demo libbenchmark-dev libyaml-dev"
test="$bench googletest clang-14 libclang-rt-14-dev clang-format-14 clang-tidy-14
  emscripten python3"

case "${1:-}" in
  demo) wanted=$demo ;;
  test) wanted=$test ;;
  bench) wanted=$bench ;;
  *) echo "usage: tools/setup.sh demo|test|bench" >&2; exit 2 ;;
esac

missing=''
for package in $wanted; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
    missing="$missing $package"
done
# The tests need some Node.js to run the browser build; a machine may have one of its own.
if [ "$1" = test ] && ! command -v node >/dev/null; then missing="$missing nodejs"; fi
[ -n "$missing" ] || exit 0

as_root=''
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || {
    echo "These packages are missing, and installing them needs root or sudo:$missing" >&2
    exit 1
  }
  as_root=sudo
fi
echo "Installing with apt-get:$missing"
$as_root env DEBIAN_FRONTEND=noninteractive apt-get update -qq
# shellcheck disable=SC2086 # one word a package
$as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends $missing >/dev/null
