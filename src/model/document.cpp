// SPDX-License-Identifier: MIT
#include "kinefile/document.hpp"

namespace kinefile {

std::string_view kind_name(const Document& document) {
  return std::holds_alternative<Motion>(document.content) ? "motion" : "skeleton";
}

const Skeleton& skeleton_of(const Document& document) {
  const Motion* motion = std::get_if<Motion>(&document.content);
  return motion != nullptr ? motion->skeleton : std::get<Skeleton>(document.content);
}

}  // namespace kinefile
