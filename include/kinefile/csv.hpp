// SPDX-License-Identifier: MIT
#pragma once

#pragma GCC visibility push(default)

namespace kinefile::csv {

/// How to read a table, beyond what `kinefile::ReadOptions` says.
struct ReadOptions {
  bool in_degrees = false;  ///< of a flow: numbers are degrees, by `kinefile::ReadOptions::project`
  bool is_relative = false;  ///< ... from the base pose on
};

/// How to write a table, beyond what `kinefile::WriteOptions` says.
struct WriteOptions {
  bool in_degrees = false;   ///< of a flow: words of sliders that the project gives degrees for
  bool is_relative = false;  ///< ... from the base pose on
};

}  // namespace kinefile::csv

#pragma GCC visibility pop
