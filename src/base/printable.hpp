// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace kinefile {

/// The first character of a text.
struct Character {
  char32_t value = 0;         ///< 0 for a byte that is no UTF-8
  std::size_t length = 1;     ///< in bytes
  bool is_printable = false;  ///< see `printable`
};

/// \param text  not empty
Character first_character(std::string_view text);

}  // namespace kinefile
