// SPDX-License-Identifier: MIT
#include "simd/crc32.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace kinefile::simd {
namespace {

/// As ISO 3309 defines it, bit by bit.
std::uint32_t crc32_bit_by_bit(std::string_view bytes) {
  std::uint32_t state = 0xFFFFFFFF;
  for (const char byte : bytes) {
    state ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) state = (state >> 1) ^ ((state & 1) != 0 ? 0xEDB88320u : 0);
  }
  return ~state;
}

std::string random_bytes(std::size_t size) {
  std::mt19937 random(3);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

TEST(Crc32, HasTheKnownValues) {
  EXPECT_EQ(crc32(0, ""), 0u);
  EXPECT_EQ(crc32(0, "123456789"), 0xCBF43926u);
  EXPECT_EQ(crc32(0, std::string(32, '\0')), 0x190A55ADu);
}

TEST(Crc32, IsExactForEveryLengthAndAlignment) {
  const std::string bytes = random_bytes(700);
  for (std::size_t begin = 0; begin < 17; ++begin) {
    for (std::size_t size = 0; size + begin <= bytes.size(); ++size) {
      const auto part = std::string_view(bytes).substr(begin, size);
      ASSERT_EQ(crc32(0, part), crc32_bit_by_bit(part)) << begin << " " << size;
    }
  }
}

TEST(Crc32, PiecesGiveThatOfTheWhole) {
  const std::string bytes = random_bytes(100'000);
  const std::uint32_t whole = crc32_bit_by_bit(bytes);
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    std::uint32_t crc = 0;
    for (std::string_view rest = bytes; !rest.empty();) {
      const std::size_t size = std::min<std::size_t>(random() % 20'000, rest.size());
      crc = crc32(crc, rest.substr(0, size));
      rest.remove_prefix(size);
    }
    ASSERT_EQ(crc, whole);
  }
}

}  // namespace
}  // namespace kinefile::simd
