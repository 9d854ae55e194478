// SPDX-License-Identifier: MIT
// What holds for any robot, tried on random ones with fixed seeds.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kinefile/robot.hpp"
#include "support/random_skeletons.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

constexpr double kSameRobotPlace = 1e-9;
constexpr double kSameRobotTurn = 1e-7;

/// Lets joints that follow others repeat their values.
void repeat_following(Motion& motion) {
  const Rows rows = motion.clip.mutate();
  for (const FollowingColumn& following : following_columns(motion.skeleton)) {
    const DegreeOfFreedom& dof = motion.skeleton.joints[following.joint].dofs[0];
    for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
      rows[f][following.column] = value_of(dof, rows[f][dof.coordinate]);
    }
  }
}

/// A robot's motion whose joints start on the turn that is nearest to 0.
Motion robot_near_zero(RandomSource& random) {
  Motion motion = random_robot(random);
  for (const Joint& joint : motion.skeleton.joints) {
    if (joint.dofs.empty() || joint.dofs[0].kind != DofKind::Rotation) continue;
    const std::size_t column = joint.dofs[0].coordinate;
    const double first = motion.clip.row(0)[column];
    const Rows rows = motion.clip.mutate();
    for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
      rows[f][column] -= first - std::clamp(first, -3.0, 3.0);
    }
  }
  repeat_following(motion);
  return motion;
}

TEST(RobotProperties, JointsComeBackBitForBitAndLinksAsNear) {
  RandomSource random(201);
  for (int i = 0; i < 200; ++i) {
    const Motion motion = robot_near_zero(random);
    const ExpectUnchanged unchanged(motion);
    Diagnostics diagnostics;
    ASSERT_TRUE(robot::is_robot(motion.skeleton));
    for (const auto form :
         {robot::BodyForm::Joints, robot::BodyForm::Both, robot::BodyForm::Links}) {
      const auto body = robot::project(motion, form, nullptr, diagnostics);
      ASSERT_TRUE(body);
      const auto back = robot::pose(*body, motion.skeleton, false, diagnostics);
      ASSERT_TRUE(back);
      if (form == robot::BodyForm::Joints) {
        EXPECT_TRUE(same_bits(back->clip.values, motion.clip.values));
      }
      const WorldDifference difference = world_difference(motion, *back);
      EXPECT_LT(difference.position, kSameRobotPlace) << i;
      EXPECT_LT(difference.rotation, kSameRobotTurn) << i;
      for (std::size_t c = kRootColumns; c < motion.clip.num_coordinates; ++c) {
        for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
          EXPECT_NEAR(back->clip.row(f)[c], motion.clip.row(f)[c], 1e-9);
        }
      }
    }
    EXPECT_EQ(text_of(diagnostics), "");
  }
}

TEST(RobotProperties, LinksOfAnySkeletonAreWhereItsJointsAre) {
  RandomSource random(202);
  for (int i = 0; i < 100; ++i) {
    Motion motion = random_motion(random, {.free_joints = true});
    motion.skeleton.metres_per_unit = 1;
    const ExpectUnchanged unchanged(motion);
    Diagnostics diagnostics;
    const auto body = robot::project(motion, robot::BodyForm::Links, nullptr, diagnostics);
    ASSERT_TRUE(body);
    auto links = robot::motion_of_links(*body);
    ASSERT_TRUE(links);
    for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
      links->skeleton.joints[j].name = motion.skeleton.joints[j].name;
    }
    const WorldDifference difference = world_difference(motion, *links);
    EXPECT_LT(difference.position, kSameRobotPlace);
    EXPECT_LT(difference.rotation, kSameRobotTurn);
  }
}

TEST(RobotProperties, ARobotFollowsItself) {
  RandomSource random(203);
  for (int i = 0; i < 200; ++i) {
    Motion motion = robot_near_zero(random);
    // Only the root translates; what else does so stays at rest, which is told.
    bool is_told = false;
    for (const Joint& joint : motion.skeleton.joints) {
      if (joint.dofs.empty() || joint.dofs[0].kind != DofKind::Translation) continue;
      is_told = true;
      const Rows rows = motion.clip.mutate();
      for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
        rows[f][joint.dofs[0].coordinate] = joint.dofs[0].rest;
      }
    }
    repeat_following(motion);
    Diagnostics diagnostics;
    const auto body = robot::onto_robot(motion, motion.skeleton, {}, true, diagnostics);
    ASSERT_TRUE(body);
    EXPECT_EQ(count_code(diagnostics, "BRG015"), is_told ? 1u : 0u) << text_of(diagnostics);
    const auto back = robot::pose(*body, motion.skeleton, false, diagnostics);
    ASSERT_TRUE(back);
    const WorldDifference difference = world_difference(motion, *back);
    EXPECT_LT(difference.position, kSameRobotPlace) << i;
    EXPECT_LT(difference.rotation, kSameRobotTurn) << i;
  }
}

