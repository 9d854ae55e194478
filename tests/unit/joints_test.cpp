// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "kinefile/compare.hpp"
#include "kinefile/edit.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

Motion with(const Motion& motion, const std::vector<std::string>& names) {
  Diagnostics diagnostics;
  auto result = edit::joints(motion, names, diagnostics);
  EXPECT_TRUE(result) << to_string(result.error());
  EXPECT_EQ(test::text_of(diagnostics), "");
  EXPECT_TRUE(validate(result->skeleton));
  return result ? std::move(*result) : Motion{};
}

std::vector<std::string> names_of(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
  return names;
}

TEST(WithJoints, KeepsThemAndAllAboveInTheirPlaces) {
  const Motion walk = examples::make_walk({.num_frames = 10});
  const Motion part = with(walk, {"Spine1", "LeftFoot"});
  EXPECT_EQ(names_of(part.skeleton),
            (std::vector<std::string>{"Hips", "Spine", "Spine1", "LeftUpperLeg", "LeftLowerLeg",
                                      "LeftFoot"}));
  EXPECT_EQ(part.clip.num_coordinates, 6u + 5 * 3);
  const MotionComparison comparison = compare_motions(part, walk);
  EXPECT_EQ(comparison.distance.value, 0);
  EXPECT_TRUE(comparison.only_in_first.empty());
}

TEST(WithJoints, PutsTipsWhereChildrenWere) {
  const Motion part = with(examples::make_walk({.num_frames = 2}), {"Chest", "Head"});
  EXPECT_TRUE(part.skeleton.joints[3].tips.empty());
  const Motion chest = with(examples::make_walk({.num_frames = 2}), {"Chest"});
  ASSERT_EQ(chest.skeleton.joints[3].tips.size(), 3u);
  EXPECT_EQ(chest.skeleton.joints[3].tips[0].offset, Vec3(0, 19, 1));
  EXPECT_EQ(chest.skeleton.joints[3].tips[2].offset, Vec3(-3, 14, 2));
}

TEST(WithJoints, GivesShapesOfJointsThatCannotMoveToTheOneThatStays) {
  Motion walk = examples::make_walk({.num_frames = 2});
  Skeleton& skeleton = walk.skeleton;
  const auto add = [&skeleton](const std::string& name, std::size_t parent) {
    Joint joint;
    joint.name = name;
    joint.parent = parent;
    joint.offset = Vec3(0, 0, 1);
    joint.rest_rotation = Quat(std::sqrt(0.5), 0, 0, std::sqrt(0.5));  // x to y
    joint.visuals = {{ShapeKind::Cone, {1, 1, 2}, {1, 0, 0}}};
    skeleton.joints.push_back(joint);
    return skeleton.joints.size() - 1;
  };
  const std::size_t first = add("fixed", 0);
  const std::size_t second = add("fixed to it", first);
  const std::size_t moving = add("moving", 0);
  skeleton.joints[moving].dofs = {skeleton.joints[0].dofs.back()};
  add("on the moving one", moving);
  EXPECT_TRUE(validate(skeleton));
  const Motion hips = with(walk, {skeleton.joints[0].name});
  const auto& shapes = hips.skeleton.joints.at(0).visuals;
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_LE((shapes[0].position - Vec3(0, 1, 1)).norm(), 1e-15);
  EXPECT_LE((shapes[1].position - Vec3(-1, 0, 2)).norm(), 1e-15);
  EXPECT_LE((shapes[1].rotation * Vec3::UnitX() + Vec3::UnitX()).norm(), 1e-15);
  EXPECT_EQ(shapes[1].size, Vec3(1, 1, 2));
  const Motion both = with(walk, {"fixed"});
  EXPECT_EQ(both.skeleton.joints[0].visuals.size(), 0u);
  EXPECT_EQ(both.skeleton.joints.at(1).visuals.size(), 2u);
  EXPECT_EQ(with(walk, {"*"}).skeleton.joints.at(second).visuals.size(), 1u);
}

/// A joint that slides on another.
constexpr char kSlide[] =
    "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 0\nJOINT a\n{\nOFFSET 1 2 3\n"
    "CHANNELS 1 Xposition\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n}\n"
    "MOTION\nFrames: 2\nFrame Time: 0.1\n";

