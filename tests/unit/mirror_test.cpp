// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kinefile/bvh.hpp"
#include "kinefile/compare.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/evidence.hpp"
#include "kinefile/kinematics.hpp"
#include "support/figures.hpp"
#include "support/support.hpp"
#include "support/threads.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

Motion in_mirror(const Motion& motion, std::size_t axis = 0) {
  Diagnostics diagnostics;
  auto result = edit::mirror(motion, axis, false, diagnostics);
  EXPECT_TRUE(result) << to_string(result.error());
  // Halves of these small skeletons may differ much.
  EXPECT_EQ(diagnostics.count_of("EDT015", Severity::Warning), diagnostics.items().size())
      << test::text_of(diagnostics);
  return result ? std::move(*result) : Motion{};
}

std::size_t joint_of(const Motion& motion, const std::string& name) {
  std::size_t j = 0;
  while (j < motion.skeleton.joints.size() && motion.skeleton.joints[j].name != name) ++j;
  return j;
}

Vec3 place_of(const Motion& motion, std::size_t frame, const std::string& name) {
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip);
  const std::size_t at = (frame * poses.num_joints + joint_of(motion, name)) * 3;
  return {poses.positions[at], poses.positions[at + 1], poses.positions[at + 2]};
}

Vec3 across(Vec3 place, Eigen::Index axis = 0) {
  place[axis] = -place[axis];
  return place;
}

/// A skeleton of a root and some joints on it, each turning about three axes.
Motion star(const std::vector<std::pair<std::string, Vec3>>& arms) {
  std::string text =
      "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\n"
      "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
  std::string row = "1 2 3 10 20 30";
  double angle = 5;
  for (const auto& [name, offset] : arms) {
    text += "JOINT " + name + "\n{\nOFFSET " + std::to_string(offset[0]) + " " +
            std::to_string(offset[1]) + " " + std::to_string(offset[2]) +
            "\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n";
    for (int k = 0; k < 3; ++k) row += " " + std::to_string(angle += 7);
  }
  return test::motion_of(text + "}\nMOTION\nFrames: 1\nFrame Time: 0.1\n" + row + "\n");
}

TEST(Mirrored, PutsEveryJointWhereItsOtherHalfWasInTheMirror) {
  const Motion walk = examples::make_walk({.num_frames = 40});
  const Motion image = in_mirror(walk);
  for (const std::size_t frame : {0u, 17u, 39u}) {
    for (const auto& [name, other] :
         {std::pair("LeftHand", "RightHand"), {"RightToe", "LeftToe"}, {"Head", "Head"}}) {
      EXPECT_LT((place_of(image, frame, name) - across(place_of(walk, frame, other))).norm(), 1e-10)
          << name << " in frame " << frame;
    }
  }
}

TEST(Mirrored, TwiceIsTheSameMotionBitForBit) {
  const Motion walk = examples::make_walk({.num_frames = 40});
  EXPECT_EQ(in_mirror(in_mirror(walk)).clip.values, walk.clip.values);
  EXPECT_EQ(in_mirror(walk).clip.row(3)[0], -walk.clip.row(3)[0]);
}

TEST(Mirrored, AlongZTurnsTheOtherWay) {
  Motion pair = star({{"front", {0, 0, 4}}, {"back", {0, 0, -4}}});
  pair.skeleton.up = 1;
  const Motion image = in_mirror(pair, 2);
  EXPECT_LT((place_of(image, 0, "front") - across(place_of(pair, 0, "back"), 2)).norm(), 1e-12);
  EXPECT_EQ(in_mirror(image, 2).clip.values, pair.clip.values);
}

TEST(Mirrored, PairsByTheNamesThatAreInUse) {
  const std::vector<std::pair<std::string, std::string>> names = {
      {"LeftArm", "RightArm"}, {"arm_l", "arm_r"},    {"L_Arm", "R_Arm"},
      {"Arm.L", "Arm.R"},      {"lfemur", "rfemur"},  {"handL", "handR"},
      {"左腕", "右腕"},        {"upleft", "upright"}, {"Bip L Arm", "Bip R Arm"}};
  for (const auto& [left, right] : names) {
    // They do not lie like each other in the mirror, so that nothing but the names pairs them.
    const Motion pair = star({{left, {3, 0, 0}}, {right, {-9, 5, 0}}});
    const Motion image = in_mirror(pair);
    EXPECT_EQ(image.clip.row(0)[6], -pair.clip.row(0)[9]) << left;
    EXPECT_EQ(image.clip.row(0)[7], pair.clip.row(0)[10]) << left;
    EXPECT_EQ(image.clip.row(0)[11], -pair.clip.row(0)[8]) << left;
  }
}

