// SPDX-License-Identifier: MIT
#include "text/scanner.hpp"

#include <gtest/gtest.h>

namespace kinefile::text {
namespace {

TEST(Scanner, TakesWordsOverLines) {
  Scanner scanner(" a\r\n\n\tb{c}");
  EXPECT_EQ(scanner.peek(), "a");
  EXPECT_EQ(scanner.take(), "a");
  EXPECT_EQ(scanner.take(), "b");
  EXPECT_EQ(scanner.take(), "{");
  EXPECT_EQ(scanner.take(), "c");
  EXPECT_EQ(scanner.take(), "}");
  EXPECT_EQ(scanner.take(), "");
}

TEST(Scanner, StaysInTheLineWhenAsked) {
  Scanner scanner("a b\nc");
  EXPECT_EQ(scanner.take_in_line(), "a");
  EXPECT_EQ(scanner.take_in_line(), "b");
  EXPECT_EQ(scanner.take_in_line(), "");
  EXPECT_EQ(scanner.take(), "c");
}

TEST(Scanner, TakesNamesWithBlanks) {
  Scanner scanner("  Body Ctrl.001 \t\n");
  EXPECT_EQ(scanner.take_name(), "Body Ctrl.001");
  Scanner braced("Hips {");
  EXPECT_EQ(braced.take_name(), "Hips");
  EXPECT_EQ(braced.take(), "{");
}

TEST(Scanner, TakesACharacterOfTheLine) {
  Scanner scanner(" : 3");
  EXPECT_TRUE(scanner.take_character(':'));
  EXPECT_FALSE(scanner.take_character(':'));
  EXPECT_EQ(scanner.take(), "3");
}

TEST(Scanner, ComparesWithoutCase) {
  EXPECT_TRUE(equals_ignoring_case("RoOt", "ROOT"));
  EXPECT_FALSE(equals_ignoring_case("ROOTS", "ROOT"));
  EXPECT_TRUE(starts_with_ignoring_case("Frames:3", "frames"));
  EXPECT_FALSE(starts_with_ignoring_case("Fr", "frames"));
}

}  // namespace
}  // namespace kinefile::text
