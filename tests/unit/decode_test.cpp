// SPDX-License-Identifier: MIT
#include "text/decode.hpp"

#include <gtest/gtest.h>

#include "support/support.hpp"

namespace kinefile::text {
namespace {

using namespace std::string_view_literals;

struct Outcome {
  std::string text;
  std::string encoding;
  bool has_bom;
  std::string codes;
};

Outcome decoded(std::string_view bytes, const std::string& encoding = "") {
  Diagnostics diagnostics;
  const auto result = decode(bytes, encoding, "s", diagnostics);
  if (!result) return {"", result.error().code, false, ""};
  std::string codes;
  for (const std::string& code : test::codes_of(diagnostics)) codes += code + " ";
  return {std::string(result->view()), result->encoding, result->has_bom, codes};
}

TEST(Decode, PassesUtf8Through) {
  const std::string_view bytes = "ROOT \xE5\x8F\xB3\n";
  Diagnostics diagnostics;
  const auto result = decode(bytes, "", "s", diagnostics);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->view().data(), bytes.data()) << "it must not be copied";
  EXPECT_EQ(result->encoding, "utf-8");
}

TEST(Decode, DropsByteOrderMarks) {
  EXPECT_EQ(decoded("\xEF\xBB\xBFHI").text, "HI");
  EXPECT_TRUE(decoded("\xEF\xBB\xBFHI").has_bom);
  EXPECT_EQ(decoded("\xFF\xFEH\0I\0"sv).text, "HI");
  EXPECT_EQ(decoded("\xFF\xFEH\0I\0"sv).encoding, "utf-16le");
  EXPECT_EQ(decoded("\xFE\xFF\0H\0I"sv).text, "HI");
}

TEST(Decode, SeesUtf16WithoutAMark) {
  EXPECT_EQ(decoded("H\0I\0E\0"sv).text, "HIE");
  EXPECT_EQ(decoded("\0H\0I\0E"sv).text, "HIE");
}

TEST(Decode, JoinsSurrogatePairs) {
  EXPECT_EQ(decoded("\xFF\xFE\x3D\xD8\x00\xDE"sv).text, "\xF0\x9F\x98\x80");
}

TEST(Decode, TakesOtherBytesForLatin1WithANote) {
  const Outcome outcome = decoded("h\xE9\n");
  EXPECT_EQ(outcome.text, "h\xC3\xA9\n");
  EXPECT_EQ(outcome.encoding, "latin-1");
  EXPECT_EQ(outcome.codes, "TXT002 ");
}

TEST(Decode, ReadsCodePage932OnRequest) {
  // "migi ude" in kanji, the half-width katakana "a", and a character whose second byte is '\'.
  EXPECT_EQ(decoded("\x89\x45\x98\x72 \xB1 \x95\x5C", "cp932").text,
            "\xE5\x8F\xB3\xE8\x85\x95 \xEF\xBD\xB1 \xE8\xA1\xA8");
}

TEST(Decode, ReplacesWhatIsNoCharacterWithAWarning) {
  EXPECT_EQ(decoded("a\x81", "cp932").text, "a\xEF\xBF\xBD");
  EXPECT_EQ(decoded("a\x81", "cp932").codes, "TXT001 ");
  EXPECT_EQ(decoded("a\xFFz", "utf-8").text, "a\xEF\xBF\xBDz");
  EXPECT_EQ(decoded("\xFF\xFE\x00\xD8H\0"sv).codes, "TXT001 ");
  EXPECT_EQ(decoded("\xFF\xFEH\0I"sv).codes, "TXT001 ");
}

TEST(Decode, RefusesOverlongAndSurrogateUtf8) {
  EXPECT_EQ(decoded("\xC0\x80").encoding, "latin-1");
  EXPECT_EQ(decoded("\xE0\x80\x80").encoding, "latin-1");
  EXPECT_EQ(decoded("\xED\xA0\x80").encoding, "latin-1");
  EXPECT_EQ(decoded("\xF4\x90\x80\x80").encoding, "latin-1");
  EXPECT_EQ(decoded("12345678\xE5").encoding, "latin-1") << "cut off at the end";
}

TEST(Decode, RefusesUnknownEncodings) { EXPECT_EQ(decoded("x", "ebcdic").encoding, "TXT003"); }

}  // namespace
}  // namespace kinefile::text
