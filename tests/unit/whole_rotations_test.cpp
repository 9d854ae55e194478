// SPDX-License-Identifier: MIT
// Joints that turn in any way by the numbers of several columns, and joints that follow others.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinefile/edit.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/retime.hpp"
#include "kinefile/shape.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

/// One joint that turns in any way, by rows of its numbers.
Motion turning(DofKind kind, AngleUnit unit, const std::vector<std::vector<double>>& rows) {
  Motion motion;
  motion.skeleton.angle_unit = unit;
  motion.skeleton.metres_per_unit = 1;
  Joint joint;
  joint.name = "ball";
  joint.dofs = {{kind, Vec3::UnitX(), 0, 0}};
  joint.tips = {{"", {1, 2, 3}}};
  motion.skeleton.joints = {joint};
  for (std::size_t k = 0; k < num_coordinates(joint.dofs[0]); ++k) {
    motion.skeleton.coordinates.push_back({0, channel_name(kind, k)});
  }
  motion.clip.num_frames = rows.size();
  motion.clip.num_coordinates = motion.skeleton.coordinates.size();
  for (const auto& row : rows) motion.clip.values.append(row);
  motion.clip.timeline = {FrameRate{10}, 0};
  return motion;
}

std::vector<double> row_of(const Motion& motion, std::size_t frame) {
  const auto row = motion.clip.row(frame);
  return {row.begin(), row.end()};
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-12) << k;
}

Motion halfway(const Motion& motion) {
  retime::TimeMap map;
  map.old_frames = {0.5};
  Diagnostics diagnostics;
  return retime::apply(motion, map, {}, diagnostics).value();
}

TEST(WholeRotations, AQuaternionOfNoLengthIsInterpolatedAsNoRotation) {
  const double half = std::sqrt(0.5);
  const Motion motion = turning(DofKind::Ball, AngleUnit::Degrees,
                                {{0, 0, 0, 0}, {1e200 * half, 0, 0, 1e200 * half}});
  const double eighth = std::numbers::pi / 8;
  expect_near(row_of(halfway(motion), 0), {std::cos(eighth), 0, 0, std::sin(eighth)});
}

TEST(WholeRotations, ColumnsAreNamedByWhatTheyHold) {
  EXPECT_EQ(column_names(turning(DofKind::Ball, AngleUnit::Degrees, {}).skeleton),
            (std::vector<std::string>{"ball.qw", "ball.qx", "ball.qy", "ball.qz"}));
  EXPECT_EQ(column_names(turning(DofKind::RotationVector, AngleUnit::Degrees, {}).skeleton),
            (std::vector<std::string>{"ball.rotvec_x", "ball.rotvec_y", "ball.rotvec_z"}));
  EXPECT_EQ(rest_coordinates(turning(DofKind::Ball, AngleUnit::Degrees, {}).skeleton),
            (std::vector<double>{1, 0, 0, 0}));
}

TEST(WholeRotations, ABallIsInterpolatedOnTheSphere) {
  const double s = std::sqrt(0.5);
  const Motion motion = turning(DofKind::Ball, AngleUnit::Degrees, {{2, 0, 0, 0}, {-s, -s, 0, 0}});
  const double c = std::cos(std::numbers::pi / 8);
  expect_near(row_of(halfway(motion), 0), {c, std::sin(std::numbers::pi / 8), 0, 0});
}

TEST(WholeRotations, ARotationVectorIsInterpolatedOnTheSphereAndStaysOnItsTurn) {
  // 350 and 370 degrees about z: beside a whole turn, not beside 0.
  const Motion motion =
      turning(DofKind::RotationVector, AngleUnit::Degrees, {{0, 0, 350}, {0, 0, 380}});
  expect_near(row_of(halfway(motion), 0), {0, 0, 365});
  // About different axes: half of the turn between them.
  const Motion oblique =
      turning(DofKind::RotationVector, AngleUnit::Degrees, {{90, 0, 0}, {0, 90, 0}});
  const Motion half = halfway(oblique);
  const auto dofs = rotations_of(oblique.skeleton.joints[0]);
  const auto at = [&](const Motion& m, std::size_t f) {
    return quaternion_in_row(dofs, m.clip.row(f), AngleUnit::Degrees);
  };
  const Quat middle = slerp(at(oblique, 0), at(oblique, 1), 0.5);
  EXPECT_LT(angle_between(middle, at(half, 0)), 1e-7);
}

TEST(WholeRotations, UnwrapTakesJumpsOfSignsAndTurnsOut) {
  const Motion ball =
      turning(DofKind::Ball, AngleUnit::Degrees, {{1, 0, 0, 0}, {-1, 0.1, 0, 0}, {1, 0.2, 0, 0}});
  EXPECT_EQ(row_of(edit::unwrap(ball), 1), (std::vector<double>{1, -0.1, 0, 0}));
  const Motion vector = turning(DofKind::RotationVector, AngleUnit::Degrees,
                                {{0, 170, 0}, {0, -170, 0}, {0, -150, 0}});
  expect_near(row_of(edit::unwrap(vector), 1), {0, 190, 0});
  expect_near(row_of(edit::unwrap(vector), 2), {0, 210, 0});
  EXPECT_EQ(row_of(edit::unwrap(vector), 0), (std::vector<double>{0, 170, 0}));
}

