// SPDX-License-Identifier: MIT
#include "kinefile/servo_map.hpp"

#include <gtest/gtest.h>

#include "kinefile/math.hpp"

namespace kinefile::test {
namespace {

TEST(ServoMap, WordsAreDegreesBySignOffsetAndResolution) {
  const ServoMapEntry plain{.slider = 0, .joint = "a", .units_per_degree = 182.0417};
  EXPECT_DOUBLE_EQ(angle_of_word(plain, 18204.17) / kRadiansPerDegree, 100);
  EXPECT_DOUBLE_EQ(word_of_angle(plain, -kRadiansPerDegree), -182.0417);
  const ServoMapEntry turned{
      .slider = 0, .joint = "a", .sign = -1, .units_per_degree = 100, .offset = 1000};
  EXPECT_EQ(angle_of_word(turned, 1000), 0);
  EXPECT_DOUBLE_EQ(angle_of_word(turned, 0) / kRadiansPerDegree, 10);
  EXPECT_DOUBLE_EQ(word_of_angle(turned, 20 * kRadiansPerDegree), -1000);
}

TEST(ServoMap, WordsComeBack) {
  const ServoMapEntry entry{
      .slider = 0, .joint = "a", .sign = -1, .units_per_degree = 364.0833, .offset = 3};
  for (int word = -32768; word <= 32767; word += 97) {
    EXPECT_NEAR(word_of_angle(entry, angle_of_word(entry, word)), word, 1e-9);
  }
}

}  // namespace
}  // namespace kinefile::test
