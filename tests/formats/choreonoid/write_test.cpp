// SPDX-License-Identifier: MIT
// What is written as .seq: from .seq to .seq everything stays, other motions become the usual form.

#include <fmt/format.h>

#include <cmath>

#include "kinefile/choreonoid.hpp"
#include "support/seq.hpp"

namespace kinefile::test {
namespace {

/// A document and what writing it told.
struct Written {
  std::string text;
  Diagnostics diagnostics;
  bool is_good = false;
};

Written write_seq(const Document& document, const choreonoid::WriteOptions& options = {}) {
  Written written;
  const Sink sink = [&](std::string_view piece) {
    written.text += piece;
    return true;
  };
  written.is_good = find_format("choreonoid")
                        ->write(document, {.of_formats = options}, sink, written.diagnostics)
                        .has_value();
  return written;
}

Document document_of(const std::string& text, const ReadOptions& options = {}) {
  ReadText read = read_seq(text, options);
  EXPECT_TRUE(read.document) << text_of(read.diagnostics);
  return read.document ? std::move(*read.document) : Document{};
}

/// Writes what was read, and expects it to read the same.
std::string again(const std::string& text, const choreonoid::WriteOptions& options = {}) {
  const ReadText read = read_seq(text);
  if (!read.document) return "";
  std::string written = write_seq(*read.document, options).text;
  expect_same_components(components_of(read_seq(written)), components_of(read), written);
  return written;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

constexpr char kAllKinds[] =
    "type: CompositeSeq\n"
    "content: BodyMotion\n"
    "formatVersion: 2\n"
    "frameRate: 50\n"
    "numFrames: 2\n"
    "components:\n"
    "  -\n"
    "    type: MultiSE3Seq\n"
    "    content: LinkPosition\n"
    "    numParts: 1\n"
    "    frameRate: 50\n"
    "    numFrames: 2\n"
    "    SE3Format: XYZQWQXQYQZ\n"
    "    frames:\n"
    "      - [ [ 1, 2, 3, 1, 0, 0, 0 ] ]\n"
    "      - [ [ 1, 2, 4, 0.5, 0.5, 0.5, 0.5 ] ]\n"
    "  -\n"
    "    type: MultiValueSeq\n"
    "    content: JointDisplacement\n"
    "    numParts: 2\n"
    "    frameRate: 50\n"
    "    numFrames: 2\n"
    "    frames:\n"
    "      - [ 0.1, 0.2 ]\n"
    "      - [ 0.3, 0.4 ]\n"
    "  -\n"
    "    type: Vector3Seq\n"
    "    content: ZMP\n"
    "    frameRate: 50\n"
    "    numFrames: 2\n"
    "    isRootRelative: true\n"
    "    frames:\n"
    "      - [ 0, 0.1, 0 ]\n"
    "      - [ 0, 0.2, 0 ]\n";

TEST(SeqWrite, AFileOfVersion2InTheDocumentsStyleIsWrittenByteForByte) {
  EXPECT_EQ(again(kAllKinds), kAllKinds);
}

TEST(SeqWrite, TheSpellingOfKeysStays) {
  std::string text = kAllKinds;
  for (const auto& [camel, snake] :
       std::vector<std::pair<std::string, std::string>>{{"formatVersion", "format_version"},
                                                        {"frameRate", "frame_rate"},
                                                        {"numFrames", "num_frames"},
                                                        {"numParts", "num_parts"},
                                                        {"isRootRelative", "is_root_relative"}}) {
    for (std::size_t at = text.find(camel); at != std::string::npos; at = text.find(camel)) {
      text.replace(at, camel.size(), snake);
    }
  }
  EXPECT_EQ(again(text), text);
}

TEST(SeqWrite, TheVersionStaysAsItIsSpelt) {
  for (const char* version : {"2", "2.5", "3", "3.0", "1", "1.0", "4", "+3", "0.5"}) {
    const std::string text = "type: CompositeSeq\nformatVersion: " + std::string(version) +
                             "\nframeRate: 10\ncomponents:\n" + zmp({"[ 1, 2, 3 ]"});
    const std::string written = again(text);
    EXPECT_TRUE(has(written, "formatVersion: " + std::string(version) + "\n")) << written;
    EXPECT_EQ(again(written), written);
    // Choreonoid takes no ZMP alone.
    EXPECT_EQ(codes_of(read_seq(written).diagnostics), std::vector<std::string>{"SEQ018"})
        << written;
  }
}

TEST(SeqWrite, AFileWithoutAVersionStaysOneOfVersion1) {
  const std::string text =
      "type: BodyMotion\ncomponents:\n" +
      replaced(joints({"[ 1, 2 ]"}, "    frameRate: 20\n"), "JointDisplacement", "JointPosition");
  const ReadText read = read_seq(text);
  EXPECT_EQ(text_of(read.diagnostics), "");
  const std::string written = again(text);
  EXPECT_EQ(written.find("# Body motion data set format version 1.0 defined by Choreonoid\n\n"),
            0u);
  EXPECT_TRUE(has(written, "type: BodyMotion\n")) << written;
  EXPECT_FALSE(has(written, "formatVersion"));
  EXPECT_TRUE(has(written, "content: JointPosition\n"));
}

TEST(SeqWrite, PosesKeepTheOrderOfTheirNumbers) {
  for (const auto& [order, numbers] : std::vector<std::pair<std::string, std::string>>{
           {"XYZQWQXQYQZ", "[ [ 1, 2, 3, 0.1, 0.2, 0.3, 0.4 ] ]"},
           {"XYZQXQYQZQW", "[ [ 1, 2, 3, 0.2, 0.3, 0.4, 0.1 ] ]"},
           {"XYZRPY", "[ [ 1, 2, 3, 3, -2, 1 ] ]"}}) {
    const std::string written = again(seq_of({poses({numbers}, "", order)}));
    EXPECT_TRUE(has(written, "    SE3Format: " + order + "\n"));
    EXPECT_TRUE(has(written, "      - " + numbers + "\n")) << written;
  }
}

TEST(SeqWrite, AnotherOrderIsWrittenWhereItIsAskedFor) {
  const Document w_first = document_of(seq_of({poses({"[ [ 1, 2, 3, 0.1, 0.2, 0.3, 0.4 ] ]"})}));
  const Written w_last = write_seq(w_first, {.se3_format = "XYZQXQYQZQW"});
  EXPECT_TRUE(has(w_last.text, "[ [ 1, 2, 3, 0.2, 0.3, 0.4, 0.1 ] ]")) << w_last.text;
  EXPECT_EQ(codes_of(w_last.diagnostics), std::vector<std::string>{"SEQ018"});
  const Document turned = document_of(seq_of({poses({"[ [ 1, 2, 3, 0, 0, 1, 0 ] ]"})}));
  const Written angles = write_seq(turned, {.se3_format = "XYZRPY"});
  const auto components = components_of(read_seq(angles.text));
  EXPECT_EQ(components.at(0).pose_form, PoseForm::RollPitchYaw);
  const auto q = quaternion_of_pose(PoseForm::RollPitchYaw, components.at(0).row(0));
  EXPECT_NEAR(std::abs(q[2]), 1, 1e-12);
  const Written back = write_seq(document_of(angles.text), {.se3_format = "XYZQWQXQYQZ"});
  EXPECT_EQ(components_of(read_seq(back.text)).at(0).pose_form, PoseForm::Quaternion);
}

TEST(SeqWrite, RollPitchYawGoesOnFromFrameToFrameWithoutAJump) {
  std::vector<std::string> rows;
  for (int i = 0; i < 100; ++i) {
    rows.push_back(
        fmt::format("[ [ 0, 0, 0, {}, 0, 0, {} ] ]", std::cos(i * 0.1), std::sin(i * 0.1)));
  }
  const Written angles = write_seq(document_of(seq_of({poses(rows)})), {.se3_format = "XYZRPY"});
  const auto components = components_of(read_seq(angles.text));
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_NEAR(components.at(0).row(i)[5], static_cast<double>(i) * 0.2, 1e-12);
  }
}

TEST(SeqWrite, EveryVersionHasItsWords) {
  const Document document = document_of(kAllKinds);
  const auto text = [&](int version) { return write_seq(document, {.version = version}).text; };
  const std::string first = text(1);
  EXPECT_EQ(first.find("# Body motion data set format version 1.0"), 0u);
  for (const char* part :
       {"type: BodyMotion\n", "formatVersion: 1\n", "content: JointPosition\n",
        "content: LinkPosition\n", "content: RelativeZMP\n", "    format: XYZQWQXQYQZ\n"}) {
    EXPECT_TRUE(has(first, part)) << part << first;
  }
  EXPECT_FALSE(has(first, "isRootRelative"));
  EXPECT_EQ(text(2), kAllKinds);
  const std::string third = text(3);
  for (const char* part : {"formatVersion: 3\n", "content: MultiJointDisplacementSeq\n",
                           "content: MultiLinkPositionSeq\n", "content: ZMPSeq\n",
                           "isRootRelative: true\n", "SE3Format: XYZQWQXQYQZ\n"}) {
    EXPECT_TRUE(has(third, part)) << part << third;
  }
  const std::string fourth = text(4);
  for (const char* part : {"format_version: 4\n", "content: JointDisplacement\n",
                           "content: LinkPosition\n", "content: ZMP\n", "is_root_relative: true\n",
                           "frame_rate: 50\n", "num_parts: 2\n", "SE3Format: XYZQWQXQYQZ\n"}) {
    EXPECT_TRUE(has(fourth, part)) << part << fourth;
  }
  for (int version = 1; version <= 4; ++version) {
    const ReadText read = read_seq(text(version));
    EXPECT_EQ(text_of(read.diagnostics), "") << version;
    expect_same_components(components_of(read), std::get<BodyMotion>(document.content).components);
    // From any version to any other, and back.
    for (int other = 1; other <= 4; ++other) {
      EXPECT_EQ(write_seq(*read.document, {.version = other}).text, text(other));
    }
  }
}

TEST(SeqWrite, AZmpInTheWorldIsNoRelativeOneInAnyVersion) {
  const Document document = document_of(seq_of({zmp({"[ 1, 2, 3 ]"})}));
  for (int version = 1; version <= 4; ++version) {
    const std::string text = write_seq(document, {.version = version}).text;
    EXPECT_FALSE(components_of(read_seq(text)).at(0).is_root_relative) << text;
    EXPECT_FALSE(has(text, "elative")) << text;
  }
}

TEST(SeqWrite, UnknownKeysStayAsTheyStand) {
  const std::string top =
      "author: somebody else # and others\n"
      "quoted: \"a: b\"\n"
      "rows: [ 1, 2.50, [ 3, 0x10 ] ]\n"
      "nested:\n  deeper: { a: 1, b: [ x, y ] }\n  list:\n    - 1\n    - two words\n"
      "text: |\n  first\n   second\n\n"
      "empty:\n";
  const std::string written = again(seq_of({joints({"[ 1, 2 ]"}, "    joints: [ A, B ]\n")}, top));
  for (const char* part :
       {"author: somebody else\n", "quoted: \"a: b\"\n", "    joints: [ A, B ]\n", "two words ]\n",
        "\"first\\u000a second\\u000a\""}) {
    EXPECT_TRUE(has(written, part)) << part << written;
  }
  const auto kept = [](const std::string& text) {
    return fact_of(document_of(text), "unknown_keys");
  };
  EXPECT_EQ(kept(written), kept(seq_of({}, top)));
  EXPECT_EQ(again(written), written);
}

TEST(SeqWrite, ComponentsOfUnknownTypeStayAsTheyStand) {
  const std::string unknown =
      "  -\n    type: MultiVector3Seq\n    content: Forces\n    labels: [ left, right ]\n"
      "    frames:\n      - [ [ 1, 2, 3 ], [ 4, 5, 6.0 ] ]\n      - [ [ 1, 2, 3 ], [ 4, 5, 6 ] ]\n";
  const std::string written = again(seq_of({zmp({"[ 0, 0, 0 ]"}), unknown}));
  EXPECT_TRUE(written.ends_with(unknown)) << written;
}

TEST(SeqWrite, OtherContentAndOldTypesStay) {
  const std::string effort =
      replaced(seq_of({joints({"[ 1, 2 ]"})}), "JointDisplacement", "JointEffort");
  EXPECT_TRUE(has(again(effort), "    content: JointEffort\n"));
  std::string old = seq_of({poses({"[ [ 1, 2, 3, 1, 0, 0, 0 ] ]"})});
  old.replace(old.find("MultiSE3Seq"), 11, "MultiSe3Seq");
  EXPECT_TRUE(has(again(old), "    type: MultiSe3Seq\n"));
  EXPECT_TRUE(has(write_seq(document_of(old), {.version = 4}).text, "type: MultiSE3Seq\n"));
}

TEST(SeqWrite, NumbersKeepTheirBits) {
  const std::vector<std::string> numbers = {"-0",
                                            "0.1",
                                            "1e-300",
                                            "-5e-324",
                                            "1.7976931348623157e308",
                                            "3.0000000000000004",
                                            "1e-05",
                                            "123456789012345678",
                                            "nan",
                                            "inf",
                                            "-inf",
                                            "0.30000000000000004"};
  std::string text = seq_of({});
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    rows.push_back("[ " + numbers[i] + ", " + numbers[i + 1] + " ]");
  }
  for (const choreonoid::YamlStyle style :
       {choreonoid::YamlStyle::Block, choreonoid::YamlStyle::Json}) {
    again(seq_of({joints(rows)}), {.style = style});
  }
}

TEST(SeqWrite, NumbersWithAnExponentHaveAPointSoThatAllYamlReadersTakeThemForNumbers) {
  const std::string written = again(seq_of({joints({"[ 1e-05, 1e300 ]"})}));
  EXPECT_TRUE(has(written, "[ 1.0e-05, 1.0e+300 ]")) << written;
}

TEST(SeqWrite, RatesOfTheirOwnStay) {
  const std::string written = again(
      seq_of({joints({"[ 1, 2 ]"}, "    frameRate: 119.88011988011988\n"), zmp({"[ 0, 0, 0 ]"})}));
  EXPECT_TRUE(has(written, "\nframeRate: 119.88011988011988\n")) << written;
  EXPECT_TRUE(has(written, "    frameRate: 10\n")) << written;
}

TEST(SeqWrite, LineEndsStay) {
  std::string text = kAllKinds;
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) {
    text.insert(at, 1, '\r');
  }
  EXPECT_EQ(again(text), text);
}

