// SPDX-License-Identifier: MIT
// Rows with a template, held against a plain reading of the same text.
#include "simd/template_rows.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "text/numbers.hpp"
#include "text/row_template.hpp"

namespace kinefile::simd {
namespace {

/// The text before the first number, then behind each.
using Gaps = std::vector<std::string>;

const std::vector<Gaps>& all_gaps() {
  static const std::vector<Gaps> gaps = {
      {"", ",", ",", "\n"},
      {"", ",", "\r\n"},
      {"", "\n"},
      {"- [ ", ", ", ", ", ", ", " ]\n"},
      {"      - [ [ ", ", ", ", ", " ], [ ", ", ", " ] ]\n"},
      {"- [", ",", ",", "]\n"},
      {"", "\nroot ", " ", " ", " ", "\nlower_back_of_the_figure ", "\nrfemur ", " ", " \n"},
      {"\t", "\t", "  \t", "\r\n"},
      {"{\"a\": [", ", ", "], \"b\": ", " }\n"},
      {"a word ", " more words x-y z ", " ", " the end\n"},
  };
  return gaps;
}

RowTemplate template_of(const Gaps& gaps) {
  RowTemplate row;
  for (const std::string& gap : gaps) row.add_gap(gap);
  return row;
}

std::string number(std::mt19937& random) {
  const double value = (static_cast<double>(random()) - 2e9) * 1e-8;
  switch (random() % 6) {
    case 0:
      return fmt::format("{}", value);
    case 1:
      return fmt::format("{:.2f}", value);
    case 2:
      return fmt::format("{:e}", value);
    case 3:
      return fmt::format("{}", static_cast<int>(value));
    case 4:
      return fmt::format("{:.19f}", value);
    default:
      return fmt::format("{:.6f}", value);
  }
}

struct Text {
  std::string text;
  std::vector<double> values;
  std::vector<std::size_t> begins;  ///< of rows
};

void append_row(const Gaps& gaps, std::mt19937& random, Text& made) {
  made.begins.push_back(made.text.size());
  made.text += gaps[0];
  for (std::size_t i = 1; i < gaps.size(); ++i) {
    const std::string token = number(random);
    made.values.push_back(text::parse_number(token).value);
    made.text += token + gaps[i];
  }
}

/// The rows at the end of a text may be left to another reader.
constexpr std::size_t kTail = 200;

/// Whether this machine has vectors that the reader uses.
bool reads_rows() {
  const RowTemplate row = template_of({"", "\n"});
  std::vector<double> values(100);
  const std::string text(200, '\n');
  std::string ones;
  for (int i = 0; i < 90; ++i) ones += "1\n";
  return read_template_rows(ones.data(), ones.data() + ones.size(), row, 90, values.data())
             .num_rows > 0;
}

TEST(TemplateRows, ReadsEveryTextBetweenNumbers) {
  std::mt19937 random(3);
  for (const Gaps& gaps : all_gaps()) {
    Text made;
    while (made.text.size() < 1'500'000) append_row(gaps, random, made);
    const RowTemplate row = template_of(gaps);
    std::vector<double> values(made.values.size());
    std::vector<const char*> begins(made.begins.size());
    const char* const begin = made.text.data();
    const NumberRows read = read_template_rows(begin, begin + made.text.size(), row, begins.size(),
                                               values.data(), begins.data());
    if (!reads_rows()) {
      EXPECT_EQ(read.num_rows, 0u);
      continue;
    }
    ASSERT_LT(static_cast<std::size_t>(begin + made.text.size() - read.next), kTail) << gaps[1];
    for (std::size_t i = 0; i < read.num_rows; ++i) {
      ASSERT_EQ(static_cast<std::size_t>(begins[i] - begin), made.begins[i]);
    }
    for (std::size_t i = 0; i < read.num_rows * row.num_columns(); ++i) {
      ASSERT_EQ(values[i], made.values[i]);
    }
  }
}

TEST(TemplateRows, StopsWhereAByteIsAnother) {
  std::mt19937 random(4);
  constexpr std::string_view kBytes = " ,[]\n\r\tx-1.e#\x80";
  std::size_t num_changed = 0;
  for (const Gaps& gaps : all_gaps()) {
    for (int round = 0; round < 300; ++round) {
      Text made;
      for (int i = 0; i < 30; ++i) append_row(gaps, random, made);
      const std::size_t place = random() % (made.text.size() / 2);
      const char byte = kBytes[random() % kBytes.size()];
      if (made.text[place] == byte) continue;
      made.text[place] = byte;
      ++num_changed;
      const RowTemplate row = template_of(gaps);
      std::vector<double> values(made.values.size());
      const char* const begin = made.text.data();
      const NumberRows read = read_template_rows(begin, begin + made.text.size(), row,
                                                 made.begins.size(), values.data());
      // Rows before the change are right. The changed one is not read, or has the template's text
      // all the same: then a plain reading of it gives these numbers.
      std::string_view rest(made.text);
      const double* value = values.data();
      for (std::size_t i = 0; i < read.num_rows; ++i) {
        ASSERT_TRUE(rest.starts_with(gaps[0]));
        rest.remove_prefix(gaps[0].size());
        for (std::size_t c = 1; c < gaps.size(); ++c) {
          std::size_t length = 0;
          while (length < rest.size() && !is_separator(rest[length])) ++length;
          const text::Number token = text::parse_number(rest.substr(0, length));
          ASSERT_EQ(token.fault, text::NumberFault::None);
          ASSERT_EQ(*value++, token.value);
          rest.remove_prefix(length);
          ASSERT_TRUE(rest.starts_with(gaps[c]));
          rest.remove_prefix(gaps[c].size());
        }
      }
      ASSERT_EQ(rest.data(), read.next);
    }
  }
  EXPECT_GT(num_changed, 1000u);
}

TEST(TemplateRows, StopsAtTheMostRows) {
  std::mt19937 random(5);
  Text made;
  for (int i = 0; i < 5000; ++i) append_row(all_gaps()[0], random, made);
  const RowTemplate row = template_of(all_gaps()[0]);
  std::vector<double> values(made.values.size());
  for (const std::size_t most : {0u, 1u, 7u, 4000u}) {
    const char* const begin = made.text.data();
    const NumberRows read =
        read_template_rows(begin, begin + made.text.size(), row, most, values.data());
    EXPECT_EQ(read.num_rows, reads_rows() ? most : 0);
    const auto next = static_cast<std::size_t>(read.next - begin);
    EXPECT_EQ(next, reads_rows() ? made.begins[most] : 0);
  }
}

TEST(TemplateRows, ATemplateIsMadeOfARow) {
  const auto row = text::template_of_row("  - [ 1, -2.5e3, [ nan, 4 ] ] # x\n", 3);
  ASSERT_TRUE(row);
  EXPECT_EQ(row->num_columns(), 3u);
  EXPECT_EQ(row->end_places(), (std::vector<std::uint32_t>{1, 2, 4}));  // nan is a word
  EXPECT_EQ(row->num_ends(), 7u);
  EXPECT_FALSE(text::template_of_row("1,2,3\n", 2));
  EXPECT_FALSE(text::template_of_row("", 1));
}

}  // namespace
}  // namespace kinefile::simd
