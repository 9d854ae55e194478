// SPDX-License-Identifier: MIT
#include "kinefile/differences.hpp"

#include <gtest/gtest.h>

#include "support/flows.hpp"
#include "support/robots.hpp"
#include "walk.hpp"

namespace kinefile::test {
namespace {

Comparison compared(const Document& a, const Document& b, double tolerance = 0) {
  const auto comparison = compare(a, b, {tolerance});
  EXPECT_TRUE(comparison);
  return comparison.value_or(Comparison{});
}

Document as_document(decltype(Document::content) content) { return {std::move(content), "", {}}; }

const BodyComparison& bodies(const Comparison& comparison) {
  return std::get<BodyComparison>(comparison.found);
}

const std::vector<FlowDifference>& flows(const Comparison& comparison) {
  return std::get<FlowComparison>(comparison.found).differences;
}

TEST(Compare, MotionsDifferBeyondTheTolerance) {
  const Motion walk = examples::make_walk({.num_frames = 4});
  Motion moved = walk;
  moved.clip.mutate()[2][0] += 0.5;
  EXPECT_FALSE(compared(as_document(walk), as_document(walk)).is_different);
  EXPECT_TRUE(compared(as_document(walk), as_document(moved), 0.4).is_different);
  EXPECT_FALSE(compared(as_document(walk), as_document(moved), 0.6).is_different);
  moved.skeleton.joints.back().name = "other";
  EXPECT_TRUE(compared(as_document(walk), as_document(moved), 0.6).is_different);
}

TEST(Compare, ASkeletonAloneIsAMotionOfOneFrame) {
  const Motion walk = examples::make_walk({.num_frames = 1});
  EXPECT_FALSE(compared(as_document(walk.skeleton), as_document(walk.skeleton)).is_different);
  const auto comparison = compared(as_document(walk.skeleton), as_document(walk));
  const auto& found = std::get<MotionComparison>(comparison.found);
  EXPECT_EQ(found.num_frames_first, 1u);
  EXPECT_EQ(found.num_frames_second, 1u);
}

TEST(Compare, ComponentsAreMatchedByKindAndContent) {
  const BodyMotion body = hinge_motion({0, 0.5});
  EXPECT_FALSE(compared(as_document(body), as_document(body)).is_different);
  BodyMotion other = body;
  other.components[1].values.mutate()[1] += 0.25;
  const Comparison numbers = compared(as_document(body), as_document(other), 0.125);
  EXPECT_TRUE(numbers.is_different);
  EXPECT_FALSE(bodies(numbers).components[0].is_different);
  EXPECT_EQ(bodies(numbers).components[1].distance.value, 0.25);
  EXPECT_EQ(bodies(numbers).components[1].distance.frame, 1u);
  EXPECT_FALSE(compared(as_document(body), as_document(other), 0.5).is_different);

  other.components.pop_back();
  other.components.push_back(body.components[0]);
  other.components[1].content = "Other";
  const Comparison names = compared(as_document(body), as_document(other));
  EXPECT_TRUE(names.is_different);
  ASSERT_EQ(bodies(names).components.size(), 3u);
  EXPECT_FALSE(bodies(names).components[1].second);
  EXPECT_FALSE(bodies(names).components[2].first);
  EXPECT_EQ(bodies(names).components[2].content, "Other");
}

TEST(Compare, ComponentsOfOtherSizesOrTimesDiffer) {
  const BodyMotion body = hinge_motion({0, 0.5});
  const Comparison longer = compared(as_document(body), as_document(hinge_motion({0, 0.5, 1})));
  EXPECT_TRUE(longer.is_different);
  EXPECT_FALSE(bodies(longer).components[0].has_one_size);
  EXPECT_EQ(bodies(longer).components[0].second->num_frames, 3u);
  BodyMotion slower = body;
  slower.components[0].timeline = {FrameRate{5}, 0};
  const Comparison times = compared(as_document(body), as_document(slower));
  EXPECT_TRUE(times.is_different);
  EXPECT_FALSE(bodies(times).components[0].has_same_times);
  EXPECT_TRUE(bodies(times).components[1].has_same_times);
}

TEST(Compare, FlowsDifferSettingBySetting) {
  const PoseFlow flow = v1r4_counter();
  EXPECT_FALSE(compared(as_document(flow), as_document(flow)).is_different);
  PoseFlow other = flow;
  for (Block& block : other.blocks) {
    if (auto* pose = std::get_if<PoseBlock>(&block.body)) pose->ticks += 1;
  }
  other.blocks[0].name = "begin";
  other.blocks[0].x += 10;  // where the editor draws it
  const Comparison comparison = compared(as_document(flow), as_document(other));
  EXPECT_TRUE(comparison.is_different);
  ASSERT_GE(flows(comparison).size(), 2u);
  EXPECT_EQ(flows(comparison)[0].what, "name");
  EXPECT_EQ(flows(comparison)[0].second, "'begin'");
  EXPECT_EQ(flows(comparison)[1].what, "ticks");
  EXPECT_EQ(flows(comparison)[1].first, "10");
  EXPECT_EQ(flows(comparison)[1].second, "11");
}

TEST(Compare, ABlockThatOnlyOneFlowHasIsToldByItsKind) {
  const PoseFlow flow = v1r4_counter();
  PoseFlow shorter = flow;
  shorter.blocks.pop_back();
  const Comparison comparison = compared(as_document(shorter), as_document(flow));
  EXPECT_EQ(flows(comparison)[0].what, "blocks");
  EXPECT_FALSE(flows(comparison)[0].block);
  EXPECT_EQ(flows(comparison).back().what, "kind");
  EXPECT_EQ(flows(comparison).back().first, "");
}

TEST(Compare, KindsMustBeAlike) {
  const auto refused = compare(as_document(hinge_motion({0})), as_document(PoseFlow{}));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
}

}  // namespace
}  // namespace kinefile::test
