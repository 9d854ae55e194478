// SPDX-License-Identifier: MIT
#include "formats/csv/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/csv/columns.hpp"
#include "formats/csv/flow_table.hpp"
#include "formats/files.hpp"
#include "formats/quaternion_faults.hpp"
#include "formats/table_rows.hpp"
#include "text/attempts.hpp"
#include "text/csv_fields.hpp"
#include "text/decode.hpp"
#include "text/numbers.hpp"
#include "text/row_template.hpp"

namespace kinefile::csv {
namespace {

/// Reads a number; false after an error.
/// \param is_time  whether it is the time of its row, which is checked with the other times
bool parse_value(const TableReader& reader, text::CsvFields& fields, bool is_time,
                 std::vector<double>& values) {
  const char* const at = fields.position();
  const auto plain = fields.take_plain();
  const text::CsvField in_quotes = plain ? text::CsvField{} : fields.take_field();
  if (!reader.are_quotes_good(fields)) return false;
  const std::string_view token = plain ? *plain : std::string_view(in_quotes.text);
  const text::Number number = text::parse_number(token);
  if (number.fault != text::NumberFault::None) {
    reader.error(
        "CSV004",
        fmt::format("expected a number, found {}", token.empty() ? "nothing" : text::quoted(token)),
        at);
    return false;
  }
  if (!std::isfinite(number.value) && !is_time) {
    text::report(reader.source, reader.diagnostics, Severity::Warning, "CSV019",
                 fmt::format("expected a finite number, found {}", text::quoted(token)), at);
  }
  values.push_back(number.value);
  return true;
}

/// Reads one row, or an empty line; false after an error.
/// \param values  reused from row to row
bool parse_row(const TableReader& reader, text::CsvFields& fields, std::vector<double>& values,
               TableRows& rows) {
  const char* const start = fields.position();
  if (fields.take_line_end()) return true;
  values.clear();
  do {
    if (!parse_value(reader, fields, values.empty(), values)) return false;
  } while (fields.take_comma());
  if (values.size() != rows.num_columns) {
    reader.error("CSV005",
                 fmt::format("expected {} fields, found {}", rows.num_columns, values.size()),
                 start);
    return false;
  }
  rows.append(values, start, reader.source.end());
  fields.take_line_end();
  return true;
}

/// Whether a row has one comma between each two numbers, and nothing else.
bool has_only_commas(std::string_view text, const simd::RowTemplate& row) {
  const std::span<const std::uint32_t> gaps(row.gap_sizes());
  const std::span<const std::uint32_t> inner = gaps.subspan(1, gaps.size() - 2);
  const auto num_commas = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
  return gaps.front() == 0 && num_commas == inner.size() &&
         std::all_of(inner.begin(), inner.end(), [](std::uint32_t size) { return size == 1; });
}

/// How rows like the first one are read; empty if its text has other numbers beside its own.
/// \param end  of its text
std::optional<text::RowReader> reader_like_first(const TableRows& rows, const char* end) {
  const char* const first = rows.starts.front();
  const std::string_view text(first, static_cast<std::size_t>(end - first));
  const auto row = text::template_of_row(text, rows.num_columns);
  if (!row) return std::nullopt;
  return has_only_commas(text, *row) ? text::comma_row_reader(rows.num_columns)
                                     : text::template_row_reader(*row);
}

/// Reads the rows; false after an error.
/// \param like  out: how rows like the first one are read, if they can be
bool parse_rows(const TableReader& reader, text::CsvFields& fields, TableRows& rows,
                std::optional<text::RowReader>& like) {
  text::Attempts attempts;
  std::vector<double> values;
  while (!fields.is_at_end()) {
    if (!simd::kReadsTemplateRows || !like || !attempts.is_due()) {
      const bool is_first = rows.starts.empty();
      if (!parse_row(reader, fields, values, rows)) return false;
      if (is_first && !rows.starts.empty()) like = reader_like_first(rows, fields.position());
      continue;
    }
    const char* const begin = fields.position();
    fields.move_to(append_rows(begin, reader.source.end(), *like, rows));
    attempts.made(fields.position() != begin);
  }
  return true;
}

/// \param values  of the group's columns
Component component_of(const Group& group, const Timeline& timeline, std::size_t num_frames,
                       Array<double> values) {
  Component component;
  component.kind = group.kind;
  component.content = group.content;
  component.pose_form = group.pose_form;
  component.num_parts = group.columns.size() / component.width();
  component.part_names = group.names;
  component.is_root_relative =
      group.kind == ComponentKind::Vectors && group.content.ends_with(kRootRelativeSuffix);
  if (component.is_root_relative) {
    component.content.resize(component.content.size() - kRootRelativeSuffix.size());
  }
  component.num_frames = num_frames;
  component.timeline = timeline;
  component.values = std::move(values);
  const Rows frames = component.mutate();
  for (const FollowingPart& one : group.following) {
    for (std::size_t f = 0; f < component.num_frames; ++f) {
      frames[f][one.part] = value_of(one.dof, frames[f][one.leader]);
    }
  }
  return component;
}

/// Reports quaternions that are no rotations or of another length than 1.
void check_quaternions(const TableReader& reader, const Component& component,
                       const TableRows& rows) {
  const bool has_quaternions =
      component.kind == ComponentKind::Poses && component.pose_form == PoseForm::Quaternion;
  if (!has_quaternions) return;
  QuaternionFaults faults;
  for (std::size_t f = 0; f < component.num_frames; ++f) {
    look_at_quaternions(component.row(f), f, rows.starts[f], faults);
  }
  tell_quaternion_faults(reader.source, faults, component.content, {"CSV017", "CSV018"},
                         reader.diagnostics);
}

/// A part of a file that is not in the text of its beginning.
struct Rest {
  const ByteSource& bytes;
  std::size_t offset = 0;
};

/// Reads the components of a robot's motion after a header; empty after an error.
/// \param rest  more rows, behind the text; null: there are none
std::optional<BodyMotion> read_body(const TableReader& reader, text::CsvFields& fields,
                                    const std::vector<text::CsvField>& header, const Rest* rest) {
  const std::vector<Group> groups = parse_header(reader, header);
  TableRows rows;
  rows.num_columns = header.size();
  for (const Group& group : groups) rows.add_part(group.columns);
  std::optional<text::RowReader> like;
  if (reader.diagnostics.has_errors() || !parse_rows(reader, fields, rows, like)) {
    return std::nullopt;
  }
  const bool are_all = rest == nullptr || (like && append_rows(rest->bytes, rest->offset, *like,
                                                               reader.source.end(), rows));
  if (!are_all) return std::nullopt;
  const auto timeline =
      timeline_of_rows(reader.source, rows, reader.options.fps,
                       {"CSV006", "CSV007", "CSV016", "CSV021", "CSV022"}, reader.diagnostics);
  if (!timeline) return std::nullopt;
  BodyMotion motion;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    motion.components.push_back(
        component_of(groups[i], *timeline, rows.starts.size(), std::move(rows.parts[i].values)));
    check_quaternions(reader, motion.components.back(), rows);
  }
  return motion;
}

/// A table and its kept data, without its content.
Document table_document(const text::DecodedText& decoded) {
  Document document;
  document.format = "csv";
  document.kept = Kept(layout_of(decoded));
  return document;
}

Result<Document> read_alone(std::string_view bytes, const kinefile::ReadOptions& options,
                            Diagnostics& diagnostics) {
  auto decoded = text::decode(bytes, options.encoding, options.source_name, diagnostics);
  if (!decoded) return fail(std::move(decoded.error()));
  const text::Source source(options.source_name, decoded->view());
  const TableReader reader{source, options, diagnostics};
  text::CsvFields fields(source.text());
  const std::vector<text::CsvField> header = fields.take_record();
  if (!reader.are_quotes_good(fields)) return fail(diagnostics.first_error());
  Document document = table_document(*decoded);
  if (is_flow_header(header, options.project.get())) {
    auto flow = read_flow(reader, fields, header);
    if (!flow) return fail(diagnostics.first_error());
    document.content = std::move(*flow);
  } else {
    auto motion = read_body(reader, fields, header, nullptr);
    if (!motion) return fail(diagnostics.first_error());
    document.content = std::move(*motion);
  }
  return document;
}

/// Whether nothing is said of a place behind a text, of which only the beginning is there.
bool are_all_within(const Diagnostics& diagnostics, const text::Source& source) {
  const std::size_t end = source.place_of(source.end()).line;
  return std::none_of(diagnostics.items().begin(), diagnostics.items().end(),
                      [end](const Diagnostic& item) { return item.place.line >= end; });
}

/// Where the header and two rows end; 0 if there are fewer lines.
std::size_t end_of_second_row(std::string_view text) {
  std::size_t end = 0;
  for (int line = 0; line < 3; ++line) {
    end = text.find('\n', end) + 1;
    if (end == 0) return 0;
  }
  return end;
}

/// Reads a table whose first rows are in memory.
std::optional<Document> read_after(std::string_view head, const ByteSource& bytes,
                                   const kinefile::ReadOptions& options, Diagnostics& diagnostics) {
  const auto decoded = text::decode(head, options.encoding, options.source_name, diagnostics);
  if (!decoded || !decoded->storage.empty()) return std::nullopt;
  const text::Source source(options.source_name, decoded->view());
  const TableReader reader{source, options, diagnostics};
  text::CsvFields fields(source.text());
  const std::vector<text::CsvField> header = fields.take_record();
  const bool is_plain = reader.are_quotes_good(fields) && !fields.is_at_end() &&
                        !is_flow_header(header, options.project.get());
  if (!is_plain) return std::nullopt;
  const Rest rest{bytes, head.size()};
  auto motion = read_body(reader, fields, header, &rest);
  if (!motion || diagnostics.has_errors() || !are_all_within(diagnostics, source)) {
    return std::nullopt;
  }
  Document document = table_document(*decoded);
  document.content = std::move(*motion);
  return document;
}

}  // namespace

Result<Document> read(std::string_view bytes, const kinefile::ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

std::optional<Result<Document>> read_pieces(const ByteSource& bytes,
                                            const kinefile::ReadOptions& options,
                                            Diagnostics& diagnostics) {
  const Array<char> head = text::read_head_to(bytes, end_of_second_row);
  if (head.empty()) return std::nullopt;
  auto document = read_after({head.data(), head.size()}, bytes, options, diagnostics);
  if (!document) return std::nullopt;
  return *std::move(document);
}

}  // namespace kinefile::csv
