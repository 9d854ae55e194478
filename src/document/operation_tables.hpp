// SPDX-License-Identifier: MIT
// What operations do to motions, body motions and flows of servo poses. Each reads what follows "="
// in the operation's word, or null, and is empty if that is not what the table says.
#pragma once

#include "kinefile/operation.hpp"

namespace kinefile::operation {

ApplyOperation parse_trim(const std::string* argument);
ApplyOperation parse_reverse(const std::string* argument);
ApplyOperation parse_speed(const std::string* argument);
ApplyOperation parse_mirror(const std::string* argument);
ApplyOperation parse_scale(const std::string* argument);
ApplyOperation parse_up(const std::string* argument);
ApplyOperation parse_in_place(const std::string* argument);
ApplyOperation parse_loop(const std::string* argument);
ApplyOperation parse_append(const std::string* argument);
ApplyOperation parse_joints(const std::string* argument);
ApplyOperation parse_rename(const std::string* argument);
ApplyOperation parse_smooth(const std::string* argument);
ApplyOperation parse_unwrap(const std::string* argument);
ApplyOperation parse_zmp(const std::string* argument);

ApplyOperation parse_flow_mirror(const std::string* argument);
ApplyOperation parse_flow_reverse(const std::string* argument);
ApplyOperation parse_flow_speed(const std::string* argument);
ApplyOperation parse_flow_offset(const std::string* argument);
ApplyOperation parse_flow_merge(const std::string* argument);
ApplyOperation parse_flow_insert(const std::string* argument);
ApplyOperation parse_flow_delete(const std::string* argument);

/// Reads another file that an operation names.
/// \errors CLI001 (Usage) where the context cannot open any; the reader's
inline Result<Document> open_other(const std::string& name, const OperationContext& context) {
  if (context.open) return context.open(name);
  return fail(ErrorKind::Usage, "CLI001", "'" + name + "' cannot be read: no other files can be");
}

}  // namespace kinefile::operation
