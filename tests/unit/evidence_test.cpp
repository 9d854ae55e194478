// SPDX-License-Identifier: MIT
#include "kinefile/evidence.hpp"

#include <gtest/gtest.h>

#include "kinefile/edit.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/robot.hpp"
#include "support/figures.hpp"
#include "support/robots.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

using Row = std::vector<double>;

/// A person who moves along z by a step a frame, turned by some angles of z, x and y.
Motion travelling(const std::vector<Bone>& bones, const Vec3& start, const Vec3& step,
                  const Vec3& angles, int num_frames = 20) {
  std::vector<Row> rows;
  for (int f = 0; f < num_frames; ++f) {
    const Vec3 place = start + f * step;
    rows.push_back(row_of(bones, {place[0], place[1], place[2], angles[0], angles[1], angles[2]}));
  }
  return motion_of(bvh_of_figure(bones, rows));
}

Vec3 root_in(const Motion& motion, std::size_t frame, std::size_t joint = 0) {
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip);
  return Vec3(&poses.positions[(frame * poses.num_joints + joint) * 3]);
}

TEST(FindUpAxis, OfAPersonWhoLies) {
  // On the back along z: the legs show z, the rest pose and the ground y.
  const Motion lying = travelling(person(), {0, 12, 0}, {0, 0, 4}, {0, -90, 0});
  const UpAxis up = find_up_axis(lying);
  EXPECT_EQ(up.axis, 1u);
  EXPECT_NE(up.certainty, Certainty::Known);
  EXPECT_EQ(root_in(edit::in_place(lying, ignored()), 19), Vec3(0, 12, 0));
  const Motion turned = edit::up(lying, 2, ignored());
  EXPECT_LT((root_in(turned, 10) - Vec3(0, -40, 12)).norm(), 1e-9);
  EXPECT_EQ(edit::up(lying, 1, ignored()).clip.values, lying.clip.values);
}

TEST(FindUpAxis, OfAFigureWhoseRestPoseDoesNotStand) {
  // At rest along y, in all frames turned to stand along z.
  const Motion standing = travelling(person(), {0, 0, 90}, {0, 3, 0}, {0, 90, 0});
  EXPECT_EQ(find_up_axis(standing).axis, 2u);
  EXPECT_EQ(find_up_axis(standing).certainty, Certainty::Clear);
}

TEST(FindUpAxis, OfAnAnimalAndOfAFigureWithAProp) {
  // The body is much longer along z than the legs are high.
  const std::vector<Bone> dog = {{"Body", 0, {0, 0, 0}},
                                 {"FrontLeg_L", 1, {5, 0, 60}, Vec3(0, -30, 0)},
                                 {"FrontLeg_R", 1, {-5, 0, 60}, Vec3(0, -30, 0)},
                                 {"HindLeg_L", 1, {5, 0, 0}, Vec3(0, -30, 0)},
                                 {"HindLeg_R", 1, {-5, 0, 0}, Vec3(0, -30, 0)},
                                 {"Head", 1, {0, 5, 90}, Vec3(0, 0, 30)}};
  EXPECT_EQ(find_up_axis(travelling(dog, {0, 30, 0}, {0, 0, 2}, {0, 0, 0})).axis, 1u);
  std::vector<Bone> bones = person();
  bones.push_back({"Pole", 1, {0, 0, 0}, Vec3(0, 0, 900)});
  EXPECT_EQ(find_up_axis(travelling(bones, {0, 90, 0}, {0, 0, 2}, {0, 0, 0})).axis, 1u);
}

TEST(FindUpAxis, IsKnownWhereTheCallerOrTheFormatSaysIt) {
  Motion motion = travelling(person(), {0, 90, 0}, {0, 0, 1}, {0, 0, 0});
  motion.skeleton.up = 0;
  EXPECT_EQ(find_up_axis(motion).axis, 0u);
  EXPECT_EQ(find_up_axis(motion).certainty, Certainty::Known);
  const Motion turned = edit::up(motion, 1, ignored());
  EXPECT_LT((root_in(turned, 0) - Vec3(-90, 0, 0)).norm(), 1e-9);
  EXPECT_EQ(turned.skeleton.up, 1u);
  motion.skeleton.up = 3;
  EXPECT_EQ(validate(motion.skeleton).error().code, "MDL001");
}