TEST(Mirrored, PairsByPlaceWithoutNames) {
  const Motion pair = star({{"a", {3, 1, 0}}, {"b", {-3.01, 1, 0}}, {"c", {0, 2, 0}}});
  const Motion image = in_mirror(pair);
  EXPECT_EQ(image.clip.row(0)[7], pair.clip.row(0)[10]);
  EXPECT_EQ(image.clip.row(0)[13], pair.clip.row(0)[13]);
}

TEST(Mirrored, PairsRepeatedNamesInTheirOrder) {
  Motion motion = star({{"a", {3, 0, 0}}, {"b", {4, 0, 0}}, {"c", {-3, 0, 0}}, {"d", {-4, 0, 0}}});
  for (std::size_t j = 1; j < 5; ++j) {
    motion.skeleton.joints[j].name = j < 3 ? "LeftToe" : "RightToe";
  }
  const Motion image = in_mirror(motion);
  EXPECT_EQ(image.clip.row(0)[7], motion.clip.row(0)[13]);
  EXPECT_EQ(image.clip.row(0)[10], motion.clip.row(0)[16]);
}

TEST(Mirrored, RefusesAJointWithoutOtherHalf) {
  const Motion odd = star({{"LeftArm", {3, 0, 0}}, {"tail", {2, 0, 0}}});
  Diagnostics diagnostics;
  const auto refused = edit::mirror(odd, 0, false, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "EDT004");
  EXPECT_EQ(refused.error().message,
            "joint 'LeftArm' has no other half, by name or by where it lies, and does not lie in "
            "the plane of the mirror");
  const auto image = edit::mirror(odd, 0, true, diagnostics);
  ASSERT_TRUE(image);
  EXPECT_EQ(test::codes_of(diagnostics), (std::vector<std::string>{"EDT004", "EDT004"}));
  EXPECT_EQ(image->clip.row(0)[6], -odd.clip.row(0)[6]);
}

/// Two arms whose rotations stand in different orders.
constexpr char kTwoOrders[] =
    "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 0\n"
    "JOINT Left\n{\nOFFSET 2 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
    "End Site\n{\nOFFSET 1 2 3\n}\n}\n"
    "JOINT Right\n{\nOFFSET -2 0 0\nCHANNELS 3 Xrotation Yrotation Zrotation\n"
    "End Site\n{\nOFFSET -1 2 3\n}\n}\n}\n"
    "MOTION\nFrames: 3\nFrame Time: 0.1\n"
    "10 20 30 40 50 60\n70 60 50 40 30 20\n100 50 40 30 20 10\n";

TEST(Mirrored, FindsAnglesOfOtherOrders) {
  const Motion motion = test::motion_of(kTwoOrders);
  const Motion image = in_mirror(motion);
  KinematicsOptions options;
  options.tips = true;
  const WorldPoses before = forward_kinematics(motion.skeleton, motion.clip, options);
  const WorldPoses after = forward_kinematics(image.skeleton, image.clip, options);
  for (std::size_t f = 0; f < 3; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double sign = k == 0 ? -1 : 1;
      EXPECT_NEAR(after.tips[f * 6 + k], sign * before.tips[f * 6 + 3 + k], 1e-12);
      EXPECT_NEAR(after.tips[f * 6 + 3 + k], sign * before.tips[f * 6 + k], 1e-12);
    }
  }
  EXPECT_LT(compare_motions(in_mirror(image), motion).tip_distance.value, 1e-12);
}

TEST(Mirrored, RefusesAHalfThatCannotMoveSo) {
  std::string text = kTwoOrders;
  text.replace(text.find("3 Xrotation Yrotation Zrotation"), 31, "1 Xrotation");
  for (const char* rest : {" 50 60", " 30 20", " 20 10"}) text.erase(text.find(rest), 6);
  Diagnostics diagnostics;
  const auto refused = edit::mirror(test::motion_of(text), 0, false, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "joint 'Right' cannot move as 'Left' does in the mirror");
}

