// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "kinefile/robot.hpp"
#include "kinefile/run.hpp"
#include "support/flows.hpp"
#include "support/keyframes.hpp"
#include "support/robots.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

/// A pose of slider 0 at once, one of 30 ticks to 600 words.
PoseFlow two_poses() { return word_n_of({pose_block(1, {0}, 1), pose_block(30, {600}, kNoBlock)}); }

TimedRun timed(const PoseFlow& flow, const RunSettings& settings = {}) {
  Diagnostics diagnostics;
  auto done = run(flow, settings, diagnostics);
  EXPECT_TRUE(done);
  return done ? std::move(*done) : TimedRun{};
}

std::shared_ptr<RobotProject> project_at(double tick_seconds) {
  auto project = std::make_shared<RobotProject>();
  project->tick_seconds = tick_seconds;
  return project;
}

ServoMap map_to(const std::string& joint) {
  ServoMap map = map_of_joints(1);
  map.entries[0].joint = joint;
  return map;
}

std::string run_csv_of(const RunTable& table) {
  std::string text;
  write_run_csv(table, [&text](std::string_view piece) {
    text += piece;
    return true;
  });
  return text;
}

TEST(RunDocuments, TheCallerTheProjectOrTheMapSaysHowLongATickIs) {
  EXPECT_EQ(timed(two_poses()).tick_seconds, 1.0 / 60);
  RunSettings settings;
  settings.servo_map = map_to("HINGE");
  settings.servo_map->tick_seconds = 0.03;
  EXPECT_EQ(timed(two_poses(), settings).tick_seconds, 0.03);
  settings.project = project_at(0.02);
  EXPECT_EQ(timed(two_poses(), settings).tick_seconds, 0.02);
  settings.tick_us = 10'000;
  EXPECT_EQ(timed(two_poses(), settings).tick_seconds, 0.01);
  settings.tick_us = 16667;
  EXPECT_EQ(timed(two_poses(), settings).tick_seconds, 1.0 / 60);
}

TEST(RunDocuments, TheBasePoseIsTheCallersTheProjectsOrTheMaps) {
  RunSettings settings;
  settings.servo_map = map_to("HINGE");
  settings.servo_map->base_pose = {7};
  EXPECT_EQ(timed(two_poses(), settings).options.base_pose, std::vector<std::int16_t>{7});
  auto project = project_at(1.0 / 60);
  project->sliders.resize(1);
  project->base_poses = {{"stand", {8}, {}}};
  settings.project = project;
  EXPECT_EQ(timed(two_poses(), settings).options.base_pose, std::vector<std::int16_t>{8});
  settings.options.base_pose = {9};
  EXPECT_EQ(timed(two_poses(), settings).options.base_pose, std::vector<std::int16_t>{9});
}

TEST(RunDocuments, TimesInSecondsBecomeTicks) {
  RunSettings settings;
  settings.max_seconds = 0.25;
  settings.hold_seconds = 0.1;
  const TimedRun run = timed(two_poses(), settings);
  EXPECT_EQ(run.run.num_ticks, 15u);
  EXPECT_EQ(run.run.end, flow::End::MaxTicks);
  EXPECT_EQ(run.options.hold_ticks, 6u);
  settings.max_seconds = 1e12;
  EXPECT_EQ(timed(two_poses(), settings).options.max_ticks, kMostRunTicks);
}

TEST(RunDocuments, ARunBecomesDisplacementsOfARobotOrTheMotionOfAFigure) {
  Diagnostics diagnostics;
  const TimedRun run = timed(two_poses());
  const auto plain = document_of_run(run, map_to("HINGE"), {}, diagnostics);
  ASSERT_TRUE(plain);
  EXPECT_EQ(std::get<BodyMotion>(plain->content).components[0].num_frames, 32u);
  const auto robots =
      document_of_run(run, map_to("HINGE"), source_of({hinge_robot(), "", {}}), diagnostics);
  ASSERT_TRUE(robots);
  EXPECT_TRUE(std::holds_alternative<BodyMotion>(robots->content));
  Skeleton figure = hinge_robot();
  figure.joints[0].dofs.clear();
  const auto motion =
      document_of_run(run, map_to("HINGE"), source_of({figure, "", {}}), diagnostics);
  ASSERT_TRUE(motion);
  const Motion& turned = std::get<Motion>(motion->content);
  EXPECT_NEAR(turned.clip.row(31)[kRootColumns], 6 * kRadiansPerDegree, 1e-12);
  EXPECT_EQ(document_of_run(run, map_to("HINGE"), source_that_fails(), diagnostics).error().code,
            "IO001");
  EXPECT_EQ(
      document_of_run(run, map_to("H"), source_of({PoseFlow{}, "", {}}), diagnostics).error().code,
      "DOC001");
}

TEST(RunDocuments, KeyframesOfADocumentOfEveryKind) {
  Diagnostics diagnostics;
  const servo::KeyframeOptions options{.num_poses = 2, .tolerance = {}};
  const DocumentSource robot = source_of({hinge_robot(), "", {}});
  const Document body{hinge_motion({0, 0.1}), "", {}};
  const auto made = keyframe(body, map_to("HINGE"), robot, options, diagnostics);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->ticks, (std::vector<std::size_t>{0, 6}));
  const auto posed =
      robot::pose(std::get<BodyMotion>(body.content), hinge_robot(), false, diagnostics);
  const auto same =
      keyframe({*posed, "", {}}, map_to("HINGE"), source_that_fails(), options, diagnostics);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->flow, made->flow);
  EXPECT_EQ(keyframe(body, map_to("HINGE"), source_that_fails(), options, diagnostics).error().code,
            "IO001");
  const auto refused = keyframe({hinge_robot(), "", {}}, map_to("HINGE"), {}, options, diagnostics);
  EXPECT_EQ(refused.error().message, "expected a motion to make poses of, found a skeleton alone");
}

