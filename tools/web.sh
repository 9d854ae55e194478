#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds the page: the core in WebAssembly, then one HTML file with it, at build/web/page.html.
# Packages come from the lock file; nothing is fetched when the page is used.
set -eu

if ! [ viewer/node_modules/.package-lock.json -nt viewer/package-lock.json ]; then
  echo "Installing the page's packages with npm ci; the log is build/npm.log"
  mkdir -p build
  (cd viewer && npm ci --ignore-scripts --no-audit --no-fund) >build/npm.log 2>&1 ||
    { tail -n 20 build/npm.log >&2; exit 1; }
fi
tools/build.sh web kinefile_page_core
node viewer/build.mjs build/wasm build/web/page.html