TEST(FindUpAxis, ADoubtfulOneIsTold) {
  const Motion motion =
      motion_of(bvh_of_figure({{"a", 0, {0, 0, 0}, Vec3(0, 1, 1)}}, {{0, 0, 0, 0, 0, 0}}));
  Diagnostics diagnostics;
  EXPECT_EQ(settle_up_axis(motion, diagnostics).axis, 1u);
  EXPECT_EQ(codes_of(diagnostics), std::vector<std::string>{"MOT005"});
}

TEST(FindFacing, IsForwardOfTheLineBetweenTheHalves) {
  const Motion motion = travelling(person(), {0, 90, 0}, {0, 0, 1}, {0, 0, 90});
  const Facing facing = find_facing(motion, 1);
  ASSERT_TRUE(facing.direction);
  EXPECT_LT((*facing.direction - Vec3(1, 0, 0)).norm(), 1e-9);
  EXPECT_LT((*find_facing({motion.skeleton, {}}, 1).direction - Vec3(0, 0, 1)).norm(), 1e-9);
  const Motion none = motion_of(bvh_of_figure({{"a", 0}}, {{0, 0, 0, 0, 0, 0}}));
  EXPECT_FALSE(find_facing(none, 1).direction);
}

/// A person whose rest pose is flat, with all bones along x; stands in all frames.
std::vector<Bone> flat_person() {
  return {{"Hips", 0, {0, 0, 0}},       {"Spine", 1, {12, 2, 0}, Vec3(60, 0, 0)},
          {"LeftLeg", 1, {-5, 0, 9}},   {"LeftFoot", 2, {-84, 0, 0}, Vec3(0, -4, 0)},
          {"RightLeg", 1, {-5, 0, -9}}, {"RightFoot", 2, {-84, 0, 0}, Vec3(0, -4, 0)}};
}

TEST(FindLengthUnit, IsOfTheStandingFigure) {
  const Motion motion = travelling(flat_person(), {0, 89, 0}, {0.1, 0, 0}, {90, 0, 0});
  EXPECT_NEAR(standing_height(motion, 1), 161, 1e-9);
  const LengthUnit unit = find_length_unit(motion);
  EXPECT_EQ(unit.metres, 0.01);
  EXPECT_EQ(unit.certainty, Certainty::Clear);
  EXPECT_EQ(find_length_unit(edit::scale(motion, 10)).metres, 0.001);
  EXPECT_EQ(find_length_unit(edit::scale(motion, 0.01)).metres, 1);
  EXPECT_EQ(find_length_unit(edit::scale(motion, 0.1)).certainty, Certainty::Doubtful);
}

/// A root that never moves above hips that carry the travel.
Motion with_still_root(const Vec3& root_angles) {
  std::vector<Bone> bones = {{"Reference", 0, {0, 0, 0}}};
  for (Bone bone : person()) {
    ++bone.depth;
    bone.has_positions = bone.depth == 1;
    bones.push_back(bone);
  }
  bones[1].offset = {0, 90, 0};
  std::vector<Row> rows;
  for (int f = 0; f < 6; ++f) {
    rows.push_back(row_of(bones, {0, 0, 0, root_angles[0], root_angles[1], root_angles[2], 1.0 * f,
                                  90.0 + f % 2, 5.0 * f}));
  }
  return motion_of(bvh_of_figure(bones, rows));
}

TEST(FindTravellers, AreBelowARootThatNeverMoves) {
  const Motion motion = with_still_root({0, 0, 0});
  EXPECT_EQ(find_travellers(motion), std::vector<std::size_t>{1});
  EXPECT_EQ(find_travellers(travelling(person(), {0, 90, 0}, {0, 0, 5}, {0, 0, 0})),
            std::vector<std::size_t>{0});
  const Motion held = edit::in_place(motion, ignored());
  EXPECT_EQ(root_in(held, 5, 1), Vec3(0, 91, 0));
  const auto looped = edit::loop(motion, 2, 2, ignored());
  ASSERT_TRUE(looped);
  for (std::size_t f = 0; f < 10; ++f) {
    EXPECT_NEAR(root_in(*looped, f, 1).z(), 5.0 * static_cast<double>(f), 1e-9) << f;
  }
}

