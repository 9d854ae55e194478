// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "kinefile/edit.hpp"
#include "kinefile/evidence.hpp"
#include "kinefile/kinematics.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

Motion upwards(const Motion& motion, std::size_t axis) {
  Diagnostics diagnostics;
  Motion result = edit::up(motion, axis, diagnostics);
  EXPECT_EQ(test::text_of(diagnostics), "");
  EXPECT_TRUE(validate(result.skeleton));
  return result;
}

WorldPoses placed(const Motion& motion) {
  KinematicsOptions options;
  options.tips = true;
  return forward_kinematics(motion.skeleton, motion.clip, options);
}

void expect_turned_to_z(const Array<double>& before, const Array<double>& after) {
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); i += 3) {
    EXPECT_NEAR(after[i], before[i], 1e-10);
    EXPECT_NEAR(after[i + 1], -before[i + 2], 1e-10);
    EXPECT_NEAR(after[i + 2], before[i + 1], 1e-10);
  }
}

/// A figure with scales, a free root and turned axes, higher than it is deep.
Motion odd_figure() {
  Motion motion;
  Joint root;
  root.name = "root";
  root.dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  Joint arm;
  arm.name = "arm";
  arm.parent = 0;
  arm.offset = {1, 9, 2};
  arm.rest_rotation = Quat(0.5, 0.5, 0.5, -0.5);
  arm.dofs = {{DofKind::Translation, Vec3::UnitZ(), 7, 0.5},
              {DofKind::Rotation, Vec3(0.6, 0, 0.8), 8, 0},
              {DofKind::Rotation, Vec3::UnitZ(), 9, 0},
              {DofKind::TailTranslation, Vec3::UnitZ(), 10, 0},
              {DofKind::TailScale, Vec3::UnitZ(), 11, 1}};
  arm.tips = {{"", {3, 4, 5}}};
  Joint mimic;
  mimic.name = "mimic";
  mimic.parent = 0;
  mimic.offset = {0, 8, 1};
  mimic.dofs = {{DofKind::Rotation, Vec3::UnitZ(), 9, 0}};
  mimic.tips = {{"", {1, 1, 1}}};
  motion.skeleton.joints = {root, arm, mimic};
  for (std::size_t c = 0; c < 12; ++c)
    motion.skeleton.coordinates.push_back({c < 7 ? 0u : 1u, "q"});
  motion.clip.num_frames = 2;
  motion.clip.num_coordinates = 12;
  motion.clip.values = {1, 2, 3, 0.9, 0.1, 0.3, -0.3, 0.7, 20, 30, 0.4, 1.5,
                        1, 2, 4, 0.9, 0.2, 0.3, -0.2, 0.8, 25, 35, 0.5, 1.25};
  return motion;
}

TEST(WithUpAxis, TurnsTheWorldByAQuarter) {
  const Motion walk = examples::make_walk({.num_frames = 20});
  const Motion turned = upwards(walk, 2);
  expect_turned_to_z(placed(walk).positions, placed(turned).positions);
  expect_turned_to_z(placed(walk).tips, placed(turned).tips);
  EXPECT_EQ(turned.skeleton.coordinates[1].channel, "Zposition");
  EXPECT_EQ(turned.skeleton.coordinates[2].channel, "Yposition");
  EXPECT_EQ(turned.skeleton.coordinates[3].channel, "Yrotation");
}

TEST(WithUpAxis, ThereAndBackIsTheSameBits) {
  const Motion walk = examples::make_walk({.num_frames = 20});
  const Motion again = upwards(upwards(walk, 2), 1);
  EXPECT_EQ(again.clip.values, walk.clip.values);
  Document before;
  before.content = walk;
  Document after;
  after.content = again;
  EXPECT_EQ(test::write_to_string(after), test::write_to_string(before));
}

TEST(WithUpAxis, TurnsEveryWayToMove) {
  const Motion figure = odd_figure();
  const Motion turned = upwards(figure, 2);
  expect_turned_to_z(placed(figure).positions, placed(turned).positions);
  expect_turned_to_z(placed(figure).tips, placed(turned).tips);
  const Motion again = upwards(turned, 1);
  EXPECT_EQ(again.clip.values, figure.clip.values);
  EXPECT_EQ(again.skeleton.joints[1].dofs[0].axis, figure.skeleton.joints[1].dofs[0].axis);
  EXPECT_EQ(again.skeleton.joints[1].dofs[0].rest, 0.5);
}