TEST(SeqWrite, CommentsAreNotWrittenAndANoteSaysSo) {
  const Written written = write_seq(document_of("# a walk\n" + std::string(kAllKinds)));
  EXPECT_EQ(text_of(written.diagnostics), "note[SEQ025]: the file's comments are not written\n");
  EXPECT_EQ(written.text, kAllKinds);
  EXPECT_EQ(text_of(write_seq(document_of(kAllKinds)).diagnostics), "");
}

TEST(SeqWrite, ChoreonoidsDigitsAreNineAndSixForTheRateAtTheTop) {
  std::string text = kAllKinds;
  text.replace(text.find("0.1, 0.2"), 8, "0.12345678901234567, 1e-5");
  const std::string rate = "frameRate: 119.88011988";
  for (std::size_t at = text.find("frameRate: 50"); at != std::string::npos;
       at = text.find("frameRate: 50")) {
    text.replace(at, 13, rate);
  }
  const std::string written = write_seq(document_of(text), {.choreonoid_digits = true}).text;
  EXPECT_TRUE(has(written, "- [ 0.123456789, 1e-05 ]\n")) << written;
  EXPECT_TRUE(has(written, "\nframeRate: 119.88\n"));
  EXPECT_TRUE(has(written, "    frameRate: 119.88012\n"));
}

