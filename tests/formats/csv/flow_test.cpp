// SPDX-License-Identifier: MIT
// Flows of servo poses as tables.

#include <gtest/gtest.h>

#include "kinefile/csv.hpp"
#include "kinefile/robot_project.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

ReadText read_flow_table(std::string_view bytes, ReadOptions options = {}) {
  options.source_name = "t.csv";
  ReadText read;
  auto document = find_format("csv")->read(bytes, options, read.diagnostics);
  if (document) read.document = std::move(*document);
  return read;
}

const PoseFlow& flow_read(const ReadText& read) {
  static const PoseFlow kNone;
  EXPECT_TRUE(read.document) << text_of(read.diagnostics);
  return read.document ? std::get<PoseFlow>(read.document->content) : kNone;
}

std::string written(const PoseFlow& flow, const WriteOptions& options = {}) {
  std::string text;
  Diagnostics none;
  const auto sink = [&](std::string_view piece) { return text += piece, true; };
  EXPECT_TRUE(find_format("csv")->write(Document{flow, "robovie", {}}, options, sink, none));
  return text;
}

/// Two sliders of 100 units a degree, and one that has none; the base pose is 50, -50, 7.
std::shared_ptr<const RobotProject> project() {
  RobotProject project;
  project.sliders.resize(3);
  project.sliders[0].units_per_degree = project.sliders[1].units_per_degree = 100;
  project.base_poses.push_back({"base", {50, -50, 7}, {}});
  return std::make_shared<const RobotProject>(project);
}

constexpr const char* kTable =
    "time,next,break,sound,s0,s1,s2\n"
    "40,1,-1,,0x2b01,0X0000,0xffff\n"
    "239,0,2,\"a,b.wav\",0x8000,0x7fff,0X1234\n"
    "1,-1,-1,,0x0000,0x0000,0x0000\n";

TEST(FlowTable, WhatIsWrittenIsWhatWasRead) {
  const auto read = read_flow_table(kTable);
  const PoseFlow& flow = flow_read(read);
  ASSERT_EQ(flow.blocks.size(), 3u);
  EXPECT_EQ(flow.format, FlowFormat::WordN);
  EXPECT_EQ(flow.num_sliders, 3u);
  EXPECT_EQ(flow.blocks[1].branch, 2);
  EXPECT_EQ(flow.blocks[1].line, 3u);
  const auto& pose = std::get<PoseBlock>(flow.blocks[1].body);
  EXPECT_EQ(pose.ticks, 239);
  EXPECT_EQ(pose.sound, "a,b.wav");
  EXPECT_EQ(pose.words[0], (SliderWord{-32768, true}));
  EXPECT_EQ(pose.words[2], (SliderWord{0x1234, false}));
  EXPECT_EQ(written(flow), kTable);
}

TEST(FlowTable, ColumnsMayBeLeftOutAndFieldsEmpty) {
  const auto read = read_flow_table("s2,Time,next\r\n0x0001,5,\r\n\r\n,6,\r\n0x0003, 7 ,0\r\n");
  const PoseFlow& flow = flow_read(read);
  ASSERT_EQ(flow.blocks.size(), 3u);
  EXPECT_EQ(flow.num_sliders, 3u);
  EXPECT_EQ(flow.blocks[0].normal, 1);
  EXPECT_EQ(flow.blocks[1].normal, 2);
  EXPECT_EQ(flow.blocks[2].normal, 0);
  EXPECT_EQ(std::get<PoseBlock>(flow.blocks[0].body).words[2], (SliderWord{1, true}));
  EXPECT_EQ(std::get<PoseBlock>(flow.blocks[1].body).words[2], SliderWord{});
}

TEST(FlowTable, DegreesAreWordsExactly) {
  PoseFlow flow;
  flow.format = FlowFormat::WordN;
  flow.num_sliders = 3;
  for (int value = -32768; value <= 32767; value += 17) {
    const auto word = static_cast<std::int16_t>(value);
    Block block;
    block.normal = value + 17 <= 32767 ? static_cast<int>(flow.blocks.size()) + 1 : kNoBlock;
    block.body = PoseBlock{1, {{word, true}, {word, false}, {word, true}}, "", {}};
    flow.blocks.push_back(block);
  }
  for (const bool is_relative : {false, true}) {
    WriteOptions to;
    to.project = project();
    to.of_formats.edit<csv::WriteOptions>().in_degrees = true;
    to.of_formats.edit<csv::WriteOptions>().is_relative = is_relative;
    ReadOptions from;
    from.project = to.project;
    from.of_formats.edit<csv::ReadOptions>().in_degrees = true;
    from.of_formats.edit<csv::ReadOptions>().is_relative = is_relative;
    EXPECT_EQ(flow_read(read_flow_table(written(flow, to), from)), flow);
  }
}

