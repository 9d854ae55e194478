// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "text/printer.hpp"

namespace kinefile::text {

/// Prints some rows, from one up to another that is not included.
using PrintRows = std::function<void(Printer& printer, std::size_t begin, std::size_t end)>;

/// Prints rows, in parts on several threads if they are many, and hands the parts on in order.
/// \param print  called for several parts at once
/// \returns      false if the sink ever returned false
bool print_rows(std::size_t num_rows, std::size_t numbers_per_row,
                const simd::NumberSpelling& spelling, const PrintRows& print,
                const std::function<bool(std::string_view)>& sink);

}  // namespace kinefile::text
