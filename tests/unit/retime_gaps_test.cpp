// SPDX-License-Identifier: MIT
// Numbers that are not finite.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/motions.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Motion walk_with(std::size_t frame, std::size_t column, double value) {
  Motion walk = examples::make_walk({.num_frames = 10});
  walk.clip.mutate()[frame][column] = value;
  return walk;
}

/// The columns that are NaN in a row.
std::vector<std::size_t> gaps_in(std::span<const double> row) {
  std::vector<std::size_t> gaps;
  for (std::size_t c = 0; c < row.size(); ++c) {
    EXPECT_FALSE(std::isinf(row[c]));
    if (std::isnan(row[c])) gaps.push_back(c);
  }
  return gaps;
}

TEST(RetimeGaps, AreAnErrorWhereTheyAreNeeded) {
  // Column 7 is the second angle of Spine.
  const Motion walk = walk_with(4, 7, std::nan(""));
  Diagnostics diagnostics;
  const auto refused = retime::apply(walk, {{1, 2.5, 4.5, 3.5}}, {}, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::InvalidInput);
  EXPECT_EQ(to_string(refused.error()),
            "error[RTM005]: joint 'Spine': Xrotation is not a finite number in frame 4, which the "
            "new frame 2 needs");
}

TEST(RetimeGaps, AreCopiedWhereFramesAreWhole) {
  const Motion walk = walk_with(4, 7, std::nan(""));
  const Motion copy = test::retimed(walk, {{2.5, 4, 5.5}});
  EXPECT_EQ(gaps_in(copy.clip.row(1)), std::vector<std::size_t>{7});
  EXPECT_TRUE(gaps_in(copy.clip.row(0)).empty());
  EXPECT_TRUE(gaps_in(copy.clip.row(2)).empty());
}

TEST(RetimeGaps, LenientGivesNoRotationAndSparesTheOtherJoints) {
  for (const double value : {std::nan(""), kInfinity, -kInfinity}) {
    const Motion walk = walk_with(4, 7, value);
    Diagnostics diagnostics;
    const auto result =
        retime::apply(walk, {{2.5, 3.5, 4.25, 5.5}}, {.lenient = true}, diagnostics);
    ASSERT_TRUE(result);
    EXPECT_TRUE(gaps_in(result->clip.row(0)).empty());
    EXPECT_EQ(gaps_in(result->clip.row(1)), (std::vector<std::size_t>{6, 7, 8}));
    EXPECT_EQ(gaps_in(result->clip.row(2)), (std::vector<std::size_t>{6, 7, 8}));
    EXPECT_TRUE(gaps_in(result->clip.row(3)).empty());
    EXPECT_EQ(test::text_of(diagnostics),
              "warning[RTM005]: joint 'Spine': Xrotation is not a finite number in frame 4, which "
              "the new frame 1 needs; 2 new frames of the joint have gaps\n");
  }
}

TEST(RetimeGaps, ANumberIsAGapOfItsOwn) {
  const Motion walk = walk_with(4, 1, kInfinity);
  Diagnostics diagnostics;
  const auto result = retime::apply(walk, {{4.5}}, {.lenient = true}, diagnostics);
  ASSERT_TRUE(result);
  EXPECT_EQ(gaps_in(result->clip.row(0)), std::vector<std::size_t>{1});
}

TEST(RetimeGaps, CubicNeedsFourFrames) {
  const Motion walk = walk_with(4, 7, std::nan(""));
  const retime::RetimeOptions cubic{.rotation = retime::RotationInterpolation::Cubic,
                                    .lenient = true};
  Diagnostics diagnostics;
  const auto result = retime::apply(walk, {{1.5, 2.5, 3.5, 4.5, 5.5, 6.5}}, cubic, diagnostics);
  ASSERT_TRUE(result);
  for (std::size_t n = 0; n < 6; ++n) {
    EXPECT_EQ(gaps_in(result->clip.row(n)).size(), n == 0 || n == 5 ? 0u : 3u) << n;
  }
}

TEST(RetimeGaps, AnAverageNeedsAllThatItIsMadeOf) {
  const Motion walk = walk_with(6, 2, std::nan(""));
  const retime::RetimeOptions smooth{.antialias = true, .lenient = true};
  Diagnostics diagnostics;
  const auto result = retime::apply(walk, {{0, 2, 4, 6, 8}}, smooth, diagnostics);
  ASSERT_TRUE(result);
  for (std::size_t n = 0; n < 5; ++n) {
    const bool is_near = n == 2 || n == 3 || n == 4;
    EXPECT_EQ(gaps_in(result->clip.row(n)).size(), is_near ? 1u : 0u) << n;
  }
}

TEST(RetimeGaps, AFreeJointHasNoRotationThen) {
  const Motion motion =
      test::free_motion({{0, 0, 0, 1, 0, 0, 0}, {1, 1, 1, 1, std::nan(""), 0, 0}});
  Diagnostics diagnostics;
  const auto result = retime::apply(motion, {{0.5}}, {.lenient = true}, diagnostics);
  ASSERT_TRUE(result);
  EXPECT_EQ(gaps_in(result->clip.row(0)), (std::vector<std::size_t>{3, 4, 5, 6}));
}

}  // namespace
}  // namespace kinefile
