// SPDX-License-Identifier: MIT
#include "text/source.hpp"

#include <gtest/gtest.h>

namespace kinefile::text {
namespace {

Place place_in(std::string_view text, std::size_t offset) {
  return Source("s", text).place_of(text.data() + offset);
}

TEST(Source, CountsLinesAndColumnsFromOne) {
  const std::string_view text = "ab\ncd\n";
  EXPECT_EQ(place_in(text, 0).line, 1u);
  EXPECT_EQ(place_in(text, 0).column, 1u);
  EXPECT_EQ(place_in(text, 4).line, 2u);
  EXPECT_EQ(place_in(text, 4).column, 2u);
}

TEST(Source, TheEndIsAPlace) {
  EXPECT_EQ(place_in("ab\n", 3).line, 2u);
  EXPECT_EQ(place_in("ab\n", 3).column, 1u);
  EXPECT_EQ(place_in("", 0).line, 1u);
  EXPECT_EQ(place_in("", 0).column, 1u);
}

TEST(Source, KnowsEveryLineEnd) {
  EXPECT_EQ(place_in("a\r\nb", 3).line, 2u);
  EXPECT_EQ(place_in("a\rb", 2).line, 2u);
  EXPECT_EQ(place_in("a\r\rb", 3).line, 3u);
  EXPECT_EQ(place_in("a\n\r\nb", 4).line, 3u);
}

TEST(Source, CutsLongLinesAroundThePlace) {
  const std::string text = std::string(300, 'x') + "!" + std::string(300, 'y') + "\n";
  const Source source("s", text);
  const Diagnostic item = source.diagnose(Severity::Error, "C", "m", text.data() + 300);
  EXPECT_EQ(item.place.column, 301u);
  EXPECT_EQ(item.excerpt[item.caret], '!');
  EXPECT_EQ(item.excerpt.size(), 106u);
  EXPECT_TRUE(item.excerpt.starts_with("...x"));
  EXPECT_TRUE(item.excerpt.ends_with("y..."));
}

TEST(Source, DoesNotCutThroughACharacter) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "\xE5\x8F\xB3";
  const Source source("s", text);
  for (std::size_t offset = 0; offset < text.size(); offset += 3) {
    const Diagnostic item = source.diagnose(Severity::Error, "C", "m", text.data() + offset);
    std::string_view shown = item.excerpt;
    if (shown.starts_with("...")) shown.remove_prefix(3);
    if (shown.ends_with("...")) shown.remove_suffix(3);
    EXPECT_EQ(shown.size() % 3, 0u);
    EXPECT_EQ(shown.substr(0, 3), "\xE5\x8F\xB3");
    EXPECT_EQ(item.excerpt.substr(item.caret, 3), "\xE5\x8F\xB3");
  }
}

TEST(Source, ShowsNoControlCharacters) {
  const std::string_view text("a\x01\x1b[2J\0b", 8);
  const Diagnostic item = Source("s", text).diagnose(Severity::Error, "C", "m", text.data());
  EXPECT_EQ(item.excerpt, "a??[2J?b");
}

TEST(Quoted, NamesTheEndAndEscapesAndCuts) {
  EXPECT_EQ(quoted(""), "the end of the file");
  EXPECT_EQ(quoted("abc"), "'abc'");
  EXPECT_EQ(quoted(std::string_view("a\x1b\0", 3)), "'a\\x1b\\x00'");
  EXPECT_EQ(text::quoted(std::string(50, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace kinefile::text
