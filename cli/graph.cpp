// SPDX-License-Identifier: MIT
#include <memory>

#include "command.hpp"
#include "options.hpp"
#include "report.hpp"
#include "signals.hpp"

namespace kinefile::cli {
namespace {

struct Graph {
  std::string file;
  std::string out = "-";
  bool may_replace = false;
  Reading reading;
};

int run(const Graph& graph, const Globals& globals) {
  int exit_code = kDone;
  const auto flow = load_flow(graph.file, graph.reading, globals, exit_code);
  if (!flow) return exit_code;
  if (finish_reading(graph.reading, globals, kDone) != kDone) return kUsage;
  auto out = OutputFile::create(graph.out, output_options(graph.may_replace));
  if (out) out->write(flow::graph(*flow));
  const auto committed = out ? out->commit() : Result<void>(fail(out.error()));
  if (committed) return kDone;
  print_error(committed.error(), globals);
  return exit_code_of(committed.error());
}

}  // namespace

void add_graph(CLI::App& app, Globals& globals) {
  auto graph = std::make_shared<Graph>();
  CLI::App* command = app.add_subcommand(
      "graph", "Draw a flow of servo poses as the editor does, for Graphviz: neato -n");
  command->add_option("FLOW", graph->file, "File to read; - is standard input")->required();
  command->add_option("-o,--out", graph->out, "File to write; else standard output")
      ->type_name("OUT");
  command->add_flag("--force", graph->may_replace, "Replace an existing file");
  add_reading_options(*command, graph->reading);
  command->callback(
      [graph, &globals] { globals.run = [graph, &globals] { return run(*graph, globals); }; });
}

}  // namespace kinefile::cli