TEST(FlowTable, DegreesGoToTheNearestWord) {
  ReadOptions options;
  options.project = project();
  options.of_formats.edit<csv::ReadOptions>().in_degrees = true;
  const auto words = [&](const std::string& fields) {
    return std::get<PoseBlock>(
               flow_read(read_flow_table("time,s0,s1,s2\n1," + fields, options)).blocks.at(0).body)
        .words;
  };
  EXPECT_EQ(words("1.5,-0.017,0x0007")[0], (SliderWord{150, true}));
  EXPECT_EQ(words("1.5,-0.017,0x0007")[1], (SliderWord{-2, true}));
  options.of_formats.edit<csv::ReadOptions>().is_relative = true;
  EXPECT_EQ(words("1.5,0,0X0007")[0], (SliderWord{200, true}));
  EXPECT_EQ(words("1.5,0,0X0007")[1], (SliderWord{-50, true}));
  EXPECT_EQ(text_of(read_flow_table("time,s0,s2\n1,400,5\n", options).diagnostics),
            "t.csv:2:3: error[CSV014]: expected degrees that a word of 16 bits can say, found 400\n"
            "  1,400,5\n    ^\n"
            "t.csv:2:7: error[CSV014]: expected a word such as 0x2b01: the project does not show "
            "slider 2 in degrees\n  1,400,5\n        ^\n");
}

TEST(FlowTable, WholeNumbersAreWordsAndSlidersHaveTheirNames) {
  const auto numbers = read_flow_table("time,s0,s1\n1,-32768,32767\n");
  EXPECT_EQ(std::get<PoseBlock>(flow_read(numbers).blocks[0].body).words,
            (std::vector<SliderWord>{{-32768, true}, {32767, true}}));
  RobotProject named = *project();
  named.sliders[1].name = "knee";
  ReadOptions options;
  options.project = std::make_shared<const RobotProject>(named);
  options.of_formats.edit<csv::ReadOptions>().in_degrees = true;
  const auto names = read_flow_table("time,knee\n1,1.5\n", options);
  EXPECT_EQ(flow_read(names).num_sliders, 2u);
  EXPECT_EQ(std::get<PoseBlock>(flow_read(names).blocks[0].body).words[1], (SliderWord{150, true}));
  EXPECT_EQ(read_flow_table("time,s0\n1,32768\n").diagnostics.first_error().code, "CSV013");
}

TEST(FlowTable, JsonHasAllThatBlocksSay) {
  std::string text;
  Diagnostics none;
  PoseFlow flow = flow_read(read_flow_table("time,s0\n40,0x2b01\n"));
  Block branch;
  branch.name = "n\"";
  branch.normal = 0;
  branch.body = BranchBlock{64, Condition::AtLeast, 3};
  flow.blocks.push_back(branch);
  const auto sink = [&](std::string_view piece) { return text += piece, true; };
  ASSERT_TRUE(find_format("json")->write(Document{flow, "csv", {}}, {}, sink, none));
  EXPECT_EQ(text,
            "{\"flow_format\":\"POSEDEF_WORD_N\",\"enable_axis\":1,\n\"blocks\":["
            "{\"number\":0,\"kind\":\"pose\",\"name\":\"\",\"x\":0,\"y\":0,\"normal_turn\":6,"
            "\"branch_turn\":6,\"normal\":-1,\"branch\":-1,\"ticks\":40,\"words\":[\"0x2b01\"],"
            "\"sound\":\"\",\"servo_off\":\"000000000000000000000000000000\"},\n  "
            "{\"number\":1,\"kind\":\"branch\",\"name\":\"n\\\"\",\"x\":0,\"y\":0,"
            "\"normal_turn\":6,\"branch_turn\":6,\"normal\":0,\"branch\":-1,\"variable\":64,"
            "\"condition\":\"at_least\",\"detail\":3}]}\n");
}

}  // namespace
}  // namespace kinefile::test
