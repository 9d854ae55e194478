// SPDX-License-Identifier: MIT
#include "kinefile/document.hpp"

namespace kinefile {

std::string_view kind_name(const Document& document) {
  if (std::holds_alternative<BodyMotion>(document.content)) return "body_motion";
  return std::holds_alternative<Motion>(document.content) ? "motion" : "skeleton";
}

const Skeleton& skeleton_of(const Document& document) {
  const Motion* motion = std::get_if<Motion>(&document.content);
  return motion != nullptr ? motion->skeleton : std::get<Skeleton>(document.content);
}

bool has_skeleton(const Document& document) {
  return !std::holds_alternative<BodyMotion>(document.content);
}

}  // namespace kinefile
