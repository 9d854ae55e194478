#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs build/release, as a static and as a shared library, and builds tests/consumer against each:
# by find_package and by pkg-config, with the library's flags, with -mavx2 and with -march=native. The
# sizes of public structs and what is computed must not depend on any of these.
set -eu

root=$(pwd)
file=tests/formats/bvh/valid/spec_example.bvh
expected='Chest 8.3296403 40.0386948 89.6891140'
flags='-DPLAIN -march=native'
! grep -qw avx2 /proc/cpuinfo 2>/dev/null || flags="$flags -mavx2"
rm -rf build/install build/consumer
mkdir -p build/consumer
sizes=''

fail() {
  echo "$*" >&2
  exit 1
}

# check NAME PROGRAM
check() {
  said=$("$2" "$file")
  found=$(echo "$said" | tail -n 1)
  found_sizes=$(echo "$said" | head -n 1)
  : "${sizes:=$found_sizes}"
  [ "$found" = "$expected" ] || fail "$1: expected '$expected', found '$found'"
  [ "$found_sizes" = "$sizes" ] || fail "$1: expected the sizes '$sizes', found '$found_sizes'"
  echo "$1: $found"
}

# check_installed static|shared
check_installed() {
  stage=$root/build/install/$1
  cmake --install build/release --prefix "$stage" >/dev/null
  pkg_folder=$(dirname "$(find "$stage" -name kinefile.pc)")
  for flag in $flags; do
    built=build/consumer/$1$flag
    cmake -S tests/consumer -B "$built" -G Ninja -DCMAKE_PREFIX_PATH="$stage" \
      -DCMAKE_CXX_FLAGS="$flag" >/dev/null
    cmake --build "$built" >"$built/log" || fail "$(cat "$built/log")"
    check "$1 library, find_package, $flag" "$built/consumer"
    # shellcheck disable=SC2046 # one word a flag
    g++ -std=c++20 "$flag" tests/consumer/main.cpp -Wl,-rpath,"$pkg_folder/.." \
      $(PKG_CONFIG_PATH=$pkg_folder pkg-config --cflags --libs kinefile) -o "$built/by_pkg_config"
    check "$1 library, pkg-config, $flag" "$built/by_pkg_config"
  done
  "$stage/bin/kinefile" --version
}

check_installed static
stage=$root/build/install/static
for name in share/man/man1/kinefile.1 share/bash-completion/completions/kinefile \
  share/zsh/site-functions/_kinefile share/fish/vendor_completions.d/kinefile.fish; do
  test -s "$stage/$name" || fail "$name is not installed"
done
bash -n "$stage/share/bash-completion/completions/kinefile"

# The same objects make the shared library: only links are made anew, and then undone.
use_libraries() {
  if ! { cmake -DBUILD_SHARED_LIBS="$1" build/release &&
    cmake --build build/release --target kinefile kinefile_command kinefile_manual
  } >build/shared.log 2>&1; then
    fail "$(tail -n 60 build/shared.log)"
  fi
}
trap 'use_libraries OFF' EXIT
use_libraries ON
check_installed shared
library=$(find "$root/build/install/shared" -name 'libkinefile.so.*.*.*')
[ -n "$library" ] || fail "no libkinefile.so with a version is installed"
objdump -p "$library" | grep -q 'SONAME *libkinefile\.so\.[0-9]*\.[0-9]*$' ||
  fail "$library has no soname with a version"
objdump -p "$root/build/install/shared/bin/kinefile" | grep -q 'NEEDED *libkinefile\.so' ||
  fail "the command does not use the shared library"
# Internals are hidden: the text layer, for one.
! nm -DC --defined-only "$library" | grep -q 'kinefile::text::' ||
  fail "$library exports its internals: $(nm -DC --defined-only "$library" | grep -m 3 'kinefile::text::')"
echo "Sizes with all flags: $sizes"
