// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinefile/robot.hpp"
#include "support/keyframes.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

/// A robot: a free root, and joints HEAD (id 0), ARM (id 1) and SLIDE (id 2), which moves straight.
Skeleton small_robot() {
  Skeleton robot;
  robot.angle_unit = AngleUnit::Radians;
  robot.metres_per_unit = 1;
  const auto add = [&robot](const char* name, std::size_t parent, DofKind kind, std::size_t column,
                            double rest) {
    Joint& joint = robot.joints.emplace_back();
    joint.name = name;
    joint.parent = parent;
    joint.dofs.push_back({kind, Vec3::UnitX(), column, rest});
  };
  add("ROOT", kNoParent, DofKind::Free, 0, 0);
  add("HEAD", 0, DofKind::Rotation, 7, 0);
  add("ARM", 0, DofKind::Rotation, 8, 0.25);
  add("SLIDE", 0, DofKind::Translation, 9, 0);
  for (const char* channel : {"x", "y", "z", "qw", "qx", "qy", "qz"}) {
    robot.coordinates.push_back({0, channel});
  }
  for (std::size_t j = 1; j <= 3; ++j) robot.coordinates.push_back({j, "q"});
  return robot;
}

ServoMap map_of(const std::vector<std::string>& joints) {
  ServoMap map = map_of_joints(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) map.entries[j].joint = joints[j];
  return map;
}

/// Two sliders and three ticks' values of each.
flow::Run small_run() {
  flow::Run run;
  run.num_sliders = 2;
  run.num_ticks = 2;
  run.sliders = {0, 0, 100, -200, 250, -400};
  return run;
}

double degrees(double value) { return value / kRadiansPerDegree; }

TEST(Unroll, WithoutARobotJointsAreInTheOrderOfTheMap) {
  Diagnostics diagnostics;
  const auto body = servo::unroll(small_run(), map_of({"a", "b"}), nullptr, diagnostics);
  ASSERT_TRUE(body);
  ASSERT_EQ(body->components.size(), 1u);
  const Component& joints = body->components[0];
  EXPECT_EQ(joints.content, kJointDisplacement);
  EXPECT_EQ(joints.num_parts, 2u);
  EXPECT_EQ(joints.num_frames, 3u);
  EXPECT_EQ(frame_rate(joints.timeline), 60);  // exactly
  EXPECT_NEAR(degrees(joints.row(1)[0]), 1, 1e-12);
  EXPECT_NEAR(degrees(joints.row(1)[1]), -2, 1e-12);
  EXPECT_NEAR(degrees(joints.row(2)[0]), 2.5, 1e-12);
  EXPECT_TRUE(diagnostics.items().empty());
}

TEST(Unroll, OfARobotJointsAreInTheOrderOfItsIdsAndOthersRest) {
  Diagnostics diagnostics;
  const Skeleton robot = small_robot();
  const auto body = servo::unroll(small_run(), map_of({"TAIL", "HEAD"}), &robot, diagnostics);
  ASSERT_TRUE(body);
  const Component& joints = body->components[0];
  EXPECT_EQ(joints.num_parts, 3u);
  EXPECT_NEAR(degrees(joints.row(2)[0]), -4, 1e-12);
  EXPECT_EQ(joints.row(2)[1], 0.25);
  EXPECT_EQ(joints.row(2)[2], 0);
  EXPECT_EQ(text_of(diagnostics),
            "warning[SVM011]: joints of the servo map that the motion of the robot does not have, "
            "or not as one angle, are left out: 'TAIL'\n");
}

TEST(Unroll, ARobotWithNoneOfTheJointsIsRefused) {
  Diagnostics diagnostics;
  const Skeleton robot = small_robot();
  EXPECT_EQ(servo::unroll(small_run(), map_of({"TAIL", "SLIDE"}), &robot, diagnostics).error().code,
            "SVM010");
  Skeleton figure = robot;
  figure.joints[0].dofs.clear();
  EXPECT_EQ(servo::unroll(small_run(), map_of({"HEAD"}), &figure, diagnostics).error().code,
            "BRG012");
}

