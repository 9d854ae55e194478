#!/bin/sh
# SPDX-License-Identifier: MIT
# clang-tidy over the library and the command, as .clang-tidy says; needs build/release.
set -eu
tools/sources.sh src cli | grep '\.cpp$' | xargs -P 2 -n 4 clang-tidy-14 -p build/release --quiet \
  --extra-arg=-Wno-unknown-warning-option
