#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs build/release into a folder and builds tests/consumer against it, once by find_package
# and once by pkg-config.
set -eu

root=$(pwd)
stage=$root/build/install
rm -rf "$stage" build/consumer
cmake --install build/release --prefix "$stage" >/dev/null
cmake -S tests/consumer -B build/consumer -G Ninja -DCMAKE_PREFIX_PATH="$stage" >/dev/null
cmake --build build/consumer >/dev/null
file=tests/formats/bvh/valid/spec_example.bvh
expected='Chest 8.3296403 40.0386948 89.6891140'
check() {
  if [ "$2" != "$expected" ]; then
    echo "$1: expected '$expected', found '$2'" >&2
    exit 1
  fi
  echo "$1: $2"
}
check find_package "$(build/consumer/consumer $file)"

pkg_folder=$(dirname "$(find "$stage" -name kinefile.pc)")
# shellcheck disable=SC2046 # one word a flag
g++ -std=c++20 tests/consumer/main.cpp \
  $(PKG_CONFIG_PATH=$pkg_folder pkg-config --cflags --libs kinefile) -o build/consumer/by_pkg_config
check pkg-config "$(build/consumer/by_pkg_config $file)"

"$stage/bin/kinefile" --version
for file in share/man/man1/kinefile.1 share/bash-completion/completions/kinefile \
  share/zsh/site-functions/_kinefile share/fish/vendor_completions.d/kinefile.fish; do
  test -s "$stage/$file" || { echo "$file is not installed" >&2; exit 1; }
done
bash -n "$stage/share/bash-completion/completions/kinefile"
