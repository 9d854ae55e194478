// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#pragma GCC visibility push(default)

namespace kinefile::choreonoid {

/// How a YAML document is laid out.
enum class YamlStyle {
  Kept,   ///< as the file was; block style for others
  Block,  ///< rows in flow style, all else in blocks
  Json,   ///< all in flow style, which is JSON
};

/// How to write a .seq file, beyond what `kinefile::WriteOptions` says.
struct WriteOptions {
  int version = 0;              ///< 1 to 4; 0: the file's own, 2 for others
  std::string se3_format = {};  ///< "XYZQWQXQYQZ", ...; empty: the file's own
  YamlStyle style = YamlStyle::Kept;
  bool choreonoid_digits = false;  ///< nine significant digits, as Choreonoid writes
};

}  // namespace kinefile::choreonoid

#pragma GCC visibility pop
