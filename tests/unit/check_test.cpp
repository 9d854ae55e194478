// SPDX-License-Identifier: MIT
#include "kinefile/check.hpp"

#include <gtest/gtest.h>

#include <map>

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

/// A figure of two joints, the root with positions, in degrees.
Motion small_figure(std::size_t num_frames) {
  Motion figure;
  Skeleton& skeleton = figure.skeleton;
  skeleton.joints.resize(2);
  skeleton.joints[0].name = "hips";
  skeleton.joints[1].name = "head";
  skeleton.joints[1].parent = 0;
  skeleton.joints[1].offset = Vec3(0, 2, 0);
  for (std::size_t c = 0; c < 9; ++c) {
    const std::size_t joint = c < 6 ? 0 : 1;
    const bool is_position = c < 3;
    skeleton.joints[joint].dofs.push_back({is_position ? DofKind::Translation : DofKind::Rotation,
                                           Vec3::Unit(static_cast<Eigen::Index>(c % 3)), c, 0});
    skeleton.coordinates.push_back({joint, is_position ? "position" : "rotation"});
  }
  figure.clip.num_frames = num_frames;
  figure.clip.num_coordinates = 9;
  figure.clip.timeline = {FrameRate{30}, 0};
  figure.clip.values.resize(num_frames * 9);
  const Rows rows = figure.clip.mutate();
  for (std::size_t f = 0; f < num_frames; ++f) {
    for (std::size_t c = 0; c < 9; ++c) {
      rows[f][c] = c < 3 ? 0.01 * static_cast<double>(f) : 40 + static_cast<double>(f);
    }
  }
  return figure;
}

TEST(Check, ARootThatJumpsIsNoted) {
  EXPECT_EQ(checked({small_figure(40), "", {}}, {"a.bvh"}), "");
  Motion figure = small_figure(40);
  figure.clip.mutate()[7][1] = 5;
  EXPECT_EQ(checked({figure, "", {}}, {"a.bvh"}),
            "a.bvh: note[MOT006]: joint 'hips' jumps by 4.94002 from frame 6 to 7, the first of 2 "
            "jumps\n");
  // One that is below the size of the figure is no jump, and neither is a fast way of many frames.
  figure.clip.mutate()[7][1] = 1.5;
  EXPECT_EQ(checked({figure, "", {}}, {"a.bvh"}), "");
  Motion fast = small_figure(40);
  const Rows rows = fast.clip.mutate();
  for (std::size_t f = 0; f < 40; ++f) rows[f][2] = 3 * static_cast<double>(f);
  EXPECT_EQ(checked({fast, "", {}}, {"a.bvh"}), "");
}

TEST(Check, DegreesThatLookLikeRadiansAreNoted) {
  Motion figure = small_figure(3);
  const Rows rows = figure.clip.mutate();
  for (std::size_t f = 0; f < 3; ++f) {
    for (std::size_t c = 3; c < 9; ++c) rows[f][c] = 0.7 + 0.1 * static_cast<double>(f);
  }
  EXPECT_EQ(checked({figure, "", {}}, {"a.bvh"}),
            "a.bvh: note[MOT009]: no angle is above 0.9, as if they were radians; they are read as "
            "degrees\n");
  rows[1][4] = 0;
  EXPECT_NE(checked({figure, "", {}}, {"a.bvh"}), "") << "it is still six angles";
  for (std::size_t f = 0; f < 3; ++f) rows[f][4] = 0;
  EXPECT_EQ(checked({figure, "", {}}, {"a.bvh"}), "") << "five angles are few";
  rows[1][4] = -4;
  EXPECT_EQ(checked({figure, "", {}}, {"a.bvh"}), "");
}

TEST(Check, JointsBeyondATurnAreNotedUnlessARobotHasLimits) {
  const Document body{hinge_motion({0.9, 15, -30, 0.5}), "", {}};
  EXPECT_EQ(checked(body, {"a.seq"}),
            "a.seq: note[MOT007]: joint 'joint0' reaches -30 (frame 2), beyond a full turn in "
            "radians, as if in degrees\n");
  const std::string on_robot = checked(body, {"a.seq", source_of({hinge_robot(), "", {}})});
  EXPECT_EQ(on_robot.find("MOT007"), std::string::npos);
  EXPECT_NE(on_robot.find("MOT003"), std::string::npos);
}

TEST(Check, LinksInMillimetresAndLinksThatJumpAreNoted) {
  BodyMotion body = hinge_motion({0.1, 0.2, 0.3});
  Component& links = body.components[0];
  ASSERT_EQ(links.content, kLinkPosition);
  for (std::size_t f = 0; f < 3; ++f) links.mutate()[f][2] = 700;
  EXPECT_EQ(checked({body, "", {}}, {"a.seq"}),
            "a.seq: note[MOT008]: 'link0' is 700 m from the origin (frame 0), as if in "
            "millimetres\n");
  links.mutate()[0][2] = 0.7;
  for (std::size_t f = 1; f < 3; ++f) links.mutate()[f][2] = 9;
  EXPECT_EQ(checked({body, "", {}}, {"a.seq"}),
            "a.seq: note[MOT006]: 'link0' jumps by 8.3 m from frame 0 to 1\n");
}

TEST(Check, NamesThatCannotBeSeenOrToldApartAreTold) {
  Motion figure = small_figure(3);
  figure.skeleton.joints[1].name = "HIPS";
  EXPECT_EQ(checked({figure, "", {}}, {"a.bvh"}),
            "a.bvh: note[DOC003]: the names 'hips' and 'HIPS' differ in case alone; options that "
            "name one may mean both\n");
  for (const auto& [name, code] :
       std::map<std::string, std::string>{{std::string("he\0ad", 5), "U+0000"},
                                          {"he\xC2\x9B"
                                           "ad",
                                           "U+009B"},
                                          {"he\xE2\x80\x8B"
                                           "ad",
                                           "U+200B"},
                                          {"\xEF\xBB\xBFhead", "U+FEFF"}}) {
    figure.skeleton.joints[1].name = name;
    const std::string text = checked({figure, "", {}}, {"a.bvh"});
    EXPECT_NE(text.find("warning[DOC002]"), std::string::npos) << code;
    EXPECT_NE(text.find(code), std::string::npos) << text;
  }
  for (const std::string name : {"頭", "Kopf ü", "سر\xE2\x80\x8Cها"}) {
    figure.skeleton.joints[1].name = name;
    EXPECT_EQ(checked({figure, "", {}}, {"a.bvh"}), "") << name;
  }
}

TEST(Check, ComponentsThatDoNotFitTogetherAreTold) {
  BodyMotion body = hinge_motion({0.1, 0.2, 0.3});
  body.components[1].timeline = {FrameRate{5}, 0};
  EXPECT_EQ(checked({body, "", {}}, {"a.seq"}),
            "a.seq: warning[BRG021]: the components differ in length or rate: 3 frames at 5 a "
            "second of 'JointDisplacement' beside 3 at 10 of 'LinkPosition'; 'kinefile resample' "
            "brings them to one\n");
}

}  // namespace
}  // namespace kinefile::test
