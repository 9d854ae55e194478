// SPDX-License-Identifier: MIT
// Tables of joint values, in and out. tests/formats/csv/invalid holds a file for every code that
// reading can give, and beside it the exact diagnostics.

#include <fmt/format.h>

#include "formats/table_rate.hpp"
#include "kinefile/robot.hpp"
#include "support/seq.hpp"

namespace kinefile::test {
namespace {

ReadText read_csv(std::string_view bytes, ReadOptions options = {}, bool is_strict = false) {
  if (options.source_name == "<memory>") options.source_name = "t.csv";
  ReadText read;
  read.diagnostics.warnings_are_errors = is_strict;
  auto document = find_format("csv")->read(bytes, options, read.diagnostics);
  if (document) read.document = std::move(*document);
  return read;
}

/// Two joints whose ids are in another order than their links.
std::shared_ptr<const Document> robot_document() {
  ReadText read;
  auto document = find_format("body")->read(
      "format: ChoreonoidBody\nformat_version: 2\nlinks:\n"
      "  - { name: WAIST, joint_type: free }\n"
      "  - { name: KNEE, parent: WAIST, joint_name: KNEE_P, joint_type: revolute, joint_id: 1, "
      "joint_axis: [ 0, 1, 0 ] }\n"
      "  - { name: HIP, parent: WAIST, joint_type: revolute, joint_id: 0, joint_axis: [ 0, 1, 0 ] "
      "}\n",
      {}, read.diagnostics);
  EXPECT_TRUE(document) << text_of(read.diagnostics);
  return document ? std::make_shared<const Document>(std::move(*document)) : nullptr;
}

TEST(CsvInvalid, EveryFileHasItsExactDiagnostics) {
  const auto names = fixtures("csv/invalid", ".csv");
  ASSERT_GT(names.size(), 14u);
  for (const std::string& name : names) {
    ReadOptions options;
    options.source_name = name.substr(name.find_last_of('/') + 1);
    const std::string expected = fixture(name.substr(0, name.size() - 3) + "txt");
    const ReadText read = read_csv(fixture(name), options);
    EXPECT_EQ(text_of(read.diagnostics), expected) << name;
    EXPECT_EQ(read.document.has_value(), !read.diagnostics.has_errors()) << name;
  }
}

TEST(Csv, ReadsJointsLinksAndPoints) {
  const auto read = read_csv(
      "time,HIP.q,\"WAIST, lower.x\",\"WAIST, lower.y\",\"WAIST, lower.z\",\"WAIST, lower.qw\","
      "\"WAIST, lower.qx\",\"WAIST, lower.qy\",\"WAIST, lower.qz\",KNEE,ZMP.x,ZMP.y,ZMP.z\r\n"
      "0,0.1,1,2,3,1,0,0,0,0.2,7,8,9\r\n"
      "\r\n"
      "0.02, 0.3 ,4,5,6,0,1,0,0,\"0.4\",-7,inf,nan\r\n");
  const auto& components = components_of(read);
  ASSERT_EQ(components.size(), 3u);
  EXPECT_EQ(components[0].content, kJointDisplacement);
  EXPECT_EQ(components[0].values, (std::vector<double>{0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(components[1].content, kLinkPosition);
  EXPECT_EQ(components[1].values, (std::vector<double>{1, 2, 3, 1, 0, 0, 0, 4, 5, 6, 0, 1, 0, 0}));
  EXPECT_EQ(components[2].content, kZmp);
  EXPECT_EQ(components[2].values[3], -7);
  EXPECT_TRUE(std::isnan(components[2].values[5]));
  EXPECT_EQ(components[0].timeline, (Timeline{FrameRate{50}, 0}));
  EXPECT_EQ(components[0].num_frames, 2u);
}

TEST(Csv, ManyRowsAreReadAsFewAre) {
  for (const std::string line_end : {"\n", "\r\n"}) {
    std::string text =
        "time,b.q,WAIST.x,WAIST.y,WAIST.z,WAIST.qw,WAIST.qx,WAIST.qy,WAIST.qz,a.q" + line_end;
    std::vector<double> joints;
    std::vector<double> poses;
    constexpr int kRows = 9000;
    for (int i = 0; i < kRows; ++i) {
      const double b = -1.5 * i;
      const double x = 1e-3 * i;
      const bool is_odd = i % 1000 == 999;
      text += fmt::format("{},{},{},2,3,1,0,0,0,", 0.002 * i,
                          is_odd ? fmt::format("\"{}\"", b) : fmt::format("{}", b), x);
      text += is_odd ? "+0.25" + line_end + line_end : "0.25" + line_end;
      joints.insert(joints.end(), {b, 0.25});
      poses.insert(poses.end(), {x, 2, 3, 1, 0, 0, 0});
    }
    const auto read = read_csv(text);
    const auto& components = components_of(read);
    ASSERT_EQ(components.size(), 2u);
    EXPECT_EQ(components[0].num_frames, static_cast<std::size_t>(kRows));
    EXPECT_EQ(components[0].values, joints);
    EXPECT_EQ(components[1].values, poses);
    EXPECT_EQ(components[0].timeline, (Timeline{FrameRate{500}, 0}));
    // The odd rows have an empty line behind them.
    const auto odd = read_csv(text + "18,1,2,3,x" + line_end);
    EXPECT_EQ(odd.diagnostics.first_error().place.line, 2u + kRows + kRows / 1000);
    EXPECT_EQ(odd.diagnostics.first_error().code, "CSV004");
  }
}

TEST(Csv, LinksMayHaveRollPitchAndYaw) {
  const auto read = read_csv(
      "time,W.x,W.y,W.z,W.roll,W.pitch,W.yaw,NECK.yaw,V.X,V.y,V.z,V.roll,V.pitch,V.yaw\n"
      "0,1,2,3,0.1,0.2,0.3,9,4,5,6,0,0,0.5\n");
  const auto& components = components_of(read);
  ASSERT_EQ(components.size(), 2u);
  EXPECT_EQ(components[0].content, kLinkPosition);
  EXPECT_EQ(components[0].pose_form, PoseForm::RollPitchYaw);
  EXPECT_EQ(components[0].values,
            (std::vector<double>{1, 2, 3, 0.1, 0.2, 0.3, 4, 5, 6, 0, 0, 0.5}));
  EXPECT_EQ(components[1].part_names, std::vector<std::string>{"NECK.yaw"});
}

TEST(Csv, NumberedPartsBelongToTheirContents) {
  const auto read = read_csv(
      "time,JointEffort0.q,Grip[0].q,Grip[1].q,HAND,Tip[0].x,Tip[0].y,Tip[0].z,Tip[0].qw,Tip[0].qx,"
      "Tip[0].qy,Tip[0].qz\n0,1,2,3,4,5,6,7,1,0,0,0\n");
  const auto& components = components_of(read);
  ASSERT_EQ(components.size(), 4u);
  EXPECT_EQ(components[0].content, "JointEffort");
  EXPECT_EQ(components[1].content, "Grip");
  EXPECT_EQ(components[1].values, (std::vector<double>{2, 3}));
  EXPECT_EQ(components[2].content, kJointDisplacement);
  EXPECT_EQ(components[3].content, "Tip");
  EXPECT_EQ(components[3].kind, ComponentKind::Poses);
}

TEST(Csv, PointsMayBeRelativeToTheRoot) {
  const auto read = read_csv("time,ZMP.root.x,ZMP.root.y,ZMP.root.z\n0,1,2,3\n1,4,5,6\n");
  const Component& zmp = components_of(read)[0];
  EXPECT_EQ(zmp.content, kZmp);
  EXPECT_TRUE(zmp.is_root_relative);
  EXPECT_EQ(column_names(robot::motion_of_component(zmp).skeleton)[0], "ZMP.root.x");
}

TEST(Csv, TheRateIsWhatTheTimesTell) {
  const auto rate_of = [](const std::string& rows, std::optional<double> fps = {}) {
    ReadOptions options;
    options.fps = fps;
    return frame_rate(components_of(read_csv("time,A\n" + rows, options))[0].timeline);
  };
  EXPECT_EQ(rate_of("0,1\n0.0333,1\n0.0667,1\n0.1,1\n"), 30);
  EXPECT_EQ(rate_of("5,1\n5.5,1\n"), 2);
  EXPECT_DOUBLE_EQ(rate_of("0,1\n0.4,1\n0.8,1\n"), 2.5);
  EXPECT_EQ(rate_of("0,1\n0.4,1\n", 100), 100);
  EXPECT_EQ(rate_of("0,1\n"), 30);
  EXPECT_EQ(rate_of("0,1\n0.017,1\n0.033,1\n0.050,1\n0.067,1\n0.083,1\n"), 60);
  EXPECT_EQ(rate_of("0,1\n0.011,1\n0.022,1\n0.033,1\n0.044,1\n0.056,1\n0.067,1\n"), 90);
  const auto read = read_csv("time,A\n0,1\n0.1,2\n0.3,3\n");
  EXPECT_EQ(own_times(components_of(read)[0].timeline), (std::vector<double>{0, 0.1, 0.3}));
}

/// A table of one joint whose times are printed with few decimals.
std::string printed_table(double rate, int decimals, int num_rows, double start) {
  std::string table = "time,A\n";
  for (int i = 0; i < num_rows; ++i) {
    table += fmt::format("{:.{}f},{}\n", start + i / rate, decimals, i);
  }
  return table;
}

TEST(Csv, RoundedTimesAreSteady) {
  for (const double rate : {24.0, 25.0, 30.0, 50.0, 60.0, 100.0, 120.0, 240.0}) {
    for (const int decimals : {3, 4, 5, 6}) {
      for (const int num_rows : {2, 3, 4, 7, 20, 61, 5000}) {
        for (const double start : {0.0, 1.0, 12.3456789}) {
          const auto read = read_csv(printed_table(rate, decimals, num_rows, start));
          const Component& joints = components_of(read)[0];
          EXPECT_FALSE(has_own_times(joints.timeline));
          // A few rows in milliseconds do not tell 240 from 250, or from anywhere 24 from 25.
          const bool is_told = num_rows >= 20 || (start == 0 && (rate != 240 || num_rows >= 7));
          if (!is_told && decimals == 3) continue;
          EXPECT_EQ(frame_rate(joints.timeline), rate)
              << decimals << " decimals, " << num_rows << " rows, from " << start;
        }
      }
    }
  }
}

TEST(Csv, OtherRatesAreFoundInRoundedTimes) {
  const auto rate_of = [](double rate, int decimals) {
    return frame_rate(components_of(read_csv(printed_table(rate, decimals, 3000, 0)))[0].timeline);
  };
  for (const double rate : {72.0, 90.0, 144.0, 7.5, 12.5, 29.97, 23.976, 33.3}) {
    for (const int decimals : {3, 4}) {
      const double found = rate_of(rate, decimals);
      EXPECT_NEAR(found, rate, 2e-6 * rate) << decimals;
    }
  }
  EXPECT_EQ(rate_of(30 / 1.001, 4), 30.0 * 1000 / 1001);
  for (const double rate : {239.76, 119.876, 17.53, 240 / 1.001}) {
    for (const double start : {0.0, 3.21}) {
      const auto read = read_csv(printed_table(rate, 4, 3000, start));
      EXPECT_NEAR(frame_rate(components_of(read)[0].timeline), rate, 1e-5 * rate) << start;
      EXPECT_FALSE(has_own_times(components_of(read)[0].timeline)) << rate << " from " << start;
    }
  }
  // Cut off, not rounded.
  const auto read = read_csv("time,A\n0.000,1\n0.016,1\n0.033,1\n0.050,1\n0.066,1\n0.083,1\n");
  EXPECT_EQ(frame_rate(components_of(read)[0].timeline), 60);
}

TEST(Csv, GapsAndJitterAreNotRounding) {
  for (const char* const rows :
       {"0,1\n0.017,1\n0.033,1\n0.067,1\n0.083,1\n",
        "0.000,1\n0.017,1\n0.036,1\n0.050,1\n0.067,1\n0.083,1\n", "0.0,1\n0.1,1\n0.2,1\n0.4,1\n",
        "3.000,1\n3.033,1\n3.100,1\n3.133,1\n", "0.0000,1\n0.0333,1\n0.0669,1\n0.1000,1\n"}) {
    const auto read = read_csv(std::string("time,A\n") + rows);
    EXPECT_TRUE(has_own_times(components_of(read)[0].timeline)) << rows;
  }
}

TEST(Csv, TheLastPrintedDigitCounts) {
  const auto half = [](std::string_view text) {
    return half_of_last_digit(text.data(), text.data() + text.size());
  };
  EXPECT_DOUBLE_EQ(half("0.050,1"), 0.0005);
  EXPECT_DOUBLE_EQ(half("\"0.050\",1"), 0.0005);
  EXPECT_DOUBLE_EQ(half("  12 0.25"), 0.5);
  EXPECT_DOUBLE_EQ(half(".5"), 0.05);
  EXPECT_DOUBLE_EQ(half("1.667e-02 3"), 0.000005);
  EXPECT_DOUBLE_EQ(half("1.2E+1"), 0.5);
}

TEST(Csv, AJointThatFollowsNeedsNoColumn) {
  Document robot = *robot_document();
  Joint& knee = std::get<Skeleton>(robot.content).joints[1];
  ASSERT_EQ(knee.name, "KNEE");
  EXPECT_EQ(knee.joint_name, "KNEE_P");
  knee.dofs[0].coordinate = kRootColumns;  // the hip's
  knee.dofs[0].gain = 2;
  knee.dofs[0].shift = 0.5;
  ReadOptions options;
  options.skeleton = std::make_shared<const Document>(robot);
  const auto without = read_csv("time,HIP\n0,1\n0.1,3\n", options);
  EXPECT_EQ(components_of(without)[0].values, (std::vector<double>{1, 2.5, 3, 6.5}));
  EXPECT_EQ(text_of(without.diagnostics), "");
  const auto with = read_csv("time,KNEE,HIP\n0,7,1\n0.1,8,3\n", options);
  EXPECT_EQ(components_of(with)[0].values, (std::vector<double>{1, 7, 3, 8}));
}

TEST(Csv, JointsGoToTheirIdsByTheirNames) {
  ReadOptions options;
  options.skeleton = robot_document();
  ASSERT_NE(options.skeleton, nullptr);
  for (const char* header : {"time,KNEE.q,HIP.q\n", "time,KNEE_P,HIP\n"}) {
    const auto read = read_csv(std::string(header) + "0,1,2\n0.1,3,4\n", options);
    EXPECT_EQ(components_of(read)[0].values, (std::vector<double>{2, 1, 4, 3})) << header;
  }
  const auto partly = read_csv("time,KNEE\n0,1\n0.1,3\n", options);
  EXPECT_EQ(components_of(partly)[0].values, (std::vector<double>{0, 1, 0, 3}));
  EXPECT_EQ(text_of(partly.diagnostics),
            "t.csv:1:1: warning[CSV009]: the table has no column for 1 of the robot's 2 joints; "
            "they stay at 0\n  time,KNEE\n  ^\n");
  const auto unknown = read_csv("time,KNEE,ANKLE\n0,1,2\n", options);
  EXPECT_EQ(text_of(unknown.diagnostics),
            "t.csv:1:11: error[CSV008]: expected the name of a joint of the robot, found 'ANKLE'\n"
            "  time,KNEE,ANKLE\n            ^\n");
  const auto twice = read_csv("time,KNEE,KNEE_P\n0,1,2\n", options);
  EXPECT_EQ(twice.diagnostics.items().back().message,
            "expected each joint of the robot once, found 'KNEE_P' again");
}

/// Links called joint1 to joint3, of which the ids 1 and 3 are no joint's.
std::shared_ptr<const Document> robot_with_gaps() {
  ReadText read;
  auto document = find_format("body")->read(
      "format: ChoreonoidBody\nformat_version: 2\nlinks:\n"
      "  - { name: WAIST, joint_type: free }\n"
      "  - { name: joint1, parent: WAIST, joint_type: revolute, joint_id: 0 }\n"
      "  - { name: joint2, parent: joint1, joint_type: revolute, joint_id: 2 }\n"
      "  - { name: joint3, parent: joint2, joint_type: revolute, joint_id: 4 }\n",
      {}, read.diagnostics);
  EXPECT_TRUE(document) << text_of(read.diagnostics);
  return document ? std::make_shared<const Document>(std::move(*document)) : nullptr;
}

TEST(Csv, IdsWithoutAJointHaveNamesThatNoJointHas) {
  ReadOptions options;
  options.skeleton = robot_with_gaps();
  ASSERT_NE(options.skeleton, nullptr);
  EXPECT_EQ(names_of_value_columns(skeleton_of(*options.skeleton)),
            (std::vector<std::string>{"joint1", "joint1_", "joint2", "joint3_", "joint3"}));
  for (const char* header : {"time,joint1.q,joint1_.q,joint2.q,joint3_.q,joint3.q\n",
                             "time,joint1.q,WAIST.q1,joint2.q,WAIST.q3,joint3.q\n"}) {
    const auto read = read_csv(std::string(header) + "0,1,2,3,4,5\n0.1,6,7,8,9,10\n", options);
    EXPECT_EQ(text_of(read.diagnostics), "") << header;
    EXPECT_EQ(components_of(read)[0].values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  }
  const auto usual = robot_document();
  EXPECT_EQ(names_of_value_columns(skeleton_of(*usual)), (std::vector<std::string>{"HIP", "KNEE"}));
}

TEST(Csv, WhatIsWrittenOfARobotReadsTheSame) {
  ReadOptions options;
  options.skeleton = robot_document();
  ASSERT_NE(options.skeleton, nullptr);
  const auto seq = read_seq(
      seq_of({joints({"[ 0.1, 1e-300 ]", "[ -0.5, 2 ]"}),
              poses({"[ [ 1, 2, 3, 1, 0, 0, 0 ] ]", "[ [ 0.1, 0.2, 0.3, 0.6, 0, 0.8, 0 ] ]"})}));
  Diagnostics none;
  auto motion = robot::pose(std::get<BodyMotion>(seq.document->content),
                            skeleton_of(*options.skeleton), false, none);
  ASSERT_TRUE(motion);
  std::string text;
  const Document document{*motion, "choreonoid", {}};
  ASSERT_TRUE(find_format("csv")->write(
      document, {}, [&](std::string_view piece) { return text += piece, true; }, none));
  const auto back = read_csv(text, options);
  const auto& components = components_of(back);
  ASSERT_EQ(components.size(), 2u);
  EXPECT_EQ(components[0].values, components_of(seq)[1].values);
  EXPECT_EQ(components[1].values, components_of(seq)[0].values);
  EXPECT_EQ(components[1].timeline, (Timeline{FrameRate{10}, 0}));
}

TEST(Csv, WhatIsWrittenOfARobotWithGapsReadsTheSame) {
  ReadOptions options;
  options.skeleton = robot_with_gaps();
  ASSERT_NE(options.skeleton, nullptr);
  const auto table = read_csv(
      "time,joint1_.q,joint1.q,joint2.q,joint3.q,joint3_.q\n"
      "0,9,1,2,3,8\n0.1,7,4,5,6,-7\n",
      options);
  Diagnostics none;
  auto motion = robot::pose(std::get<BodyMotion>(table.document->content),
                            skeleton_of(*options.skeleton), false, none);
  ASSERT_TRUE(motion);
  const auto back = read_csv(write_to_string({*motion, "choreonoid", {}}, "csv"), options);
  const Component* joints = find_component(std::get<BodyMotion>(back.document->content),
                                           ComponentKind::Values, kJointDisplacement);
  ASSERT_NE(joints, nullptr) << text_of(back.diagnostics);
  EXPECT_EQ(joints->values, (std::vector<double>{1, 9, 2, 8, 3, 4, 7, 5, -7, 6}));
}

TEST(Csv, EveryTruncationIsReadOrRefusedWithAPlace) {
  const std::string whole = "time,A.q,B.x,B.y,B.z\n0,1,\"2\",3,4\n0.5,-1e3,2,3,4\n";
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto read = read_csv(whole.substr(0, length));
    EXPECT_EQ(read.document.has_value(), !read.diagnostics.has_errors()) << length;
    for (const Diagnostic& item : read.diagnostics.items()) EXPECT_GT(item.place.line, 0u);
  }
}

}  // namespace
}  // namespace kinefile::test