TEST(SeqWrite, ARateThatAFrameTimeWasCutOffFromIsWritten) {
  Component component;
  component.content = kJointDisplacement;
  component.num_frames = 1;
  component.values = {0.5};
  component.timeline = {FrameTime{0.0333333}, 0};
  Document document;
  document.content = BodyMotion{{component}};
  const Written written = write_seq(document);
  EXPECT_EQ(text_of(written.diagnostics),
            "note[SEQ026]: the frame time 0.0333333 s is written as 30 frames a second, from which "
            "it was cut off\n");
  EXPECT_TRUE(has(written.text, "formatVersion: 2\nframeRate: 30\n")) << written.text;
}

TEST(SeqWrite, WhatIsNoBodyMotionIsRefused) {
  Document document;
  document.content = Skeleton{};
  Diagnostics diagnostics;
  const auto written = find_format("choreonoid")->write(document, {}, {}, diagnostics);
  ASSERT_FALSE(written);
  EXPECT_EQ(to_string(written.error()),
            "error[SEQ027]: expected a body motion to write as .seq, found a skeleton");
}

TEST(SeqWrite, ARateOfZeroIsRefused) {
  Component component;
  component.timeline = {FrameRate{0}, 0};
  Document document;
  document.content = BodyMotion{{component}};
  Diagnostics diagnostics;
  const auto written = find_format("choreonoid")->write(document, {}, {}, diagnostics);
  ASSERT_FALSE(written);
  EXPECT_EQ(to_string(written.error()), "error[SEQ027]: expected frames a second above 0, found 0");
}

TEST(SeqWrite, ATimeThatNoReaderTakesIsRefused) {
  Component component;
  component.content = "Grip";
  component.num_frames = 2;
  component.values = {1, 2};
  component.timeline.given = FrameTimes{{-0.5, 1}};
  Diagnostics diagnostics;
  const auto written =
      find_format("choreonoid")->write({BodyMotion{{component}}, "", {}}, {}, {}, diagnostics);
  ASSERT_FALSE(written);
  EXPECT_EQ(to_string(written.error()),
            "error[SEQ027]: expected times from 0 s up in 'Grip', found -0.5 s");
  EXPECT_EQ(written.error().kind, ErrorKind::DataLoss);
}

}  // namespace
}  // namespace kinefile::test
