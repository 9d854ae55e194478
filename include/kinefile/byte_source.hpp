// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>

#pragma GCC visibility push(default)

namespace kinefile {

/// The bytes of a file that are read piece by piece.
struct ByteSource {
  std::size_t size = 0;
  /// Reads the bytes from a place on, all of which are in the file; false after a fault. May be
  /// called from several threads at once.
  std::function<bool(std::size_t offset, std::span<char> bytes)> read = {};
  /// All bytes, if they are in memory: then `read` is not called.
  std::string_view view = {};
};

}  // namespace kinefile

#pragma GCC visibility pop
