// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>

#include "formats/bvh/bind.hpp"
#include "kinefile/clip.hpp"
#include "text/printer.hpp"

namespace kinefile::bvh {

/// Writes the hierarchy; `line_end` is "\n" or "\r\n".
void print_hierarchy(text::Printer& printer, const File& file, std::string_view line_end);

/// Writes the motion: the counts and one line per frame.
void print_motion(text::Printer& printer, const Unbound& unbound, const Clip& clip,
                  std::string_view line_end);

}  // namespace kinefile::bvh
