// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "kinefile/pose_flow.hpp"

namespace kinefile::robovie {

/// How the lines of a file are laid out and encoded.
struct Layout {
  std::string encoding = "utf-16le";
  bool has_bom = true;
  std::string_view line_end = "\r\n";
  bool has_blank_lines = true;  ///< before every block
  bool ends_with_line = true;   ///< whether the last line has a line end, too
};

/// The two lines before the blocks, with "\n" for line ends.
std::string header_text(const PoseFlow& flow);

/// The lines of a block.
std::string block_text(const PoseFlow& flow, const Block& block);

/// Why a flow cannot be written, as text; empty if it can.
std::string why_not_written(const PoseFlow& flow);

}  // namespace kinefile::robovie