TEST(WithUpAxis, NotesThatTheAxisPointsUpAlready) {
  const Motion walk = examples::make_walk({.num_frames = 20});
  Diagnostics diagnostics;
  EXPECT_EQ(edit::up(walk, 1, diagnostics).clip.values, walk.clip.values);
  EXPECT_EQ(test::text_of(diagnostics), "note[EDT009]: y points up already\n");
}

TEST(GuessUpAxis, TellsItFromTheMotion) {
  const Motion walk = examples::make_walk({.num_frames = 200});
  EXPECT_EQ(find_up_axis(walk).axis, 1u);
  EXPECT_EQ(find_up_axis(upwards(walk, 2)).axis, 2u);
}

TEST(GuessUpAxis, TellsItFromTheRestPoseWithoutFrames) {
  const Motion walk = examples::make_walk({.num_frames = 0});
  EXPECT_EQ(find_up_axis(walk).axis, 1u);
  EXPECT_EQ(find_up_axis(upwards(walk, 2)).axis, 2u);
}

TEST(GuessUpAxis, IsYInDoubt) {
  EXPECT_EQ(find_up_axis(Motion{}).axis, 1u);
  Motion nowhere = examples::make_walk({.num_frames = 2});
  for (double& value : nowhere.clip.values.mutate()) value = std::nan("");
  EXPECT_EQ(find_up_axis(nowhere).axis, 1u);
}

TEST(Scaled, MultipliesEveryPlace) {
  for (const Motion& motion : {examples::make_walk({.num_frames = 5}), odd_figure()}) {
    const Motion twice = edit::scale(motion, 2);
    const WorldPoses before = placed(motion);
    const WorldPoses after = placed(twice);
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
      EXPECT_EQ(after.positions[i], 2 * before.positions[i]);
    }
    for (std::size_t i = 0; i < before.tips.size(); ++i) {
      EXPECT_EQ(after.tips[i], 2 * before.tips[i]);
    }
    EXPECT_EQ(edit::scale(twice, 0.5).clip.values, motion.clip.values);
  }
}

TEST(InPlace, KeepsTheRootOverItsStart) {
  const Motion walk = examples::make_walk({.num_frames = 30});
  const Motion there = edit::in_place(walk, test::ignored());
  for (std::size_t f = 0; f < 30; ++f) {
    EXPECT_EQ(there.clip.row(f)[0], walk.clip.row(0)[0]);
    EXPECT_EQ(there.clip.row(f)[1], walk.clip.row(f)[1]);
    EXPECT_EQ(there.clip.row(f)[2], walk.clip.row(0)[2]);
    EXPECT_EQ(there.clip.row(f)[7], walk.clip.row(f)[7]);
  }
}

TEST(InPlace, HoldsFreeRootsAndTurnedOnes) {
  Motion figure = odd_figure();
  EXPECT_EQ(edit::in_place(figure, test::ignored()).clip.row(1)[2], 3);
  Joint& root = figure.skeleton.joints[0];
  root.dofs = {{DofKind::Translation, Vec3(0, 0.6, 0.8), 0, 0},
               {DofKind::Translation, Vec3(0, 0.8, -0.6), 1, 0}};
  const WorldPoses before = placed(figure);
  figure.clip.mutate()[1][0] = 5;
  const double height = placed(figure).positions[9 + 1];
  const WorldPoses after = placed(edit::in_place(figure, test::ignored()));
  EXPECT_NEAR(after.positions[9 + 2], before.positions[2], 1e-12);
  EXPECT_NEAR(after.positions[9 + 1], height, 1e-12);
}

TEST(InPlace, LeavesARootThatCannotSlide) {
  Motion motion;
  motion.skeleton.joints.resize(1);
  motion.clip.num_frames = 2;
  EXPECT_EQ(edit::in_place(motion, test::ignored()).clip.num_frames, 2u);
}

TEST(InPlace, PassesOverNumbersThatAreNotFinite) {
  Motion walk = examples::make_walk({.num_frames = 3});
  const double start = walk.clip.row(1)[2];
  walk.clip.mutate()[0][2] = std::nan("");
  const Motion there = edit::in_place(walk, test::ignored());
  EXPECT_TRUE(std::isnan(there.clip.row(0)[2]));
  EXPECT_EQ(there.clip.row(2)[2], start);
}

}  // namespace
}  // namespace kinefile
