#!/bin/sh
# SPDX-License-Identifier: MIT
# tools/check_includes.sh [FILE...]: compiles every public header, and every source file of the library,
# the command and the page's core, alone and without making code. The builds compile a layer as one unit, where a file
# sees what those before it included: only here an include that is missing is found.
set -eu

flags="-std=c++20 -w -Iinclude -Isrc -Iwasm -DFMT_HEADER_ONLY -DEIGEN_MPL2_ONLY \
  $(pkg-config --cflags eigen3)"
out=build/includes
mkdir -p "$out"

# Most of the time goes into Eigen, which all but the lowest layers see through kinefile/math.hpp.
printf '#include <Eigen/Core>\n#include <Eigen/Geometry>\n' >"$out/eigen.hpp"
# shellcheck disable=SC2086 # one word a flag
clang++-14 $flags -fpch-instantiate-templates -x c++-header "$out/eigen.hpp" -o "$out/eigen.pch"

# shellcheck disable=SC2046 # no name has blanks
[ $# -gt 0 ] || set -- $(tools/sources.sh include src cli wasm | grep -E '^include/|\.cpp$')

# The shared library exports what public headers declare, where they say so.
for header in include/kinefile/*.hpp; do
  grep -q '^namespace kinefile' "$header" || continue
  grep -qx '#pragma GCC visibility push(default)' "$header" &&
    [ "$(tail -n 1 "$header")" = '#pragma GCC visibility pop' ] && continue
  echo "$header: expected '#pragma GCC visibility push(default)' before its declarations, and pop" >&2
  exit 1
done

export flags out
# shellcheck disable=SC2016 # expanded by the inner shell
printf '%s\n' "$@" | xargs -P "$(nproc)" -n 1 sh -c '
  case $1 in
    src/base/* | src/text/*) clang++-14 $flags -fsyntax-only "$1" ;;
    include/*) printf "#include \"%s\"\n#include \"%s\"\n" "${1#include/}" "${1#include/}" |
      clang++-14 $flags -fsyntax-only -x c++ - ;;
    *) clang++-14 $flags -fsyntax-only -include-pch "$out/eigen.pch" "$1" ;;
  esac || { echo "$1 does not compile alone" >&2; exit 255; }' sh
echo "$# files compile alone"