TEST(Unroll, SlidersThatTheFlowDoesNotHaveAreZero) {
  Diagnostics diagnostics;
  ServoMap map = map_of({"a"});
  map.entries[0].slider = 40;
  map.entries[0].offset = 100;
  const auto body = servo::unroll(small_run(), map, nullptr, diagnostics);
  ASSERT_TRUE(body);
  EXPECT_NEAR(degrees(body->components[0].row(0)[0]), -1, 1e-12);
}

TEST(Unroll, OtherTicksAreOtherRates) {
  Diagnostics diagnostics;
  ServoMap map = map_of({"a"});
  map.tick_seconds = 0.02;
  const auto body = servo::unroll(small_run(), map, nullptr, diagnostics);
  EXPECT_EQ(frame_rate(body.value().components[0].timeline), 50);
}

TEST(Unroll, AMotionOfAFigureHasItsUnits) {
  Diagnostics diagnostics;
  const Skeleton figure = motion_of(bvh_with_rows({"1 2 3 4 5 6 0 0 0"})).skeleton;
  const std::string column = column_names(figure)[3];
  const auto motion = servo::motion_of_run(small_run(), map_of({column}), figure, diagnostics);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->clip.num_frames, 3u);
  EXPECT_NEAR(motion->clip.row(2)[3], 2.5, 1e-12);
  EXPECT_EQ(motion->clip.row(2)[4], 0);
}

TEST(TrajectoryOf, MotionsByJointOrChannelInTheirUnits) {
  Diagnostics diagnostics;
  Motion robot{small_robot(), {}};
  robot.clip.num_frames = 2;
  robot.clip.num_coordinates = 10;
  robot.clip.values = {0, 0, 0, 1, 0, 0, 0, 0.1, 0.2, 0.3, 0, 0, 0, 1, 0, 0, 0, 0.4, 0.5, 0.6};
  robot.clip.timeline.given = FrameTime{0.0166667};  // which stands for 1/60
  const auto trajectory = servo::trajectory_of(robot, map_of({"ARM.q", "HEAD"}), diagnostics);
  ASSERT_TRUE(trajectory);
  EXPECT_EQ(trajectory->joints, (std::vector<std::string>{"ARM.q", "HEAD"}));
  EXPECT_EQ(trajectory->angles, (std::vector<double>{0.2, 0.1, 0.5, 0.4}));
  EXPECT_EQ(trajectory->frame_time, 1.0 / 60);

  const Motion figure = motion_of(bvh_with_rows({"1 2 3 90 5 6 0 0 0"}));
  const std::string column = column_names(figure.skeleton)[3];
  const auto turned = servo::trajectory_of(figure, map_of({column}), diagnostics);
  ASSERT_TRUE(turned);
  EXPECT_NEAR(turned->angles[0], 90 * kRadiansPerDegree, 1e-15);
  EXPECT_EQ(diagnostics.items().size(), diagnostics.count_of("SVM014", Severity::Note));
  // A joint of several angles is none, nor is a position.
  const std::string root = figure.skeleton.joints[0].name;
  const std::string position = column_names(figure.skeleton)[0];
  EXPECT_EQ(servo::trajectory_of(figure, map_of({root, position}), diagnostics).error().code,
            "SVM010");
}

