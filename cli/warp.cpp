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

int run_on_many(const Warp& warp, const Globals& globals) {
  const auto retime = [&warp](Document& document, Diagnostics& diagnostics) -> Result<void> {
    const auto map = retime::warp_map(document, warp.options, diagnostics);
    if (!map) return fail(map.error());
    return retime::apply(document, *map, options_of(warp.retiming), diagnostics);
  };
  return retime_many(warp.retiming, retime, {}, globals);
}

int run(const Warp& warp, const Globals& globals) {
  if (globals.takes_many) return run_on_many(warp, globals);
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
  add_retiming_inputs(*command, warp->file, warp->retiming, globals);
  add_flags(*command, retime::warp_options(), warp->options);
  add_retiming_options(*command, warp->retiming, true, true);
  command->callback(
      [warp, &globals] { globals.run = [warp, &globals] { return run(*warp, globals); }; });
}

}  // namespace kinefile::cli
