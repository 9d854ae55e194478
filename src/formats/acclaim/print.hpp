// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "formats/acclaim/bind.hpp"
#include "kinefile/frame_source.hpp"
#include "text/printer.hpp"

namespace kinefile::acclaim {

/// Writes a skeleton; `line_end` is "\n" or "\r\n".
void print_asf(text::Printer& printer, const AsfFile& file, std::string_view line_end);

/// The content of the lines before the first frame.
struct AmcHeading {
  std::string skeleton;     ///< the ASF file's name; empty: not written
  std::string other_lines;  ///< unchanged
  AngleUnit angle = AngleUnit::Degrees;
  bool says_rate = true;
  std::int64_t first_frame_number = 1;
  std::vector<std::string> bone_order;  ///< the bones that have values, if their order is kept
};

/// Writes a motion.
/// \param num_columns  of its frames
/// \errors those of `frames`
Result<void> print_amc(text::Printer& printer, const Unbound& unbound, const AmcHeading& heading,
                       const Timeline& timeline, std::size_t num_columns, EachBlock frames,
                       std::string_view line_end);

}  // namespace kinefile::acclaim
