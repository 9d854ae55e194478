// SPDX-License-Identifier: MIT
#include "text/yaml/characters.hpp"

#include <algorithm>

namespace kinefile::text::yaml {
namespace {

constexpr unsigned char byte_of(char c) { return static_cast<unsigned char>(c); }

bool is_forbidden(const char* p, const char* end) {
  const unsigned char c = byte_of(*p);
  const auto next = [&](std::ptrdiff_t i) { return i < end - p ? byte_of(p[i]) : 0u; };
  if (c < 0x20) return c != '\t' && c != '\n' && c != '\r';
  if (c == 0x7F) return true;
  if (c == 0xC2) return next(1) < 0xA0 && next(1) != 0x85;  // the second set of control characters
  return c == 0xEF && next(1) == 0xBF && next(2) >= 0xBE;   // U+FFFE and U+FFFF
}

}  // namespace

std::size_t Cursor::break_width(std::ptrdiff_t ahead) const {
  switch (byte_of(peek(ahead))) {
    case '\n':
      return 1;
    case '\r':
      return peek(ahead + 1) == '\n' ? 2 : 1;
    case 0xC2:
      return byte_of(peek(ahead + 1)) == 0x85 ? 2 : 0;
    case 0xE2:
      return byte_of(peek(ahead + 1)) == 0x80 && (byte_of(peek(ahead + 2)) & 0xFE) == 0xA8 ? 3 : 0;
    default:
      return 0;
  }
}

void Cursor::skip_break() {
  next_ += break_width();
  ++line_;
  line_start_ = index();
}

void Cursor::jump(const char* to, std::size_t line_starts, const char* last_start) {
  index();
  if (line_starts > 0) {
    line_ += line_starts;
    line_start_ = count_ + static_cast<std::size_t>(last_start - next_);
  }
  count_ += static_cast<std::size_t>(to - next_);
  next_ = counted_ = to;
}

std::size_t Cursor::index() const {
  count_ += static_cast<std::size_t>(
      std::count_if(counted_, next_, [](char c) { return (byte_of(c) & 0xC0) != 0x80; }));
  counted_ = next_;
  return count_;
}

const char* find_forbidden_character(std::string_view part, const char* text_end) {
  const char* const end = part.data() + part.size();
  // One block at a time, because nearly all blocks need no closer check.
  constexpr std::ptrdiff_t kBlock = 4096;
  for (const char* block = part.data(); block != end;) {
    const char* const block_end = block + std::min(kBlock, end - block);
    unsigned suspects = 0;
    for (const char* p = block; p != block_end; ++p) {
      const unsigned char c = byte_of(*p);
      suspects |= static_cast<unsigned>(c < 0x20) & static_cast<unsigned>(c != '\n');
      suspects |= static_cast<unsigned>(c >= 0x7F);
    }
    if (suspects != 0) {
      const char* const found = std::find_if(
          block, block_end, [text_end](const char& c) { return is_forbidden(&c, text_end); });
      if (found != block_end) return found;
    }
    block = block_end;
  }
  return nullptr;
}

}  // namespace kinefile::text::yaml
