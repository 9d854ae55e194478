// SPDX-License-Identifier: MIT
#include "kinefile/joint_curves.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "kinefile/kinematics.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

/// A crank that turns about z by the given degrees, and its hand, 2 units along x; ten frames a
/// second.
Motion crank(const std::vector<double>& degrees) {
  Motion motion;
  Joint& base = motion.skeleton.joints.emplace_back();
  base.name = "Crank";
  base.dofs.push_back({DofKind::Rotation, Vec3::UnitZ(), 0, 0});
  Joint& hand = motion.skeleton.joints.emplace_back();
  hand.name = "Hand";
  hand.parent = 0;
  hand.offset = {2, 0, 0};
  motion.skeleton.coordinates = {{0, "Zrotation"}};
  motion.clip.num_frames = degrees.size();
  motion.clip.num_coordinates = 1;
  motion.clip.values = degrees;
  motion.clip.timeline = {FrameRate{10}, 0};
  EXPECT_TRUE(validate(motion.skeleton));
  return motion;
}

JointCurves curves_of_hand(const Motion& motion) {
  constexpr std::array<std::size_t, 1> kHand = {1};
  auto curves = joint_curves(motion, kHand);
  EXPECT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].joint, 1u);
  EXPECT_EQ(curves[0].positions.size(), motion.clip.num_frames * 3);
  EXPECT_EQ(curves[0].speeds.size(), motion.clip.num_frames);
  EXPECT_EQ(curves[0].angular_speeds.size(), motion.clip.num_frames);
  return curves[0];
}

/// The length of a chord of the hand's circle.
double chord(double degrees) { return 4 * std::sin(degrees / 2 * std::numbers::pi / 180); }

TEST(JointCurves, SpeedsAreCentralDifferences) {
  const JointCurves hand = curves_of_hand(crank({0, 9, 18, 48}));
  EXPECT_NEAR(hand.positions[3], 2 * std::cos(9 * kRadiansPerDegree), 1e-12);
  EXPECT_NEAR(hand.positions[4], 2 * std::sin(9 * kRadiansPerDegree), 1e-12);
  EXPECT_EQ(hand.positions[5], 0);
  const double speeds[] = {chord(9) / 0.1, chord(18) / 0.2, chord(39) / 0.2, chord(30) / 0.1};
  const double angular_speeds[] = {90, 90, 195, 300};
  for (std::size_t f = 0; f < 4; ++f) {
    EXPECT_NEAR(hand.speeds[f], speeds[f], 1e-12) << f;
    EXPECT_NEAR(hand.angular_speeds[f], angular_speeds[f], 1e-10) << f;
  }
}

TEST(JointCurves, UseTheFramesOwnTimes) {
  Motion motion = crank({0, 10, 20, 30});
  motion.clip.timeline.given = FrameTimes{{0, 0.1, 0.5, 0.75}};
  const JointCurves hand = curves_of_hand(motion);
  EXPECT_NEAR(hand.angular_speeds[0], 10 / 0.1, 1e-10);
  EXPECT_NEAR(hand.angular_speeds[1], 20 / 0.5, 1e-10);
  EXPECT_NEAR(hand.angular_speeds[2], 20 / 0.65, 1e-10);
  EXPECT_NEAR(hand.angular_speeds[3], 10 / 0.25, 1e-10);
  EXPECT_NEAR(hand.speeds[2], chord(20) / 0.65, 1e-12);
}

TEST(JointCurves, TurnsOfUpToHalfATurnAFrameAreSeenWhole) {
  const JointCurves hand = curves_of_hand(crank({0, 170, 340, 510, 510, 510, 540, 510, 510}));
  EXPECT_NEAR(hand.angular_speeds[1], 1700, 1e-9);
  EXPECT_NEAR(hand.angular_speeds[2], 1700, 1e-9);
  EXPECT_NEAR(hand.angular_speeds[4], 0, 1e-9);
  EXPECT_NEAR(hand.angular_speeds[6], 0, 1e-9) << "there and back";
  EXPECT_NEAR(hand.angular_speeds[7], 150, 1e-9);
}

TEST(JointCurves, ASingleFrameStandsStill) {
  const JointCurves hand = curves_of_hand(crank({90}));
  EXPECT_NEAR(hand.positions[1], 2, 1e-12);
  EXPECT_EQ(hand.speeds[0], 0);
  EXPECT_EQ(hand.angular_speeds[0], 0);
}

TEST(JointCurves, NoFramesAndNoJointsAreEmpty) {
  EXPECT_TRUE(curves_of_hand(crank({})).positions.empty());
  EXPECT_TRUE(joint_curves(crank({0, 1}), {}).empty());
}

TEST(JointCurves, NumbersThatAreNotFiniteAreSeenWhereTheyAreUsed) {
  const JointCurves hand = curves_of_hand(crank({0, 9, std::nan(""), 27, 36, 45}));
  EXPECT_TRUE(std::isnan(hand.positions[6]));
  for (const std::size_t f : {1u, 2u, 3u}) {
    EXPECT_FALSE(std::isfinite(hand.angular_speeds[f])) << f;
  }
  EXPECT_NEAR(hand.angular_speeds[0], 90, 1e-10);
  EXPECT_NEAR(hand.angular_speeds[4], 90, 1e-10);
}

TEST(JointCurves, TimesThatDoNotIncreaseGiveNoSpeed) {
  Motion motion = crank({0, 10, 20, 30});
  motion.clip.timeline.given = FrameTimes{{0, 0, 0.5, 0.4}};
  const JointCurves hand = curves_of_hand(motion);
  EXPECT_TRUE(std::isnan(hand.speeds[0]));
  EXPECT_NEAR(hand.angular_speeds[1], 40, 1e-10);
  EXPECT_TRUE(std::isnan(hand.speeds[3]) && std::isnan(hand.angular_speeds[3]));
}

TEST(JointCurves, AreTheSameAtTheBordersOfBlocks) {
  const Skeleton skeleton = examples::make_walk({.num_frames = 1}).skeleton;
  const std::size_t block = frames_per_block(skeleton);
  const Motion walk = examples::make_walk({.num_frames = 2 * block + 3});
  constexpr std::array<std::size_t, 2> kJoints = {5, 2};
  const auto curves = joint_curves(walk, kJoints);
  ASSERT_EQ(curves.size(), 2u);
  KinematicsOptions around;
  around.rotations = true;
  around.num_frames = 3;
  for (const std::size_t middle : {block - 1, block, 2 * block}) {
    around.first_frame = middle - 1;
    const WorldPoses poses = forward_kinematics(walk.skeleton, walk.clip, around);
    for (const JointCurves& own : curves) {
      const auto position = [&](std::size_t row) {
        return Vec3(&poses.positions[(row * poses.num_joints + own.joint) * 3]);
      };
      const double seconds = 2 * frame_time(walk.clip.timeline);
      EXPECT_EQ(Vec3(&own.positions[middle * 3]), position(1)) << middle;
      EXPECT_NEAR(own.speeds[middle], (position(2) - position(0)).norm() / seconds, 1e-9);
      EXPECT_GT(own.angular_speeds[middle], 0);
    }
  }
}

}  // namespace
}  // namespace kinefile
