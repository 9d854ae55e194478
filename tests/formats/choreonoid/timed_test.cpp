// SPDX-License-Identifier: MIT
// Frames with times of their own. The examples are those of the format's document; their results
// follow from its rule: a frame goes to the first one at or after its time and holds until the
// next.

#include <array>
#include <cmath>

#include "support/seq.hpp"

namespace kinefile::test {
namespace {

constexpr char kTimed[] = "    hasFrameTime: true\n";

/// The document's example of joints.
std::string example_of_joints() {
  return seq_of({joints({"[ 0.0, 0.0,  0.0  ]", "[ 0.1, 0.01, 0.01 ]", "[ 0.3, 0.01, 0.02 ]",
                         "[ 0.4, 0.02, 0.03 ]", "[ 0.7, 2,    0.04 ]"},
                        kTimed)});
}

/// The document's example of poses; its poses are all the same, and told apart by x here.
std::string example_of_poses(const std::string& se3_format = "XYZQWQXQYQZ") {
  const std::string rest = se3_format == "XYZRPY"        ? "-0.5, 0.1, 0, 0, 0"
                           : se3_format == "XYZQWQXQYQZ" ? "-0.5, 0.1, 1, 0, 0, 0"
                                                         : "-0.5, 0.1, 0, 0, 0, 1";
  std::vector<std::string> rows;
  for (const char* start : {"0.0, [ -2, ", "0.1, [ -3, ", "0.3, [ -4, ", "0.4, [ -5, "}) {
    rows.push_back("[ " + std::string(start) + rest + " ] ]");
  }
  rows.push_back("[ 0.7, [ -6, " + rest + " ] ]");
  return seq_of({poses(rows, kTimed, se3_format)});
}

ReadOptions rounded(TimedRounding rounding, std::optional<double> fps = std::nullopt) {
  ReadOptions options;
  options.timed_rounding = rounding;
  options.fps = fps;
  return options;
}

/// One joint of two, at times; the other is at 0.
std::string first_joint(const std::vector<std::pair<std::string, std::string>>& rows) {
  std::vector<std::string> frames;
  for (const auto& [time, value] : rows) frames.push_back("[ " + time + ", " + value + ", 0 ]");
  return seq_of({joints(frames, kTimed)});
}

/// The first joint's values.
std::vector<double> values_of(const ReadText& read) {
  std::vector<double> values;
  const auto& components = components_of(read);
  if (components.empty()) return values;
  for (std::size_t f = 0; f < components[0].num_frames; ++f) {
    values.push_back(components[0].row(f)[0]);
  }
  return values;
}

using FrameValues = Array<double>;

TEST(SeqTimed, TheDocumentsJointsAtItsRate) {
  const ReadText read = read_seq(example_of_joints());
  EXPECT_EQ(text_of(read.diagnostics), "");
  const Component& component = components_of(read).at(0);
  EXPECT_EQ(component.num_frames, 8u);
  EXPECT_EQ(frame_rate(component.timeline), 10);
  EXPECT_FALSE(has_own_times(component.timeline));
  EXPECT_EQ(component.values, (FrameValues{0, 0, 0.01, 0.01, 0.01, 0.01, 0.01, 0.02,  //
                                           0.02, 0.03, 0.02, 0.03, 0.02, 0.03, 2, 0.04}));
}

TEST(SeqTimed, TheDocumentsPosesInEveryOrderOfNumbers) {
  const FrameValues expected = {-2, -3, -3, -4, -5, -5, -5, -6};
  for (const char* order : {"XYZQWQXQYQZ", "XYZQXQYQZQW", "XYZRPY"}) {
    const ReadText read = read_seq(example_of_poses(order));
    const Component& component = components_of(read).at(0);
    EXPECT_EQ(values_of(read), expected) << order;
    const std::size_t width = component.width();
    EXPECT_EQ(width, std::string(order) == "XYZRPY" ? 6u : 7u);
    for (std::size_t f = 0; f < component.num_frames; ++f) {
      EXPECT_EQ(component.row(f)[1], -0.5);
      EXPECT_EQ(component.row(f)[3], width == 7 ? 1 : 0);
    }
  }
}

TEST(SeqTimed, TheDocumentsJointsUnderFloor) {
  const ReadText same = read_seq(example_of_joints(), rounded(TimedRounding::Floor));
  EXPECT_EQ(text_of(same.diagnostics), "");
  EXPECT_EQ(components_of(same).at(0).values,
            components_of(read_seq(example_of_joints())).at(0).values);
  // At 4 frames a second the times lie between frames: 0, 0.4, 1.2, 1.6 and 2.8 periods.
  const ReadText ceil = read_seq(example_of_joints(), rounded(TimedRounding::Ceil, 4));
  EXPECT_EQ(codes_of(ceil.diagnostics), std::vector<std::string>{"SEQ021"});
  EXPECT_EQ(components_of(ceil).at(0).values, (FrameValues{0, 0, 0.01, 0.01, 0.02, 0.03, 2, 0.04}));
  const ReadText floor = read_seq(example_of_joints(), rounded(TimedRounding::Floor, 4));
  EXPECT_EQ(codes_of(floor.diagnostics), (std::vector<std::string>{"SEQ021", "SEQ021"}));
  EXPECT_EQ(components_of(floor).at(0).values, (FrameValues{0.01, 0.01, 0.02, 0.03, 2, 0.04}));
}

TEST(SeqTimed, TheDocumentsExamplesUnderSlerp) {
  const ReadText read = read_seq(example_of_joints(), rounded(TimedRounding::Slerp));
  EXPECT_EQ(text_of(read.diagnostics), "");
  const FrameValues expected = {0,    0,    0.01, 0.01,    0.01, 0.015,    0.01, 0.02,
                                0.02, 0.03, 0.68, 0.1 / 3, 1.34, 0.11 / 3, 2,    0.04};
  const FrameValues& values = components_of(read).at(0).values;
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-14) << i;
  const FrameValues x = values_of(read_seq(example_of_poses(), rounded(TimedRounding::Slerp)));
  const FrameValues expected_x = {-2, -3, -3.5, -4, -5, -16.0 / 3, -17.0 / 3, -6};
  ASSERT_EQ(x.size(), expected_x.size());
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], expected_x[i], 1e-14) << i;
}

