// SPDX-License-Identifier: MIT
#include "text/row_template.hpp"

#include <cmath>

#include "text/numbers.hpp"

namespace kinefile::text {
namespace {

bool is_number(std::string_view token) {
  const Number number = parse_number(token);
  return number.fault == NumberFault::None && std::isfinite(number.value);
}

}  // namespace

std::optional<simd::RowTemplate> template_of_row(std::string_view row, std::size_t num_columns) {
  simd::RowTemplate found;
  std::size_t gap = 0;  // where the text since the last number begins
  for (std::size_t at = 0; at < row.size();) {
    if (simd::is_separator(row[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < row.size() && !simd::is_separator(row[end])) ++end;
    if (is_number(row.substr(at, end - at))) {
      found.add_gap(row.substr(gap, at - gap));
      gap = end;
    }
    at = end;
  }
  found.add_gap(row.substr(gap));
  if (found.num_columns() != num_columns) return std::nullopt;
  return found;
}

}  // namespace kinefile::text
