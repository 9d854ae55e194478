// SPDX-License-Identifier: MIT

#include "text/encode.hpp"

#include <gtest/gtest.h>

#include "text/decode.hpp"

namespace kinefile::text {
namespace {

std::string encoded(std::string_view text, std::string_view encoding) {
  std::string bytes;
  EXPECT_EQ(append_encoded(bytes, text, encoding), "");
  return bytes;
}

TEST(Encode, KnownCharactersHaveTheirBytes) {
  EXPECT_EQ(encoded("Aあ", "utf-16le"), std::string("A\0\x42\x30", 4));
  EXPECT_EQ(encoded("Aあ", "utf-16be"), std::string("\0A\x30\x42", 4));
  EXPECT_EQ(encoded("\U0001F600", "utf-16le"), std::string("\x3D\xD8\x00\xDE", 4));
  EXPECT_EQ(encoded("Aソ声ｱ", "cp932"), "A\x83\x5C\x90\xBA\xB1");
  EXPECT_EQ(encoded("é", "latin-1"), "\xE9");
  EXPECT_EQ(encoded("é", "utf-8"), "é");
}

TEST(Encode, OfEqualCharactersWindowsCodeIsWritten) {
  EXPECT_EQ(encoded("≒", "cp932"), "\x81\xE0");   // 8790, too
  EXPECT_EQ(encoded("Ⅰ", "cp932"), "\x87\x54");   // FA4A, too
  EXPECT_EQ(encoded("ⅰ", "cp932"), "\xFA\x40");   // EEEF, too
  EXPECT_EQ(encoded("纊", "cp932"), "\xFA\x5C");  // ED40, too
  EXPECT_EQ(encoded("￢", "cp932"), "\x81\xCA");  // EEF9 and FA54, too
}

TEST(Encode, ACharacterThatTheEncodingLacksIsTold) {
  std::string bytes;
  EXPECT_EQ(append_encoded(bytes, "aéb", "cp932"), "é");
  EXPECT_EQ(bytes, "a");
  EXPECT_EQ(append_encoded(bytes, "あ", "latin-1"), "あ");
}

TEST(Encode, EveryPairOfCp932IsReadAgain) {
  for (int lead = 0x81; lead <= 0xFC; ++lead) {
    for (int trail = 0x40; trail <= 0xFC; ++trail) {
      const std::string pair = {static_cast<char>(lead), static_cast<char>(trail)};
      Diagnostics diagnostics;
      const auto decoded = decode(pair, "cp932", "t", diagnostics);
      if (!decoded || !diagnostics.items().empty()) continue;
      const std::string text(decoded->view());
      const std::string bytes = encoded(text, "cp932");
      EXPECT_EQ(decode(bytes, "cp932", "t", diagnostics)->view(), text);
    }
  }
}

}  // namespace
}  // namespace kinefile::text
