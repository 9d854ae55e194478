#!/bin/sh
# SPDX-License-Identifier: MIT
# All tests, as `make test` and CI run them. Each part says what it is and after how many seconds it
# begins; the first failure ends it.
set -eu

begin=$(date +%s)
say() { printf '\n== %s (%s s)\n' "$*" $(($(date +%s) - begin)); }

say "Layout of the code"
tools/sources.sh . | xargs clang-format-14 --dry-run --Werror

say "The page, which the command embeds"
tools/web.sh

say "Release build: unit, format, property, transcript, layer and document tests"
tools/build.sh release
ctest --test-dir build/release --output-on-failure

say "Every public header and every source file compiles alone"
tools/check_includes.sh

say "Installation: find_package and pkg-config in a program of its own, with other flags, too"
tools/test_install.sh

say "The same tests under the address and undefined behaviour sanitizers"
tools/build.sh asan
ctest --test-dir build/sanitize --output-on-failure

say "Fuzzing each reader for a while, conversions of mutants, and random command lines"
tools/fuzz.sh "${FUZZ_SECONDS:-8}"

say "The core for the browser: its unit tests under Node"
tools/build.sh wasm
ctest --test-dir build/wasm --output-on-failure

say "The page: types, lint, and its tests in a browser"
tools/test_page.sh

say "All tests passed"
