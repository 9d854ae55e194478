// SPDX-License-Identifier: MIT
#include "text/yaml/emit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/numbers.hpp"
#include "text/printer.hpp"

namespace kinefile::text::yaml {
namespace {

/// Calls `use` with the entries of a sequence, one after the other: nodes, or the texts of rows.
template <class UseNode, class UseRow>
void for_each_entry(const Node& sequence, const UseNode& use_node, const UseRow& use_row) {
  for (const Node* child : sequence.children) use_node(*child);
  if (!sequence.rows) return;
  for (const RowEntries::Entry& entry : sequence.rows->entries) {
    if (entry.node != nullptr) {
      use_node(*entry.node);
    } else {
      use_row(entry.text);
    }
  }
}

std::string on_one_line(std::string_view row) {
  std::string text(row);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return is_line_end(c); }, ' ');
  return text;
}

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// Whether a plain scalar can be written unchanged in a block: on one line, also at its start.
bool fits_block(std::string_view text) {
  const bool has_break =
      contains(text, "\n") || contains(text, "\xE2\x80\xA8") || contains(text, "\xE2\x80\xA9");
  return !has_break && !text.starts_with("---") && !text.starts_with("...");
}

/// Whether it can be written unchanged in flow style.
bool fits_flow(std::string_view text) {
  return !text.empty() && fits_block(text) &&
         text.find_first_of(",[]{}") == std::string_view::npos && !text.starts_with('?') &&
         !text.starts_with(':') && !contains(text, ": ") && !contains(text, ":?") &&
         !text.ends_with(':') && !contains(text, " #");
}

