// SPDX-License-Identifier: MIT
#include <memory>

#include "options.hpp"
#include "report.hpp"
#include "retiming.hpp"

namespace kinefile::cli {
namespace {

struct Align {
  std::string file;
  std::string reference;
  retime::AlignOptions options;
  Retiming retiming;
};

int run(Align& align, const Globals& globals) {
  int exit_code = kDone;
  const Reading& reading = align.retiming.reading;
  auto document = load_motion(align.file, reading, globals, exit_code);
  const auto reference = load_motion(align.reference, reading, globals, exit_code);
  if (!document || !reference) return exit_code;
  if (!has_skeleton(*document) || !has_skeleton(*reference)) {
    return usage_error(globals, "align needs motions with skeletons; convert them first");
  }
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = reading.is_strict;
  auto map = retime::align_map(*document, *reference, align.options, diagnostics);
  // Without an output file the map is printed.
  const bool has_output = align.retiming.writing.out != "-" || !align.retiming.writing.to.empty();
  align.retiming.prints_table |= !has_output;
  return finish_retiming(std::move(map), std::move(*document), align.file, align.retiming,
                         diagnostics, globals);
}

}  // namespace

void add_align(CLI::App& app, Globals& globals) {
  auto align = std::make_shared<Align>();
  CLI::App* command = app.add_subcommand(
      "align", "Find the times that bring one motion onto another; print or apply them");
  command->add_option("A", align->file, "The motion to bring onto the other")->required();
  command->add_option("B", align->reference, "The motion that sets the times")->required();
  add_flags(*command, retime::align_options(), align->options);
  add_retiming_options(*command, align->retiming, true, false);
  command->callback(
      [align, &globals] { globals.run = [align, &globals] { return run(*align, globals); }; });
}

}  // namespace kinefile::cli
