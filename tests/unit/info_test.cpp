// SPDX-License-Identifier: MIT
#include "kinefile/info.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/flows.hpp"
#include "support/robots.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile::test {
namespace {

TEST(Info, TellsOfAMotionAndItsSkeleton) {
  const Info told = info({examples::make_walk({.num_frames = 61}), "bvh", {}});
  EXPECT_EQ(told.format, "bvh");
  EXPECT_EQ(told.kind, "motion");
  ASSERT_TRUE(told.skeleton && told.motion);
  EXPECT_FALSE(told.body || told.flow);
  EXPECT_EQ(told.skeleton->num_joints, 22u);
  EXPECT_EQ(told.skeleton->num_roots, 1u);
  EXPECT_EQ(told.skeleton->num_columns, 69u);
  EXPECT_EQ(told.skeleton->num_dofs, 69u);
  EXPECT_EQ(told.skeleton->num_joints_with_translations, 1u);
  ASSERT_EQ(told.skeleton->rotation_orders.size(), 1u);
  EXPECT_EQ(told.skeleton->rotation_orders[0].num_joints, 22u);
  EXPECT_EQ(told.motion->time.num_frames, 61u);
  EXPECT_NEAR(told.motion->time.frame_rate, 60, 1e-3);
  EXPECT_NEAR(told.motion->time.duration, 1, 1e-4);
  EXPECT_FALSE(told.motion->time.has_own_times);
  EXPECT_GT(told.motion->extent.max.z(), told.skeleton->rest_extent.max.z());
}

TEST(Info, TellsOfASkeletonAlone) {
  const Info told = info({hinge_robot(), "urdf", {}});
  EXPECT_EQ(told.kind, "skeleton");
  ASSERT_TRUE(told.skeleton);
  EXPECT_FALSE(told.motion);
  EXPECT_EQ(told.skeleton->num_dofs, 7u);
  EXPECT_EQ(told.skeleton->num_columns, 8u);
  EXPECT_EQ(told.skeleton->angle_unit, AngleUnit::Radians);
  ASSERT_EQ(told.skeleton->rotation_orders.size(), 1u);
  EXPECT_EQ(told.skeleton->rotation_orders[0].order, "Z");
}

TEST(Info, TellsTheFactsOfTheFile) {
  const ReadText read = read_bvh(bvh_with_rows({"0 0 0 0 0 0 0 0 0"}));
  ASSERT_TRUE(read.document);
  const Info told = info(*read.document);
  const auto line_end = std::find_if(told.facts.begin(), told.facts.end(),
                                     [](const Fact& fact) { return fact.key == "line_end"; });
  ASSERT_NE(line_end, told.facts.end());
  EXPECT_EQ(line_end->value, "lf");
  EXPECT_TRUE(info({hinge_robot(), "", {}}).facts.empty());
}

TEST(Info, AnObliqueAxisHasNoLetter) {
  Skeleton skeleton = hinge_robot();
  skeleton.joints[1].dofs[0].axis = Vec3(1, 1, 0).normalized();
  EXPECT_EQ(info({skeleton, "", {}}).skeleton->rotation_orders[0].order, "?");
}

TEST(Info, TellsOfTheComponentsOfABodyMotion) {
  BodyMotion body = hinge_motion({0, 0.5, 1});
  body.components[1].num_frames = 2;
  body.components[1].timeline.given = FrameTimes{{0, 0.3}};
  const Info told = info({body, "", {}});
  EXPECT_FALSE(told.skeleton);
  ASSERT_TRUE(told.body);
  ASSERT_EQ(told.body->components.size(), 2u);
  EXPECT_EQ(told.body->components[0].content, kLinkPosition);
  EXPECT_EQ(told.body->components[0].kind, ComponentKind::Poses);
  EXPECT_TRUE(told.body->components[1].time.has_own_times);
  ASSERT_TRUE(told.body->time);
  EXPECT_EQ(told.body->time->num_frames, 3u);
  EXPECT_FALSE(info({BodyMotion{}, "", {}}).body->time);
}

TEST(Info, TellsOfTheBlocksOfAFlowAndOfItsPosesIfAsked) {
  const Document flow{v1r4_counter(), "", {}};
  const Info told = info(flow);
  ASSERT_TRUE(told.flow);
  EXPECT_EQ(told.flow->num_sliders, std::get<PoseFlow>(flow.content).num_sliders);
  std::size_t num_blocks = 0;
  for (const BlockCount& count : told.flow->blocks) {
    EXPECT_GT(count.num_blocks, 0u);
    num_blocks += count.num_blocks;
  }
  EXPECT_EQ(num_blocks, told.flow->num_blocks);
  EXPECT_EQ(told.flow->blocks.front().kind, "start");
  EXPECT_TRUE(told.flow->poses.empty());
}

TEST(Info, PosesNameSlidersAndDegreesByTheProject) {
  PoseFlow flow = word_n_of({pose_block(7, {100, 200, 300}, kNoBlock)});
  pose_of(flow.blocks[0]).words[1].is_enabled = false;
  RobotProject project;
  project.sliders.resize(1);
  project.sliders[0].name = "HEAD";
  project.sliders[0].units_per_degree = 50;
  const Info told = info({flow, "", {}}, {.poses = true, .project = &project});
  ASSERT_EQ(told.flow->poses.size(), 1u);
  const PoseInfo& pose = told.flow->poses[0];
  EXPECT_EQ(pose.ticks, 7);
  ASSERT_EQ(pose.sliders.size(), 2u);
  EXPECT_EQ(pose.sliders[0].name, "HEAD");
  EXPECT_EQ(pose.sliders[0].degrees, 2);
  EXPECT_EQ(pose.sliders[1].name, "s2");
  EXPECT_EQ(pose.sliders[1].slider, 2u);
  EXPECT_EQ(pose.sliders[1].word, 300);
  EXPECT_FALSE(pose.sliders[1].degrees);
}

}  // namespace
}  // namespace kinefile::test