TEST(RunDocuments, ATableShowsWordsOrDegreesAndEvents) {
  PoseFlow flow = word_n_of({pose_block(1, {100}, 1), pose_block(1, {200}, kNoBlock)});
  pose_of(flow.blocks[1]).sound = "a,b.wav";
  const TimedRun run = timed(flow);
  EXPECT_EQ(run_csv_of({run}),
            "tick,time,s0,sound\n0,0,0,\n1,0.016666666666666666,100,\"a,b.wav\"\n"
            "2,0.03333333333333333,200,\n");
  RobotProject project;
  project.sliders.resize(1);
  project.sliders[0].name = "HEAD";
  project.sliders[0].units_per_degree = 50;
  project.base_poses = {{"stand", {100}, {}}};
  EXPECT_TRUE(run_csv_of({run, &project}).starts_with("tick,time,HEAD,sound\n0,0,0,\n"));
  EXPECT_TRUE(run_csv_of({run, &project, true}).starts_with("tick,time,HEAD,sound\n0,0,-2,\n"));
}

TEST(RunDocuments, ATraceHasALineABlockAndSaysHowItEnded) {
  const PoseFlow flow = two_poses();
  EXPECT_EQ(trace_of(flow, timed(flow)),
            "     0     0.000  0 pose, 1 tick\n     1     0.017  1 pose, 30 ticks\n"
            "    31     0.517  ends\n");
}

std::vector<flow::Input> inputs_of(std::string_view text) {
  auto inputs = parse_inputs(text, "in.csv");
  EXPECT_TRUE(inputs);
  return inputs ? std::move(*inputs) : std::vector<flow::Input>();
}

std::string input_fault(std::string_view text) {
  const auto inputs = parse_inputs(text, "in.csv");
  EXPECT_FALSE(inputs);
  const std::string shown = inputs ? "" : to_string(inputs.error());
  return shown.substr(0, shown.find('\n'));
}

TEST(RunInputs, CellsThatAreEmptyChangeNothing) {
  const auto inputs = inputs_of("v64,tick,held\n3,0,\n, 10 ,1\r\n\n-2,10,\"0\"\n");
  ASSERT_EQ(inputs.size(), 3u);
  EXPECT_EQ(inputs[0].tick, 0u);
  EXPECT_FALSE(inputs[0].is_held);
  EXPECT_EQ(inputs[0].variables[0], (std::pair<std::size_t, std::int16_t>{64, 3}));
  EXPECT_EQ(inputs[1].tick, 10u);
  EXPECT_EQ(inputs[1].is_held, true);
  EXPECT_TRUE(inputs[1].variables.empty());
  EXPECT_EQ(inputs[2].is_held, false);
  EXPECT_EQ(inputs[2].variables[0].second, -2);
}

TEST(RunInputs, AByteOrderMarkAndQuotesAreNothing) {
  EXPECT_EQ(inputs_of("\xef\xbb\xbf\"tick\",\"held\"\r\n0,1\r\n").size(), 1u);
}

TEST(RunInputs, FaultsHaveTheirPlaces) {
  EXPECT_EQ(input_fault(""),
            "in.csv: error[RUN010]: expected a header with a column tick, found nothing");
  EXPECT_EQ(input_fault("held,v64\n"),
            "in.csv:1:1: error[RUN010]: expected a column tick, found none");
  EXPECT_EQ(input_fault("tick,v256\n"),
            "in.csv:1:6: error[RUN010]: expected columns tick, held and v0 to v255, found 'v256'");
  EXPECT_EQ(input_fault("tick,held,held\n"),
            "in.csv:1:11: error[RUN010]: expected each column once, found 'held' again");
  EXPECT_EQ(input_fault("tick,held\n\n 0 , 2\n"),
            "in.csv:3:6: error[RUN011]: expected 0 or 1, found '2'");
  EXPECT_EQ(input_fault("tick,v64\n5,40000\n"),
            "in.csv:2:3: error[RUN011]: expected a whole number from -32768 to 32767, found "
            "'40000'");
  EXPECT_EQ(input_fault("tick\n-1\n"), "in.csv:2:1: error[RUN011]: expected a tick, found '-1'");
  EXPECT_EQ(input_fault("tick\n20\n10\n"),
            "in.csv:3:1: error[RUN012]: expected a tick of 20 or later, found 10");
  EXPECT_EQ(input_fault("tick,v64\n20\n"),
            "in.csv:2:1: error[RUN013]: expected 2 cells, as the header has, found 1");
}

TEST(RunInputs, QuotesMustBeClosed) {
  EXPECT_EQ(
      input_fault("tick,held\n0,\"1\n"),
      "in.csv:2:3: error[RUN011]: expected a quote that closes this one, found the end of the "
      "file");
  EXPECT_EQ(input_fault("tick,held\n0,\"1\"x\n"),
            "in.csv:2:6: error[RUN011]: expected a comma or the end of the line behind a field in "
            "quotes");
}

}  // namespace
}  // namespace kinefile::test
