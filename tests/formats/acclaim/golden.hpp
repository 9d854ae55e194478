// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "kinefile/kinematics.hpp"
#include "support/support.hpp"

// Where other programs place the ends of bones.

namespace kinefile::test {

/// A row of a table of bone ends: `frame,bone,x,y,z`, frames from 1.
struct BoneEnd {
  std::size_t frame = 0;
  std::string bone;
  Vec3 point;
};

inline std::vector<BoneEnd> read_table(const std::string& name) {
  std::istringstream text(bytes_of(data_folder() + "/acclaim/golden/" + name));
  std::vector<BoneEnd> rows;
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    BoneEnd row;
    fields >> row.frame >> row.bone >> row.point[0] >> row.point[1] >> row.point[2];
    --row.frame;
    rows.push_back(row);
  }
  return rows;
}

/// The largest distance of a motion's bone ends from a table's, relative to the distance from the
/// origin, or absolute.
inline double largest_error(const Motion& motion, const std::vector<BoneEnd>& table,
                            bool is_relative) {
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip, {.tips = true});
  std::map<std::string, std::size_t> tip_of_bone;
  for (std::size_t j = 1; j < motion.skeleton.joints.size(); ++j) {
    tip_of_bone[motion.skeleton.joints[j].name] = j - 1;
  }
  double largest = 0;
  for (const BoneEnd& row : table) {
    const double* p =
        row.bone == "root"
            ? &poses.positions[row.frame * poses.num_joints * 3]
            : &poses.tips[(row.frame * poses.num_tips + tip_of_bone.at(row.bone)) * 3];
    const double distance = (Vec3(p[0], p[1], p[2]) - row.point).norm();
    largest = std::max(largest, is_relative ? distance / row.point.norm() : distance);
  }
  return largest;
}

/// The largest distance of a motion's bone ends from a table's, in the file's unit.
inline double distance_from_table(const Motion& motion, const std::string& table) {
  return largest_error(motion, read_table(table), false);
}

}  // namespace kinefile::test
