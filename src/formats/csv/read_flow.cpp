// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words.hpp"
#include "formats/csv/flow_table.hpp"
#include "kinefile/robot_project.hpp"
#include "model/slider_words.hpp"
#include "text/numbers.hpp"

namespace kinefile::csv {
namespace {

constexpr std::string_view kTime = "time", kNext = "next", kBreak = "break", kSound = "sound";

/// The content of a column.
struct Column {
  std::string_view word;  ///< one of the above; empty: a slider
  std::size_t slider = kNoColumn;
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text::is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && text::is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// The column for a name; empty if a flow has no such column.
std::optional<Column> column_of(std::string_view name, const RobotProject* project) {
  for (std::size_t s = 0; project != nullptr && s < project->sliders.size(); ++s) {
    if (s < max_sliders(FlowFormat::WordN) && project->sliders[s].name == trimmed(name)) {
      return Column{{}, s};
    }
  }
  const std::string lower = lowered(trimmed(name));
  for (const std::string_view word : {kTime, kNext, kBreak, kSound}) {
    if (lower == word) return Column{word, kNoColumn};
  }
  if (!lower.starts_with('s')) return std::nullopt;
  const auto slider = text::parse_count(std::string_view(lower).substr(1));
  if (!slider || *slider >= max_sliders(FlowFormat::WordN)) return std::nullopt;
  return Column{{}, *slider};
}

bool is_of_16_bits(double value) { return value >= -32768 && value <= 32767; }

/// The places of a row's arrows.
struct Arrows {
  const char* normal = nullptr;
  const char* branch = nullptr;
};

class FlowReader {
 public:
  FlowReader(const TableReader& reader, const std::vector<text::CsvField>& header)
      : reader_(reader), own_(reader.options.of_formats.get<csv::ReadOptions>()), header_(header) {
    if (reader.options.project != nullptr && own_.is_relative) {
      base_ = base_values(*reader.options.project);
    }
  }

  std::optional<PoseFlow> read(text::CsvFields& fields) {
    if (!parse_columns()) return std::nullopt;
    flow_.format = FlowFormat::WordN;
    while (!fields.is_at_end()) {
      if (fields.take_line_end()) continue;  // an empty line
      const char* const start = fields.position();
      const std::vector<text::CsvField> row = fields.take_record();
      if (!reader_.are_quotes_good(fields)) return std::nullopt;
      if (row.size() != columns_.size()) {
        error("CSV005", fmt::format("expected {} fields, found {}", columns_.size(), row.size()),
              start);
        return std::nullopt;
      }
      parse_row(row, start);
    }
    settle_arrows();
    if (reader_.diagnostics.has_errors()) return std::nullopt;
    return std::move(flow_);
  }

 private:
  void error(const char* code, std::string message, const char* at) const {
    reader_.error(code, std::move(message), at);
  }

  bool parse_columns() {
    std::vector<bool> is_known(max_sliders(FlowFormat::WordN));
    for (const text::CsvField& field : header_) {
      const auto column = column_of(field.text, reader_.options.project.get());
      const bool is_again =
          column && (column->word.empty()
                         ? is_known[column->slider]
                         : std::any_of(columns_.begin(), columns_.end(), [&](const Column& other) {
                             return other.word == column->word;
                           }));
      if (!column || is_again) {
        error("CSV010",
              fmt::format("expected time, next, break, sound or s0 to s63, each once, found {}",
                          text::quoted(field.text)),
              field.at);
        return false;
      }
      columns_.push_back(*column);
      if (!column->word.empty()) continue;
      is_known[column->slider] = true;
      flow_.num_sliders = std::max(flow_.num_sliders, column->slider + 1);
    }
    if (flow_.num_sliders == 0) {
      error("CSV010", "expected columns of sliders, s0 up, found none", header_[0].at);
    }
    return flow_.num_sliders > 0;
  }

  void parse_row(const std::vector<text::CsvField>& row, const char* start) {
    Block block;
    block.line = reader_.source.place_of(start).line;
    block.normal = kOpenArrow;
    Arrows arrows{start, start};
    PoseBlock pose;
    pose.words.resize(flow_.num_sliders);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Column& column = columns_[i];
      if (column.word == kTime) {
        pose.ticks = integer(row[i], "CSV011", 1, kMaxTicks, "a time of 1 to 239 ticks");
      } else if (column.word == kNext) {
        block.normal = arrow(row[i], kOpenArrow);
        arrows.normal = row[i].at;
      } else if (column.word == kBreak) {
        block.branch = arrow(row[i], kNoBlock);
        arrows.branch = row[i].at;
      } else if (column.word == kSound) {
        pose.sound = row[i].text;
      } else {
        pose.words[column.slider] = word(row[i], column.slider);
      }
    }
    block.body = std::move(pose);
    flow_.blocks.push_back(std::move(block));
    arrows_.push_back(arrows);
  }

