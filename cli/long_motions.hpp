// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "writing.hpp"

// Motions that are too large to be kept in memory. Commands that need some frames at a time alone
// read them block by block.

namespace kinefile::cli {

/// Motions whose values need less memory are read whole, since each frame is then read once.
/// \param is_changed  a change makes a second motion, which reading whole would keep, too
constexpr double most_bytes_in_memory(bool is_changed) {
  return (is_changed ? 48.0 : 96.0) * 1024 * 1024;
}

/// Opens the motion of a file that is too large for memory.
/// \returns empty if the file has to be read whole, and nothing is printed
std::optional<LongMotion> open_long(const std::string& path, const Reading& reading,
                                    bool is_changed, Diagnostics& diagnostics);

/// Changes a motion, block by block.
using ChangeLong = std::function<Result<LongMotion>(LongMotion motion, Diagnostics& diagnostics)>;

/// Converts and writes the motion of a file that is too large for memory, and reports everything.
/// \param format  of the output, as far as it is known without the input
/// \param change  null: the motion stays as it is
/// \returns       the exit code; empty if the file has to be read whole, and nothing is done
std::optional<int> write_long(const std::string& path, const Format& format, const Writing& writing,
                              const Reading& reading, const ChangeLong& change,
                              const Globals& globals);

}  // namespace kinefile::cli
