// SPDX-License-Identifier: MIT
#include "kinefile/check.hpp"

#include <gtest/gtest.h>

#include "support/robots.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile::test {
namespace {

std::string checked(const Document& document, const CheckOptions& options) {
  Diagnostics diagnostics;
  check(document, options, diagnostics);
  return text_of(diagnostics);
}

TEST(Check, AWalkIsInOrder) {
  EXPECT_EQ(checked({examples::make_walk(), "", {}}, {"walk.bvh"}), "");
  EXPECT_EQ(checked({hinge_robot(), "", {}}, {"robot"}), "");
}

TEST(Check, SuddenTurnsAreNotesInASentenceEach) {
  constexpr std::size_t kHeadY = 3 + 6 * 3 - 1;
  Motion walk = examples::make_walk({.num_frames = 40});
  const Rows rows = walk.clip.mutate();
  rows[13][kHeadY] += 170;
  for (std::size_t f = 30; f < 40; ++f) rows[f][kHeadY] += 170;
  const std::string text = checked({walk, "", {}}, {"walk.bvh"});
  EXPECT_NE(text.find("walk.bvh: note[MOT001]: joint 'Head' turns by 170 degrees from frame 12 to "
                      "13 and is back in frame 14\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("walk.bvh: note[MOT002]: joint 'Head' turns by 170 degrees from frame 29 to "
                      "30\n"),
            std::string::npos)
      << text;
}

TEST(Check, ARobotThatLeavesItsLimitsIsWarnedOf) {
  const Document body{hinge_motion({0.9, 1.1, 1.2, 0.5}), "", {}};
  EXPECT_EQ(checked(body, {"a.seq"}), "");
  EXPECT_EQ(checked(body, {"a.seq", source_of({hinge_robot(), "", {}})}),
            "a.seq: warning[MOT003]: joint 'HINGE' goes up to 68.7549 deg (frame 2), its limit is "
            "57.2958 "
            "deg; beyond it in 2 frames, first in 1\n"
            "a.seq: warning[MOT004]: joint 'HINGE' moves at up to 401.07 deg/s (to frame 3), its "
            "limit is "
            "114.592 deg/s; too fast in 1 frames, first in 3\n");
}

TEST(Check, AFigureThatLeavesItsLimitsIsNotedOnceAJointAndKind) {
  Motion figure;
  Joint& joint = figure.skeleton.joints.emplace_back();
  joint.name = "arm";
  joint.dofs.push_back({DofKind::Rotation, Vec3::UnitX(), 0, 0, -10, 10});
  joint.dofs.push_back({DofKind::Rotation, Vec3::UnitY(), 1, 0, -10, 10});
  figure.skeleton.coordinates = {{0, "rx"}, {0, "ry"}};
  figure.clip.num_frames = 1;
  figure.clip.num_coordinates = 2;
  figure.clip.values = {12, 25};
  EXPECT_EQ(checked({figure, "", {}}, {"a.amc"}),
            "a.amc: note[MOT003]: joint 'arm' goes up to 25 deg (frame 0), its limit is 10 deg; "
            "beyond it in 1 frames, first in 0\n");
}

TEST(Check, WhatCannotBePutOnTheRobotIsAnError) {
  const DocumentSource robot = source_of({hinge_robot(), "", {}});
  EXPECT_NE(checked({PoseFlow{}, "", {}}, {"a.txt", robot}).find("a.txt: error[CLI001]"),
            std::string::npos);
  EXPECT_NE(checked({hinge_motion({0}), "", {}}, {"a.seq", source_that_fails()})
                .find("a.seq: error[IO001]"),
            std::string::npos);
}

TEST(Check, WarningsAreErrorsWhereTheCallerSaysSo) {
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = true;
  check(Document{hinge_motion({1.2}), "", {}}, {"a.seq", source_of({hinge_robot(), "", {}})},
        diagnostics);
  EXPECT_EQ(diagnostics.count(Severity::Error), 1u);
}

TEST(Check, ReadsFirstAndCountsWhatKeepsItFromReading) {
  Diagnostics diagnostics;
  EXPECT_TRUE(check(source_of({examples::make_walk(), "", {}}), {"a.bvh"}, diagnostics));
  const auto failed = check(source_that_fails(), {"a.bvh"}, diagnostics);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().kind, ErrorKind::Io);
  EXPECT_EQ(codes_of(diagnostics), std::vector<std::string>{"IO001"});
}

}  // namespace
}  // namespace kinefile::test
