// SPDX-License-Identifier: MIT
#include "kinefile/fk.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/robots.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile::test {
namespace {

Result<Placed> place_of(const Document& document, const DocumentSource& robot = {}) {
  Diagnostics diagnostics;
  return place(document, robot, false, diagnostics);
}

Document walk() { return {examples::make_walk({.num_frames = 10}), "bvh", {}}; }

std::string fk_csv_of(const FkTable& table) {
  std::string text;
  const Sink sink = [&text](std::string_view piece) {
    text += piece;
    return true;
  };
  EXPECT_TRUE(write_table(table, *find_format("csv"), {}, sink));
  return text;
}

Error fk_fault(const FkOptions& options) {
  auto table = fk(place_of(walk()).value(), options);
  EXPECT_FALSE(table);
  return table ? Error{} : table.error();
}

TEST(Place, AMotionStaysAndASkeletonHasNoFrames) {
  const auto moving = place_of(walk());
  ASSERT_TRUE(moving);
  EXPECT_EQ(moving->motion.clip.num_frames, 10u);
  EXPECT_FALSE(moving->is_still);
  const auto still = place_of({moving->motion.skeleton, "bvh", {}});
  ASSERT_TRUE(still);
  EXPECT_TRUE(still->is_still);
  EXPECT_EQ(still->motion.clip.num_frames, 0u);
  EXPECT_EQ(still->motion.clip.num_coordinates, moving->motion.clip.num_coordinates);
}

TEST(Place, ABodyMotionGoesOntoItsRobotOrStandsByItsLinks) {
  const Document body{hinge_motion({0, 1}), "", {}};
  const auto links = place_of(body);
  ASSERT_TRUE(links);
  EXPECT_EQ(links->motion.skeleton.joints.size(), 1u);
  EXPECT_FALSE(links->recorded);
  const auto on_robot = place_of(body, source_of({hinge_robot(), "", {}}));
  ASSERT_TRUE(on_robot);
  EXPECT_EQ(on_robot->motion.skeleton.joints.size(), 2u);
  EXPECT_TRUE(on_robot->recorded);
}

TEST(Place, SaysWhatItCannotPlace) {
  EXPECT_EQ(place_of({PoseFlow{}, "", {}}).error().code, "CLI001");
  const Document body{hinge_motion({0}), "", {}};
  EXPECT_EQ(place_of(body, source_that_fails()).error().code, "IO001");
  EXPECT_EQ(place_of(body, source_of({PoseFlow{}, "", {}})).error().code, "DOC001");
}

TEST(Fk, SelectsFramesAndJoints) {
  const auto table = fk(place_of(walk()).value(), {.frames = "2:8:3", .joints = {"Head", "Hips"}});
  ASSERT_TRUE(table);
  EXPECT_EQ(table->frames.num_frames(), 2u);
  EXPECT_EQ(table->joints.size(), 2u);
  const std::string csv = fk_csv_of(*table);
  EXPECT_TRUE(csv.starts_with("frame,time,joint,x,y,z\n2,")) << csv;
  EXPECT_NE(csv.find("\n5,"), std::string::npos);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
}

TEST(Fk, PosesAreThoseOfKinematicsInTheWorldOrInTheParents) {
  auto table = fk(place_of(walk()).value(), {.tips = true, .rotations = true}).value();
  const Motion& motion = table.placed.motion;
  const PoseArrays poses = poses_of(table, table.frames);
  const WorldPoses world =
      forward_kinematics(motion.skeleton, motion.clip, {.rotations = true, .tips = true});
  EXPECT_TRUE(std::equal(poses.positions.begin(), poses.positions.end(), world.positions.begin()));
  EXPECT_EQ(poses.rotations.size(), world.rotations.size());
  EXPECT_EQ(poses.tips.size(), world.tips.size());
  table.options.local = true;
  const LocalPoses local = local_poses(motion.skeleton, motion.clip);
  const PoseArrays parents = poses_of(table, table.frames);
  EXPECT_TRUE(
      std::equal(local.positions.begin(), local.positions.end(), parents.positions.begin()));
}

TEST(Fk, TheRestPoseIsOneFrame) {
  Document skeleton{examples::make_walk({.num_frames = 2}).skeleton, "bvh", {}};
  const auto table = fk(place_of(skeleton).value(), {.rest = true});
  ASSERT_TRUE(table);
  EXPECT_EQ(table->frames.num_frames(), 1u);
  const auto refused = fk(place_of(skeleton).value(), {.name = "a.asf"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "'a.asf' holds a skeleton alone; --rest shows its rest pose");
}

TEST(Fk, SaysWhatIsWrongWithTheOptions) {
  EXPECT_EQ(fk_fault({.frames = "5:11"}).message,
            "expected --frames N, A:B or A:B:STEP within 0:10, found '5:11'");
  EXPECT_EQ(fk_fault({.joints = {"Tail"}, .name = "a.bvh"}).message,
            "there is no joint 'Tail' in 'a.bvh'");
  Motion no_unit = examples::make_walk({.num_frames = 1});
  no_unit.skeleton.metres_per_unit = 0;
  EXPECT_EQ(fk(Placed{no_unit}, {.metres = true}).error().kind, ErrorKind::Usage);
  no_unit.skeleton.metres_per_unit = 0.01;
  EXPECT_EQ(fk(Placed{no_unit}, {.metres = true})->length_scale, 0.01);
}

TEST(Fk, RecordedLinksStandInTheirPlace) {
  BodyMotion body = hinge_motion({0.5});
  Component& links = body.components[0];
  links.num_parts = 2;
  links.values = {1, 2, 3, 1, 0, 0, 0, 7, 8, 9, 1, 0, 0, 0};
  const auto table = fk(place_of({body, "", {}}, source_of({hinge_robot(), "", {}})).value(), {});
  ASSERT_TRUE(table);
  const PoseArrays poses = poses_of(*table, table->frames);
  EXPECT_EQ(poses.positions[3], 7);
  EXPECT_EQ(poses.positions[5], 9);
}

TEST(Fk, ComparesKinematicsWithRecordedLinks) {
  Diagnostics diagnostics;
  const DocumentSource robot = source_of({hinge_robot(), "", {}});
  const auto links = compare_links({hinge_motion({0.5}), "", {}}, robot, false, diagnostics);
  ASSERT_TRUE(links);
  ASSERT_EQ(links->size(), 1u);
  EXPECT_EQ((*links)[0].link, "BASE");
  EXPECT_EQ((*links)[0].distance, 0);
  EXPECT_EQ(compare_links(walk(), robot, false, diagnostics).error().code, "DOC001");
  EXPECT_EQ(compare_links({hinge_motion({0}), "", {}}, {}, false, diagnostics).error().code,
            "CNV002");
}

}  // namespace
}  // namespace kinefile::test
