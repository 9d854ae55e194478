// SPDX-License-Identifier: MIT
#pragma once

#pragma GCC visibility push(default)

namespace kinefile::csv {

/// How to read a table, in addition to `kinefile::ReadOptions`.
struct ReadOptions {
  bool in_degrees = false;   ///< for a flow: numbers are degrees, converted by
                             ///< `kinefile::ReadOptions::project`
  bool is_relative = false;  ///< degrees are relative to the base pose
};

/// How to write a table, in addition to `kinefile::WriteOptions`.
struct WriteOptions {
  bool in_degrees = false;   ///< for a flow: degrees, for sliders that the project shows in degrees
  bool is_relative = false;  ///< degrees are relative to the base pose
};

}  // namespace kinefile::csv

#pragma GCC visibility pop