TEST(SeqTimed, AFrameGoesToTheFirstOneAtOrAfterItsTime) {
  const std::string text = first_joint({{"0", "1"}, {"0.11", "2"}, {"0.3", "3"}});
  EXPECT_EQ(values_of(read_seq(text)), (FrameValues{1, 1, 2, 3}));
  EXPECT_EQ(values_of(read_seq(text, rounded(TimedRounding::Floor))), (FrameValues{1, 2, 2, 3}));
}

TEST(SeqTimed, TimesThatDecimalsCannotSayExactlyAreTheFramesTheyMean) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (int i = 0; i < 100; ++i) {
    rows.emplace_back((i < 10 ? "0.0" : "0.") + std::to_string(i), std::to_string(i));
  }
  const ReadText read = read_seq(first_joint(rows), rounded(TimedRounding::Ceil, 100));
  EXPECT_EQ(text_of(read.diagnostics), "");
  const FrameValues values = values_of(read);
  ASSERT_EQ(values.size(), 100u);
  for (std::size_t f = 0; f < values.size(); ++f) EXPECT_EQ(values[f], static_cast<double>(f));
}

TEST(SeqTimed, FloorIsChoreonoidsArithmeticWithoutATolerance) {
  // 0.29 * 100 is below 29 in doubles.
  const ReadText read = read_seq(first_joint({{"0", "1"}, {"0.28", "2"}, {"0.29", "3"}}),
                                 rounded(TimedRounding::Floor, 100));
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"SEQ021"});
  const FrameValues values = values_of(read);
  ASSERT_EQ(values.size(), 29u);
  EXPECT_EQ(values[27], 1);
  EXPECT_EQ(values[28], 3);
}

TEST(SeqTimed, FramesBeforeTheFirstTimeHoldItsValues) {
  const ReadText read = read_seq(first_joint({{"0.2", "5"}, {"0.3", "6"}}));
  EXPECT_EQ(text_of(read.diagnostics),
            "t.seq:12:9: note[SEQ023]: the first time is 0.2 s; the 2 frames before it hold its "
            "values\n        - [ 0.2, 5, 0 ]\n          ^\n");
  EXPECT_EQ(values_of(read), (FrameValues{5, 5, 5, 6}));
}

