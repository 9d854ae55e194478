// SPDX-License-Identifier: MIT
#include "formats/npz/npy.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/printable.hpp"

namespace kinefile::npz {
namespace {

std::u32string characters_of(std::string_view text) {
  constexpr char32_t kReplacement = 0xFFFD;
  std::u32string characters;
  while (!text.empty()) {
    const Character character = first_character(text);
    characters += character.value == 0 ? kReplacement : character.value;
    text.remove_prefix(character.length);
  }
  return characters;
}

}  // namespace

std::string npy_header(std::string_view type, std::span<const std::uint64_t> shape) {
  constexpr std::size_t kAlignment = 64;
  std::string header("\x93NUMPY\1\0..", 10);  // the version, and room for a length of two bytes
  const std::size_t num_before = header.size();
  header += fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': (", type);
  for (std::size_t k = 0; k < shape.size(); ++k) {
    header += fmt::format("{}{}", k > 0 ? ", " : "", shape[k]);
  }
  header += shape.size() == 1 ? ",), }" : "), }";  // as Python writes a tuple
  const std::size_t size = (header.size() + kAlignment) / kAlignment * kAlignment;
  header.resize(size - 1, ' ');
  header += '\n';
  header[num_before - 2] = static_cast<char>((size - num_before) & 0xFF);
  header[num_before - 1] = static_cast<char>((size - num_before) >> 8);
  return header;
}

Texts texts_of(std::span<const std::string> texts) {
  std::vector<std::u32string> all;
  std::size_t length = 1;  // NumPy has no texts without any character
  for (const std::string& text : texts) {
    all.push_back(characters_of(text));
    length = std::max(length, all.back().size());
  }
  Texts out{fmt::format("{}U{}", kByteOrder, length), {}};
  for (std::u32string& text : all) {
    text.resize(length, U'\0');
    out.characters.insert(out.characters.end(), text.begin(), text.end());
  }
  return out;
}

}  // namespace kinefile::npz
