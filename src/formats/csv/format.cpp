// SPDX-License-Identifier: MIT
#include "formats/csv/format.hpp"

#include <array>

#include "formats/csv/flow_table.hpp"
#include "formats/csv/read.hpp"
#include "formats/files.hpp"
#include "text/printer.hpp"
#include "text/scanner.hpp"

namespace kinefile::csv {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".csv"};
constexpr std::array<std::string_view, 6> kReadOptions = {"degrees", "encoding", "fps",
                                                          "project", "relative", "skeleton"};
constexpr std::array<std::string_view, 11> kWriteOptions = {
    "channels", "decimals", "degrees", "form",     "map", "order",
    "project",  "relative", "robot",   "skeleton", "up"};

constexpr Kinds kWrites = {.motions = true, .flows = true};

/// Tables that are read begin with the time.
bool probe(std::string_view head) { return text::starts_with_ignoring_case(head, "time,"); }

Result<void> write(const Document& document, const WriteOptions& options, const Sink& sink,
                   Diagnostics&) {
  if (const PoseFlow* flow = std::get_if<PoseFlow>(&document.content)) {
    return write_flow(*flow, options, sink);
  }
  const Motion* motion = std::get_if<Motion>(&document.content);
  if (motion == nullptr && has_skeleton(document)) {
    return fail(make_error(ErrorKind::Usage, "CSV001",
                           "expected a motion to write as CSV, found a skeleton alone"));
  }
  if (auto taken = expect_kind(document, kWrites, "a motion to write as CSV"); !taken) return taken;
  text::Printer printer(sink, options.decimals);
  printer.print("time");
  for (const std::string& name : column_names(motion->skeleton)) {
    printer.print(',');
    printer.print(text::csv_field(name));
  }
  printer.print('\n');
  for (std::size_t f = 0; f < motion->clip.num_frames; ++f) {
    printer.print_exact(time_of_frame(motion->clip.timeline, f));
    for (const double value : motion->clip.row(f)) {
      printer.print(',');
      printer.print(value);
    }
    printer.print('\n');
  }
  if (!printer.finish()) return fail(make_error(ErrorKind::Io, "IO003", "the output was cut off"));
  return {};
}

}  // namespace

Format format() {
  Format format;
  format.name = "csv";
  format.description = "comma-separated values: a row a frame, a column a channel";
  format.extensions = kExtensions;
  format.probe = probe;
  format.read = read;
  format.write = write;
  format.facts = facts_of_layout;
  format.takes_skeleton = true;
  format.conventions.writes = kWrites;
  format.conventions.has_columns_of_components = true;
  // A table has a row a pose, each with its next and break.
  format.conventions.flow_format = FlowFormat::WordN;
  format.read_options = kReadOptions;
  format.write_options = kWriteOptions;
  format.conventions.keeps_times = true;
  return format;
}

}  // namespace kinefile::csv
