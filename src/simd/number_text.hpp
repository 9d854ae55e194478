// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <optional>
#include <span>
#include <string_view>

namespace kinefile::simd {

/// How numbers are spelled.
struct NumberSpelling {
  /// Digits after the point; absent: the shortest form that reads back as the same double.
  std::optional<int> decimals = std::nullopt;
  /// 1.0e-05 instead of 1e-05.
  bool points_exponents = false;
  /// "nan", "inf" and "-inf" in quotes instead of nan, inf and -inf.
  bool quotes_non_finite = false;
};

/// Appends numbers as fmt prints them, by `{:.{}f}` or `{}`, except for NaN, whose sign is left
/// out: it has no meaning. \param separator  stands behind each number; two characters at most
void append_numbers(std::span<const double> numbers, std::string_view separator,
                    const NumberSpelling& spelling, fmt::memory_buffer& out);

}  // namespace kinefile::simd
