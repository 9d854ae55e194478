// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kinefile::npz {

/// The beginning of an .npy file: its bytes up to the data, which are in C order. Their number is a
/// multiple of 64, as with NumPy. Version 1.0: it is for headers of ASCII of less than 64 KiB,
/// which all of ours are. \param type  of an element, as `type_of` gives it Source:
/// numpy.lib.format, "A simple format for saving numpy arrays to disk with the full information
/// about them", NEP 1.
std::string npy_header(std::string_view type, std::span<const std::uint64_t> shape);

/// The byte order of this machine, in which arrays are written, as NumPy does.
inline constexpr char kByteOrder = std::endian::native == std::endian::little ? '<' : '>';

/// The type of numbers in .npy: "<f8".
template <class T>
std::string type_of() {
  return std::string{kByteOrder, std::floating_point<T> ? 'f' : 'i'} + std::to_string(sizeof(T));
}

/// The bytes of an array's data.
template <class T>
std::string_view bytes_of(std::span<const T> numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

/// Texts as NumPy has them in an array: all as long as the longest, with zeros behind shorter ones.
struct Texts {
  std::string type;  ///< "<U12", the number of characters
  std::vector<char32_t> characters;
};

/// \param texts  UTF-8; a byte that is not becomes U+FFFD
Texts texts_of(std::span<const std::string> texts);

}  // namespace kinefile::npz
