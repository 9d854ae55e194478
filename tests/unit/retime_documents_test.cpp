// SPDX-License-Identifier: MIT
#include "kinefile/retime_documents.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/robots.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile::test {
namespace {

Document walk_of(std::size_t num_frames) {
  return {examples::make_walk({.num_frames = num_frames}), "", {}};
}

retime::DocumentWarp warp_to(double old_frame, double new_frame) {
  retime::DocumentWarp warp;
  warp.options.keys = {{old_frame, new_frame}};
  return warp;
}

TEST(RetimeDocuments, KeysMayBeInSeconds) {
  Diagnostics diagnostics;
  const Document walk = walk_of(61);
  const auto frames = retime::warp_map(walk, warp_to(30, 15), diagnostics);
  retime::DocumentWarp in_seconds = warp_to(0.5, 0.25);
  in_seconds.keys_in_seconds = true;
  const auto seconds = retime::warp_map(walk, in_seconds, diagnostics);
  ASSERT_TRUE(frames && seconds);
  EXPECT_EQ(frames->old_frames, seconds->old_frames);
}

TEST(RetimeDocuments, ABodyMotionsKeysCountTheFramesOfItsMainComponent) {
  Diagnostics diagnostics;
  BodyMotion body = hinge_motion({0, 1, 2, 3, 4});
  body.components[1] = hinge_motion({0, 1}).components[1];
  const auto map = retime::warp_map({body, "", {}}, warp_to(1, 2), diagnostics);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->old_frames.size(), 5u);
  EXPECT_EQ(map->old_frames[2], 1);
}

TEST(RetimeDocuments, FramesWithOwnTimesAreWarpedInTime) {
  Diagnostics diagnostics;
  Document walk = walk_of(4);
  std::get<Motion>(walk.content).clip.timeline.given = FrameTimes{{0, 0.1, 0.3, 0.4}};
  const auto map = retime::warp_map(walk, warp_to(2, 1), diagnostics);
  ASSERT_TRUE(map && map->timeline);
  EXPECT_EQ(*map->timeline, (Timeline{FrameRate{10}, 0}));
  EXPECT_EQ(map->old_frames[1], 2);
  EXPECT_EQ(diagnostics.count_of("RTM009", Severity::Note), 1u);
}

/// A body on one foot, 100 frames a second, which is in the air from frame 40 to 79 of 120.
Motion hop() {
  Motion motion;
  Joint& body = motion.skeleton.joints.emplace_back();
  body.name = "Body";
  body.dofs.push_back({DofKind::Translation, Vec3::UnitY(), 0, 0});
  Joint& foot = motion.skeleton.joints.emplace_back();
  foot.name = "LeftFoot";
  foot.parent = 0;
  foot.offset = {0, -1.7, 0};
  motion.skeleton.coordinates = {{0, "y"}};
  motion.clip.num_frames = 120;
  motion.clip.num_coordinates = 1;
  motion.clip.timeline = {FrameRate{100}, 0};
  for (int f = 0; f < 120; ++f) {
    const double time = (f - 39) * 0.01;
    motion.clip.values.push_back(f > 39 && f < 80 ? 4.9 * time * (0.41 - time) : 0);
  }
  return motion;
}

TEST(RetimeDocuments, ContactsKeepFlightAsItIsAndNeedASkeleton) {
  Diagnostics diagnostics;
  retime::DocumentWarp warp = warp_to(100, 110);
  warp.follows_contacts = true;
  const auto map = retime::warp_map({hop(), "", {}}, warp, diagnostics);
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_NEAR(map->old_frames[65] - map->old_frames[64], 1, 1e-9);
  EXPECT_LT(map->old_frames[11] - map->old_frames[10], 0.9);
  const Document body{hinge_motion({0, 1, 2, 3}), "", {}};
  EXPECT_EQ(retime::warp_map(body, warp, diagnostics).error().code, "CLI002");
}

