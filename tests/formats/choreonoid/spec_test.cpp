// SPDX-License-Identifier: MIT
// The example blocks of the format's document, their dots completed. Those with times are in
// timed_test.cpp.

#include <fmt/format.h>

#include "support/seq.hpp"

namespace kinefile::test {
namespace {

std::string repeated(const std::string& first, const std::string& row, std::size_t count) {
  std::string text = first;
  for (std::size_t i = 0; i < count; ++i) text += row;
  return text;
}

const std::string kTop = "type: CompositeSeq\ncontent: BodyMotion\nformatVersion: 2\n";

TEST(SeqSpec, TheStructureOfAFileWithItsCommentsAndBlanksBehindKeys) {
  std::string text = "# トップノード\n" + kTop +
                     "frameRate: 1000\nnumFrames: 7261\ncomponents: \n"
                     "  - \n    # コンポーネント1\n    type: MultiSE3Seq\n"
                     "    content: LinkPosition\n    numParts: 1\n    frameRate: 1000\n"
                     "    numFrames: 7261\n    SE3Format: XYZQWQXQYQZ\n    frames: \n"
                     "    # コンポーネント1のフレームデータ\n";
  text = repeated(text, "      - [ [ 1, 2, 3, 1, 0, 0, 0 ] ]\n", 7261);
  text +=
      "  - \n    # コンポーネント2\n    type: MultiValueSeq\n    content: JointDisplacement\n"
      "    numParts: 2\n    frameRate: 1000\n    numFrames: 7261\n    frames: \n"
      "    # コンポーネント2のフレームデータ\n";
  text = repeated(text, "      - [ 0.5, -0.25 ]\n", 7261);
  const ReadText read = read_seq(text);
  EXPECT_TRUE(read.diagnostics.items().empty()) << text_of(read.diagnostics);
  const auto& components = components_of(read);
  ASSERT_EQ(components.size(), 2u);
  EXPECT_EQ(components[0].content, kLinkPosition);
  EXPECT_EQ(components[1].content, kJointDisplacement);
  for (const Component& component : components) {
    EXPECT_EQ(component.num_frames, 7261u);
    EXPECT_EQ(frame_rate(component.timeline), 1000);
  }
  const auto pose = components[0].row(7260);
  EXPECT_EQ(std::vector<double>(pose.begin(), pose.end()),
            (std::vector<double>{1, 2, 3, 1, 0, 0, 0}));
}

TEST(SeqSpec, JointDisplacements) {
  const std::string head =
      kTop +
      "components:\n  - \n    type: MultiValueSeq\n    content: JointDisplacement\n"
      "    numParts: 2\n    frameRate: 100\n    numFrames: 100\n    frames: \n"
      "      - [ 0.0,  0.0  ]\n      - [ 0.01, 0.01 ]\n      - [ 0.01, 0.02 ]\n"
      "      - [ 0.02, 0.03 ]\n      - [ 0.02, 0.04 ]\n";
  const ReadText read = read_seq(repeated(head, "      - [ 0.03, 0.05 ]\n", 95));
  EXPECT_TRUE(read.diagnostics.items().empty()) << text_of(read.diagnostics);
  const Component& joints = components_of(read).at(0);
  EXPECT_EQ(joints.num_frames, 100u);
  EXPECT_EQ(joints.num_parts, 2u);
  const std::vector<double> first(joints.values.begin(), joints.values.begin() + 10);
  EXPECT_EQ(first, (std::vector<double>{0, 0, 0.01, 0.01, 0.01, 0.02, 0.02, 0.03, 0.02, 0.04}));
}

TEST(SeqSpec, LinkPositions) {
  const std::string head =
      kTop +
      "components:\n - \n   type: MultiSE3Seq\n   content: LinkPosition\n   numParts: 1\n"
      "   frameRate: 100\n   numFrames: 100\n   SE3Format: XYZQWQXQYQZ\n   frames: \n";
  const ReadText read = read_seq(repeated(head, "     - [ [ -2, -0.5, 0.1, 1, 0, 0, 0 ] ]\n", 100));
  EXPECT_TRUE(read.diagnostics.items().empty()) << text_of(read.diagnostics);
  const Component& links = components_of(read).at(0);
  EXPECT_EQ(links.num_frames, 100u);
  const auto last = links.row(99);
  EXPECT_EQ(std::vector<double>(last.begin(), last.end()),
            (std::vector<double>{-2, -0.5, 0.1, 1, 0, 0, 0}));
}

TEST(SeqSpec, SeveralLinksStandSideBySideInAFrame) {
  std::string row = "     - [ ";
  for (int link = 1; link <= 5; ++link) {
    row += fmt::format("{}[ {}, {}, {}, 1, 0, 0, 0 ]", link > 1 ? ", " : "", link, link * 10,
                       link * 100);
  }
  const ReadText read =
      read_seq(kTop +
               "components:\n - \n   type: MultiSE3Seq\n   content: LinkPosition\n   numParts: 5\n"
               "   frameRate: 100\n   SE3Format: XYZQWQXQYQZ\n   frames: \n" +
               row + " ]\n");
  EXPECT_TRUE(read.diagnostics.items().empty()) << text_of(read.diagnostics);
  const Component& links = components_of(read).at(0);
  ASSERT_EQ(links.num_parts, 5u);
  for (std::size_t link = 0; link < 5; ++link) {
    EXPECT_EQ(links.row(0)[link * 7 + 2], 100 * static_cast<double>(link + 1));
  }
}

TEST(SeqSpec, AZmpIsInTheWorldUnlessItSaysOtherwise) {
  const std::string head =
      kTop +
      "components:\n - \n   type: Vector3Seq\n   content: ZMP\n   frameRate: 100\n"
      "   numFrames: 100\n";
  const std::string frames =
      "   frames: \n     - [ 0.0, 0.0,   0.0 ]\n     - [ 0.0, 0.001, 0.0 ]\n"
      "     - [ 0.0, 0.002, 0.0 ]\n     - [ 0.0, 0.003, 0.0 ]\n     - [ 0.0, 0.004, 0.0 ]\n";
  for (const auto& [key, is_relative] : {std::pair("", false),
                                         {"   isRootRelative: true\n", true},
                                         {"   isRootRelative: false\n", false}}) {
    const ReadText read = read_seq(repeated(head + key + frames, "     - [ 0, 0.005, 0 ]\n", 95));
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"SEQ018"})
        << text_of(read.diagnostics) << "Choreonoid takes no ZMP alone";
    const Component& zmp = components_of(read).at(0);
    EXPECT_EQ(zmp.num_frames, 100u);
    EXPECT_EQ(zmp.is_root_relative, is_relative) << key;
    EXPECT_EQ(zmp.row(4)[1], 0.004);
  }
}

}  // namespace
}  // namespace kinefile::test
