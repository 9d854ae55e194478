// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "simd/template_rows.hpp"

namespace kinefile::text {

/// The template of a row: the text between its finite numbers. Empty if they are not as many as
/// expected.
/// \param row  a whole row, with its line end
std::optional<simd::RowTemplate> template_of_row(std::string_view row, std::size_t num_columns);

}  // namespace kinefile::text
