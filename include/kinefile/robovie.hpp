// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#pragma GCC visibility push(default)

namespace kinefile::robovie {

/// How to read a RobovieMaker flow, in addition to `kinefile::ReadOptions`.
struct ReadOptions {
  /// Warns of sliders that change by more than this many units per tick.
  std::optional<double> max_speed = std::nullopt;
};

/// How to write a RobovieMaker flow, in addition to `kinefile::WriteOptions`.
struct WriteOptions {
  std::string encoding = {};  ///< "utf-16le", "cp932", "utf-8"; empty: that of the source file
};

}  // namespace kinefile::robovie

#pragma GCC visibility pop
