// SPDX-License-Identifier: MIT
#include "kinefile/diagnostics.hpp"

#include <gtest/gtest.h>

namespace kinefile {
namespace {

Diagnostic warning(std::string code) {
  return {Severity::Warning, {}, std::move(code), "something", {"a.bvh", 3, 5}, "one two", 4};
}

TEST(Diagnostics, FormatsPlaceSeverityCodeAndCaret) {
  EXPECT_EQ(to_string(warning("BVH001")),
            "a.bvh:3:5: warning[BVH001]: something\n"
            "  one two\n"
            "      ^");
}

TEST(Diagnostics, FormatsWithoutAPlace) {
  EXPECT_EQ(to_string(make_error(ErrorKind::Io, "IO001", "cannot read", "a.bvh")),
            "a.bvh: error[IO001]: cannot read");
  EXPECT_EQ(to_string(make_error(ErrorKind::Usage, "CLI001", "no")), "error[CLI001]: no");
}

TEST(Diagnostics, CaretStandsUnderTheCharacterAfterTabsAndWideOnes) {
  Diagnostic item = warning("BVH001");
  item.excerpt = "\t\xE5\x8F\xB3 x";  // a tab and a character two columns wide
  item.caret = 5;
  EXPECT_EQ(to_string(item),
            "a.bvh:3:5: warning[BVH001]: something\n"
            "  \t\xE5\x8F\xB3 x\n"
            "  \t   ^");
}

TEST(Diagnostics, CountsBySeverityAndCode) {
  Diagnostics diagnostics;
  diagnostics.add(warning("BVH001"));
  diagnostics.add(warning("BVH002"));
  diagnostics.add(warning("BVH001"));
  EXPECT_EQ(diagnostics.count(Severity::Warning), 3u);
  EXPECT_EQ(diagnostics.count_of("BVH001", Severity::Warning), 2u);
  EXPECT_EQ(diagnostics.count_of("BVH009", Severity::Warning), 0u);
  EXPECT_FALSE(diagnostics.has_errors());
}

TEST(Diagnostics, StrictMakesWarningsErrors) {
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = true;
  diagnostics.add(warning("BVH001"));
  ASSERT_TRUE(diagnostics.has_errors());
  EXPECT_EQ(diagnostics.first_error().code, "BVH001");
  EXPECT_EQ(diagnostics.first_error().severity, Severity::Error);
}

TEST(Diagnostics, KeepsOnlySoManyOfOneCodeButCountsAll) {
  Diagnostics diagnostics;
  for (std::size_t i = 0; i < Diagnostics::kMaxPerCode + 5; ++i) diagnostics.add(warning("BVH1"));
  diagnostics.add(warning("BVH2"));
  EXPECT_EQ(diagnostics.items().size(), Diagnostics::kMaxPerCode + 1);
  EXPECT_EQ(diagnostics.count_of("BVH1", Severity::Warning), Diagnostics::kMaxPerCode + 5);
}

TEST(Diagnostics, AnErrorIsKeptHoweverManyWarningsOfItsCodeThereAre) {
  Diagnostics diagnostics;
  for (std::size_t i = 0; i < Diagnostics::kMaxPerCode + 5; ++i) diagnostics.add(warning("BVH1"));
  Diagnostic error = warning("BVH1");
  error.severity = Severity::Error;
  diagnostics.add(error);
  ASSERT_TRUE(diagnostics.has_errors());
  EXPECT_EQ(diagnostics.first_error().code, "BVH1");
}

TEST(Diagnostics, AppendsAnotherOnesItemsAndCounts) {
  Diagnostics a;
  Diagnostics b;
  a.add(warning("BVH1"));
  for (std::size_t i = 0; i < Diagnostics::kMaxPerCode + 5; ++i) b.add(warning("BVH1"));
  a.append(std::move(b));
  EXPECT_EQ(a.count(Severity::Warning), Diagnostics::kMaxPerCode + 6);
  EXPECT_EQ(a.items().size(), Diagnostics::kMaxPerCode);
}

TEST(Diagnostics, ShowsNoControlCharactersOfAFile) {
  EXPECT_EQ(to_string(make_error(ErrorKind::Usage, "X", "joint '\x1b[2J'")),
            "error[X]: joint '\\x1b[2J'");
}

TEST(Printable, ShowsWhatControlsATerminal) {
  EXPECT_EQ(printable("a b"), "a b");
  EXPECT_EQ(printable("\xE6\xAD\xA9\xE3\x81\x8F \xC3\xA9 \xF0\x9F\x95\xBA"),
            "\xE6\xAD\xA9\xE3\x81\x8F \xC3\xA9 \xF0\x9F\x95\xBA");
  EXPECT_EQ(printable("\x1b[31m\t\n\x7f"), "\\x1b[31m\\x09\\x0a\\x7f");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\u009b31m");
  EXPECT_EQ(printable("\xE2\x80\xAE"
                      "abc\xE2\x81\xA6\xD8\x9C"),
            "\\u202eabc\\u2066\\u061c");
  EXPECT_EQ(printable("\x9B"
                      "31m\xE3\x81"),
            "\\x9b31m\\xe3\\x81")
      << "bytes that are no UTF-8";
  EXPECT_EQ(printable("\xC0\x9B\xE0\x82\x9B\xF4\x90"), "\\xc0\\x9b\\xe0\\x82\\x9b\\xf4\\x90")
      << "longer than need be, or beyond Unicode";
}

}  // namespace
}  // namespace kinefile
