// SPDX-License-Identifier: MIT
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace kinefile::text {
namespace {

std::uint64_t bits(double value) {
  std::uint64_t pattern = 0;
  std::memcpy(&pattern, &value, sizeof pattern);
  return pattern;
}

/// Reads one row; numbers that are followed by 40 blanks take the fast path.
std::vector<double> row_of(const std::string& text) {
  std::vector<double> out(64);
  const NumberRow row =
      read_number_row(text.data(), text.data() + text.size(), out.data(), out.size());
  EXPECT_EQ(row.end, RowEnd::EndOfLine) << text;
  out.resize(row.count);
  return out;
}

void expect_exact(const std::string& token) {
  const double expected = std::strtod(token.c_str(), nullptr);
  const Number number = parse_number(token);
  EXPECT_EQ(number.fault, NumberFault::None) << token;
  EXPECT_EQ(bits(number.value), bits(expected)) << token;
  for (const std::string& padding : {std::string(), std::string(40, ' ')}) {
    const auto row = row_of(token + padding);
    ASSERT_EQ(row.size(), 1u) << token;
    EXPECT_EQ(bits(row[0]), bits(expected)) << token;
  }
}

TEST(ParseNumber, ReadsEveryPlainNotationToTheLastBit) {
  for (const char* token : {"0",
                            "-0",
                            "1",
                            "-1.5",
                            "+1.",
                            ".5",
                            "-.25",
                            "1e3",
                            "1E-3",
                            "8.8e+01",
                            "0.1",
                            "0.0333333",
                            "123456789012345",
                            "1234567890123456",
                            "12345678901234567890",
                            "0.000000000000000000001",
                            "9007199254740993",
                            "1.7976931348623157e308",
                            "4.9e-324",
                            "2.2250738585072011e-308",
                            "0.30000000000000004",
                            "-164.3500000000000000000000000001",
                            "1e-400",
                            "00012.50"}) {
    expect_exact(token);
  }
}

TEST(ParseNumber, ReadsRandomNumbersAsTheLibraryDoes) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    double value = 0;
    const std::uint64_t pattern = random();
    std::memcpy(&value, &pattern, sizeof value);
    if (std::isfinite(value)) expect_exact(fmt::format("{}", value));
    const double angle = std::ldexp(static_cast<double>(static_cast<std::int64_t>(pattern)), -53);
    expect_exact(fmt::format("{:.{}f}", angle, static_cast<int>(pattern % 18)));
  }
}

TEST(ReadNumberList, NumbersOfManyDigitsAreWhatTheLibraryMakesOfThem) {
  // Long and short ones take turns, so that every way through is taken after every other.
  std::mt19937_64 random(7);
  std::string text;
  std::vector<double> expected;
  for (int i = 0; i < 200'000; ++i) {
    const int num_digits = static_cast<int>(random() % 22) + 1;
    std::string digits;
    for (int k = 0; k < num_digits; ++k) digits += static_cast<char>('0' + random() % 10);
    const std::size_t point = random() % (digits.size() + 1);
    digits.insert(point, digits.size() == point ? "" : ".");
    if (digits == "." || digits.empty()) digits = "0";
    const std::string number = (random() % 2 == 0 ? "-" : "") + digits;
    expected.push_back(std::strtod(number.c_str(), nullptr));
    text += (i > 0 ? ", " : "") + number;
  }
  text += " ]";
  Array<double> found;
  const NumberList list = read_number_list(text.data(), text.data() + text.size(), found);
  EXPECT_EQ(list.count, expected.size());
  EXPECT_EQ(*list.next, ']');
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(bits(found[i]), bits(expected[i])) << "number " << i;
  }
}

TEST(ReadNumberList, TellsOfLineEndsAndCommas) {
  Array<double> out;
  const std::string text = "1, 2,\r\n 3 , ]";
  const NumberList list = read_number_list(text.data(), text.data() + text.size(), out);
  EXPECT_EQ(list.count, 3u);
  EXPECT_TRUE(list.has_break);
  EXPECT_TRUE(list.ends_with_comma);
  EXPECT_EQ(*list.next, ']');
}

