// SPDX-License-Identifier: MIT
#include "base/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace kinefile {

std::string lowered(std::string_view text) {
  std::string copy(text);
  std::transform(copy.begin(), copy.end(), copy.begin(), [](char c) { return lowered(c); });
  return copy;
}

std::string listed(const std::vector<std::string>& names, std::size_t num_names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostListed); ++i) {
    text += fmt::format("{}'{}'", i == 0 ? "" : ", ", names[i]);
  }
  if (num_names > kMostListed) text += fmt::format(" and {} more", num_names - kMostListed);
  return text;
}

}  // namespace kinefile
