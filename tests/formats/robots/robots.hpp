// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "formats/robot_file.hpp"
#include "kinefile/kinefile.hpp"
#include "support/support.hpp"

namespace kinefile::test {

inline constexpr double kPi = std::numbers::pi;

/// Files that lie beside the one that is read, by name.
inline Resolver files_of(std::vector<std::pair<std::string, std::string>> files) {
  Resolver resolver;
  resolver.open = [files](const std::string& name) -> std::optional<CompanionFile> {
    for (const auto& [known, text] : files) {
      if (known != name) continue;
      const auto owner = std::make_shared<const std::string>(text);
      return CompanionFile{name, *owner, owner};
    }
    return std::nullopt;
  };
  return resolver;
}

/// Reads a robot; diagnostics call it "t.FORMAT" unless the options say otherwise.
inline ReadText read_robot(const std::string& format, std::string_view bytes,
                           ReadOptions options = {}) {
  if (options.source_name == "<memory>") options.source_name = "t." + format;
  ReadText read;
  auto document = find_format(format)->read(bytes, options, read.diagnostics);
  if (document) read.document = std::move(*document);
  return read;
}

/// A robot that must read without a word.
inline Document robot_of(const std::string& format, std::string_view bytes,
                         const ReadOptions& options = {}) {
  ReadText read = read_robot(format, bytes, options);
  EXPECT_TRUE(read.document);
  EXPECT_EQ(text_of(read.diagnostics), "");
  if (!read.document) return {};
  EXPECT_TRUE(validate(skeleton_of(*read.document)));
  return std::move(*read.document);
}

/// The names of the joints, in order.
inline std::string names_of(const Skeleton& skeleton) {
  std::string names;
  for (const Joint& joint : skeleton.joints) names += (names.empty() ? "" : " ") + joint.name;
  return names;
}

/// The names of the columns behind the root's, in order.
inline std::string joint_columns_of(const Skeleton& skeleton) {
  std::string names;
  const auto all = column_names(skeleton);
  for (std::size_t c = 7; c < all.size(); ++c) names += (c == 7 ? "" : " ") + all[c];
  return names;
}

/// How many columns of joint ids a robot has.
inline std::size_t num_joint_ids(const Document& document) {
  const auto* const kept = document.kept.get<robot_file::KeptFile>();
  EXPECT_NE(kept, nullptr);
  return kept == nullptr ? 0 : kept->num_joint_ids;
}

inline std::size_t joint_of_name(const Skeleton& skeleton, const std::string& name) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].name == name) return j;
  }
  ADD_FAILURE() << name;
  return 0;
}

/// Where joints are for some values of columns.
inline WorldPoses poses_of(const Skeleton& skeleton, const std::vector<double>& values) {
  Clip clip;
  clip.num_coordinates = skeleton.coordinates.size();
  clip.num_frames = values.size() / clip.num_coordinates;
  clip.values = values;
  return forward_kinematics(skeleton, clip, {.rotations = true});
}

inline Vec3 position_in(const WorldPoses& poses, std::size_t joint, std::size_t frame = 0) {
  return Vec3(poses.positions.data() + (frame * poses.num_joints + joint) * 3);
}

inline Quat rotation_in(const WorldPoses& poses, std::size_t joint, std::size_t frame = 0) {
  const double* q = poses.rotations.data() + (frame * poses.num_joints + joint) * 4;
  return {q[0], q[1], q[2], q[3]};
}

}  // namespace kinefile::test
