// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#pragma GCC visibility push(default)

namespace kinefile::robovie {

/// How to read a RobovieMaker flow, beyond what `kinefile::ReadOptions` says.
struct ReadOptions {
  /// Warns of sliders that go further than so many units in a tick.
  std::optional<double> max_speed = std::nullopt;
};

/// How to write a RobovieMaker flow, beyond what `kinefile::WriteOptions` says.
struct WriteOptions {
  std::string encoding = {};  ///< "utf-16le", "cp932", "utf-8"; empty: the file's own
};

}  // namespace kinefile::robovie

#pragma GCC visibility pop