/// A joint's axes that are turned by C, as in ASF files: C e.
std::vector<DegreeOfFreedom> turned_axes(const Mat3& axes, std::size_t first) {
  std::vector<DegreeOfFreedom> dofs;
  for (std::size_t k = 0; k < 3; ++k) {
    dofs.push_back({DofKind::Rotation, axes.col(static_cast<Eigen::Index>(2 - k)).normalized(),
                    first + 2 - k, 0});
  }
  return dofs;
}

TEST(Mirrored, CopiesAnglesAboutTurnedAxes) {
  Motion motion;
  Joint root;
  root.name = "root";
  Joint left;
  left.name = "lfemur";
  left.parent = 0;
  left.offset = {1, -1, 0};
  Joint right = left;
  right.name = "rfemur";
  right.offset = {-1, -1.1, 0};
  const Mat3 c = Eigen::AngleAxisd(0.35, Vec3(0, 0, 1)).toRotationMatrix();
  const Mat3 noise = Mat3::Constant(3e-15);
  left.dofs = turned_axes(c, 0);
  right.dofs = turned_axes(c.transpose() + noise, 3);
  motion.skeleton.joints = {root, left, right};
  for (std::size_t k = 0; k < 6; ++k) motion.skeleton.coordinates.push_back({1 + k / 3, "r"});
  motion.clip.num_frames = 1;
  motion.clip.num_coordinates = 6;
  motion.clip.values = {11, 22, 33, 44, 55, 66};
  EXPECT_EQ(in_mirror(motion).clip.values, (std::vector<double>{44, -55, -66, 11, -22, -33}));
}

TEST(Mirrored, WorksWhereJointsAreTurnedAtRest) {
  // A robot's shoulders: both frames are turned alike at rest, so that they are not mirrored.
  Motion motion;
  Joint root;
  root.name = "root";
  root.dofs = {{DofKind::Free, Vec3::UnitX(), 0, 0}};
  Joint left;
  left.name = "left";
  left.parent = 0;
  left.offset = {1, 2, 0.5};
  left.rest_rotation = Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  left.dofs = {{DofKind::Rotation, Vec3::UnitZ(), 7, 0},
               {DofKind::Rotation, Vec3::UnitX(), 8, 0},
               {DofKind::Rotation, Vec3::UnitY(), 9, 0}};
  const Vec3 tip(0.3, -2, 0.4);
  left.tips = {{"", left.rest_rotation.conjugate() * tip}};
  Joint right = left;
  right.name = "right";
  right.offset = across(left.offset);
  right.tips = {{"", left.rest_rotation.conjugate() * across(tip)}};
  for (DegreeOfFreedom& dof : right.dofs) dof.coordinate += 3;
  motion.skeleton.joints = {root, left, right};
  for (std::size_t k = 0; k < 13; ++k) motion.skeleton.coordinates.push_back({0, "q"});
  motion.skeleton.coordinates[12].joint = 2;
  motion.clip.num_frames = 1;
  motion.clip.num_coordinates = 13;
  motion.clip.values = {5, 6, 7, 0.5, 0.5, -0.5, 0.5, 10, 20, 30, 40, 50, 60};
  const Motion image = in_mirror(motion);
  EXPECT_EQ(image.clip.values[0], -5);
  EXPECT_EQ(image.clip.values[4], 0.5);
  EXPECT_EQ(image.clip.values[5], 0.5);
  EXPECT_EQ(image.clip.values[6], -0.5);
  KinematicsOptions options;
  options.tips = true;
  const WorldPoses before = forward_kinematics(motion.skeleton, motion.clip, options);
  const WorldPoses after = forward_kinematics(image.skeleton, image.clip, options);
  for (std::size_t k = 0; k < 3; ++k) {
    const double sign = k == 0 ? -1 : 1;
    EXPECT_NEAR(after.tips[k], sign * before.tips[3 + k], 1e-12);
    EXPECT_NEAR(after.tips[3 + k], sign * before.tips[k], 1e-12);
  }
}

TEST(Mirrored, AddedPositionsAreMirroredWhereTheyAre) {
  ReadOptions options;
  options.of_formats = bvh::ReadOptions{bvh::PositionMode::Add};
  std::string text = test::bvh_with_rows({"1 2 3 4 5 6 7 8 9"});
  text.replace(text.find("OFFSET 0 0 0"), 12, "OFFSET 5 1 2");
  text.replace(text.find("OFFSET 1 2 3"), 12, "OFFSET 0 2 3");
  const auto read = test::read_bvh(text, options);
  const Motion image = in_mirror(read.motion());
  EXPECT_LT((place_of(image, 0, "Hips") - Vec3(-6, 3, 5)).norm(), 1e-12);
  EXPECT_LT((place_of(image, 0, "A") - across(place_of(read.motion(), 0, "A"))).norm(), 1e-12);
}