TEST(TrajectoryOf, BodyMotionsByIdsOrInTheOrderOfTheMap) {
  Diagnostics diagnostics;
  BodyMotion body;
  Component& joints = body.components.emplace_back();
  joints.content = kJointDisplacement;
  joints.num_parts = 3;
  joints.num_frames = 1;
  joints.values = {0.1, 0.2, 0.3};
  const Skeleton robot = small_robot();
  const auto by_ids = servo::trajectory_of(body, map_of({"ARM", "HEAD"}), &robot, diagnostics);
  EXPECT_EQ(by_ids.value().angles, (std::vector<double>{0.2, 0.1}));
  const std::string left_out =
      "note[SVM014]: servos follow 2 of 3 joints; the others and other components, such as where "
      "the robot goes, are left out\n";
  EXPECT_EQ(text_of(diagnostics), left_out);
  const auto in_order = servo::trajectory_of(body, map_of({"ARM", "HEAD"}), nullptr, diagnostics);
  EXPECT_EQ(in_order.value().angles, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(text_of(diagnostics),
            left_out + left_out +
                "warning[SVM012]: expected 2 joints, as the servo map has, found 3; without "
                "--skeleton they are taken in its order\n");
  EXPECT_EQ(servo::trajectory_of(BodyMotion{}, map_of({"ARM"}), nullptr, diagnostics).error().code,
            "BRG010");
}

TEST(TrajectoryOf, FramesWithTimesAreInterpolatedAtTicks) {
  Diagnostics diagnostics;
  BodyMotion body;
  Component& joints = body.components.emplace_back();
  joints.content = kJointDisplacement;
  joints.num_frames = 3;
  joints.values = {0, 3, 0};
  joints.timeline.given = FrameTimes{{1, 1.05, 1.1}};  // three ticks up, three down
  const auto trajectory = servo::trajectory_of(body, map_of({"ARM"}), nullptr, diagnostics);
  ASSERT_TRUE(trajectory);
  EXPECT_EQ(trajectory->frame_time, 1.0 / 60);
  ASSERT_EQ(trajectory->num_frames, 7u);
  const std::vector<double> expected = {0, 1, 2, 3, 2, 1, 0};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(trajectory->angles[i], expected[i], 1e-9);
  joints.timeline.given = FrameTimes{{0, 1, 1e300}};
  EXPECT_EQ(servo::trajectory_of(body, map_of({"ARM"}), nullptr, diagnostics).error().code,
            "KEY001");
}

TEST(TrajectoryOf, ThereAndBackWithinTheTolerance) {
  Diagnostics diagnostics;
  const ServoMap map = map_of_joints(4, 128);
  BodyMotion body;
  Component& joints = body.components.emplace_back();
  joints.content = kJointDisplacement;
  joints.num_parts = 4;
  joints.num_frames = 240;
  joints.values = swinging(4, 240, 3).angles;
  joints.timeline = {FrameRate{60}, 0};
  const auto trajectory = servo::trajectory_of(body, map, nullptr, diagnostics);
  ASSERT_TRUE(trajectory);
  const auto made = servo::keyframe(
      *trajectory, map, {.num_poses = {}, .tolerance = 1.5, .lead_in_ticks = 40}, diagnostics);
  ASSERT_TRUE(made);
  EXPECT_LT(made->ticks.size(), 120u);
  const auto run = flow::run(made->flow, {}, diagnostics);
  ASSERT_TRUE(run);
  const auto back = servo::unroll(*run, map, nullptr, diagnostics);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->components[0].num_frames, 240u + 40u);
  double largest = 0;
  for (std::size_t i = 0; i < joints.values.size(); ++i) {
    const double off = back->components[0].values[40 * 4 + i] - joints.values[i];
    largest = std::max(largest, std::abs(degrees(off)));
  }
  EXPECT_LE(largest, 1.5);
  EXPECT_GT(largest, 0.5);  // poses were saved
  EXPECT_TRUE(diagnostics.items().empty());
}

TEST(TrajectoryOf, NamesOfPartsTellWithoutARobot) {
  Diagnostics diagnostics;
  const auto body = servo::unroll(small_run(), map_of({"a", "b"}), nullptr, diagnostics);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->components[0].part_names, (std::vector<std::string>{"a", "b"}));
  const auto trajectory =
      servo::trajectory_of(*body, map_of({"b", "c", "a"}), nullptr, diagnostics);
  ASSERT_TRUE(trajectory);
  EXPECT_EQ(trajectory->joints, (std::vector<std::string>{"b", "a"}));
  EXPECT_EQ(diagnostics.items().at(0).code, "SVM011");
  for (std::size_t frame = 0; frame < trajectory->num_frames; ++frame) {
    EXPECT_EQ(trajectory->angles[frame * 2], body->components[0].row(frame)[1]);
    EXPECT_EQ(trajectory->angles[frame * 2 + 1], body->components[0].row(frame)[0]);
  }
}

}  // namespace
}  // namespace kinefile::test