TEST(WholeRotations, SmoothKeepsSignsAndTurns) {
  std::vector<std::vector<double>> rows;
  for (int f = 0; f < 40; ++f) rows.push_back({0, 0, 10.0 * f + (f % 2 == 0 ? 2 : -2)});
  const auto smooth = edit::smooth(turning(DofKind::RotationVector, AngleUnit::Degrees, rows), 0.5);
  ASSERT_TRUE(smooth);
  for (std::size_t f = 12; f < 28; ++f) {
    EXPECT_NEAR(smooth->clip.row(f)[2], 10.0 * static_cast<double>(f), 0.5) << f;
  }
}

TEST(WholeRotations, WrittenRotationsAreNearTheNumbersThatWereThere) {
  const DegreeOfFreedom dof{DofKind::RotationVector, Vec3::UnitX(), 0, 0};
  std::vector<double> row = {0, 0, -700};
  const Quat turn(Eigen::AngleAxisd(30 * kRadiansPerDegree, Vec3::UnitZ()));
  set_whole_rotation(dof, turn, AngleUnit::Degrees, row);
  expect_near(row, {0, 0, -690});
  set_whole_rotation(dof, Quat::Identity(), AngleUnit::Degrees, row);
  expect_near(row, {0, 0, -720});
  row = {0, 0, 100};
  set_whole_rotation(dof, Quat::Identity(), AngleUnit::Degrees, row);
  expect_near(row, {0, 0, 0});
  const DegreeOfFreedom ball{DofKind::Ball, Vec3::UnitX(), 0, 0};
  row = {-1, 0, 0, 0};
  set_whole_rotation(ball, turn, AngleUnit::Degrees, row);
  EXPECT_LT(row[0], 0);
}

/// An arm whose second joint follows the first, twice as far the other way around.
Motion following() {
  Motion motion;
  motion.skeleton.angle_unit = AngleUnit::Degrees;
  for (const char* name : {"arm", "hand"}) motion.skeleton.joints.emplace_back().name = name;
  motion.skeleton.joints[1].parent = 0;
  motion.skeleton.joints[1].offset = {0, 1, 0};
  for (Joint& joint : motion.skeleton.joints) {
    joint.dofs = {{DofKind::Rotation, Vec3::UnitX(), 0, 0}};
  }
  motion.skeleton.joints[1].dofs[0].gain = -2;
  motion.skeleton.coordinates = {{0, "Xrotation"}};
  motion.clip.num_frames = 3;
  motion.clip.num_coordinates = 1;
  motion.clip.values = {10, 20, 40};
  motion.clip.timeline = {FrameRate{10}, 0};
  return motion;
}

TEST(Following, UnwrapTakesOutWholeTurnsOfAllReaders) {
  Motion motion = following();
  motion.clip.values = {10, 380, 40};
  EXPECT_EQ(row_of(edit::unwrap(motion), 1), std::vector<double>{20});
  motion.skeleton.joints[1].dofs[0].gain = 0.5;  // twice around, to come round
  motion.clip.values = {10, 365, 40};
  EXPECT_EQ(row_of(edit::unwrap(motion), 1), std::vector<double>{365});
  motion.clip.values = {10, 740, 40};
  EXPECT_EQ(row_of(edit::unwrap(motion), 1), std::vector<double>{20});
  motion.skeleton.joints[1].dofs[0].gain = 0.3;  // never together
  EXPECT_EQ(row_of(edit::unwrap(motion), 1), std::vector<double>{740});
}

TEST(Following, AJointThatCannotFollowAsItDidIsTold) {
  const Motion motion = following();
  Diagnostics diagnostics;
  const auto same = shape::onto_skeleton(motion, motion.skeleton, diagnostics);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->clip.values, motion.clip.values);
  EXPECT_EQ(diagnostics.count(Severity::Warning), 1u) << "the unit of length";
  Skeleton other = motion.skeleton;
  other.joints[1].dofs[0].gain = -1;
  const auto moved = shape::onto_skeleton(motion, other, diagnostics);
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->clip.values, motion.clip.values) << "the hand follows the arm";
  EXPECT_EQ(diagnostics.items().back().message,
            "joint 'hand' cannot turn as it did: up to 40 degrees are left out");
}

TEST(Following, AMirrorLeavesToTheLeaderWhatFollows) {
  Motion motion = following();
  Diagnostics diagnostics;
  const auto image = edit::mirror(motion, 0, false, diagnostics);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->clip.values, motion.clip.values);
  EXPECT_TRUE(diagnostics.items().empty()) << text_of(diagnostics);
}

TEST(Following, ScaleScalesALengthThatFollowsAnAngle) {
  Motion motion = following();
  DegreeOfFreedom& slide = motion.skeleton.joints[1].dofs[0];
  slide = {DofKind::Translation, Vec3::UnitY(), 0, 0, -1, 1};
  slide.gain = 0.01;
  slide.shift = 0.5;
  const Motion scaled = edit::scale(motion, 2);
  EXPECT_EQ(scaled.clip.values, motion.clip.values);
  const DegreeOfFreedom& dof = scaled.skeleton.joints[1].dofs[0];
  EXPECT_EQ(dof.gain, 0.02);
  EXPECT_EQ(dof.shift, 1);
  EXPECT_EQ(dof.upper, 2);
}

TEST(Following, OtherChannelsHaveItsValues) {
  Diagnostics diagnostics;
  const auto channels = shape::with_channels(following(), {}, diagnostics);
  ASSERT_TRUE(channels);
  EXPECT_EQ(row_of(*channels, 1), (std::vector<double>{20, -40}));
  EXPECT_TRUE(is_plain(channels->skeleton.joints[1].dofs[0]));
}

}  // namespace
}  // namespace kinefile::test