TEST(RetimeDocuments, AMapIsAppliedToAllComponentsOfOneLength) {
  Diagnostics diagnostics;
  const retime::TimeMap map{{0, 0.5, 1}};
  Document body{hinge_motion({0, 1, 2}), "", {}};
  ASSERT_TRUE(retime::apply(body, map, {}, diagnostics));
  const BodyMotion& retimed = std::get<BodyMotion>(body.content);
  EXPECT_EQ(retimed.components[1].values[1], 0.5);
  EXPECT_EQ(retimed.components[0].num_frames, 3u);
  BodyMotion uneven = hinge_motion({0, 1, 2});
  uneven.components[1] = hinge_motion({0, 1}).components[1];
  Document other{uneven, "", {}};
  EXPECT_EQ(retime::apply(other, map, {}, diagnostics).error().code, "CLI002");
}

TEST(RetimeDocuments, EveryComponentIsResampledFromItsOwnRate) {
  Diagnostics diagnostics;
  BodyMotion body = hinge_motion({0, 1, 2});
  body.components[1].timeline = {FrameRate{5}, 0};
  Document document{body, "", {}};
  ASSERT_TRUE(retime::resample(document, 20, {}, diagnostics));
  const BodyMotion& resampled = std::get<BodyMotion>(document.content);
  EXPECT_EQ(resampled.components[1].num_frames, 9u);
  // The one that ends 0.2 s earlier, two of its frames, holds its last values, with a warning.
  EXPECT_EQ(resampled.components[0].num_frames, 9u);
  const auto last = resampled.components[0].row(8);
  const auto held = resampled.components[0].row(4);
  EXPECT_TRUE(std::equal(last.begin(), last.end(), held.begin(), held.end()));
  EXPECT_EQ(diagnostics.count(Severity::Warning), 1u);
  Document walk = walk_of(61);
  ASSERT_TRUE(retime::resample(walk, 30, {}, diagnostics));
  EXPECT_EQ(std::get<Motion>(walk.content).clip.num_frames, 31u);
}

TEST(RetimeDocuments, ComponentsThatLastAsLongButForAFrameAreBroughtToOneWithANote) {
  Diagnostics diagnostics;
  BodyMotion body = hinge_motion({0, 1, 2, 3, 4, 5});  // 0.5 s
  body.components[1] = hinge_motion({0, 1, 2}).components[1];
  body.components[1].timeline = {FrameRate{5}, 0};  // 0.4 s
  Document document{body, "", {}};
  ASSERT_TRUE(retime::resample(document, 10, {}, diagnostics));
  const BodyMotion& resampled = std::get<BodyMotion>(document.content);
  ASSERT_EQ(resampled.components[1].num_frames, 6u);
  EXPECT_EQ(resampled.components[1].values[3], 1.5);
  EXPECT_EQ(resampled.components[1].values[5], 2);
  EXPECT_TRUE(robot::motion_of_components(resampled, false, diagnostics));
  ASSERT_EQ(diagnostics.items().size(), 1u);
  EXPECT_EQ(diagnostics.items()[0].severity, Severity::Note);
  EXPECT_EQ(diagnostics.items()[0].message,
            "'JointDisplacement' ends 0.1 s before the other components; its last values are held");
}

TEST(RetimeDocuments, AlignsMotionsAlone) {
  const Document walk = walk_of(20);
  const auto map = retime::align_map(walk, walk, {}, test::ignored());
  ASSERT_TRUE(map);
  EXPECT_EQ(map->old_frames.size(), 20u);
  const Document body{hinge_motion({0}), "", {}};
  EXPECT_EQ(retime::align_map(walk, body, {}, test::ignored()).error().code, "DOC001");
}

TEST(RetimeDocuments, WhatHasNoFramesIsRefused) {
  Diagnostics diagnostics;
  for (Document document : {Document{hinge_robot(), "", {}}, Document{PoseFlow{}, "", {}},
                            Document{BodyMotion{}, "", {}}}) {
    EXPECT_FALSE(retime::has_frames(document));
    EXPECT_EQ(retime::warp_map(document, {}, diagnostics).error().code, "DOC001");
    EXPECT_EQ(retime::apply(document, {}, {}, diagnostics).error().code, "DOC001");
    EXPECT_EQ(retime::resample(document, 10, {}, diagnostics).error().code, "DOC001");
  }
}

}  // namespace
}  // namespace kinefile::test
