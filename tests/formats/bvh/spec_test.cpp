// SPDX-License-Identifier: MIT
// The format document's own examples and tables (single precision, as bvhio printed them).

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "kinefile/kinematics.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

struct Line {
  std::string joint;
  Vec3 position;
  Vec3 direction;
};

/// The lines of a table: `x y z ux uy uz JOINT`.
std::vector<Line> table_of(const std::string& name) {
  std::istringstream text(fixture("bvh/valid/" + name));
  std::vector<Line> lines;
  Line line;
  while (text >> line.position[0] >> line.position[1] >> line.position[2] >> line.direction[0] >>
         line.direction[1] >> line.direction[2] >> line.joint) {
    lines.push_back(line);
  }
  return lines;
}

void expect_printed(const Vec3& printed, const double* computed, const std::string& joint) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_NEAR(printed[k], computed[k], 1e-5 + 1e-5 * std::abs(printed[k])) << joint;
  }
}

void expect_table(const Skeleton& skeleton, const WorldPoses& poses, const std::string& table) {
  const auto lines = table_of(table);
  ASSERT_EQ(lines.size(), 18u);
  ASSERT_EQ(poses.num_joints, 18u);
  for (std::size_t j = 0; j < lines.size(); ++j) {
    EXPECT_EQ(lines[j].joint, skeleton.joints[j].name);
    expect_printed(lines[j].position, &poses.positions[j * 3], lines[j].joint);
    expect_printed(lines[j].direction, &poses.directions[j * 3], lines[j].joint);
  }
}

TEST(BvhSpec, FirstFrameTable) {
  const Motion motion = motion_of(fixture("bvh/valid/spec_example.bvh"));
  const WorldPoses poses =
      forward_kinematics(motion.skeleton, motion.clip, {.num_frames = 1, .directions = true});
  expect_table(motion.skeleton, poses, "spec_example_frame0.table");
}

TEST(BvhSpec, RestPoseTable) {
  const Motion motion = motion_of(fixture("bvh/valid/spec_example.bvh"));
  const WorldPoses poses =
      forward_kinematics(motion.skeleton, rest_clip(motion.skeleton), {.directions = true});
  expect_table(motion.skeleton, poses, "spec_example_rest.table");
}

TEST(BvhSpec, WorkedExample) {
  const Motion motion = motion_of(fixture("bvh/valid/spec_example.bvh"));
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip);
  EXPECT_EQ(motion.skeleton.joints[1].name, "Chest");
  EXPECT_NEAR(poses.positions[3], 8.3296403, 5e-8);
  EXPECT_NEAR(poses.positions[4], 40.03869482, 5e-9);
  EXPECT_NEAR(poses.positions[5], 89.68911402, 5e-9);
}

TEST(BvhSpec, SmallExample) {
  const Motion motion = motion_of(fixture("bvh/valid/spec_small.bvh"));
  EXPECT_EQ(motion.clip.num_frames, 2u);
  EXPECT_EQ(motion.clip.num_coordinates, 9u);
  EXPECT_EQ(frame_time(motion.clip.timeline), 0.0333333);
  EXPECT_EQ(motion.skeleton.joints[1].tips.size(), 1u);
}

}  // namespace
}  // namespace kinefile::test
