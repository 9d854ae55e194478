// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

// The file that cmake/embed.cmake puts into the command.
extern "C" const char kinefile_page_begin[];
extern "C" const char kinefile_page_end[];

namespace kinefile::cli {

/// The HTML of the viewer; empty if the command was built without it.
inline std::string_view embedded_page() {
  return {kinefile_page_begin, static_cast<std::size_t>(kinefile_page_end - kinefile_page_begin)};
}

}  // namespace kinefile::cli
