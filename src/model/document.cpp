// SPDX-License-Identifier: MIT
#include "kinefile/document.hpp"

#include <iterator>

namespace kinefile {

std::string_view kind_name(const Document& document) {
  constexpr std::string_view kNames[] = {"motion", "skeleton", "body_motion", "pose_flow"};
  static_assert(std::size(kNames) == std::variant_size_v<decltype(document.content)>);
  return kNames[document.content.index()];
}

const Skeleton& skeleton_of(const Document& document) {
  const Motion* motion = std::get_if<Motion>(&document.content);
  return motion != nullptr ? motion->skeleton : std::get<Skeleton>(document.content);
}

Motion still_or_moving(const Document& document) {
  if (const Motion* motion = std::get_if<Motion>(&document.content)) return *motion;
  Motion still{skeleton_of(document), {}};
  still.clip.num_coordinates = still.skeleton.coordinates.size();
  return still;
}

bool has_skeleton(const Document& document) {
  return std::holds_alternative<Motion>(document.content) ||
         std::holds_alternative<Skeleton>(document.content);
}

}  // namespace kinefile