TEST(Mirrored, KeepsNumbersThatAreNotFinite) {
  Motion walk = examples::make_walk({.num_frames = 3});
  walk.clip.mutate()[1][4] = std::nan("");
  const Motion image = in_mirror(walk);
  EXPECT_TRUE(std::isnan(image.clip.row(1)[4]));
  EXPECT_FALSE(std::isnan(image.clip.row(2)[4]));
}

TEST(Mirrored, NeedsNoFramesAndNoColumns) {
  EXPECT_EQ(in_mirror(Motion{}).clip.num_frames, 0u);
  EXPECT_EQ(in_mirror(examples::make_walk({.num_frames = 0})).clip.num_frames, 0u);
  Motion still;
  still.skeleton.joints.resize(2);
  still.skeleton.joints[1].parent = 0;
  still.skeleton.joints[1].offset = {1, 0, 0};
  still.clip.num_frames = 2;
  EXPECT_EQ(in_mirror(still).clip.num_frames, 2u);
}

Vec3 tip_of(const Motion& motion, std::size_t frame, std::size_t tip) {
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip, {.tips = true});
  return Vec3(&poses.tips[(frame * poses.num_tips + tip) * 3]);
}

TEST(Mirrored, LiesBetweenHalvesThatHaveNoNames) {
  Motion pair = star({{"a", {0, 1, 4}}, {"b", {0, 1, -4}}});
  pair.skeleton.up = 1;
  const auto image = edit::mirror(pair, std::nullopt, false, test::ignored());
  ASSERT_TRUE(image);
  EXPECT_LT((place_of(*image, 0, "a") - across(place_of(pair, 0, "b"), 2)).norm(), 1e-12);
}

