#!/bin/sh
# SPDX-License-Identifier: MIT
# The tests of the page, with the core and the command of this build: types, lint and layout of the
# code, then the page in a real browser. Pictures of it stay in build/viewer-tests.
set -eu

cd viewer
node_modules/.bin/tsc --noEmit
node_modules/.bin/biome check .
node --test --test-concurrency=2 tests/*.test.mjs
