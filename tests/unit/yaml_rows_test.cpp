// SPDX-License-Identifier: MIT
// Rows of numbers in YAML, which are taken as a whole: they say what they say one by one.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "support/support.hpp"
#include "support/yaml_events.hpp"
#include "text/source.hpp"
#include "text/yaml/tree.hpp"

namespace kinefile::test {
namespace {

using text::yaml::kEmptyGroup;
using text::yaml::Node;
using text::yaml::NumberRows;
using text::yaml::Parser;
using text::yaml::RowShape;

/// The rows that a text gives as a whole.
struct YamlRows {
  std::vector<RowShape> shapes;
  std::vector<double> values;
  bool is_good = false;
};

YamlRows rows_of(std::string_view text) {
  YamlRows found;
  NumberRows rows;
  Parser parser(text, &rows);
  text::yaml::Event event;
  while (parser.next(event)) {
    if (event.kind == text::yaml::EventKind::StreamEnd) found.is_good = true;
    if (found.is_good) break;
    if (event.kind != text::yaml::EventKind::Row) continue;
    found.shapes.insert(found.shapes.end(), event.num_rows, rows.shape(event.row));
    const auto values = rows.pop(event.row, event.num_rows);
    found.values.insert(found.values.end(), values.begin(), values.end());
  }
  EXPECT_TRUE(found.is_good) << text;
  return found;
}

std::vector<RowShape> shapes(std::string_view text) { return rows_of(text).shapes; }

/// Whether a text is the same with rows as without.
void expect_same_events(std::string_view text) {
  EXPECT_EQ(test::yaml_events(text, {.takes_rows = true, .has_numbers = true}),
            test::yaml_events(text, {.takes_rows = false, .has_numbers = true}))
      << text;
}

using Shapes = std::vector<RowShape>;

TEST(YamlRows, HaveShapes) {
  EXPECT_EQ(shapes("- [1, 2, 3]"), (Shapes{{3}}));
  EXPECT_EQ(shapes("- [ [1, 2], [3, 4] ]"), (Shapes{{-2, -2}}));
  EXPECT_EQ(shapes("- [0.1, [1, 2], [3, 4], 5, 6]"), (Shapes{{1, -2, -2, 2}}));
  EXPECT_EQ(shapes("- []\n- [ [] ]\n- [ [], 1 ]"), (Shapes{{}, {kEmptyGroup}, {kEmptyGroup, 1}}));
  EXPECT_EQ(shapes("- [1,]\n- [[2,],]"), (Shapes{{1}, {-1}}));
}

/// Lines of rows, among which some are odd.
std::string many_rows(std::mt19937& random, const std::string& row_of_three, bool with_odd_ones) {
  static const std::vector<std::string> kOdd = {"- []",
                                                "- [1]",
                                                "- [ 1, 2 ]",
                                                "- [ 1, 2, nan ]",
                                                "- x",
                                                "- [ 1, 2, 3 ] #",
                                                "- [1,2,3]",
                                                "- [ 1, 2,\n     3 ]",
                                                "-\n  [ 1, 2, 3 ]",
                                                "- [ 1, 2, \"3\" ]",
                                                "-  [ 1, 2, 3 ]",
                                                "- { a: 1 }",
                                                "# [ 1, 2, 3 ]",
                                                "- [ 1, 2, 3 ] ",
                                                "- - [ 1, 2, 3 ]",
                                                "",
                                                "- [ 1, 2, -.5e3 ]",
                                                "- [ 1, 2, 1_0 ]",
                                                "- [ 1, 2, 0x1F ]",
                                                "- &a [ 1, 2, 3 ]"};
  std::string text;
  for (int i = 0; i < 300; ++i) {
    const bool is_odd = with_odd_ones && random() % 40 == 0;
    if (is_odd) {
      text += kOdd[random() % kOdd.size()] + "\n";
      continue;
    }
    std::string row = row_of_three;
    for (std::size_t at = row.find('@'); at != std::string::npos; at = row.find('@')) {
      const double value = (static_cast<double>(random()) - 2e9) * 1e-8;
      row.replace(at, 1, fmt::format("{:.{}f}", value, random() % 18));
    }
    text += row + "\n";
  }
  return text;
}

TEST(YamlRows, ManyAtOnceAreTheSameAsOneByOne) {
  std::mt19937 random(9);
  for (const std::string row : {"- [ @, @, @ ]", "- [@,@,@]", "- [ [ @, @ ], [ @ ] ]",
                                "- [ @, @, @ ]\r", "-   [ @, [ @, @ ] ]"}) {
    for (int round = 0; round < 10; ++round) {
      expect_same_events(many_rows(random, row, round > 0));
      expect_same_events("a:\n" + many_rows(random, row, false) + "b:\n" +
                         many_rows(random, row, false));
    }
  }
}

TEST(YamlRows, HaveTheNumbersBits) {
  const std::vector<std::pair<std::string, double>> numbers = {
      {"0", 0.0},
      {"-0", -0.0},
      {"-0.0", -0.0},
      {"+1.5", 1.5},
      {".5", 0.5},
      {"5.", 5},
      {"1e-5", 1e-5},
      {"-1.25E+10", -1.25e10},
      {"0.1", 0.1},
      {"0.30000000000000004", 0.30000000000000004},
      {"1.7976931348623157e308", 1.7976931348623157e308},
      {"5e-324", 5e-324},
      {"123456789012345678901234567890", 123456789012345678901234567890.0},
      {"0.1000000000000000055511151231257827021181583404541015625", 0.1},
      {"-4.656612873077393e-10", -4.656612873077393e-10}};
  std::string text = "- [";
  for (const auto& [word, value] : numbers) text += " " + word + ",";
  const YamlRows rows = rows_of(text + " 7 ]");
  ASSERT_EQ(rows.values.size(), numbers.size() + 1);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(std::memcmp(&rows.values[i], &numbers[i].second, sizeof(double)), 0)
        << numbers[i].first;
  }
}

TEST(YamlRows, MayGoOverSeveralLines) {
  const std::string text =
      "a:\n  - [ 1,\n      2,\n\n      3 ]\n  - [ [ 4\n    ], [ 5 ]\n    ]\nb: c\n";
  const YamlRows rows = rows_of(text);
  EXPECT_EQ(rows.shapes, (Shapes{{3}, {-1, -1}}));
  EXPECT_EQ(rows.values, (std::vector<double>{1, 2, 3, 4, 5}));
  expect_same_events(text);
}

TEST(YamlRows, MayStandInListsInFlow) {
  const std::string text = "frames: [ [1, 2], [3, 4],\n [5, 6] ]";
  EXPECT_EQ(shapes(text), (Shapes{{2}, {2}, {2}}));
  expect_same_events(text);
  expect_same_events("[ [ [1], [2] ], a, [ 3 ] ]");
}

TEST(YamlRows, AreNoneWhereSomethingElseStandsInThem) {
  for (const char* text : {"- [1, nan]",  "- [1, inf]", "- [1, .inf]",   "- [1, 1e400]",
                           "- [1, a]",    "- [1, '2']", "- [1, 0x10]",   "- [1, 2 # c\n  , 3]",
                           "- [1: 2]",    "- [&a 1]",   "- [1, *a]",     "- [1, ~]",
                           "- [1, true]", "- [1 2]",    "- [1_000]",     "- [1:30]",
                           "- [! 1]",     "- {a: 1}",   "- [1, {a: 2}]", "- [-]",
                           "- [1,\n\t2]"}) {
    NumberRows rows;
    Parser parser(text, &rows);
    text::yaml::Event event;
    while (parser.next(event) && event.kind != text::yaml::EventKind::StreamEnd) {
      EXPECT_NE(event.kind, text::yaml::EventKind::Row) << text;
    }
    expect_same_events(text);
  }
}

TEST(YamlRows, AreNoneThatAreKeys) {
  for (const char* text : {"- [1, 2]: x\n", "- [1, 2] : x\n", "[ [1, 2]: x ]", "[1, 2]: x\n",
                           "? [1, 2]\n: x\n", "- ? [1, 2]\n  : x\n", "[ [1] : x, [2] ]"}) {
    const auto found = test::yaml_events(text, {.takes_rows = true, .has_numbers = true});
    EXPECT_TRUE(found) << text;
    EXPECT_NE(found.value_or("").find("+MAP"), std::string::npos) << text;
    expect_same_events(text);
  }
}

TEST(YamlRows, AreNoneBehindAnchorsAndTags) {
  for (const char* text : {"- &a [1, 2]\n- *a\n", "- !t [1, 2]\n", "- &a\n  [1, 2]\n- *a\n"}) {
    EXPECT_TRUE(shapes(text).empty()) << text;
    expect_same_events(text);
  }
}

TEST(YamlRows, MayHaveCommentsBehindThem) {
  for (const char* text : {"- [1, 2] # c\n- [3, 4]\n", "- [1, 2]\n# c\n- [3, 4]#\n",
                           "- [1, 2] \t \n-   [3, 4]", "[ [1, 2] # c\n, [3, 4] ]"}) {
    expect_same_events(text);
  }
}

TEST(YamlRows, EndsOfLinesOfAllSystemsAreAlike) {
  for (const char* text :
       {"- [1,\n  2]\n- [3]\n", "- [1,\r\n  2]\r\n- [3]\r\n", "- [1,\r  2]\r- [3]\r",
        "- [1, 2]\xC2\x85- [3]\n", "- [1,\xE2\x80\xA8  2]\n- [3]\n"}) {
    expect_same_events(text);
  }
}

TEST(YamlRows, WhatFollowsThemIsAtItsPlace) {
  const std::string text = "- [ 1,\r\n  2 ]\r\n- [ 3 ]\n- x\n- [ [ 4,\n 5 ] ]\n- y: z\n";
  NumberRows rows;
  Parser parser(text, &rows);
  text::yaml::Event event;
  std::string scalars;
  while (parser.next(event) && event.kind != text::yaml::EventKind::StreamEnd) {
    if (event.kind == text::yaml::EventKind::Scalar) scalars += event.value;
  }
  EXPECT_FALSE(parser.fault()) << parser.fault()->message;
  EXPECT_EQ(scalars, "xyz");
}

TEST(YamlRows, TooManyShapesAreReadLikeAnythingElse) {
  std::string text;
  for (int i = 1; i <= 80; ++i) {
    text += "- [ 1";
    for (int k = 1; k < i; ++k) text += ", 1";
    text += " ]\n";
  }
  EXPECT_EQ(shapes(text).size(), 64u);
  expect_same_events(text);
}

/// A tree of a sequence: its entries in order, "row" or a scalar.
TEST(YamlRows, AndNodesStandInTheirOrderInATree) {
  const std::string text = "- a\n- [1, 2]\n- [3, nan]\n- [4, 5]\n- { b: c }\n";
  const text::Source source("t.yaml", text);
  Diagnostics diagnostics;
  const auto tree = text::yaml::read_tree(source, diagnostics);
  ASSERT_NE(tree, nullptr);
  const Node& root = tree->root();
  ASSERT_NE(root.rows, nullptr);
  EXPECT_TRUE(root.children.empty());
  ASSERT_EQ(root.rows->entries.size(), 5u);
  EXPECT_EQ(root.rows->values, (std::vector<double>{1, 2, 4, 5}));
  EXPECT_EQ(root.rows->entries[0].node->text, "a");
  EXPECT_EQ(root.rows->entries[1].text, "[1, 2]");
  EXPECT_EQ(root.rows->entries[1].node, nullptr);
  EXPECT_EQ(root.rows->entries[2].node->children.size(), 2u);
  EXPECT_EQ(root.rows->entries[3].text, "[4, 5]");
  EXPECT_EQ(root.rows->entries[4].node->kind, text::yaml::NodeKind::Mapping);
  EXPECT_EQ(root.size, 1u + 1 + 3 + 3 + 3 + 3);
}

/// Many rows that are read at once, and others among them, have their own texts and numbers.
TEST(YamlRows, KnowTheirTextsWhereManyAreReadAtOnce) {
  std::string text = "frames:\r\n";
  std::vector<std::string> rows;
  for (int i = 0; i < 20'000; ++i) {
    rows.push_back(i % 7000 == 6999 ? fmt::format("[{},  0 ]", i) : fmt::format("[ {}, 0.5 ]", i));
    text += "  - " + rows.back() + "\r\n";
  }
  text += "end: [";
  const text::Source source("t.yaml", text);
  Diagnostics diagnostics;
  EXPECT_EQ(text::yaml::read_tree(source, diagnostics), nullptr);
  EXPECT_EQ(diagnostics.first_error().place.line, 20'002u);
  text.back() = '0';
  const auto tree = text::yaml::read_tree(source, diagnostics);
  ASSERT_NE(tree, nullptr);
  const Node* const frames = text::yaml::find(tree->root(), "frames");
  ASSERT_EQ(frames->rows->entries.size(), rows.size());
  ASSERT_EQ(frames->rows->values.size(), 2 * rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(frames->rows->entries[i].text, rows[i]);
    ASSERT_EQ(frames->rows->values[2 * i], static_cast<double>(i));
  }
}

TEST(YamlRows, OfAnAliasAreThereForEveryUse) {
  const std::string text = "a: &a\n  - [1, 2]\n  - [3, 4]\nb: *a\n";
  const text::Source source("t.yaml", text);
  Diagnostics diagnostics;
  const auto tree = text::yaml::read_tree(source, diagnostics);
  ASSERT_NE(tree, nullptr);
  for (const char* key : {"a", "b", "a"}) {
    const auto rows = tree->take_rows(*text::yaml::find(tree->root(), key));
    ASSERT_NE(rows, nullptr);
    EXPECT_EQ(rows->values, (std::vector<double>{1, 2, 3, 4})) << key;
  }
}

TEST(YamlRows, AFormFeedIsNoSpace) {
  for (const char* text : {"- [ 1\f, 2 ]\n", "- [ 1,\v 2 ]\n", "- [ 1, 2 ]\f\n"}) {
    const text::Source source("t", text);
    Diagnostics diagnostics;
    EXPECT_EQ(text::yaml::read_tree(source, diagnostics), nullptr) << text;
  }
}

}  // namespace
}  // namespace kinefile::test