TEST(Mirrored, StandsInTheWorldWhateverTheRestPose) {
  // At rest the spine is along x, and left and right are apart along y.
  const std::vector<test::Bone> bones = {{"Hips", 0, {0, 0, 0}},
                                         {"LeftUpLeg", 1, {-2, 9, 0}, Vec3(-80, 0, 0)},
                                         {"RightUpLeg", 1, {-2, -9, 0}, Vec3(-80, 0, 0)},
                                         {"Spine", 1, {10, 0, 0}, Vec3(50, 0, 3)}};
  // Stands along y, with the left half at +z; then turns, bends and lifts a leg.
  const Motion motion = test::motion_of(
      test::bvh_of_figure(bones, {{3, 90, 7, 90, 90, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
                                  {3, 88, 9, 80, 85, 10, 0, 30, 20, 0, 5, 0, 5, 6, 7}}));
  EXPECT_EQ(find_up_axis(motion).axis, 1u);
  const auto image = edit::mirror(motion, std::nullopt, false, test::ignored());
  ASSERT_TRUE(image);
  for (std::size_t f = 0; f < 2; ++f) {
    EXPECT_LT((place_of(*image, f, "Hips") - across(place_of(motion, f, "Hips"), 2)).norm(), 1e-9);
    EXPECT_LT((tip_of(*image, f, 0) - across(tip_of(motion, f, 1), 2)).norm(), 1e-9);
    EXPECT_LT((tip_of(*image, f, 1) - across(tip_of(motion, f, 0), 2)).norm(), 1e-9);
    EXPECT_LT((tip_of(*image, f, 2) - across(tip_of(motion, f, 2), 2)).norm(), 1e-9);
  }
  const auto along_x = edit::mirror(motion, 0, false, test::ignored());
  ASSERT_TRUE(along_x);
  EXPECT_LT((tip_of(*along_x, 1, 0) - across(tip_of(motion, 1, 1), 0)).norm(), 1e-9);
}

TEST(Mirrored, TakesTheMostSymmetricFrameIfTheRestPoseIsNotSymmetric) {
  // At rest all limbs are along x, the legs are apart along x, the arms along y.
  const std::vector<test::Bone> bones = {{"Hips", 0, {0, 0, 0}},
                                         {"Chest", 1, {0, 40, 0}},
                                         {"LeftArm", 2, {15, -18, 0}, Vec3(50, 0, 0)},
                                         {"RightArm", 2, {15, 18, 0}, Vec3(50, 0, 0)},
                                         {"LeftUpLeg", 1, {9, 0, 0}, Vec3(85, 0, 0)},
                                         {"RightUpLeg", 1, {-9, 0, 0}, Vec3(85, 0, 0)}};
  // Stands in frame 1: the chest upright, arms level, legs down; raises an arm and a leg in 2.
  const Motion motion = test::motion_of(test::bvh_of_figure(
      bones, {{0, 85, 0, 20, 30, 40, 60, 5, 0, 7, 8, 9, 0, 3, 0, -90, 0, 0, -80, 0, 0},
              {0, 85, 0, 0, 0, 0, 90, 0, 0, -90, 0, 0, 90, 0, 0, -90, 0, 0, -90, 0, 0},
              {5, 80, 9, 0, 0, 20, 90, 0, 9, -60, 10, 0, 90, 0, 0, -90, 0, 0, -70, 20, 0}}));
  Diagnostics diagnostics;
  const auto image = edit::mirror(motion, 0, false, diagnostics);
  ASSERT_TRUE(image) << to_string(image.error());
  EXPECT_EQ(test::codes_of(diagnostics), std::vector<std::string>{"EDT012"});
  constexpr std::size_t kPartner[] = {1, 0, 3, 2};  // of tips
  for (std::size_t t = 0; t < 4; ++t) {
    EXPECT_LT((tip_of(*image, 1, t) - across(tip_of(motion, 1, kPartner[t]))).norm(), 1e-9) << t;
    EXPECT_LT((tip_of(*image, 2, t) - across(tip_of(motion, 2, kPartner[t]))).norm(), 1e-9) << t;
  }
}

TEST(Mirrored, AJointOfTheTrunkIsItsOwnHalf) {
  const Motion motion =
      star({{"LeftArm", {3, 0, 0}}, {"RightArm", {-3, 0, 0}}, {"Spine", {0.4, 5, 0}}});
  const Motion image = in_mirror(motion);
  EXPECT_EQ(image.clip.row(0)[12], -motion.clip.row(0)[12]);
  EXPECT_EQ(image.clip.row(0)[13], motion.clip.row(0)[13]);
  const Motion sword =
      star({{"LeftArm", {3, 0, 0}}, {"RightArm", {-3, 0, 0}}, {"LeftSword", {4, 5, 0}}});
  EXPECT_FALSE(edit::mirror(sword, 0, false, test::ignored()));
}

TEST(Mirrored, RefusesToPutAFigureOnItsHead) {
  Motion motion = star({{"LeftArm", {3, 0, 0}}, {"RightArm", {-3, 0, 0}}});
  motion.skeleton.up = 1;
  const auto refused = edit::mirror(motion, 1, false, test::ignored());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "EDT004");
}

/// A walk whose left joints have axes in another order, so that their angles are found.
Motion uneven_walk() {
  Motion walk = examples::make_walk({.num_frames = 1000});
  for (Joint& joint : walk.skeleton.joints) {
    const bool is_left = joint.name.rfind("Left", 0) == 0 && joint.dofs.size() == 3;
    if (is_left) std::swap(joint.dofs[0].axis, joint.dofs[1].axis);
  }
  return walk;
}

TEST(Mirrored, EveryNumberOfThreadsGivesTheSameBits) {
  for (const Motion& motion : {examples::make_walk({.num_frames = 1000}), uneven_walk()}) {
    const auto mirrored = [&motion](std::size_t threads) {
      const test::Threads some(threads);
      return in_mirror(motion);
    };
    const Motion alone = mirrored(1);
    for (const std::size_t threads : test::kThreadCounts) {
      EXPECT_EQ(mirrored(threads).clip.values, alone.clip.values);
    }
  }
}

TEST(Mirrored, FoundAnglesPlaceTheMirrorImage) {
  const Motion motion = uneven_walk();
  const Motion image = in_mirror(motion);
  for (const std::size_t frame : {0u, 500u, 999u}) {
    EXPECT_LT(
        (place_of(image, frame, "LeftHand") - across(place_of(motion, frame, "RightHand"))).norm(),
        1e-9);
  }
}

}  // namespace
}  // namespace kinefile