TEST(WithJoints, PutsTheTipWhereAChildStood) {
  const Motion slide = test::motion_of(std::string(kSlide) + "5\n5\n");
  EXPECT_EQ(with(slide, {"r"}).skeleton.joints[0].tips[0].offset, Vec3(5, 2, 3));
}

TEST(WithJoints, WarnsOfAChildThatMoved) {
  const Motion slide = test::motion_of(std::string(kSlide) + "5\n6\n");
  Diagnostics diagnostics;
  const std::vector<std::string> names = {"r"};
  const auto part = edit::joints(slide, names, diagnostics);
  EXPECT_EQ(test::text_of(diagnostics),
            "warning[EDT010]: joint 'a' moves on 'r', which gets a tip where it rests\n");
  EXPECT_EQ(part->skeleton.joints[0].tips[0].offset, Vec3(1, 2, 3));
}

TEST(WithJoints, NotesAChildThatWavered) {
  const Motion slide = test::motion_of(std::string(kSlide) + "1\n1.001\n");
  Diagnostics diagnostics;
  const std::vector<std::string> names = {"r"};
  const auto part = edit::joints(slide, names, diagnostics);
  EXPECT_EQ(test::text_of(diagnostics),
            "note[EDT013]: joint 'a' stays on 'r' but for noise of 0.001, which is lost\n");
  EXPECT_EQ(part->skeleton.joints[0].tips[0].offset, Vec3(1, 2, 3));
}

TEST(WithJoints, KeepsAColumnThatAJointReadsWhichStays) {
  Motion motion = examples::make_walk({.num_frames = 3});
  motion.skeleton.joints[1].dofs = {{DofKind::Rotation, Vec3::UnitX(), 20, 0}};
  const Motion part = with(motion, {"Spine"});
  EXPECT_EQ(part.clip.num_coordinates, 10u);
  EXPECT_EQ(part.clip.row(2)[9], motion.clip.row(2)[20]);
  EXPECT_EQ(part.skeleton.coordinates[9].joint, 1u);
}

TEST(WithJoints, TakesAllOfAName) {
  Motion walk = examples::make_walk({.num_frames = 1});
  walk.skeleton.joints[9].name = "Head";
  EXPECT_EQ(with(walk, {"Head"}).skeleton.joints.size(), 10u);
}

TEST(WithJoints, RefusesAnUnknownName) {
  Diagnostics diagnostics;
  const std::vector<std::string> names = {"Head", "Nose"};
  const auto refused = edit::joints(examples::make_walk({.num_frames = 1}), names, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "EDT006");
  EXPECT_EQ(refused.error().message, "there is no joint 'Nose'");
}

TEST(WithJoints, NeedsNoFrames) {
  EXPECT_EQ(with(examples::make_walk({.num_frames = 0}), {"Head"}).skeleton.joints.size(), 6u);
}

Document walk_document() {
  Document document;
  document.content = examples::make_walk({.num_frames = 1});
  return document;
}

TEST(RenameJoint, RenamesInTheSkeleton) {
  Document document = walk_document();
  ASSERT_TRUE(edit::rename(document, "Head", "head"));
  EXPECT_EQ(skeleton_of(document).joints[5].name, "head");
}

TEST(RenameJoint, WorksOnASkeletonAlone) {
  Document document;
  document.content = examples::make_walk({.num_frames = 1}).skeleton;
  ASSERT_TRUE(edit::rename(document, "Hips", "Pelvis"));
  EXPECT_EQ(skeleton_of(document).joints[0].name, "Pelvis");
}

TEST(RenameJoint, RefusesNamesThatAreNotThereOrTaken) {
  Document document = walk_document();
  EXPECT_EQ(edit::rename(document, "Nose", "nose").error().message, "there is no joint 'Nose'");
  EXPECT_EQ(edit::rename(document, "Head", "Neck").error().message,
            "there is a joint 'Neck' already");
  EXPECT_EQ(edit::rename(document, "Head", "").error().message, "a joint needs a name");
  EXPECT_TRUE(edit::rename(document, "Head", "Head"));
}

}  // namespace
}  // namespace kinefile
