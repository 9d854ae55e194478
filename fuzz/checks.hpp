// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>

#include "kinefile/kinefile.hpp"

namespace kinefile::fuzz {

inline void require(bool condition) {
  if (!condition) std::abort();
}

/// What holds for everything that a reader gives: a document or errors, all with places.
inline void check_reading(const Result<Document>& document, const Diagnostics& diagnostics) {
  require(document.has_value() == !diagnostics.has_errors());
  for (const Diagnostic& item : diagnostics.items()) {
    require(item.place.line > 0 && item.place.column > 0);
    require(item.caret <= item.excerpt.size());
    to_string(item);
  }
}

/// What holds for every body motion: as many values and times as each component says.
inline void check_components(const BodyMotion& motion) {
  for (const Component& component : motion.components) {
    require(component.values.size() == component.num_frames * component.row_size());
    const auto& times = own_times(component.timeline);
    require(times.empty() || times.size() == component.num_frames);
    require(component.num_parts > 0);
  }
}

/// What holds for every document: a valid skeleton, as many values as it says, finite work.
inline void check_document(const Document& document) {
  if (const BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    check_components(*body);
    return;
  }
  require(validate(skeleton_of(document)).has_value());
  const Motion* motion = std::get_if<Motion>(&document.content);
  if (motion == nullptr) return;
  require(motion->clip.values.size() == motion->clip.num_frames * motion->clip.num_coordinates);
  require(motion->clip.num_coordinates == motion->skeleton.coordinates.size());
  const WorldPoses poses =
      forward_kinematics(motion->skeleton, motion->clip,
                         {.num_frames = 40, .rotations = true, .directions = true, .tips = true});
  require(poses.positions.size() == poses.num_frames * motion->skeleton.joints.size() * 3);
}

/// Writes a document, which must succeed.
inline std::string written(const Document& document, std::string_view format,
                           const WriteOptions& options = {}) {
  std::string text;
  Diagnostics diagnostics;
  const auto result = find_format(format)->write(
      document, options,
      [&text](std::string_view piece) {
        text += piece;
        return true;
      },
      diagnostics);
  require(result.has_value());
  return text;
}

/// The same doubles, but for what kind of NaN one is.
inline bool same_values(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool are_nan = a[i] != a[i] && b[i] != b[i];
    if (!are_nan && std::memcmp(&a[i], &b[i], sizeof a[i]) != 0) return false;
  }
  return true;
}

}  // namespace kinefile::fuzz
