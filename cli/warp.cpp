// SPDX-License-Identifier: MIT
#include <memory>
#include <utility>

#include "options.hpp"
#include "report.hpp"
#include "retiming.hpp"

namespace kinefile::cli {
namespace {

struct Warp {
  std::string file;
  retime::DocumentWarp options;
  Retiming retiming;
};

int run(const Warp& warp, const Globals& globals) {
  int exit_code = kDone;
  auto document = load_motion(warp.file, warp.retiming.reading, globals, exit_code);
  if (!document) return exit_code;
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = warp.retiming.reading.is_strict;
  auto map = retime::warp_map(*document, warp.options, diagnostics);
  return finish_retiming(std::move(map), std::move(*document), warp.file, warp.retiming,
                         diagnostics, globals);
}

}  // namespace

void add_warp(CLI::App& app, Globals& globals) {
  auto warp = std::make_shared<Warp>();
  CLI::App* command =
      app.add_subcommand("warp", "Move frames to other times, and all between with them");
  command->add_option("FILE", warp->file, "File to read; - is standard input")->required();
  add_flags(*command, retime::warp_options(), warp->options);
  add_retiming_options(*command, warp->retiming, true);
  command->callback(
      [warp, &globals] { globals.run = [warp, &globals] { return run(*warp, globals); }; });
}

}  // namespace kinefile::cli