/// A chain of five links, of which the last three turn about axes at right angles to their
/// neighbours where all angles are 0, and two before them about any.
Motion random_chain(RandomSource& random) {
  Motion motion;
  Skeleton& skeleton = motion.skeleton;
  skeleton.angle_unit = AngleUnit::Radians;
  skeleton.metres_per_unit = 1;
  for (std::size_t j = 0; j < 6; ++j) {
    Joint joint;
    joint.name = fmt::format("LINK{}", j);
    if (j > 0) {
      joint.parent = j - 1;
      joint.offset = random_vector(random, 1);
      joint.rest_rotation = random_rotation(random);
    }
    skeleton.joints.push_back(std::move(joint));
  }
  skeleton.joints[0].dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  for (const char* channel : {"x", "y", "z", "qw", "qx", "qy", "qz"}) {
    skeleton.coordinates.push_back({0, channel});
  }
  Quat own_from_last = Quat::Identity();  // where all angles are 0
  for (std::size_t j = 5; j > 0; --j) {
    const Vec3 across = own_from_last * Vec3::Unit(static_cast<Eigen::Index>(j % 3));
    const Vec3 axis = j < 3 ? random_vector(random, 1) : across;
    skeleton.joints[j].dofs = {
        {DofKind::Rotation, axis.normalized(), 6 + j, random_number(random, -1, 1)}};
    own_from_last = skeleton.joints[j].rest_rotation * own_from_last;
  }
  for (std::size_t j = 1; j < 6; ++j) skeleton.coordinates.push_back({j, "q"});
  return motion;
}

TEST(RobotProperties, LinksThatNothingMovesKeepTheirRestAngles) {
  RandomSource random(204);
  for (int i = 0; i < 200; ++i) {
    Motion robot = random_chain(random);
    Clip& clip = robot.clip;
    clip.num_frames = 10;
    clip.num_coordinates = 12;
    clip.timeline = {FrameRate{50}, 0};
    const std::vector<double> rest = rest_coordinates(robot.skeleton);
    for (std::size_t f = 0; f < clip.num_frames; ++f) {
      std::vector<double> row = rest;
      for (std::size_t c = 9; c < 12; ++c) {
        row[c] += 0.4 * std::sin(0.5 * static_cast<double>(f + c)) -
                  0.4 * std::sin(0.5 * static_cast<double>(c));
      }
      clip.values.append(row);
    }
    // A figure that moves like it, of whose joints only the last has a link's name.
    Motion figure = robot;
    for (std::size_t j = 1; j < 5; ++j) figure.skeleton.joints[j].name = fmt::format("bone{}", j);
    Diagnostics diagnostics;
    const auto body = robot::onto_robot(figure, robot.skeleton, {}, true, diagnostics);
    ASSERT_TRUE(body);
    const auto back = robot::pose(*body, robot.skeleton, false, diagnostics);
    ASSERT_TRUE(back);
    const WorldDifference difference = world_difference(robot, *back);
    EXPECT_LT(difference.position, kSameRobotPlace) << i;
    EXPECT_LT(difference.rotation, kSameRobotTurn) << i;
    EXPECT_EQ(diagnostics.items().size(), 1u) << "that two links rest: " << text_of(diagnostics);
  }
}

TEST(RobotProperties, WithoutFreeJointsTheWorldStays) {
  RandomSource random(205);
  int num_free = 0;
  for (int i = 0; i < 200; ++i) {
    const Motion motion =
        i % 4 == 0 ? random_robot(random) : random_motion(random, {.free_joints = true});
    const ExpectUnchanged unchanged(motion);
    const Motion bound = robot::without_free_joints(motion);
    EXPECT_TRUE(validate(bound.skeleton));
    for (const Joint& joint : bound.skeleton.joints) EXPECT_FALSE(moves_freely(joint));
    for (const bool rest : {false, true}) {
      const WorldDifference difference = world_difference(motion, bound, rest);
      EXPECT_LT(difference.position, kSameRobotPlace) << i;
      EXPECT_LT(difference.tip, kSameRobotPlace) << i;
      EXPECT_LT(difference.rotation, kSameRobotTurn) << i;
    }
    for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
      const auto& old_dofs = motion.skeleton.joints[j].dofs;
      if (moves_freely(motion.skeleton.joints[j]) && ++num_free) continue;
      for (std::size_t d = 0; d < old_dofs.size(); ++d) {
        const std::size_t column = bound.skeleton.joints[j].dofs[d].coordinate;
        for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
          EXPECT_EQ(bound.clip.row(f)[column], motion.clip.row(f)[old_dofs[d].coordinate]);
        }
      }
    }
  }
  EXPECT_GT(num_free, 100);
}

}  // namespace
}  // namespace kinefile::test
