// SPDX-License-Identifier: MIT
#include "kinefile/limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace kinefile::test {
namespace {

/// One hinge that turns from -1 to 1 at up to 2 a second, ten frames a second.
Motion hinge(const std::vector<double>& values) {
  Motion motion;
  Joint joint;
  joint.name = "hinge";
  joint.dofs.push_back({DofKind::Rotation, Vec3::UnitX(), 0, 0, -1, 1, 2});
  motion.skeleton.joints.push_back(joint);
  motion.skeleton.coordinates.push_back({0, "q"});
  motion.clip.num_frames = values.size();
  motion.clip.num_coordinates = 1;
  motion.clip.values = values;
  motion.clip.timeline = {FrameRate{10}, 0};
  return motion;
}

TEST(Limits, NothingIsSaidOfAJointWithinThem) {
  EXPECT_TRUE(find_limit_breaches(hinge({-1, -0.8, -0.6, -0.4})).empty());
  EXPECT_TRUE(find_limit_breaches(hinge({})).empty());
}

TEST(Limits, EachSideHasItsFirstAndItsWorstFrame) {
  const auto breaches = find_limit_breaches(hinge({1.05, 1.1, 1.2, 1.1, 1.0, 0.9}));
  ASSERT_EQ(breaches.size(), 1u);
  EXPECT_EQ(breaches[0].kind, LimitBreach::Kind::Above);
  EXPECT_EQ(breaches[0].first_frame, 0u);
  EXPECT_EQ(breaches[0].num_frames, 4u);
  EXPECT_EQ(breaches[0].worst_frame, 2u);
  EXPECT_EQ(breaches[0].worst, 1.2);
  EXPECT_EQ(breaches[0].limit, 1);
}

TEST(Limits, AValueIsBeyondOneBound) {
  const DegreeOfFreedom dof = hinge({}).skeleton.joints[0].dofs[0];
  EXPECT_EQ(breach_of(dof, -1.1), LimitBreach::Kind::Below);
  EXPECT_EQ(breach_of(dof, 1.1), LimitBreach::Kind::Above);
  EXPECT_EQ(breach_of(dof, 1 + 1e-12), std::nullopt);
  EXPECT_EQ(breach_of(dof, std::nan("")), std::nullopt);
}

TEST(Limits, PeopleAreToldDegreesAndMetres) {
  Skeleton skeleton;
  skeleton.angle_unit = AngleUnit::Radians;
  DegreeOfFreedom dof;
  EXPECT_DOUBLE_EQ(told_unit(dof, skeleton).factor * std::acos(-1.0), 180);
  EXPECT_EQ(told_unit(dof, skeleton).name, "deg");
  skeleton.angle_unit = AngleUnit::Degrees;
  EXPECT_EQ(told_unit(dof, skeleton).factor, 1);
  dof.kind = DofKind::Translation;
  EXPECT_EQ(told_unit(dof, skeleton).name, "units");
  skeleton.metres_per_unit = 0.01;
  EXPECT_EQ(told_unit(dof, skeleton).factor, 0.01);
  EXPECT_EQ(told_unit(dof, skeleton).name, "m");
}

TEST(Limits, SpeedIsTheWayFromFrameToFrame) {
  const auto breaches = find_limit_breaches(hinge({0, 0.2, 0.5, 0.5}));
  ASSERT_EQ(breaches.size(), 1u);
  EXPECT_EQ(breaches[0].kind, LimitBreach::Kind::TooFast);
  EXPECT_EQ(breaches[0].first_frame, 2u);
  EXPECT_NEAR(breaches[0].worst, 3, 1e-12);
  EXPECT_EQ(breaches[0].limit, 2);
}

TEST(Limits, BoundTheValueThatAJointMakesOfItsColumn) {
  Motion motion = hinge({0, 0.05, 0.1});
  motion.skeleton.joints[0].dofs[0].gain = -3;
  motion.skeleton.joints[0].dofs[0].shift = -0.75;
  const auto breaches = find_limit_breaches(motion);
  ASSERT_EQ(breaches.size(), 1u);
  EXPECT_EQ(breaches[0].kind, LimitBreach::Kind::Below);
  EXPECT_NEAR(breaches[0].worst, -1.05, 1e-12);
  EXPECT_EQ(breaches[0].limit, -1);
  motion.skeleton.joints[0].dofs[0].max_speed = 1.25;  // of 1.5 that it has
  EXPECT_EQ(find_limit_breaches(motion).size(), 2u);
}

TEST(Limits, ValuesThatAreNoNumbersArePassedOver) {
  EXPECT_TRUE(find_limit_breaches(hinge({0, std::nan(""), 0})).empty());
}

}  // namespace
}  // namespace kinefile::test