TEST(SeqTimed, UnderFloorTheyAreZerosAndNoRotation) {
  const ReadOptions floor = rounded(TimedRounding::Floor);
  const ReadText numbers = read_seq(first_joint({{"0.21", "5"}}), floor);
  EXPECT_EQ(text_of(numbers.diagnostics), "");
  EXPECT_EQ(values_of(numbers), (FrameValues{0, 0, 5}));
  const ReadText w_first =
      read_seq(seq_of({poses({"[ 0.1, [ 1, 2, 3, 0, 1, 0, 0 ] ]"}, kTimed)}), floor);
  EXPECT_EQ(components_of(w_first).at(0).values,
            (FrameValues{0, 0, 0, 1, 0, 0, 0, 1, 2, 3, 0, 1, 0, 0}));
  const ReadText w_last =
      read_seq(seq_of({poses({"[ 0.1, [ 1, 2, 3, 1, 0, 0, 0 ] ]"}, kTimed, "XYZQXQYQZQW")}), floor);
  EXPECT_EQ(components_of(w_last).at(0).values,
            (FrameValues{0, 0, 0, 1, 0, 0, 0, 1, 2, 3, 0, 1, 0, 0}));
  const ReadText angles =
      read_seq(seq_of({poses({"[ 0.1, [ 1, 2, 3, 4, 5, 6 ] ]"}, kTimed, "XYZRPY")}), floor);
  EXPECT_EQ(components_of(angles).at(0).values, (FrameValues{0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6}));
}

TEST(SeqTimed, SlerpInterpolatesNumbersInAStraightLine) {
  const std::string text = first_joint({{"0", "0"}, {"0.2", "4"}, {"0.45", "-1"}});
  const ReadText read = read_seq(text, rounded(TimedRounding::Slerp));
  const FrameValues values = values_of(read);
  ASSERT_EQ(values.size(), 5u);  // the last time lies between two frames
  const FrameValues expected = {0, 2, 4, 2, 0};
  for (std::size_t f = 0; f < values.size(); ++f) EXPECT_NEAR(values[f], expected[f], 1e-14);
}

TEST(SeqTimed, SlerpTurnsPosesTheShortestWayInEveryOrderOfNumbers) {
  const double half = std::sqrt(0.5);
  const std::string s = "0.7071067811865476";
  const auto middle = [&](const std::string& from, const std::string& to,
                          const std::string& order) {
    const ReadText read = read_seq(
        seq_of({poses({"[ 0, [ 0, 0, 0, " + from + " ] ]", "[ 0.2, [ 2, 0, 0, " + to + " ] ]"},
                      kTimed, order)}),
        rounded(TimedRounding::Slerp));
    const Component& component = components_of(read).at(0);
    EXPECT_EQ(component.num_frames, 3u);
    EXPECT_NEAR(component.row(1)[0], 1, 1e-15);
    const auto row = component.row(1);
    return quaternion_of_pose(component.pose_form, row);
  };
  // From no rotation to a quarter turn about z: an eighth.
  const double w = std::sqrt((1 + half) / 2);
  const double z = std::sqrt((1 - half) / 2);
  const auto expect_eighth = [&](const std::array<double, 4>& q) {
    EXPECT_NEAR(q[0], w, 1e-12);
    EXPECT_NEAR(q[1], 0, 1e-12);
    EXPECT_NEAR(q[2], 0, 1e-12);
    EXPECT_NEAR(q[3], z, 1e-12);
  };
  expect_eighth(middle("1, 0, 0, 0", s + ", 0, 0, " + s, "XYZQWQXQYQZ"));
  expect_eighth(middle("0, 0, 0, 1", "0, 0, " + s + ", " + s, "XYZQXQYQZQW"));
  expect_eighth(middle("0, 0, 0", "0, 0, 1.5707963267948966", "XYZRPY"));
  // The same rotation with all signs turned.
  expect_eighth(middle("1, 0, 0, 0", "-" + s + ", 0, 0, -" + s, "XYZQWQXQYQZ"));
}

TEST(SeqTimed, SlerpTakesAQuaternionOfZerosForNoRotation) {
  const auto read = read_seq(
      seq_of(
          {poses({"[ 0, [ 0, 0, 0, 0, 0, 0, 0 ] ]", "[ 0.2, [ 0, 0, 0, 0, 0, 0, 1 ] ]"}, kTimed)}),
      rounded(TimedRounding::Slerp));
  const Component& links = components_of(read)[0];
  ASSERT_EQ(links.num_frames, 3u);
  EXPECT_EQ(links.row(0)[3], 0) << "numbers that are there stay";
  const double half = std::sqrt(0.5);
  EXPECT_NEAR(links.row(1)[3], half, 1e-15);
  EXPECT_NEAR(links.row(1)[6], half, 1e-15);
}

TEST(SeqTimed, SlerpKeepsTheBitsOfFramesThatAreThere) {
  const ReadText read = read_seq(first_joint({{"0", "0.1"}, {"0.1", "0.3"}, {"0.2", "1e-300"}}),
                                 rounded(TimedRounding::Slerp));
  EXPECT_EQ(values_of(read), (FrameValues{0.1, 0.3, 1e-300}));
}

