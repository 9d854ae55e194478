// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "kinefile/bvh.hpp"
#include "kinefile/kinematics.hpp"
#include "support/figures.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

const std::string kTwoFrames = bvh_with_rows({"1 2 3 4 5 6 7 8 9", "2 3 4 5 6 7 8 9 10"});

std::vector<std::string> codes_of_text(const std::string& text, ReadOptions options = {}) {
  return codes_of(read_bvh(text, std::move(options)).diagnostics);
}

TEST(BvhRead, PositionsReplaceOrAddOrDecide) {
  std::string text = replaced(kTwoFrames, "OFFSET 0 0 0", "OFFSET 5 100 -7");
  text = replaced(replaced(text, "\n1 2 3", "\n1 -98 3"), "\n2 3 4", "\n2 -97 4");
  const auto hips = [&text](bvh::PositionMode mode) {
    ReadOptions options;
    options.of_formats = bvh::ReadOptions{mode};
    options.up = 1;
    const ReadText read = read_bvh(text, options);
    const WorldPoses poses = forward_kinematics(read.motion().skeleton, read.motion().clip);
    return Vec3(poses.positions[0], poses.positions[1], poses.positions[2]);
  };
  EXPECT_EQ(hips(bvh::PositionMode::Replace), Vec3(1, -98, 3));
  EXPECT_EQ(hips(bvh::PositionMode::Add), Vec3(6, 2, -4));
  EXPECT_EQ(hips(bvh::PositionMode::Auto), Vec3(6, 2, -4)) << "the figure stands on the ground";
  ReadOptions asked;
  asked.up = 1;
  EXPECT_EQ(codes_of_text(text, asked), std::vector<std::string>{"BVH035"}) << "and worth a note";
  asked.of_formats = bvh::ReadOptions{bvh::PositionMode::Auto};
  EXPECT_EQ(codes_of_text(text, asked), std::vector<std::string>{"BVH034"});
}

TEST(BvhRead, AutoTakesAbsolutePositionsForSuch) {
  std::string text = replaced(kTwoFrames, "OFFSET 0 0 0", "OFFSET 0 90 0");
  text = replaced(replaced(text, "\n1 2 3", "\n900 92 -800"), "\n2 3 4", "\n900 91 -800");
  ReadOptions automatic;
  automatic.of_formats = bvh::ReadOptions{bvh::PositionMode::Auto};
  const ReadText read = read_bvh(text, automatic);
  EXPECT_EQ(fact_of(*read.document, "positions"), "replace");
  EXPECT_EQ(codes_of_text(text), std::vector<std::string>{});
}

/// A person with position channels everywhere, above ground at y = 0, in two frames.
/// \param root    the root's position, from zero or from its OFFSET of 90
/// \param others  what the others' positions hold: 1 their OFFSETs, 0 zeros
std::string person_with_positions(const Vec3& root, double others) {
  std::vector<Bone> bones = person();
  bones[0].offset = {0, 90, 0};
  std::vector<std::vector<double>> rows;
  for (int f = 0; f < 2; ++f) {
    std::vector<double> row = {root[0], root[1], root[2] + f, 0, 0, 0};
    for (std::size_t b = 1; b < bones.size(); ++b) {
      bones[b].has_positions = true;
      const Vec3 place = others * bones[b].offset;
      for (const double number : {place[0], place[1], place[2], 0.0, 10.0 * f, 0.0}) {
        row.push_back(number);
      }
    }
    rows.push_back(row);
  }
  return bvh_of_figure(bones, rows);
}

Vec3 place_in(const ReadText& read, std::size_t joint) {
  const WorldPoses poses = forward_kinematics(read.motion().skeleton, read.motion().clip);
  return Vec3(&poses.positions[joint * 3]);
}

TEST(BvhRead, EachJointHasItsOwnAnswerToPositions) {
  ReadOptions automatic;
  automatic.of_formats = bvh::ReadOptions{bvh::PositionMode::Auto};
  const std::string root_adds = person_with_positions({1, -3, 2}, 1);
  const ReadText one = read_bvh(root_adds, automatic);
  EXPECT_EQ(fact_of(*one.document, "positions"), "root=add,others=replace");
  EXPECT_EQ(place_in(one, 0), Vec3(1, 87, 2));
  EXPECT_EQ(place_in(one, 2), Vec3(10, 2, 2));
  const ReadText doubted = read_bvh(root_adds);
  EXPECT_EQ(codes_of(doubted.diagnostics), std::vector<std::string>{"BVH035"});
  EXPECT_NE(text_of(doubted.diagnostics).find("(--positions root=add,others=replace)"),
            std::string::npos);
  const std::string others_add = person_with_positions({1, 87, 2}, 0);
  const ReadText two = read_bvh(others_add, automatic);
  EXPECT_EQ(fact_of(*two.document, "positions"), "root=replace,others=add");
  EXPECT_EQ(place_in(two, 2), Vec3(10, 2, 2));
  EXPECT_EQ(codes_of_text(others_add).size(), 5u) << "one for each bone without length";
  for (const std::string& text : {root_adds, others_add}) {
    ReadOptions options;
    options.of_formats = bvh::ReadOptions{
        text == root_adds ? bvh::Positions(bvh::PositionMode::Add, bvh::PositionMode::Replace)
                          : bvh::Positions(bvh::PositionMode::Replace, bvh::PositionMode::Add)};
    const ReadText read = read_bvh(text, options);
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{});
    EXPECT_EQ(place_in(read, 2), Vec3(10, 2, 2));
    EXPECT_EQ(write_to_string(*read.document), write_to_string(*read_bvh(text).document));
  }
}

TEST(BvhRead, AFarRootOrAFallIsNoReasonForDoubt) {
  std::vector<Bone> bones = person();
  bones[0].offset = {30, 90, -452};
  EXPECT_EQ(
      codes_of_text(bvh_of_figure(bones, {row_of(bones, {2, 90, 5}), row_of(bones, {3, 91, 5})})),
      std::vector<std::string>{});
  bones[0].offset = {0, 90, 0};
  std::vector<std::vector<double>> falls;
  std::vector<std::vector<double>> added;
  for (int f = 0; f < 12; ++f) {
    falls.push_back(row_of(bones, {0, 90.0 - 6 * f, 0}));
    added.push_back(row_of(bones, {0, -6.0 * f, 0}));
  }
  EXPECT_EQ(codes_of_text(bvh_of_figure(bones, falls)), std::vector<std::string>{});
  EXPECT_EQ(codes_of_text(bvh_of_figure(bones, added)), std::vector<std::string>{"BVH035"});
}

TEST(BvhRead, ABoneThatMovesBelowATravellingRootIsJudgedAsABone) {
  std::vector<Bone> bones = person();  // the root's OFFSET is 0 0 0
  bones.push_back({"Jaw", 2, {0, 2, 1}, std::nullopt, true});
  std::vector<std::vector<double>> rows;
  for (int f = 0; f < 4; ++f) {
    std::vector<double> row = row_of(bones, {0, 90, 3.0 * f});
    row[row.size() - 6] = 0;
    row[row.size() - 5] = 2 - 0.4 * f;
    row[row.size() - 4] = 1;
    rows.push_back(row);
  }
  const std::string text = bvh_of_figure(bones, rows);
  EXPECT_EQ(codes_of_text(text), std::vector<std::string>{});
  ReadOptions automatic;
  automatic.of_formats = bvh::ReadOptions{bvh::PositionMode::Auto};
  EXPECT_EQ(fact_of(*read_bvh(text, automatic).document, "positions"), "replace");
}

}  // namespace
}  // namespace kinefile::test
