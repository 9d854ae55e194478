// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "command.hpp"

namespace kinefile::cli {

/// What an operation of `edit` may need beside the document.
struct EditContext {
  const Reading& reading;
  Diagnostics& diagnostics;
};

/// What an operation does to a document.
using Apply = std::function<Result<void>(Document&, const EditContext&)>;

/// One operation of `edit`, read from a word such as "trim=10:20".
struct Operation {
  std::string word;
  bool needs_motion = true;     ///< else it can be done to a skeleton alone
  bool works_on_parts = false;  ///< whether it can be done to the components of a body motion
  Apply apply;                  ///< to all but flows; null: the word is none for them
  Apply apply_to_flow;          ///< null: the word is none for flows
};

/// Reads an operation.
/// \errors CLI001 (Usage) with what was expected
Result<Operation> parse_operation(const std::string& word);

/// The operations and what they are called with, for --help.
std::string list_of_operations();

}  // namespace kinefile::cli
