// SPDX-License-Identifier: MIT
#include "text/printer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "support/threads.hpp"

namespace kinefile::text {
namespace {

std::string printed(double number, std::optional<int> decimals = std::nullopt) {
  std::string text;
  const std::function<bool(std::string_view)> sink = [&text](std::string_view piece) {
    text += piece;
    return true;
  };
  Printer printer(sink, {.decimals = decimals});
  printer.print(number);
  EXPECT_TRUE(printer.finish());
  return text;
}

TEST(Printer, PrintsTheShortestExactForm) {
  EXPECT_EQ(printed(35), "35");
  EXPECT_EQ(printed(0.1), "0.1");
  EXPECT_EQ(printed(-0.0), "-0");
  EXPECT_EQ(printed(0.0333333), "0.0333333");
  EXPECT_EQ(printed(1e-7), "1e-07");
  EXPECT_EQ(printed(NAN), "nan");
  EXPECT_EQ(printed(-NAN), "nan");
  EXPECT_EQ(printed(-INFINITY), "-inf");
}

TEST(Printer, PrintsWhatReadsBackAsTheSameBits) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20'000; ++i) {
    double value = 0;
    const std::uint64_t pattern = random();
    std::memcpy(&value, &pattern, sizeof value);
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(std::strtod(printed(value).c_str(), nullptr), value);
  }
}

TEST(Printer, PutsAPointIntoEveryExponent) {
  std::string text;
  const std::function<bool(std::string_view)> sink = [&text](std::string_view piece) {
    text += piece;
    return true;
  };
  Printer printer(sink, {.points_exponents = true});
  for (int i = 0; i < 120'000; ++i) {
    printer.print(1e-5);
    printer.print(' ');
  }
  EXPECT_TRUE(printer.finish());
  std::size_t num_pointed = 0;
  for (std::size_t at = text.find("1.0e-05 "); at != std::string::npos;
       at = text.find("1.0e-05 ", at + 1)) {
    ++num_pointed;
  }
  EXPECT_EQ(num_pointed, 120'000u);
}

TEST(Printer, PrintsSoManyDecimals) {
  EXPECT_EQ(printed(1.0 / 3, 4), "0.3333");
  EXPECT_EQ(printed(2, 2), "2.00");
  EXPECT_EQ(printed(-1.5, 0), "-2");
}

TEST(Printer, PrintsRowsOfEachLength) {
  for (const std::size_t count : {0u, 1u, 2u, 1023u, 1024u, 1025u, 5000u}) {
    const std::vector<double> numbers(count, 0.5);
    std::string text;
    const std::function<bool(std::string_view)> sink = [&text](std::string_view piece) {
      text += piece;
      return true;
    };
    Printer printer(sink);
    printer.print_row(numbers, ", ");
    printer.continue_row(numbers, " ");
    EXPECT_TRUE(printer.finish());
    std::string expected;
    for (std::size_t i = 0; i < count; ++i) expected += i == 0 ? "0.5" : ", 0.5";
    for (std::size_t i = 0; i < count; ++i) expected += " 0.5";
    EXPECT_EQ(text, expected);
  }
}

TEST(Printer, StopsWhenTheSinkDoes) {
  int num_pieces = 0;
  const std::function<bool(std::string_view)> sink = [&num_pieces](std::string_view) {
    ++num_pieces;
    return false;
  };
  Printer printer(sink);
  for (int i = 0; i < 10; ++i) printer.print(std::string(100'000, 'x'));
  EXPECT_FALSE(printer.finish());
  EXPECT_EQ(num_pieces, 1);
}

TEST(CsvField, QuotesAsRfc4180Says) {
  EXPECT_EQ(csv_field("Hips"), "Hips");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("a\"b"), "\"a\"\"b\"");
  EXPECT_EQ(csv_field("a b"), "a b");
}

TEST(JsonString, EscapesWhatJsonEscapes) {
  EXPECT_EQ(json_string("a\"\\\n"), "\"a\\\"\\\\\\u000a\"");
  EXPECT_EQ(json_string("\xE5\x8F\xB3"), "\"\xE5\x8F\xB3\"");
}

std::string many_rows_printed(std::size_t num_rows) {
  std::string text;
  const std::function<bool(std::string_view)> sink = [&text](std::string_view piece) {
    text += piece;
    return true;
  };
  Printer printer(sink, {.decimals = 2});
  printer.print("before\n");
  printer.print_rows(num_rows, 3, [](Printer& part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto number = static_cast<double>(i);
      part.print_row(std::array{number, -number / 3, 1e-3 * number}, " ");
      part.print('\n');
    }
  });
  printer.print("behind\n");
  EXPECT_TRUE(printer.finish());
  return text;
}

TEST(Printer, RowsAreTheSameWithAnyNumberOfThreads) {
  for (const std::size_t num_rows : {0u, 1u, 50'000u}) {
    std::string expected;
    for (const std::size_t threads : test::kThreadCounts) {
      const test::Threads some(threads);
      const std::string text = many_rows_printed(num_rows);
      if (expected.empty()) expected = text;
      EXPECT_TRUE(text == expected);
    }
    const auto num_lines = std::count(expected.begin(), expected.end(), '\n');
    EXPECT_EQ(static_cast<std::size_t>(num_lines), num_rows + 2);
  }
}

TEST(Printer, RowsEndWhereTheSinkDoes) {
  const test::Threads some(7);
  int num_pieces = 0;
  const std::function<bool(std::string_view)> sink = [&num_pieces](std::string_view) {
    return ++num_pieces < 3;
  };
  Printer printer(sink);
  printer.print_rows(1'000'000, 1, [](Printer& part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) part.print("1\n");
  });
  EXPECT_FALSE(printer.is_good());
  EXPECT_FALSE(printer.finish());
  EXPECT_EQ(num_pieces, 3);
}

}  // namespace
}  // namespace kinefile::text