  int integer(const text::CsvField& field, const char* code, int least, int most,
              const char* expected) {
    const std::string_view token = trimmed(field.text);
    const text::Number number = text::parse_number(token);
    const bool is_good = number.fault == text::NumberFault::None && number.value >= least &&
                         number.value <= most && number.value == std::floor(number.value);
    if (is_good) return static_cast<int>(number.value);
    error(code, fmt::format("expected {}, found {}", expected, found(token)), field.at);
    return least;
  }

  static std::string found(std::string_view token) {
    return token.empty() ? "nothing" : text::quoted(token);
  }

  /// A pose's number, or -1; an empty field gives `nothing`.
  int arrow(const text::CsvField& field, int nothing) {
    if (trimmed(field.text).empty()) return nothing;
    constexpr int kMost = 100'000'000;
    return integer(field, "CSV012", kNoBlock, kMost,
                   "the number of a pose, from 0, or -1 for none");
  }

  SliderWord word(const text::CsvField& field, std::size_t slider) {
    const std::string_view token = trimmed(field.text);
    if (const auto word = parse_word(token)) return *word;
    if (token.empty()) return {};
    const text::Number number = text::parse_number(token);
    const bool is_number = number.fault == text::NumberFault::None;
    if (is_number && own_.in_degrees) {
      return word_of_degrees(number.value, slider, field);
    }
    if (is_number && number.value == std::floor(number.value) && is_of_16_bits(number.value)) {
      return {static_cast<std::int16_t>(number.value), true};
    }
    error("CSV013",
          fmt::format(
              "expected a word such as 0x2b01, 0X0000 or a whole number of 16 bits{}, found "
              "{}",
              own_.in_degrees ? ", or degrees" : " (--degrees takes degrees)", text::quoted(token)),
          field.at);
    return {};
  }

  SliderWord word_of_degrees(double degrees, std::size_t slider, const text::CsvField& field) {
    const RobotProject* project = reader_.options.project.get();
    const bool is_known = project != nullptr && slider < project->sliders.size() &&
                          project->sliders[slider].units_per_degree > 0;
    if (!is_known) {
      error("CSV014",
            fmt::format("expected a word such as 0x2b01: the project does not show slider {} in "
                        "degrees",
                        slider),
            field.at);
      return {};
    }
    const double base = slider < base_.size() ? base_[slider] : 0;
    const double value = std::round(degrees * project->sliders[slider].units_per_degree + base);
    if (!is_of_16_bits(value)) {
      error("CSV014",
            fmt::format("expected degrees that a word of 16 bits can say, found {}", degrees),
            field.at);
      return {};
    }
    return {static_cast<std::int16_t>(value), true};
  }

  void check_arrow(int arrow, int own, int count, const char* at) const {
    if (arrow < count && arrow != own) return;
    error("CSV012",
          arrow == own ? fmt::format("expected another pose than pose {} itself", own)
                       : fmt::format("expected a pose from 0 to {}, found {}", count - 1, arrow),
          at);
  }

  /// Sets arrows that the table leaves open to the next row; all must lead to a pose.
  void settle_arrows() {
    const int count = static_cast<int>(flow_.blocks.size());
    for (int i = 0; i < count; ++i) {
      Block& block = flow_.blocks[static_cast<std::size_t>(i)];
      if (block.normal == kOpenArrow) block.normal = i + 1 < count ? i + 1 : kNoBlock;
      const Arrows& places = arrows_[static_cast<std::size_t>(i)];
      check_arrow(block.normal, i, count, places.normal);
      check_arrow(block.branch, i, count, places.branch);
    }
    if (count == 0) error("CSV011", "expected a row a pose, found none", header_[0].at);
  }

  /// An arrow that the table leaves open.
  static constexpr int kOpenArrow = -2;

  const TableReader& reader_;
  const csv::ReadOptions& own_;
  const std::vector<text::CsvField>& header_;
  std::vector<Column> columns_;
  std::vector<Arrows> arrows_;
  std::vector<std::int16_t> base_;
  PoseFlow flow_;
};

}  // namespace

bool is_flow_header(const std::vector<text::CsvField>& header, const RobotProject* project) {
  bool has_time = false;
  for (const text::CsvField& field : header) {
    const auto column = column_of(field.text, project);
    if (!column) return false;
    has_time |= column->word == kTime;
  }
  return has_time && header.size() > 1;
}

std::optional<PoseFlow> read_flow(const TableReader& reader, text::CsvFields& fields,
                                  const std::vector<text::CsvField>& header) {
  return FlowReader(reader, header).read(fields);
}

}  // namespace kinefile::csv