TEST(ParseNumber, RefusesWhatIsNotAllANumber) {
  for (const char* token : {"", "abc", "1x", "1.2.3", "--1", "+-1", "++1", "1e", "e5", ".", "-",
                            "0x10", "1_000", "1,2,3", "nan(5)", "infinite", "1.0,5"}) {
    EXPECT_EQ(parse_number(token).fault, NumberFault::NotANumber) << token;
  }
}

TEST(ParseNumber, ReadsWhatIsNotFiniteInEverySpelling) {
  for (const char* token :
       {"nan", "NaN", "-nan", "+NAN", "1.#IND", "-1.#IND00", "1.#QNAN0", "-nan(ind)"}) {
    EXPECT_TRUE(std::isnan(parse_number(token).value)) << token;
  }
  EXPECT_EQ(parse_number("inf").value, INFINITY);
  EXPECT_EQ(parse_number("-Infinity").value, -INFINITY);
  EXPECT_EQ(parse_number("1.#INF").value, INFINITY);
  EXPECT_EQ(parse_number("-1.#INF00").value, -INFINITY);
}

TEST(ParseNumber, TellsTooLargeAndCommas) {
  EXPECT_EQ(parse_number("1e400").fault, NumberFault::OutOfRange);
  EXPECT_EQ(parse_number("-1e309").fault, NumberFault::OutOfRange);
  EXPECT_EQ(parse_number("0,0333").fault, NumberFault::DecimalComma);
  EXPECT_EQ(parse_number("0,0333").value, 0.0333);
}

TEST(ParseCount, TakesDigitsAlone) {
  EXPECT_EQ(parse_count("0"), 0u);
  EXPECT_EQ(parse_count("1000000000"), 1'000'000'000u);
  for (const char* token :
       {"", "-1", "+1", "1.0", "1e3", "99999999999999999999", "9223372036854775808", "0x1", " 1"}) {
    EXPECT_FALSE(parse_count(token)) << token;
  }
}

TEST(ReadNumberRow, StopsAtTheEndOfTheLine) {
  const std::string text = "  1 2\t3  \r\n4";
  std::vector<double> out(8);
  const NumberRow row = read_number_row(text.data(), text.data() + text.size(), out.data(), 8);
  EXPECT_EQ(row.count, 3u);
  EXPECT_EQ(row.end, RowEnd::EndOfLine);
  EXPECT_EQ(*row.next, '4');
}

TEST(ReadNumberRow, ReadsNoMoreThanThereIsRoomFor) {
  const std::string text = "1 2 3\n";
  double out[2] = {};
  const NumberRow row = read_number_row(text.data(), text.data() + text.size(), out, 2);
  EXPECT_EQ(row.count, 2u);
  EXPECT_EQ(row.end, RowEnd::Full);
  EXPECT_EQ(*row.next, '3');
}

TEST(ReadNumberRow, LeavesOddTokensToTheCaller) {
  for (const char* token : {"abc", "nan", "inf", "1e400", "1.5x", "0,5", "-", "1.#IND"}) {
    for (const std::string& padding : {std::string(), std::string(40, ' ')}) {
      const std::string text = std::string("1 ") + token + " 2" + padding;
      double out[4] = {};
      const NumberRow row = read_number_row(text.data(), text.data() + text.size(), out, 4);
      EXPECT_EQ(row.end, RowEnd::BadToken) << token;
      EXPECT_EQ(row.count, 1u) << token;
      EXPECT_EQ(row.next - text.data(), 2) << token;
    }
  }
}

TEST(ReadNumberRow, ReadsNothingBeyondTheText) {
  // Exact-size heap buffers, so that the address sanitizer sees a byte too many.
  for (const std::string text :
       {"1", "-1.5", "12.", "-", "", " ", "1.5e", "\r", "-123456789012345.123456789012345",
        "-123456789012345.1234567890123456", "-123456789012345.12345678901234567",
        "1234567890123456789012345678901234567890", "-.1234567890123456789012345678901"}) {
    const std::vector<char> exact(text.begin(), text.end());
    double out[4] = {};
    const NumberRow row = read_number_row(exact.data(), exact.data() + exact.size(), out, 4);
    EXPECT_LE(row.next, exact.data() + exact.size());
  }
}

}  // namespace
}  // namespace kinefile::text
