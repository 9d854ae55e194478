// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "session.hpp"

namespace kinefile::page {

/// Arrays and files that an answer points to. They stay until the next question.
struct Held {
  std::vector<Array<float>> floats;
  std::vector<Array<double>> doubles;
  std::vector<std::string> texts;
};

/// Answers a question of the page, {"ask": "poses", ...}. docs/design/viewer.md lists the
/// questions. An answer that failed is {"error": {...}, "diagnostics": [...]}. Arrays are
/// {"at": address, "size": number of elements}.
Json answer(Session& session, Held& held, const Json& question);

}  // namespace kinefile::page
