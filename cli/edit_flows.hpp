// SPDX-License-Identifier: MIT
// What operations of `edit` do to flows of servo poses. Each reads what follows "=", or null, and
// gives nothing if that is not what the table of operations says.
#pragma once

#include "edit_operations.hpp"

namespace kinefile::cli {

Apply parse_flow_mirror(const std::string* argument);
Apply parse_flow_reverse(const std::string* argument);
Apply parse_flow_speed(const std::string* argument);
Apply parse_flow_offset(const std::string* argument);
Apply parse_flow_merge(const std::string* argument);
Apply parse_flow_insert(const std::string* argument);
Apply parse_flow_delete(const std::string* argument);

}  // namespace kinefile::cli
