// SPDX-License-Identifier: MIT
#include "run_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "numbers.hpp"

namespace kinefile::cli {
namespace {

/// A line of the table, and where it stands.
struct Row {
  std::string_view text;
  std::size_t line = 0;
  std::vector<std::string_view> cells;  ///< parts of `text`
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\"";  // a number may stand in quotes
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return text.substr(text.size());
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

/// The lines that hold something, without the mark of UTF-8 before the first.
std::vector<Row> rows_of(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<Row> rows;
  std::size_t line = 0;
  for (std::string_view part : split(text, '\n')) {
    ++line;
    if (part.ends_with('\r')) part.remove_suffix(1);
    if (trimmed(part).empty()) continue;
    Row& row = rows.emplace_back(Row{part, line, split(part, ',')});
    for (std::string_view& cell : row.cells) cell = trimmed(cell);
  }
  return rows;
}

/// What a column of the table is.
struct Column {
  enum Kind { Tick, Held, Variable } kind = Tick;
  std::size_t variable = 0;
};

struct Reader {
  const std::string& source;
  std::vector<Column> columns = {};
  std::vector<flow::Input> inputs = {};

  /// An error at a cell, which is a part of its row's text.
  tl::unexpected<Error> refuse(const Row& row, std::string_view cell, std::string code,
                               std::string message) const {
    constexpr std::size_t kLongest = 120;
    Error error = make_error(ErrorKind::InvalidInput, std::move(code), std::move(message), source);
    const auto column = static_cast<std::size_t>(cell.data() - row.text.data());
    error.place.line = row.line;
    error.place.column = column + 1;
    if (column < kLongest) error.excerpt = row.text.substr(0, kLongest);
    error.caret = std::min(column, error.excerpt.size());
    return fail(std::move(error));
  }

  Result<void> read_header(const Row& row) {
    bool has_tick = false;
    for (const std::string_view cell : row.cells) {
      Column column;
      if (cell == "held") column.kind = Column::Held;
      if (cell.starts_with('v')) {
        const auto number = parse_number<std::size_t>(cell.substr(1));
        column.kind = number && *number < kNumVariables ? Column::Variable : Column::Tick;
        column.variable = number.value_or(0);
      }
      if (column.kind == Column::Tick && (cell != "tick" || has_tick)) {
        return refuse(row, cell, "RUN010",
                      fmt::format("expected columns tick, held and v0 to v255, found '{}'", cell));
      }
      const bool is_again = std::any_of(columns.begin(), columns.end(), [&](const Column& other) {
        return other.kind == column.kind && other.variable == column.variable;
      });
      if (is_again) {
        return refuse(row, cell, "RUN010",
                      fmt::format("expected each column once, found '{}' again", cell));
      }
      has_tick = has_tick || column.kind == Column::Tick;
      columns.push_back(column);
    }
    if (has_tick) return {};
    return refuse(row, row.text, "RUN010", "expected a column tick, found none");
  }

  Result<void> read_tick(const Row& row, std::string_view cell, flow::Input& input) const {
    const auto tick = parse_number<std::uint64_t>(cell);
    if (!tick) {
      return refuse(row, cell, "RUN011", fmt::format("expected a tick, found '{}'", cell));
    }
    if (!inputs.empty() && *tick < inputs.back().tick) {
      return refuse(
          row, cell, "RUN012",
          fmt::format("expected a tick of {} or later, found {}", inputs.back().tick, *tick));
    }
    input.tick = *tick;
    return {};
  }

  Result<void> read_cell(const Row& row, std::string_view cell, const Column& column,
                         flow::Input& input) const {
    if (column.kind == Column::Tick) return read_tick(row, cell, input);
    if (cell.empty()) return {};
    if (column.kind == Column::Held) {
      if (cell != "0" && cell != "1") {
        return refuse(row, cell, "RUN011", fmt::format("expected 0 or 1, found '{}'", cell));
      }
      input.is_held = cell == "1";
      return {};
    }
    const auto value = parse_number<std::int16_t>(cell);
    if (!value) {
      return refuse(row, cell, "RUN011",
                    fmt::format("expected a whole number from -32768 to 32767, found '{}'", cell));
    }
    input.variables.emplace_back(column.variable, *value);
    return {};
  }

  Result<void> read_row(const Row& row) {
    if (row.cells.size() != columns.size()) {
      return refuse(row, row.text, "RUN013",
                    fmt::format("expected {} cells, as the header has, found {}", columns.size(),
                                row.cells.size()));
    }
    flow::Input input;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      auto read = read_cell(row, row.cells[c], columns[c], input);
      if (!read) return read;
    }
    inputs.push_back(std::move(input));
    return {};
  }
};

}  // namespace

std::optional<VariableValue> parse_variable_value(std::string_view text) {
  if (text.starts_with('v')) text.remove_prefix(1);
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  const auto variable = parse_number<std::size_t>(text.substr(0, equals));
  const auto value = parse_number<std::int16_t>(text.substr(equals + 1));
  if (!variable || *variable >= kNumVariables || !value) return std::nullopt;
  return VariableValue{*variable, *value};
}

Result<std::vector<flow::Input>> parse_inputs(std::string_view text, const std::string& source) {
  const std::vector<Row> rows = rows_of(text);
  if (rows.empty()) {
    return fail(make_error(ErrorKind::InvalidInput, "RUN010",
                           "expected a header with a column tick, found nothing", source));
  }
  Reader reader{source};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto read = r == 0 ? reader.read_header(rows[0]) : reader.read_row(rows[r]);
    if (!read) return fail(read.error());
  }
  return std::move(reader.inputs);
}

}  // namespace kinefile::cli
