// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "formats/bvh/bind.hpp"
#include "kinefile/timeline.hpp"
#include "text/printer.hpp"

namespace kinefile::bvh {

/// Writes the hierarchy; `line_end` is "\n" or "\r\n".
void print_hierarchy(text::Printer& printer, const File& file, std::string_view line_end);

/// Writes what stands between the hierarchy and the rows.
void print_counts(text::Printer& printer, std::size_t num_frames, const Timeline& timeline,
                  std::string_view line_end);

/// Writes the lines of frames [begin, end).
/// \param rows  of all frames, in the clip's order of columns; shape (frames, columns)
void print_frames(text::Printer& printer, const Unbound& unbound, std::span<const double> rows,
                  std::size_t begin, std::size_t end, std::string_view line_end);

}  // namespace kinefile::bvh
