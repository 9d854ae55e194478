// SPDX-License-Identifier: MIT
// Small figures for tests, written as BVH texts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinefile/motion.hpp"

namespace kinefile::test {

/// A joint of a figure; the joints of a figure come depth first.
struct Bone {
  std::string name;
  int depth = 0;
  Vec3 offset = Vec3::Zero();
  std::optional<Vec3> tip = std::nullopt;
  bool has_positions = false;  ///< three position channels; the root always has them
};

/// A figure as a BVH text; rotations are Zrotation Xrotation Yrotation.
/// \param rows  of numbers: X Y Z positions of a joint where it has them, then its rotations
std::string bvh_of_figure(const std::vector<Bone>& bones,
                          const std::vector<std::vector<double>>& rows, double frame_time = 0.1);

/// A person of about 170 units: Hips, two legs with feet, a spine, all with rotations.
/// At rest the legs point down along -y, and the person faces +z.
std::vector<Bone> person();

/// A row of zeros with the first numbers given.
std::vector<double> row_of(const std::vector<Bone>& bones, const std::vector<double>& first);

}  // namespace kinefile::test
