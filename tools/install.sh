#!/bin/sh
# SPDX-License-Identifier: MIT
# tools/install.sh PREFIX: installs build/release there, with sudo if that needs it.
set -eu

prefix=$1
parent=$prefix
while [ ! -e "$parent" ]; do parent=$(dirname "$parent"); done
as_root=''
if [ ! -w "$parent" ]; then
  command -v sudo >/dev/null || { echo "$parent cannot be written; PREFIX=... names another" >&2; exit 1; }
  as_root=sudo
fi
$as_root cmake --install build/release --strip --prefix "$prefix" >/dev/null
echo "Installed in $prefix: bin/kinefile, the library, the man page and completions"
