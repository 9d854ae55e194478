// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#pragma GCC visibility push(default)

namespace kinefile::choreonoid {

/// How a YAML document is laid out.
enum class YamlStyle {
  Kept,   ///< as in the source file; block style for other documents
  Block,  ///< rows in flow style, everything else in block style
  Json,   ///< everything in flow style, which is JSON
};

/// How to write a .seq file, in addition to `kinefile::WriteOptions`.
struct WriteOptions {
  int version = 0;              ///< 1 to 4; 0: that of the source file, 2 for other documents
  std::string se3_format = {};  ///< "XYZQWQXQYQZ", ...; empty: that of the source file
  YamlStyle style = YamlStyle::Kept;
  bool choreonoid_digits = false;  ///< nine significant digits, as Choreonoid writes
};

}  // namespace kinefile::choreonoid

#pragma GCC visibility pop
