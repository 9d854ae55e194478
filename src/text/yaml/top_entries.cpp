// SPDX-License-Identifier: MIT
#include "text/yaml/top_entries.hpp"

#include <string>

#include "text/yaml/parser.hpp"

namespace kinefile::text::yaml {
namespace {

bool starts_a_collection(const Event& event) {
  return event.kind == EventKind::MappingStart || event.kind == EventKind::SequenceStart;
}

bool ends_a_collection(const Event& event) {
  return event.kind == EventKind::MappingEnd || event.kind == EventKind::SequenceEnd;
}

/// Skips the rest of a collection whose start has been read. False at the end of the text.
bool skip_collection(Parser& parser) {
  Event event;
  for (std::size_t depth = 1; depth > 0;) {
    if (!parser.next(event) || event.kind == EventKind::StreamEnd) return false;
    if (starts_a_collection(event)) ++depth;
    if (ends_a_collection(event)) --depth;
  }
  return true;
}

}  // namespace

void visit_top_entries(
    std::string_view text,
    const std::function<bool(std::string_view key, std::string_view value)>& visit) {
  Parser parser(text);
  Event event;
  do {
    if (!parser.next(event)) return;
  } while (event.kind == EventKind::DocumentStart);
  if (event.kind != EventKind::MappingStart) return;
  std::string key;
  for (bool is_key = true; parser.next(event) && !ends_a_collection(event); is_key = !is_key) {
    const bool is_scalar = event.kind == EventKind::Scalar;
    const std::string_view word = is_scalar ? event.value : std::string_view();
    if (is_key) {
      key = word;
    } else if (!visit(key, word)) {
      return;
    }
    if (starts_a_collection(event) && !skip_collection(parser)) return;
  }
}

}  // namespace kinefile::text::yaml
