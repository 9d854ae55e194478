// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "report.hpp"

namespace kinefile::cli {

/// JSON whose keys keep the order in which they were given.
using Json = nlohmann::ordered_json;

/// Prints JSON on stdout, indented; bytes that are not UTF-8 (possible in a file's name) become
/// U+FFFD.
inline void print_json(const Json& json) {
  print_data(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace kinefile::cli
