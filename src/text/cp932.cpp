// SPDX-License-Identifier: MIT
#include "text/cp932.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace kinefile::text {
namespace {

constexpr char32_t kNone = 0xFFFD;
constexpr std::uint8_t kFirstTrail = 0x40;
constexpr std::uint8_t kLastTrail = 0xFC;

/// The rows of the two-byte part of code page 932, by lead byte 81..9F, E0..FC.
constexpr const char16_t* kCp932[] = {
#include "text/cp932_table.inc"
};

using CodeOf = std::pair<char32_t, std::uint16_t>;

/// Whether a code is one of NEC's copies of IBM's characters, which Windows reads and never writes.
bool is_copy(std::uint16_t code) { return (code >> 8) == 0xED || (code >> 8) == 0xEE; }

/// Every two-byte character with the code that Windows writes, by character.
std::vector<CodeOf> codes_by_character() {
  std::vector<CodeOf> codes;
  for (std::size_t row = 0; row < std::size(kCp932); ++row) {
    const std::size_t lead = row <= 0x9F - 0x81 ? row + 0x81 : row - 0x1F + 0xE0;
    for (std::size_t trail = kFirstTrail; trail <= kLastTrail; ++trail) {
      const char32_t character = kCp932[row][trail - kFirstTrail];
      if (character != kNone) {
        codes.emplace_back(character, static_cast<std::uint16_t>((lead << 8) | trail));
      }
    }
  }
  std::sort(codes.begin(), codes.end(), [](const CodeOf& a, const CodeOf& b) {
    if (a.first != b.first) return a.first < b.first;
    if (is_copy(a.second) != is_copy(b.second)) return is_copy(b.second);
    return a.second < b.second;
  });
  codes.erase(std::unique(codes.begin(), codes.end(),
                          [](const CodeOf& a, const CodeOf& b) { return a.first == b.first; }),
              codes.end());
  return codes;
}

}  // namespace

std::optional<char32_t> cp932_character(std::uint8_t lead, std::uint8_t trail) {
  const bool is_lead = (lead >= 0x81 && lead <= 0x9F) || (lead >= 0xE0 && lead <= 0xFC);
  if (!is_lead || trail < kFirstTrail || trail > kLastTrail) return std::nullopt;
  const char32_t c = kCp932[lead <= 0x9F ? lead - 0x81 : lead - 0xE0 + 0x1F][trail - kFirstTrail];
  return c == kNone ? std::nullopt : std::optional(c);
}

std::optional<std::uint16_t> cp932_code(char32_t character) {
  if (character < 0x80) return static_cast<std::uint16_t>(character);
  if (character >= 0xFF61 && character <= 0xFF9F) {  // half-width katakana
    return static_cast<std::uint16_t>(character - 0xFF61 + 0xA1);
  }
  static const std::vector<CodeOf> kCodes = codes_by_character();
  const auto found =
      std::lower_bound(kCodes.begin(), kCodes.end(), character,
                       [](const CodeOf& entry, char32_t wanted) { return entry.first < wanted; });
  if (found == kCodes.end() || found->first != character) return std::nullopt;
  return found->second;
}

}  // namespace kinefile::text
