// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace kinefile {

/// An ASCII letter in lower case; any other character unchanged.
constexpr char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

/// A text with its ASCII letters in lower case.
std::string lowered(std::string_view text);

/// The maximum number of names that a message lists.
inline constexpr std::size_t kMostListed = 5;

/// A list of quoted names for a message: the first names, and the number of further ones.
/// \param names   all of them, or the first `kMostListed` of `num_names`
std::string listed(const std::vector<std::string>& names, std::size_t num_names);
inline std::string listed(const std::vector<std::string>& names) {
  return listed(names, names.size());
}

}  // namespace kinefile