TEST(SeqTimed, KeptTimesNeedNoRate) {
  ReadOptions options;
  options.keeps_times = true;
  std::string text = example_of_joints();
  text.erase(text.find("frameRate: 10\n"), 14);
  const ReadText read = read_seq(text, options);
  EXPECT_EQ(text_of(read.diagnostics), "");
  const Component& component = components_of(read).at(0);
  EXPECT_EQ(component.num_frames, 5u);
  EXPECT_EQ(own_times(component.timeline), (FrameValues{0, 0.1, 0.3, 0.4, 0.7}));
  EXPECT_EQ(component.values, (FrameValues{0, 0, 0.01, 0.01, 0.01, 0.02, 0.02, 0.03, 2, 0.04}));
}

TEST(SeqTimed, ATimedFileWithoutARateNeedsOne) {
  std::string text = example_of_joints();
  text.erase(text.find("frameRate: 10\n"), 14);
  EXPECT_EQ(text_of(read_seq(text).diagnostics),
            "t.seq:6:5: error[SEQ022]: expected frameRate, to which the frames with times are to "
            "go, found none; --fps says it, --keep-times needs none\n"
            "      type: MultiValueSeq\n      ^\n");
  // Who only looks at the file does not.
  ReadOptions looking;
  looking.keeps_times_without_rate = true;
  const ReadText kept = read_seq(text, looking);
  EXPECT_EQ(text_of(kept.diagnostics),
            "t.seq:6:5: note[SEQ022]: there is no frameRate, at which the frames with times are "
            "imported; here they keep their times, other commands need --fps or --keep-times\n"
            "      type: MultiValueSeq\n      ^\n");
  EXPECT_EQ(own_times(components_of(kept).at(0).timeline), (FrameValues{0, 0.1, 0.3, 0.4, 0.7}));
  EXPECT_EQ(codes_of(read_seq(replaced(text, "[ 0.3,", "[ 0.05,"), looking).diagnostics),
            (std::vector<std::string>{"SEQ022", "SEQ019"}));
  looking.fps = 20;
  EXPECT_EQ(components_of(read_seq(text, looking)).at(0).num_frames, 15u);
  // Where a rate is given, it counts.
  looking.fps.reset();
  EXPECT_EQ(components_of(read_seq(example_of_joints(), looking)).at(0).num_frames, 8u);
  const ReadText read = read_seq(text, rounded(TimedRounding::Ceil, 20));
  EXPECT_EQ(components_of(read).at(0).num_frames, 15u);
  EXPECT_EQ(frame_rate(components_of(read).at(0).timeline), 20);
}

TEST(SeqTimed, ATimeThatIsNotAboveTheOneBeforeIsAnErrorAtItsPlace) {
  const std::string text = first_joint({{"0", "1"}, {"0.3", "2"}, {"0.1", "3"}, {"0.1", "4"}});
  EXPECT_EQ(text_of(read_seq(text).diagnostics),
            "t.seq:14:9: error[SEQ019]: expected a time above that of the frame before, 0.3 s, "
            "found 0.1 s\n        - [ 0.1, 3, 0 ]\n          ^\n"
            "t.seq:15:9: error[SEQ019]: expected a time above that of the frame before, 0.1 s, "
            "found 0.1 s\n        - [ 0.1, 4, 0 ]\n          ^\n");
}

TEST(SeqTimed, UnderFloorAndLenientItIsReadAsChoreonoidDoes) {
  // Only the frame itself changes; those behind it keep what they held.
  const std::string text = first_joint({{"0", "1"}, {"0.3", "2"}, {"0.1", "3"}});
  const ReadOptions lenient = {.lenient = true};
  for (const ReadOptions& options : {lenient, rounded(TimedRounding::Floor)}) {
    const ReadText read = read_seq(text, options);
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"SEQ019"});
    EXPECT_EQ(values_of(read), (FrameValues{1, 3, 1, 2}));
  }
}

TEST(SeqTimed, TimesThatNoMotionHasAreErrorsAtTheirPlaces) {
  const auto fault = [](const std::string& time, const ReadOptions& options) {
    const ReadText read = read_seq(first_joint({{"0", "1"}, {time, "2"}}), options);
    for (const Diagnostic& item : read.diagnostics.items()) {
      if (item.severity != Severity::Error) continue;
      EXPECT_EQ(item.place.line, 13u);
      EXPECT_EQ(item.place.column, 9u);
    }
    return codes_of(read.diagnostics).back();
  };
  const ReadOptions lenient = {.lenient = true};
  for (const ReadOptions& options :
       {ReadOptions{}, lenient, rounded(TimedRounding::Floor), rounded(TimedRounding::Slerp)}) {
    for (const char* time : {"-0.2", "nan", "inf", "-inf", "1e9", "1e300"}) {
      EXPECT_EQ(fault(time, options), "SEQ020") << time;
    }
  }
}

