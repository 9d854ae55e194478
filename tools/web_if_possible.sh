#!/bin/sh
# SPDX-License-Identifier: MIT
# The page for the demo. Where it cannot be built, the demo goes on without it, and this says why.
set -u

if [ "${WEB:-1}" = 0 ]; then
  echo "WEB=0: the page is not built, so 'kinefile view' will say that it is missing"
elif ! { tools/setup.sh web && tools/web.sh; }; then
  echo "The page is not built: what it needs is named above. All else goes on without it." >&2
fi