TEST(FindTravellers, AreHeldInTheWorldWhereTheStillRootIsTurned) {
  const Motion motion = with_still_root({0, 0, 30});
  const Vec3 start = root_in(motion, 0, 1);
  const Vec3 held = root_in(edit::in_place(motion, ignored()), 5, 1);
  EXPECT_NEAR(held.x(), start.x(), 1e-9);
  EXPECT_NEAR(held.y(), 91, 1e-9);
  EXPECT_NEAR(held.z(), start.z(), 1e-9);
  const auto looped = edit::loop(motion, 2, 2, ignored());
  ASSERT_TRUE(looped);
  const Vec3 step = root_in(motion, 1, 1) - root_in(motion, 0, 1);
  const Vec3 reached = root_in(*looped, 9, 1) - root_in(*looped, 0, 1);
  EXPECT_NEAR(reached.x(), 9 * step.x(), 1e-9);
  EXPECT_NEAR(reached.z(), 9 * step.z(), 1e-9);
}

TEST(FindTravellers, ARootThatWaversIsStillAndABallCarriesNobody) {
  Motion motion = with_still_root({0, 0, 0});
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    motion.clip.mutate()[f][0] = f % 2 == 0 ? 1e-6 : -1e-6;
  }
  EXPECT_EQ(find_travellers(motion), std::vector<std::size_t>{1});
  std::vector<Bone> bones = {{"Reference", 0, {0, 0, 0}}};
  for (Bone bone : person()) {
    ++bone.depth;
    bones.push_back(bone);
  }
  bones.push_back({"Ball", 1, {50, 0, 0}, std::nullopt, true});
  std::vector<Row> rows;
  for (int f = 0; f < 5; ++f) {
    Row row = row_of(bones, {});
    row[row.size() - 6] = 50 + 40 * f;
    rows.push_back(row);
  }
  EXPECT_EQ(find_travellers(motion_of(bvh_of_figure(bones, rows))), std::vector<std::size_t>{0});
}

TEST(FindUpAxis, LegsGoOnAboveBonesOfOtherNames) {
  // Between foot and toe lies a metatarsal; the toes alone would speak for y.
  std::vector<Bone> bones = {{"pelvis", 0, {0, 0, 0}},
                             {"thigh.L", 1, {9, 0, -5}},
                             {"foot.L", 2, {0, 0, -80}},
                             {"metatarsal.L", 3, {0, -4, -3}},
                             {"toe.L", 4, {0, -8, 0}, Vec3(0, -4, 0)},
                             {"spine", 1, {0, 0, 20}, Vec3(0, 0, 60)}};
  const Motion motion = travelling(bones, {0, 0, 90}, {0, -2, 0}, {0, 0, 0});
  EXPECT_EQ(find_up_axis(motion).axis, 2u);
  EXPECT_EQ(find_up_axis(motion).certainty, Certainty::Clear);
}

TEST(FindUpAxis, StaysWhatItWasWithinOneCommand) {
  // In place, nothing travels any more, and the evidence of the ground is gone.
  Motion lying = travelling(person(), {0, 12, 0}, {0, 0, 4}, {0, -90, 0});
  lying = edit::in_place(lying, ignored());
  Diagnostics diagnostics;
  EXPECT_LT((root_in(edit::up(lying, 2, diagnostics), 3) - Vec3(0, 0, 12)).norm(), 1e-9);
  EXPECT_EQ(codes_of(diagnostics), std::vector<std::string>{});
}

TEST(FindUpAxis, OfABodyMotionIsZWhateverItLooksLike) {
  Component links;  // two links that lie apart along y, and travel along z
  links.kind = ComponentKind::Poses;
  links.content = kLinkPosition;
  links.num_parts = 2;
  links.num_frames = 2;
  links.values = {0, 0, 0, 1, 0, 0, 0, 0, 2, 0, 1, 0, 0, 0,
                  0, 0, 5, 1, 0, 0, 0, 0, 2, 5, 1, 0, 0, 0};
  const UpAxis up = find_up_axis(robot::motion_of_component(links));
  EXPECT_EQ(up.axis, 2u);
  EXPECT_EQ(up.certainty, Certainty::Known);
}

}  // namespace
}  // namespace kinefile::test