TEST(SeqTimed, UnderFloorATimeJustBelowZeroIsFrameZero) {
  const std::string text = first_joint({{"-0.05", "1"}, {"0.1", "2"}});
  EXPECT_EQ(codes_of(read_seq(text).diagnostics), std::vector<std::string>{"SEQ020"});
  EXPECT_EQ(values_of(read_seq(text, rounded(TimedRounding::Floor))), (FrameValues{1, 2}));
}

TEST(SeqTimed, OfTwoFramesInOneTheLaterOneStands) {
  const ReadText read = read_seq(first_joint({{"0", "1"}, {"0.12", "2"}, {"0.17", "3"}}));
  EXPECT_EQ(text_of(read.diagnostics),
            "t.seq:14:9: warning[SEQ021]: two frames of the file go to frame 2 at 10 frames a "
            "second; the later one stands\n        - [ 0.17, 3, 0 ]\n          ^\n");
  EXPECT_EQ(values_of(read), (FrameValues{1, 1, 3}));
}

TEST(SeqTimed, TimesAtTheTopHoldForAllButWhoSaysOtherwise) {
  const ReadText read = read_seq(seq_of(
      {joints({"[ 0, 1, 1 ]", "[ 0.2, 2, 2 ]"}), zmp({"[ 1, 2, 3 ]"}, "    hasFrameTime: no\n")},
      "has_frame_time: yes\n"));
  EXPECT_EQ(text_of(read.diagnostics), "");
  EXPECT_EQ(values_of(read), (FrameValues{1, 1, 2}));
  EXPECT_EQ(components_of(read).at(1).values, (FrameValues{1, 2, 3}));
}

TEST(SeqTimed, KeptTimesHaveToGoForwardToo) {
  const ReadOptions keeps = {.keeps_times = true};
  const ReadOptions lenient = {.lenient = true, .keeps_times = true};
  const std::string back = first_joint({{"0", "1"}, {"0.3", "2"}, {"0.1", "3"}});
  EXPECT_EQ(text_of(read_seq(back, keeps).diagnostics),
            "t.seq:14:9: error[SEQ019]: expected a time above that of the frame before, 0.3 s, "
            "found 0.1 s\n        - [ 0.1, 3, 0 ]\n          ^\n");
  const ReadText kept = read_seq(back, lenient);
  EXPECT_EQ(codes_of(kept.diagnostics), std::vector<std::string>{"SEQ019"});
  EXPECT_EQ(own_times(components_of(kept).at(0).timeline), (FrameValues{0, 0.3, 0.1}));
  for (const char* time : {"-0.2", "nan", "inf"}) {
    for (const ReadOptions& options : {keeps, lenient}) {
      EXPECT_EQ(
          codes_of(read_seq(first_joint({{"0", "1"}, {time, "2"}}), options).diagnostics).back(),
          "SEQ020");
    }
  }
  EXPECT_TRUE(read_seq(first_joint({{"0", "1"}, {"1e9", "2"}}), keeps).document);
}

TEST(SeqTimed, WithoutFramesThereAreNoTimesToKeep) {
  std::string text =
      seq_of({"  -\n    type: Vector3Seq\n    content: ZMP\n    hasFrameTime: true\n"
              "    frames: []\n"});
  text.erase(text.find("frameRate: 10\n"), 14);
  EXPECT_EQ(codes_of(read_seq(text, {.keeps_times = true}).diagnostics),
            (std::vector<std::string>{"SEQ018", "SEQ008"}));
}

TEST(SeqTimed, KeptTimesAreWrittenAndReadAgain) {
  ReadOptions options;
  options.keeps_times = true;
  const ReadText read = read_seq(example_of_poses(), options);
  ASSERT_TRUE(read.document);
  const std::string text = write_to_string(*read.document, "choreonoid");
  EXPECT_NE(text.find("    hasFrameTime: true\n"), std::string::npos) << text;
  EXPECT_NE(text.find("      - [ 0.1, [ -3, -0.5, 0.1, 1, 0, 0, 0 ] ]\n"), std::string::npos);
  expect_same_components(components_of(read_seq(text, options)), components_of(read));
}

}  // namespace
}  // namespace kinefile::test
