#!/bin/sh
# SPDX-License-Identifier: MIT
# tools/lint.sh [FILE...]: clang-tidy over the library and the command, as .clang-tidy says. How files
# are compiled is taken from the dev preset, which knows each; nothing is built.
set -eu
[ $# -gt 0 ] || set -- src cli
cmake --preset dev >/dev/null
tools/sources.sh "$@" | grep '\.cpp$' | xargs -P 2 -n 4 clang-tidy-14 -p build/dev --quiet \
  --extra-arg=-Wno-unknown-warning-option
