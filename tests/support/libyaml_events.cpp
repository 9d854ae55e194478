// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <yaml.h>

#include "support/yaml_events.hpp"

namespace kinefile::test {
namespace {

std::string_view text_of(const yaml_char_t* text) {
  return text == nullptr ? std::string_view() : reinterpret_cast<const char*>(text);
}

std::string place_of(const yaml_event_t& event) {
  return fmt::format("{}:{}", event.start_mark.line, event.start_mark.column);
}

std::string node(std::string_view word, const yaml_event_t& event, const yaml_char_t* anchor,
                 const yaml_char_t* tag, std::string_view rest) {
  std::string line = fmt::format("{} {}", word, place_of(event));
  if (anchor != nullptr) line += fmt::format(" &{}", text_of(anchor));
  if (tag != nullptr) line += fmt::format(" <{}>", text_of(tag));
  return line + fmt::format("{}\n", rest);
}

std::string scalar(const yaml_event_t& event) {
  const auto& data = event.data.scalar;
  const std::string_view value(reinterpret_cast<const char*>(data.value), data.length);
  std::string shown = " :";
  if (data.style == YAML_SINGLE_QUOTED_SCALAR_STYLE) shown = " '";
  if (data.style == YAML_DOUBLE_QUOTED_SCALAR_STYLE) shown = " \"";
  if (data.style == YAML_LITERAL_SCALAR_STYLE) shown = " |";
  if (data.style == YAML_FOLDED_SCALAR_STYLE) shown = " >";
  for (const char c : value) shown += c == '\n' ? std::string("\\n") : std::string(1, c);
  const bool is_empty = value.empty() && data.style == YAML_PLAIN_SCALAR_STYLE;
  std::string line = node("=VAL", event, data.anchor, data.tag, shown);
  if (is_empty) line.replace(5, line.find(' ', 5) - 5, "empty");
  return line;
}

std::string line_of(const yaml_event_t& event) {
  switch (event.type) {
    case YAML_DOCUMENT_START_EVENT:
      return event.data.document_start.implicit != 0 ? "+DOC\n" : "+DOC ---\n";
    case YAML_DOCUMENT_END_EVENT:
      return event.data.document_end.implicit != 0 ? "-DOC\n" : "-DOC ...\n";
    case YAML_SEQUENCE_START_EVENT: {
      const auto& data = event.data.sequence_start;
      return node("+SEQ", event, data.anchor, data.tag,
                  data.style == YAML_FLOW_SEQUENCE_STYLE ? " []" : "");
    }
    case YAML_SEQUENCE_END_EVENT:
      return "-SEQ\n";
    case YAML_MAPPING_START_EVENT: {
      const auto& data = event.data.mapping_start;
      return node("+MAP", event, data.anchor, data.tag,
                  data.style == YAML_FLOW_MAPPING_STYLE ? " {}" : "");
    }
    case YAML_MAPPING_END_EVENT:
      return "-MAP\n";
    case YAML_ALIAS_EVENT:
      return node("=ALI", event, nullptr, nullptr,
                  fmt::format(" *{}", text_of(event.data.alias.anchor)));
    case YAML_SCALAR_EVENT:
      return scalar(event);
    default:
      return "";
  }
}

}  // namespace

std::optional<std::string> libyaml_events(std::string_view text) {
  yaml_parser_t parser;
  yaml_parser_initialize(&parser);
  yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
  yaml_parser_set_input_string(&parser, reinterpret_cast<const unsigned char*>(text.data()),
                               text.size());
  std::string lines;
  bool is_good = true;
  for (bool is_done = false; is_good && !is_done;) {
    yaml_event_t event;
    is_good = yaml_parser_parse(&parser, &event) != 0;
    if (!is_good) break;
    lines += line_of(event);
    is_done = event.type == YAML_STREAM_END_EVENT;
    yaml_event_delete(&event);
  }
  yaml_parser_delete(&parser);
  return is_good ? std::optional(lines) : std::nullopt;
}

}  // namespace kinefile::test
