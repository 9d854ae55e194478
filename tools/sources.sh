#!/bin/sh
# SPDX-License-Identifier: MIT
# tools/sources.sh FOLDER...: the C++ files in them, without what was built.
set -eu
found=$(find "$@" \( -name build -o -name node_modules \) -prune -o \( -name '*.cpp' -o -name '*.hpp' \) -print)
[ -n "$found" ] || { echo "no sources in $*" >&2; exit 1; }
echo "$found"
