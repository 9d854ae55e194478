// SPDX-License-Identifier: MIT
#include "formats/csv/read.hpp"

#include <fmt/format.h>

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
  rows.append(values, start);
  fields.take_line_end();
  return true;
}

/// Reads the rows; false after an error.
bool parse_rows(const TableReader& reader, text::CsvFields& fields, TableRows& rows) {
  std::optional<simd::RowTemplate> plain;
  text::Attempts attempts;
  std::vector<double> values;
  while (!fields.is_at_end()) {
    if (!simd::kReadsTemplateRows || rows.starts.empty() || !attempts.is_due()) {
      if (!parse_row(reader, fields, values, rows)) return false;
      continue;
    }
    const char* const begin = fields.position();
    if (!plain) {
      const char* const first = rows.starts.front();
      plain =
          text::template_of_row({first, static_cast<std::size_t>(begin - first)}, rows.num_columns)
              .value_or(simd::RowTemplate());
    }
    fields.move_to(append_like_rows(begin, reader.source.end(), *plain, rows));
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

/// Reads the components of a robot's motion after a header; empty after an error.
std::optional<BodyMotion> read_body(const TableReader& reader, text::CsvFields& fields,
                                    const std::vector<text::CsvField>& header) {
  const std::vector<Group> groups = parse_header(reader, header);
  TableRows rows;
  rows.num_columns = header.size();
  for (const Group& group : groups) rows.add_part(group.columns);
  if (reader.diagnostics.has_errors() || !parse_rows(reader, fields, rows)) return std::nullopt;
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

Result<Document> read_alone(std::string_view bytes, const kinefile::ReadOptions& options,
                            Diagnostics& diagnostics) {
  auto decoded = text::decode(bytes, options.encoding, options.source_name, diagnostics);
  if (!decoded) return fail(std::move(decoded.error()));
  const text::Source source(options.source_name, decoded->view());
  const TableReader reader{source, options, diagnostics};
  text::CsvFields fields(source.text());
  const std::vector<text::CsvField> header = fields.take_record();
  if (!reader.are_quotes_good(fields)) return fail(diagnostics.first_error());
  Document document;
  document.format = "csv";
  document.kept = Kept(layout_of(*decoded));
  if (is_flow_header(header, options.project.get())) {
    auto flow = read_flow(reader, fields, header);
    if (!flow) return fail(diagnostics.first_error());
    document.content = std::move(*flow);
  } else {
    auto motion = read_body(reader, fields, header);
    if (!motion) return fail(diagnostics.first_error());
    document.content = std::move(*motion);
  }
  return document;
}

}  // namespace

Result<Document> read(std::string_view bytes, const kinefile::ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

}  // namespace kinefile::csv
