// SPDX-License-Identifier: MIT
#include "kinefile/marks.hpp"

#include <gtest/gtest.h>

#include "kinefile/place.hpp"
#include "support/robots.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile::test {
namespace {

using Kind = Mark::Kind;

TEST(Marks, AWalkHasNone) {
  EXPECT_TRUE(find_marks(examples::make_walk()).empty());
  EXPECT_TRUE(find_marks(examples::make_walk({.num_frames = 1})).empty());
  EXPECT_TRUE(find_marks(Motion{}).empty());
}

TEST(Marks, SuddenTurnsLastUntilTheJointIsBack) {
  constexpr std::size_t kHeadY = 3 + 6 * 3 - 1;
  Motion walk = examples::make_walk({.num_frames = 40});
  const Rows rows = walk.clip.mutate();
  for (std::size_t f = 13; f < 16; ++f) rows[f][kHeadY] += 170;
  for (std::size_t f = 30; f < 40; ++f) rows[f][kHeadY] += 170;
  const std::vector<Mark> marks = find_marks(walk);
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_EQ(marks[0].kind, Kind::Spike);
  EXPECT_EQ(marks[0].severity, Severity::Note);
  EXPECT_EQ(walk.skeleton.joints[marks[0].joint].name, "Head");
  EXPECT_EQ(marks[0].first_frame, 13u);
  EXPECT_EQ(marks[0].num_frames, 3u);
  EXPECT_EQ(marks[0].worst_frame, 13u);
  EXPECT_EQ(marks[0].code, "MOT001");
  EXPECT_EQ(marks[0].message,
            "joint 'Head' turns by 170 degrees from frame 12 to 13 and is back in frame 16");
  EXPECT_EQ(marks[1].kind, Kind::Flip);
  EXPECT_EQ(marks[1].first_frame, 30u);
  EXPECT_EQ(marks[1].num_frames, 1u);
  EXPECT_EQ(marks[1].worst_frame, 30u);
  EXPECT_EQ(marks[1].code, "MOT002");
}

TEST(Marks, OfARobotAreWarnings) {
  const Document body{hinge_motion({0.9, 1.1, 1.2, 0.5, -1.5}), "", {}};
  const auto placed = place(body, source_of({hinge_robot(), "", {}}), false, ignored());
  ASSERT_TRUE(placed);
  const std::vector<Mark> marks = find_marks(placed->motion);
  ASSERT_EQ(marks.size(), 3u);
  EXPECT_EQ(marks[0].kind, Kind::BelowLimit);
  EXPECT_EQ(marks[0].first_frame, 4u);
  EXPECT_EQ(marks[0].num_frames, 1u);
  EXPECT_EQ(marks[1].kind, Kind::AboveLimit);
  EXPECT_EQ(marks[1].first_frame, 1u);
  EXPECT_EQ(marks[1].num_frames, 2u);
  EXPECT_EQ(marks[1].worst_frame, 2u);
  EXPECT_EQ(marks[1].code, "MOT003");
  EXPECT_EQ(
      marks[1].message,
      "joint 'HINGE' goes up to 68.7549 deg (frame 2), its limit is 57.2958 deg; beyond it in "
      "2 frames, first in 1");
  EXPECT_EQ(marks[2].kind, Kind::TooFast);
  EXPECT_EQ(marks[2].worst_frame, 4u);
  EXPECT_EQ(marks[2].code, "MOT004");
  for (const Mark& mark : marks) {
    EXPECT_EQ(mark.severity, Severity::Warning);
    EXPECT_EQ(placed->motion.skeleton.joints[mark.joint].name, "HINGE");
  }
}

TEST(Marks, OfAFigureAreOneAJointAndKindAndNotes) {
  Motion figure;
  Joint& joint = figure.skeleton.joints.emplace_back();
  joint.name = "arm";
  joint.dofs.push_back({DofKind::Rotation, Vec3::UnitX(), 0, 0, -10, 10});
  joint.dofs.push_back({DofKind::Rotation, Vec3::UnitY(), 1, 0, -10, 10});
  figure.skeleton.coordinates = {{0, "rx"}, {0, "ry"}};
  figure.clip.num_frames = 2;
  figure.clip.num_coordinates = 2;
  figure.clip.values = {12, 11, -11, 25};
  const std::vector<Mark> marks = find_limit_marks(figure);
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_EQ(marks[0].kind, Kind::BelowLimit);
  EXPECT_EQ(marks[0].worst_frame, 1u);
  EXPECT_EQ(marks[1].kind, Kind::AboveLimit);
  EXPECT_EQ(marks[1].worst_frame, 1u);
  EXPECT_EQ(marks[1].severity, Severity::Note);
  EXPECT_EQ(find_marks(figure).size(), 2u);
}

}  // namespace
}  // namespace kinefile::test
