#!/bin/sh
# SPDX-License-Identifier: MIT
# The tests of the page, with the core and the command of this build: types, lint and layout of the
# code, then the page in a real browser. Pictures of it stay in build/viewer-tests. A file of tests
# that fails is run once more, and said to be: a busy machine's browser loses events.
set -eu

cd viewer
node_modules/.bin/tsc --noEmit
node_modules/.bin/biome check .
printf '%s\n' tests/*.test.mjs | xargs -P 2 -I{} sh -c '
    log=$(mktemp)
    node --test "$1" >"$log" 2>&1 || {
        cat "$log"
        echo "$1 failed, is run once more"
        node --test "$1" >"$log" 2>&1 || { cat "$log"; rm "$log"; exit 255; }
    }
    grep -E "^(ok|not ok|# (tests|pass|fail|skipped))|# SKIP" "$log"
    rm "$log"' sh {}