/// A tag as written, with a blank after it; empty if there is none.
std::string tag_text(std::string_view tag) {
  if (tag.empty()) return "";
  if (tag == "!") return "! ";
  std::string text = "!<";
  for (const char c : tag) {
    const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                          (c >= 'A' && c <= 'Z') || contains("-_;/?:@&=+$.!~*'(),[]", {&c, 1});
    text += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return text + "> ";
}

std::string scalar_text(const Node& node, bool is_in_flow) {
  std::string text = tag_text(node.tag);
  if (!node.is_plain()) return text + json_string(node.text);
  if (node.text.empty()) return text + (is_in_flow || !text.empty() ? "null" : "");
  const bool is_plain = is_in_flow ? fits_flow(node.text) : fits_block(node.text);
  return text + (is_plain ? std::string(node.text) : json_string(node.text));
}

/// Whether a key needs the sign "?": it starts like something else, or is long.
bool needs_key_sign(const Node& key, std::string_view text) {
  constexpr std::size_t kLongest = 1000;
  return key.kind != NodeKind::Scalar || text.size() > kLongest;
}

void emit_flow(const Node& node, std::string& out) {
  if (node.kind == NodeKind::Scalar) {
    out += scalar_text(node, true);
    return;
  }
  out += tag_text(node.tag);
  const bool is_sequence = node.kind == NodeKind::Sequence;
  out += is_sequence ? "[" : "{";
  bool is_first = true;
  const auto separate = [&] {
    out += is_first ? " " : ", ";
    is_first = false;
  };
  if (is_sequence) {
    for_each_entry(
        node,
        [&](const Node& entry) {
          separate();
          emit_flow(entry, out);
        },
        [&](std::string_view row) {
          separate();
          out += on_one_line(row);
        });
  } else {
    for (std::size_t i = 0; i + 1 < node.children.size(); i += 2) {
      separate();
      std::string key;
      emit_flow(*node.children[i], key);
      if (needs_key_sign(*node.children[i], key)) out += "? ";
      out += key + " : ";
      emit_flow(*node.children[i + 1], out);
    }
  }
  out += is_sequence ? " ]" : " }";
}

bool is_on_one_line(const Node& node) {
  if (node.kind == NodeKind::Scalar) return true;
  if (node.children.empty() && !node.rows) return true;
  if (node.kind == NodeKind::Mapping || node.rows) return node.is_flow && !node.rows;
  return std::all_of(node.children.begin(), node.children.end(),
                     [](const Node* child) { return child->kind == NodeKind::Scalar; });
}

void emit_block(const Node& node, std::size_t indent, std::string& out);

/// Prints a value after "-" or ":".
void emit_value(const Node& node, std::size_t indent, std::string& out) {
  if (!is_on_one_line(node)) {
    if (!node.tag.empty()) {
      out += ' ' + tag_text(node.tag);
      out.pop_back();
    }
    out += '\n';
    emit_block(node, indent, out);
    return;
  }
  std::string text;
  if (node.kind == NodeKind::Scalar) {
    text = scalar_text(node, false);
  } else {
    emit_flow(node, text);
  }
  if (!text.empty()) out += ' ' + text;
}

void emit_entry(const Node& key, const Node& value, std::size_t indent, std::string& out) {
  out.append(indent, ' ');
  std::string text;
  emit_flow(key, text);
  const bool has_sign = needs_key_sign(key, text);
  out += has_sign ? "? " + text + "\n" + std::string(indent, ' ') : text;
  out += ':';
  emit_value(value, indent + 2, out);
}

void emit_block(const Node& node, std::size_t indent, std::string& out) {
  bool is_first = true;
  const auto start_line = [&] {
    if (!is_first) out += '\n';
    is_first = false;
  };
  if (node.kind == NodeKind::Mapping) {
    for (std::size_t i = 0; i + 1 < node.children.size(); i += 2) {
      start_line();
      emit_entry(*node.children[i], *node.children[i + 1], indent, out);
    }
    return;
  }
  for_each_entry(
      node,
      [&](const Node& entry) {
        start_line();
        out.append(indent, ' ');
        out += '-';
        emit_value(entry, indent + 2, out);
      },
      [&](std::string_view row) {
        start_line();
        out.append(indent, ' ');
        out += "- " + on_one_line(row);
      });
}

/// Whether a plain scalar, as spelled, is a JSON value.
bool is_json_word(std::string_view text) {
  if (text == "true" || text == "false" || text == "null") return true;
  std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
  const std::size_t whole = std::min(digits.find_first_not_of("0123456789"), digits.size());
  if (whole == 0 || (whole > 1 && digits[0] == '0')) return false;
  digits.remove_prefix(whole);
  const auto take_digits = [&digits] {
    const std::size_t count = std::min(digits.find_first_not_of("0123456789"), digits.size());
    digits.remove_prefix(count);
    return count > 0;
  };
  if (digits.starts_with('.')) {
    digits.remove_prefix(1);
    if (!take_digits()) return false;
  }
  if (digits.starts_with('e') || digits.starts_with('E')) {
    digits.remove_prefix(1);
    if (digits.starts_with('+') || digits.starts_with('-')) digits.remove_prefix(1);
    if (!take_digits()) return false;
  }
  return digits.empty();
}

/// A row of numbers in JSON spelling, without the text after the last comma.
std::string json_row(std::string_view row) {
  std::string text;
  while (!row.empty()) {
    const std::size_t end = std::min(row.find_first_of("[], \t\r\n"), row.size());
    const std::string_view number = row.substr(0, end);
    if (is_json_word(number)) {
      text += number;
    } else if (!number.empty()) {
      text += fmt::format("{}", parse_number(number).value);
    }
    if (end == row.size()) break;
    const char c = row[end];
    if (c == ']' && text.ends_with(", ")) text.resize(text.size() - 2);
    if (c == '[' || c == ']') text += c;
    if (c == ',') text += ", ";
    row.remove_prefix(end + 1);
  }
  return text;
}

void emit_json(const Node& node, std::string& out) {
  if (node.kind == NodeKind::Scalar) {
    const bool is_empty = node.is_plain() && node.text.empty();
    const bool is_word = node.is_plain() && is_json_word(node.text);
    out += is_empty ? "null" : is_word ? std::string(node.text) : json_string(node.text);
    return;
  }
  const bool is_sequence = node.kind == NodeKind::Sequence;
  out += is_sequence ? '[' : '{';
  bool is_first = true;
  const auto separate = [&] {
    if (!is_first) out += ", ";
    is_first = false;
  };
  if (is_sequence) {
    for_each_entry(
        node,
        [&](const Node& entry) {
          separate();
          emit_json(entry, out);
        },
        [&](std::string_view row) {
          separate();
          out += json_row(row);
        });
  } else {
    for (std::size_t i = 0; i + 1 < node.children.size(); i += 2) {
      separate();
      out += json_key(*node.children[i]) + ": ";
      emit_json(*node.children[i + 1], out);
    }
  }
  out += is_sequence ? ']' : '}';
}

}  // namespace

std::string entry_text(const Node& key, const Node& value) {
  std::string text;
  emit_entry(key, value, 0, text);
  return text;
}

std::string block_text(const Node& node) {
  std::string text;
  if (is_on_one_line(node)) {
    emit_flow(node, text);
  } else {
    emit_block(node, 0, text);
  }
  return text;
}

std::string json_text(const Node& node) {
  std::string text;
  emit_json(node, text);
  return text;
}

std::string json_key(const Node& key) {
  if (key.kind == NodeKind::Scalar) return json_string(key.text);
  std::string text;
  emit_flow(key, text);
  return json_string(text);
}

std::string indented(std::string_view lines, std::size_t num_blanks) {
  std::string text;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    text.append(num_blanks, ' ');
    text += lines.substr(0, end);
    text += '\n';
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  return text;
}

}  // namespace kinefile::text::yaml
