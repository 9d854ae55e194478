// SPDX-License-Identifier: MIT
// Rows of numbers by vectors, held against the reader that reads byte by byte.
#include "simd/number_rows.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "text/numbers.hpp"

namespace kinefile::simd {
namespace {

struct ReadRows {
  std::size_t num_rows = 0;
  std::size_t next = 0;  ///< the distance from the text's beginning
  std::vector<double> values;
};

ReadRows rows_of(std::string_view text, std::size_t num_columns, std::size_t max_rows = 10'000) {
  ReadRows read;
  max_rows = std::min(max_rows, text.size() / (2 * num_columns) + 1);
  read.values.resize(max_rows * num_columns);
  const NumberRows rows = read_number_rows(text.data(), text.data() + text.size(), num_columns,
                                           max_rows, read.values.data());
  read.num_rows = rows.num_rows;
  read.next = static_cast<std::size_t>(rows.next - text.data());
  read.values.resize(rows.num_rows * num_columns);
  return read;
}

/// The same by the other reader.
ReadRows rows_one_by_one(std::string_view text, std::size_t num_columns) {
  ReadRows read;
  std::vector<double> row(num_columns);
  const char* p = text.data();
  const char* const end = p + text.size();
  while (p != end) {
    const auto line = text::read_number_row(p, end, row.data(), num_columns);
    const bool has_row = line.count == num_columns && line.end == text::RowEnd::EndOfLine;
    if (!has_row || line.next[-1] != '\n') break;
    read.values.insert(read.values.end(), row.begin(), row.end());
    ++read.num_rows;
    p = line.next;
  }
  read.next = static_cast<std::size_t>(p - text.data());
  return read;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b, std::size_t count) {
  return count == 0 || std::memcmp(a.data(), b.data(), count * sizeof(double)) == 0;
}

/// Enough plain lines behind a text that its own do not lie in the last bytes, which are left.
std::string tail(std::size_t num_columns) {
  std::string line;
  for (std::size_t i = 0; i < num_columns; ++i) line += "0 ";
  std::string lines;
  while (lines.size() < 64) lines += line + "\n";
  return lines;
}

/// Rows are those of the other reader, as far as they go; false if vectors are not used here.
void expect_same(const std::string& text, std::size_t num_columns) {
  const ReadRows expected = rows_one_by_one(text, num_columns);
  const ReadRows read = rows_of(text, num_columns);
  ASSERT_LE(read.num_rows, expected.num_rows);
  ASSERT_TRUE(same_bits(read.values, expected.values, read.values.size())) << text;
  const bool reads_none = rows_of("0\n" + tail(1), 1).num_rows == 0;
  if (reads_none) return;  // a machine without vectors
  if (read.next == expected.next) return;
  // What may be left are lines that end in the last 64 bytes, and those that are longer than a
  // piece.
  const std::size_t line_end = text.find('\n', read.next);
  ASSERT_TRUE(text.size() - line_end <= 64 || line_end - read.next > 30'000)
      << read.next << " of " << expected.next << ": " << text.substr(read.next, 200);
}

class Tokens {
 public:
  explicit Tokens(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return random_() % count; }

  /// A number as some program prints it.
  std::string number() {
    const double value = std::ldexp(std::uniform_real_distribution<>(-1, 1)(random_),
                                    static_cast<int>(below(30)) - 10);
    switch (below(9)) {
      case 0:
        return fmt::format("{:.6f}", value);
      case 1:
        return fmt::format("{:.2f}", value);
      case 2:
        return fmt::format("{:g}", value);
      case 3:
        return fmt::format("{}", static_cast<float>(value));
      case 4:
        return fmt::format("{}", value);
      case 5:
        return fmt::format("{}", static_cast<int>(value));
      case 6:
        return fmt::format("{:e}", value);
      case 7:
        return digits(1 + below(40));
      default:
        return fmt::format("{:.17g}", value);
    }
  }

  /// Digits with a sign and a point somewhere, or without.
  std::string digits(std::size_t count) {
    std::string token = below(2) == 0 ? "-" : "";
    const std::size_t point = below(count + 4);
    for (std::size_t i = 0; i < count; ++i) {
      if (i == point) token += '.';
      token += static_cast<char>('0' + below(10));
    }
    return token + (point == count ? "." : "");
  }

  std::string blanks() { return below(20) == 0 ? std::string(1 + below(3), " \t"[below(2)]) : " "; }

  /// Lines of a number of columns.
  std::string lines(std::size_t num_rows, std::size_t num_columns) {
    const std::string line_end = below(2) == 0 ? "\n" : "\r\n";
    std::string text;
    for (std::size_t row = 0; row < num_rows; ++row) {
      if (below(10) == 0) text += blanks();
      for (std::size_t column = 0; column < num_columns; ++column) {
        if (column > 0) text += blanks();
        text += number();
      }
      text += (below(10) == 0 ? blanks() : "") + line_end;
    }
    return text;
  }

 private:
  std::mt19937 random_;
};

TEST(ReadNumberRows, ReadsEveryNotationToTheLastBit) {
  Tokens tokens(1);
  for (std::size_t i = 0; i < 200; ++i) {
    const std::size_t num_columns = 1 + tokens.below(100);
    expect_same(tokens.lines(1 + tokens.below(200), num_columns), num_columns);
  }
}

TEST(ReadNumberRows, ReadsTokensOfEachLength) {
  Tokens tokens(2);
  for (std::size_t length = 1; length <= 45; ++length) {
    for (std::size_t round = 0; round < 200; ++round) {
      std::string line;
      for (std::size_t i = 0; i < 5; ++i) line += tokens.digits(length) + " ";
      expect_same(line + "\n" + tail(5), 5);
    }
  }
}

TEST(ReadNumberRows, ReadsNumbersBesideTheMiddleOfTwoDoubles) {
  for (const char* token :
       {"9007199254740993", "9007199254740993.0", "9007199254740992.999", "0.500000000000000166",
        "0.50000000000000016653345369377348106354475021362304687500001", "1.7976931348623157e308",
        "4.9406564584124654e-324", "2.4703282292062328e-324", "0.000000000000000000000000000001",
        "123456789012345", "1234567890123456", "12345678901234567890", "999999999999999", "-0",
        "-0.0", "0000000000000000000001.5", "1.000000000000000000000000000000000000001"}) {
    expect_same(std::string(token) + " 1 2 3\n" + tail(4), 4);
    expect_same("1 2 3 " + std::string(token) + "\n" + tail(4), 4);
  }
}

/// Rows of four, in which a token stands among long ones, behind the text's first bytes.
std::string among_long_tokens(const std::string& token) {
  std::string text = "0.12345678901234567 -1.2345678901234567 12.345678901234567 0\n";
  for (std::size_t at = 0; at < 4; ++at) {
    for (std::size_t i = 0; i < 4; ++i) {
      text += i == at ? token : i % 2 == 0 ? "-0.1234567890123456" : "98765432109876543";
      text += i == 3 ? "\n" : " ";
    }
  }
  return text + tail(4);
}

TEST(ReadNumberRows, ReadsAnyTokenAmongLongOnes) {
  Tokens tokens(5);
  for (const char* token :
       {"0", "-0", "-0.0", "5.", "-.5", "0.0000000000000000000001", "0.00000000000000000000001",
        "9999999999999999999", "-9999999999999999999", "10000000000000000000", "+1.5", "1e-7",
        "0.9999999999999999999", "999999999.9999999999", "00000000000000000000000000000001",
        "000000000000000000000000000000001", "0.0000000000001234567890123456789",
        "18014398509481987", "1844674407370955161"}) {
    expect_same(among_long_tokens(token), 4);
  }
  for (const char* odd : {".", "-", "-.", "1.2.3", "1234567890.12345678.9", "12345678901234567-",
                          "1234567890123456:", "0x123456789012345678", "nan"}) {
    expect_same(among_long_tokens(odd), 4);
    EXPECT_EQ(rows_of(among_long_tokens(odd), 4).num_rows,
              rows_of(among_long_tokens("1"), 4).num_rows == 0 ? 0 : 1)
        << odd;
  }
  for (int round = 0; round < 3000; ++round) {
    expect_same(among_long_tokens(tokens.digits(1 + tokens.below(24))), 4);
  }
}

/// Numbers of up to 19 digits halfway between two doubles, the next ones, and their hundredths.
TEST(ReadNumberRows, RoundsLongTokensBesideTheMiddleOfTwoDoubles) {
  std::mt19937_64 random(6);
  for (int round = 0; round < 3000; ++round) {
    const int shift = 1 + static_cast<int>(random() % 10);
    const std::uint64_t middle =
        ((std::uint64_t{1} << 53 | (random() >> 11)) << shift) + (std::uint64_t{1} << (shift - 1));
    for (const std::uint64_t number : {middle - 1, middle, middle + 1}) {
      std::string digits = fmt::format("{}", number);
      expect_same(among_long_tokens(digits), 4);
      digits.insert(digits.size() - random() % digits.size(), ".");
      expect_same(among_long_tokens(digits), 4);
    }
  }
}

/// The text before the piece that is read is no longer than it is.
TEST(ReadNumberRows, ReadsAPieceThatBeginsCloseToTheText) {
  for (const std::size_t length : {200u, 40'000u}) {
    const std::string text = "1 2\n5 " + std::string(length, '0') + "7\n" + tail(2);
    const std::vector<char> alone(text.begin(), text.end());
    expect_same(std::string(alone.begin(), alone.end()), 2);
  }
}

TEST(ReadNumberRows, StopsAtWhatIsNoPlainRow) {
  for (const char* odd : {"nan",
                          "-nan",
                          "inf",
                          "infinity",
                          "1e400",
                          "1,5",
                          "1_0",
                          "0x10",
                          "1.2.3",
                          "--1",
                          "+-1",
                          "-",
                          ".",
                          "-.",
                          "+",
                          "e5",
                          "1e",
                          "1a",
                          "a",
                          "1-",
                          "\xc2\xa0"
                          "1",
                          "1\x0b"
                          "2",
                          "1;",
                          "#1",
                          "\x01",
                          "\x7f",
                          "1\x80"}) {
    for (std::size_t at = 0; at < 6; ++at) {
      for (const std::size_t before : {0u, 1u, 3u, 200u}) {
        std::string text;
        for (std::size_t i = 0; i < before; ++i) text += "1.5 -2 3 4.25 5 6\n";
        const std::size_t line = text.size();
        for (std::size_t i = 0; i < 6; ++i) text += (i == at ? odd : "7.5") + std::string(" ");
        text += "\n" + tail(6);
        const ReadRows read = rows_of(text, 6);
        EXPECT_LE(read.num_rows, before) << odd;
        EXPECT_LE(read.next, line) << odd;
      }
    }
  }
}

TEST(ReadNumberRows, StopsAtLinesOfAnotherLength) {
  for (const char* line : {"1 2\n", "1 2 3 4\n", "\n", "  \n", "1 2 3\r1 2 3\n", "\r\n"}) {
    const std::string before = "1 2 3\n4 5 6\n";
    const ReadRows read = rows_of(before + line + tail(3), 3);
    EXPECT_LE(read.num_rows, 2u) << line;
    EXPECT_LE(read.next, before.size()) << line;
  }
}

TEST(ReadNumberRows, ReadsRowsThatEndJustBeforeAnOddLine) {
  for (std::size_t num_columns = 1; num_columns < 12; ++num_columns) {
    for (std::size_t num_rows = 1; num_rows < 70; ++num_rows) {
      Tokens tokens(static_cast<unsigned>(num_rows));
      const std::string rows = tokens.lines(num_rows, num_columns);
      for (const std::string odd : {"\n", "x\n", "\r\n", " 1 2 3 4 5 6 7 8 9 10 11 12 13\n"}) {
        expect_same(rows + odd + tail(num_columns), num_columns);
      }
    }
  }
}

TEST(ReadNumberRows, StopsAtTheMostRows) {
  const std::string text = tail(4) + tail(4);
  EXPECT_LE(rows_of(text, 4, 3).num_rows, 3u);
  EXPECT_EQ(rows_of(text, 4, 0).num_rows, 0u);
  EXPECT_EQ(rows_of("", 4).num_rows, 0u);
}

TEST(ReadNumberRows, ReadsNothingOutsideOfTheText) {
  Tokens tokens(3);
  for (std::size_t shift = 0; shift < 70; ++shift) {
    const std::string text = std::string(shift, '0') + tokens.lines(8, 9);
    // Memory of just this size, so that the address sanitizer sees what is read around it.
    const std::vector<char> exact(text.begin(), text.end());
    const ReadRows expected = rows_one_by_one(text, 9);
    const ReadRows read = rows_of({exact.data(), exact.size()}, 9);
    ASSERT_LE(read.num_rows, expected.num_rows);
    ASSERT_TRUE(same_bits(read.values, expected.values, read.values.size()));
  }
}

TEST(ReadNumberRows, ReadsRowsLongerThanAPieceOrNone) {
  Tokens tokens(4);
  for (const std::size_t num_columns : {500u, 3000u, 6000u}) {
    expect_same(tokens.lines(3, num_columns), num_columns);
  }
}

/// Rows between commas, by the reader of rows.
ReadRows comma_rows_of(const std::string& text, std::size_t num_columns) {
  ReadRows read;
  std::vector<const char*> starts(text.size() + 1);
  read.values.resize((text.size() / (2 * num_columns) + 1) * num_columns);
  const NumberRows rows = read_number_rows(text.data(), text.data() + text.size(), num_columns,
                                           text.size() / (2 * num_columns) + 1, read.values.data(),
                                           starts.data(), Separator::Comma);
  read.num_rows = rows.num_rows;
  read.next = static_cast<std::size_t>(rows.next - text.data());
  read.values.resize(rows.num_rows * num_columns);
  return read;
}

std::string with_commas(std::string text) {
  std::replace(text.begin(), text.end(), ' ', ',');
  return text;
}

TEST(ReadCommaRows, AreThoseWithABlankForEachComma) {
  Tokens tokens(9);
  for (int round = 0; round < 200; ++round) {
    const std::size_t num_columns = 1 + tokens.below(60);
    const std::string line_end = round % 2 == 0 ? "\n" : "\r\n";
    std::string text;
    for (std::size_t row = 0; row < 1 + tokens.below(100); ++row) {
      for (std::size_t c = 0; c < num_columns; ++c) text += (c == 0 ? "" : " ") + tokens.number();
      text += line_end;
    }
    const ReadRows blanks = rows_of(text, num_columns);
    const ReadRows commas = comma_rows_of(with_commas(text), num_columns);
    ASSERT_EQ(commas.num_rows, blanks.num_rows);
    ASSERT_EQ(commas.next, blanks.next);
    ASSERT_TRUE(same_bits(commas.values, blanks.values, blanks.values.size()));
  }
}

TEST(ReadCommaRows, StopAtWhatHasMoreThanOneCommaBetweenNumbers) {
  std::string rest;
  for (int i = 0; i < 40; ++i) rest += "1,2,3\n";
  const std::size_t most = comma_rows_of("4,5,6\n" + rest, 3).num_rows;
  for (const char* odd :
       {"4,,5,6", ",4,5,6", "4,5,6,", "4, 5,6", "4 ,5,6", "4 5,6,7", "4,5", "", "4,5,6,7",
        "\"4\",5,6", "4;5;6", "4,5,x", "4,nan,5", "4\r,5,6", "\t4,5,6", "4,\r,6"}) {
    const ReadRows read = comma_rows_of("4,5,6\n" + std::string(odd) + "\n" + rest, 3);
    EXPECT_LE(read.num_rows, 1u) << odd;
  }
  // A byte of zeros separates nothing, wherever it stands.
  EXPECT_EQ(comma_rows_of(std::string("4,5,6\n4\0"
                                      "5,6\n",
                                      12) +
                              rest,
                          3)
                .num_rows,
            std::min<std::size_t>(most, 1));
}

}  // namespace
}  // namespace kinefile::simd
