// SPDX-License-Identifier: MIT
// The actions of a person and of sensors while a flow runs, from a table.

#include <fmt/format.h>

#include <algorithm>

#include "kinefile/run.hpp"
#include "text/csv_fields.hpp"
#include "text/option_words.hpp"
#include "text/source.hpp"

namespace kinefile {
namespace {

/// A cell without the quotes and blanks around it, and where it starts.
struct InputCell {
  std::string text;
  const char* at = nullptr;
};

InputCell trimmed(const text::CsvField& field) {
  constexpr std::string_view kBlanks = " \t";
  const std::size_t begin = std::min(field.text.find_first_not_of(kBlanks), field.text.size());
  const std::size_t end = field.text.find_last_not_of(kBlanks) + 1;
  return {field.text.substr(begin, std::max(begin, end) - begin), field.at + begin};
}

/// The meaning of a column of the table.
struct InputColumn {
  enum Kind { Tick, Held, Variable } kind = Tick;
  std::size_t variable = 0;
  bool operator==(const InputColumn&) const = default;
};

/// The column that a word of the header names, or empty.
std::optional<InputColumn> column_named(std::string_view word) {
  if (word == "tick") return InputColumn{InputColumn::Tick, 0};
  if (word == "held") return InputColumn{InputColumn::Held, 0};
  if (!word.starts_with('v')) return std::nullopt;
  const auto number = words::integer<std::size_t>(word.substr(1));
  if (!number || *number >= kNumVariables) return std::nullopt;
  return InputColumn{InputColumn::Variable, *number};
}

using InputRow = std::vector<InputCell>;

struct InputReader {
  const text::Source& source;
  std::vector<InputColumn> columns = {};
  std::vector<flow::Input> inputs = {};

  tl::unexpected<Error> refuse(const char* at, std::string code, std::string message) const {
    Error error;
    static_cast<Diagnostic&>(error) =
        source.diagnose(Severity::Error, std::move(code), std::move(message), at);
    return fail(std::move(error));
  }

  Result<void> read_header(const InputRow& row) {
    for (const InputCell& cell : row) {
      const auto column = column_named(cell.text);
      if (!column) {
        return refuse(
            cell.at, "RUN010",
            fmt::format("expected columns tick, held and v0 to v255, found '{}'", cell.text));
      }
      if (std::find(columns.begin(), columns.end(), *column) != columns.end()) {
        return refuse(cell.at, "RUN010",
                      fmt::format("expected each column once, found '{}' again", cell.text));
      }
      columns.push_back(*column);
    }
    if (std::find(columns.begin(), columns.end(), InputColumn{}) != columns.end()) return {};
    return refuse(row.front().at, "RUN010", "expected a column tick, found none");
  }

  Result<void> read_tick(const InputCell& cell, flow::Input& input) const {
    const auto tick = words::integer<std::uint64_t>(cell.text);
    if (!tick) {
      return refuse(cell.at, "RUN011", fmt::format("expected a tick, found '{}'", cell.text));
    }
    if (!inputs.empty() && *tick < inputs.back().tick) {
      return refuse(
          cell.at, "RUN012",
          fmt::format("expected a tick of {} or later, found {}", inputs.back().tick, *tick));
    }
    input.tick = *tick;
    return {};
  }

  Result<void> read_cell(const InputCell& cell, const InputColumn& column,
                         flow::Input& input) const {
    if (column.kind == InputColumn::Tick) return read_tick(cell, input);
    if (cell.text.empty()) return {};
    if (column.kind == InputColumn::Held) {
      if (cell.text != "0" && cell.text != "1") {
        return refuse(cell.at, "RUN011", fmt::format("expected 0 or 1, found '{}'", cell.text));
      }
      input.is_held = cell.text == "1";
      return {};
    }
    const auto value = words::integer<std::int16_t>(cell.text);
    if (!value) {
      return refuse(
          cell.at, "RUN011",
          fmt::format("expected a whole number from -32768 to 32767, found '{}'", cell.text));
    }
    input.variables.emplace_back(column.variable, *value);
    return {};
  }

  Result<void> read_row(const InputRow& row) {
    if (row.size() != columns.size()) {
      return refuse(row.front().at, "RUN013",
                    fmt::format("expected {} cells, as the header has, found {}", columns.size(),
                                row.size()));
    }
    flow::Input input;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      auto read = read_cell(row[c], columns[c], input);
      if (!read) return read;
    }
    inputs.push_back(std::move(input));
    return {};
  }

  Result<void> read_table() {
    text::CsvFields fields(source.text());
    while (!fields.is_at_end()) {
      InputRow row;
      for (const text::CsvField& field : fields.take_record()) row.push_back(trimmed(field));
      if (fields.fault() != nullptr) {
        const bool is_opening = *fields.fault() == '"';
        return refuse(fields.fault(), "RUN011",
                      is_opening
                          ? "expected a quote that closes this one, found the end of the file"
                          : "expected a comma or the end of the line behind a field in quotes");
      }
      if (row.size() == 1 && row.front().text.empty()) continue;  // an empty line
      auto read = columns.empty() ? read_header(row) : read_row(row);
      if (!read) return read;
    }
    if (!columns.empty()) return {};
    return fail(make_error(ErrorKind::InvalidInput, "RUN010",
                           "expected a header with a column tick, found nothing", source.name()));
  }
};

}  // namespace

Result<std::vector<flow::Input>> parse_inputs(std::string_view text,
                                              const std::string& source_name) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const text::Source source(source_name, text);
  InputReader reader{source};
  if (auto read = reader.read_table(); !read) return fail(std::move(read.error()));
  return std::move(reader.inputs);
}

}  // namespace kinefile
