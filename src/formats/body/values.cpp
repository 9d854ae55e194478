// SPDX-License-Identifier: MIT
#include "formats/body/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/body/codes.hpp"
#include "text/numbers.hpp"
#include "text/scanner.hpp"

namespace kinefile::body {
namespace {

using text::yaml::Node;
using text::yaml::NodeKind;
using Row = std::vector<double>;

/// The name of an unexpected value in a message.
std::string found(const Node& node) {
  if (node.kind == NodeKind::Sequence) return "a list";
  if (node.kind == NodeKind::Mapping) return "a mapping";
  return node.text.empty() ? "nothing" : text::quoted(node.text);
}

std::optional<double> number_of(const Node& node) {
  if (node.kind != NodeKind::Scalar) return std::nullopt;
  const text::Number number = text::parse_number(node.text);
  const bool is_good = number.fault == text::NumberFault::None && std::isfinite(number.value);
  return is_good ? std::optional(number.value) : std::nullopt;
}

/// Whether a text is infinity as YAML spells it, not as Choreonoid does.
bool is_yaml_infinity(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return text::equals_ignoring_case(text, ".inf");
}

/// The numbers of a list; empty if it contains something else.
std::optional<Row> row_of(const Node& node) {
  if (node.kind != NodeKind::Sequence || node.rows) return std::nullopt;
  Row row;
  for (const Node* child : node.children) {
    const auto number = number_of(*child);
    if (!number) return std::nullopt;
    row.push_back(*number);
  }
  return row;
}

/// Adds the groups of a row that the YAML reader read without nodes, each as a row of its own.
bool add_groups(const text::yaml::RowShape& shape, const double* values, std::vector<Row>& rows) {
  const bool is_one_list = shape.empty() || (shape.size() == 1 && shape[0] > 0);
  for (const std::int32_t group : shape) {
    if (group > 0 && !is_one_list) return false;  // numbers beside lists
    const auto count = group == text::yaml::kEmptyGroup ? 0 : std::abs(group);
    rows.emplace_back(values, values + count);
    values += count;
  }
  if (shape.empty()) rows.emplace_back();
  return true;
}

/// Adds the lists of numbers in a list, of any depth, in their order; false if there is something
/// else in it. The YAML reader stores some of them as rows without nodes.
bool add_rows(const Node& node, const text::yaml::Tree& tree, std::vector<Row>& rows) {
  if (node.kind != NodeKind::Sequence) return false;
  if (node.rows) {
    const double* next = node.rows->values.data();
    return std::all_of(node.rows->entries.begin(), node.rows->entries.end(),
                       [&](const auto& entry) {
                         if (entry.node != nullptr) return add_rows(*entry.node, tree, rows);
                         const double* const values = next;
                         next += tree.num_values(entry.shape);
                         return add_groups(tree.shape(entry.shape), values, rows);
                       });
  }
  const bool has_lists =
      !node.children.empty() && node.children.front()->kind == NodeKind::Sequence;
  if (has_lists) {
    return std::all_of(node.children.begin(), node.children.end(),
                       [&](const Node* child) { return add_rows(*child, tree, rows); });
  }
  auto row = row_of(node);
  if (row) rows.push_back(std::move(*row));
  return row.has_value();
}

}  // namespace

void Values::error(const Node& node, const char* code, std::string message) {
  if (is_of_shape) {
    spot(node).report(diagnostics, Severity::Warning, code::kLeftOutShape,
                      message + "; the shape is left out");
  } else {
    spot(node).report(diagnostics, Severity::Error, code, std::move(message));
  }
}

std::optional<std::string> Values::word(const Node& node, std::string_view what) {
  if (node.kind == NodeKind::Scalar && !node.text.empty()) return std::string(node.text);
  error(node, code::kBadValue, fmt::format("expected {}, found {}", what, found(node)));
  return std::nullopt;
}

std::optional<double> Values::number(const Node& node, std::string_view what) {
  const auto value = number_of(node);
  if (value) return value;
  error(node, code::kBadValue,
        fmt::format("expected a finite number as {}, found {}", what, found(node)));
  return std::nullopt;
}

std::optional<double> Values::limit(const Node& node) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const text::Number number =
      node.kind == NodeKind::Scalar ? text::parse_number(node.text) : text::Number{};
  const bool is_number = node.kind == NodeKind::Scalar && number.fault == text::NumberFault::None;
  if (is_number && !std::isnan(number.value)) return number.value;
  const bool is_large = number.fault == text::NumberFault::OutOfRange;
  if (is_large || node.text == "unlimited" || is_yaml_infinity(node.text)) return kInfinity;
  error(node, code::kBadValue,
        fmt::format("expected a number or inf as a limit, found {}", found(node)));
  return std::nullopt;
}

std::optional<Row> Values::list(const Node& node, std::string_view what) {
  auto row = row_of(node);
  if (row) return row;
  error(node, code::kBadValue,
        fmt::format("expected a list of finite numbers as {}, found {}", what,
                    node.kind == NodeKind::Sequence ? "something else in it" : found(node)));
  return std::nullopt;
}

std::optional<Row> Values::numbers(const Node& node, std::string_view what, std::size_t count) {
  auto row = list(node, what);
  if (!row || row->size() == count) return row;
  error(node, code::kBadValue,
        fmt::format("expected {} numbers as {}, found {}", count, what, row->size()));
  return std::nullopt;
}

std::optional<std::vector<Row>> Values::rows(const Node& node, std::string_view what,
                                             std::size_t count) {
  if (node.kind == NodeKind::Sequence) {
    const bool has_lists =
        node.rows || (!node.children.empty() && node.children.front()->kind == NodeKind::Sequence);
    if (!has_lists) {
      auto row = numbers(node, what, count);
      if (!row) return std::nullopt;
      return std::vector<Row>{std::move(*row)};
    }
    std::vector<Row> all;
    const auto is_right = [count](const Row& row) { return row.size() == count; };
    if (add_rows(node, tree, all) && std::all_of(all.begin(), all.end(), is_right)) return all;
  }
  error(node, code::kBadValue,
        fmt::format("expected {} finite numbers as {}, or a list of such lists, found {}", count,
                    what, node.kind == NodeKind::Sequence ? "another list" : found(node)));
  return std::nullopt;
}

std::optional<Vec3> Values::vector(const Node& node, std::string_view what) {
  const auto row = numbers(node, what, 3);
  if (!row) return std::nullopt;
  return Vec3((*row)[0], (*row)[1], (*row)[2]);
}

const Node* find_any(const Node& node, std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) {
    if (const Node* value = text::yaml::find(node, key)) return value;
  }
  return nullptr;
}

}  // namespace kinefile::body
