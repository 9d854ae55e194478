// SPDX-License-Identifier: MIT
#include "formats/csv/format.hpp"

#include <array>

#include "formats/csv/flow_table.hpp"
#include "formats/csv/read.hpp"
#include "text/printer.hpp"
#include "text/scanner.hpp"

namespace kinefile::csv {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".csv"};

/// Tables that are read begin with the time.
bool probe(std::string_view head) { return text::starts_with_ignoring_case(head, "time,"); }

Result<void> write(const Document& document, const WriteOptions& options, const Sink& sink,
                   Diagnostics&) {
  if (const PoseFlow* flow = std::get_if<PoseFlow>(&document.content)) {
    return write_flow(*flow, options, sink);
  }
  const Motion* motion = std::get_if<Motion>(&document.content);
  if (motion == nullptr) {
    return fail(make_error(ErrorKind::Usage, "CSV001",
                           "expected a motion to write as CSV, found a skeleton alone"));
  }
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
  return {"csv",       "comma-separated values: a row a frame, a column a channel",
          kExtensions, {},
          probe,       read,
          write,       true,
          nullptr,     true};
}

}  // namespace kinefile::csv
