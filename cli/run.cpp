// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "command.hpp"
#include "report.hpp"
#include "run_inputs.hpp"
#include "run_output.hpp"

namespace kinefile::cli {
namespace {

/// A run is kept in memory: this is two days.
constexpr double kMostTicks = 10'000'000;

struct Run {
  std::string file;
  std::string out = "-";
  std::string inputs;
  std::vector<std::string> variables;
  std::string disabled = "base";
  std::string mif_true = "branch";
  std::uint64_t num_loops = 0;
  std::optional<double> hold_seconds;
  std::optional<double> tick_us;
  std::optional<double> max_seconds;
  std::optional<std::uint64_t> max_ticks;
  bool skips_division_by_zero = false;
  bool is_trace = false;
  bool in_degrees = false;
  bool is_relative = false;
  bool may_replace = false;
  Reading reading;
};

/// How long a tick is: 1/60 s, or what the project or `--tick-us` says.
double tick_seconds_of(const Run& run, const RobotProject* project) {
  if (run.tick_us) return *run.tick_us == 16667 ? 1.0 / 60 : *run.tick_us * 1e-6;
  return project != nullptr ? project->tick_seconds : 1.0 / 60;
}

/// How many ticks begin within some seconds.
std::uint64_t ticks_within(double seconds, double tick_seconds) {
  const double ticks = std::ceil(seconds / tick_seconds - 1e-9);
  return static_cast<std::uint64_t>(std::min(std::max(ticks, 0.0), 1e15));
}

Result<std::vector<FlowInput>> load_inputs(const std::string& path) {
  if (path.empty()) return std::vector<FlowInput>();
  const auto bytes = FileBytes::open(path);
  if (!bytes) return fail(bytes.error());
  return parse_inputs(bytes->view(), path);
}

Result<RunOptions> options_of(const Run& run, const RobotProject* project, double tick_seconds) {
  RunOptions options = project != nullptr ? run_options_of(*project) : RunOptions{};
  options.num_loops = run.num_loops;
  if (run.hold_seconds) options.hold_ticks = ticks_within(*run.hold_seconds, tick_seconds);
  for (const std::string& word : run.variables) {
    options.variables.push_back(*parse_variable_value(word));
  }
  auto inputs = load_inputs(run.inputs);
  if (!inputs) return fail(std::move(inputs.error()));
  options.inputs = std::move(*inputs);
  if (run.disabled == "keep") options.disabled = DisabledWords::Keep;
  if (run.disabled == "file") options.disabled = DisabledWords::File;
  options.true_takes_branch = run.mif_true == "branch";
  options.skips_division_by_zero = run.skips_division_by_zero;
  if (run.max_ticks) options.max_ticks = *run.max_ticks;
  if (run.max_seconds) {
    options.max_ticks = std::min(ticks_within(*run.max_seconds, tick_seconds),
                                 static_cast<std::uint64_t>(kMostTicks));
  }
  return options;
}

/// What was noticed in a run, with the file that it is about.
Diagnostics named(const Diagnostics& noticed, const Run& run) {
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = run.reading.is_strict;
  for (Diagnostic item : noticed.items()) {
    if (item.place.source.empty()) item.place.source = run.file;
    diagnostics.add(std::move(item));
  }
  return diagnostics;
}

/// What is wrong with what was asked for; empty if nothing is.
std::string misuse(const Run& run) {
  if (run.in_degrees && run.reading.project.empty()) {
    return "--degrees needs --project, which says what words mean";
  }
  if (run.is_relative && !run.in_degrees) return "--relative needs --degrees";
  // Here a motion (.seq, .bvh) is to be made of the run, once there is a servo map.
  const Format* format = run.out == "-" ? nullptr : format_of_name(run.out);
  if (format != nullptr && format->name != "csv" && !run.is_trace) {
    return fmt::format("'{}' shows no format that a run is written in; that is CSV", run.out);
  }
  return {};
}

Result<void> write(const Run& run, const PoseFlow& flow, const RunOptions& options,
                   const RunTable& table) {
  auto file = OutputFile::create(run.out, run.may_replace);
  if (!file) return fail(file.error());
  const Sink sink = [&file](std::string_view piece) { return file->write(piece); };
  if (run.is_trace) {
    sink(trace_of(flow, table.run, options, table.tick_seconds));
  } else {
    write_run_csv(table, sink);
  }
  return file->commit();
}

/// Runs a flow and writes what it did.
Result<void> execute(const Run& run, const PoseFlow& flow, Diagnostics& diagnostics) {
  const auto project = load_project(run.reading, diagnostics);
  if (!project) return fail(project.error());
  const double tick_seconds = tick_seconds_of(run, project->get());
  const auto options = options_of(run, project->get(), tick_seconds);
  if (!options) return fail(options.error());
  const auto done = run_flow(flow, *options, diagnostics);
  if (!done) return fail(done.error());
  const RunTable table = {*done, tick_seconds, run.in_degrees ? project->get() : nullptr,
                          run.is_relative};
  return write(run, flow, *options, table);
}

int run_command(const Run& run, const Globals& globals) {
  if (const std::string fault = misuse(run); !fault.empty()) return usage_error(globals, fault);
  int exit_code = kDone;
  const auto flow = load_flow(run.file, run.reading, globals, exit_code);
  if (!flow) return exit_code;
  Diagnostics noticed;
  auto done = execute(run, *flow, noticed);
  const Diagnostics diagnostics = named(noticed, run);
  print_diagnostics(stderr, diagnostics, globals);
  if (!done) {
    if (done.error().place.source.empty()) done.error().place.source = run.file;
    if (!diagnostics.has_errors()) print_error(done.error(), globals);
    return exit_code_of(done.error());
  }
  return diagnostics.has_errors() ? kInvalid : kDone;
}

std::string check_variable_value(const std::string& text) {
  return parse_variable_value(text) ? ""
                                    : "expected VAR=VALUE, a variable from 0 to 255 and a value "
                                      "from -32768 to 32767, found '" +
                                          text + "'";
}

void add_time_options(CLI::App& command, Run& run) {
  const auto is_time = CLI::Range(0.0, 1e12);
  command
      .add_option("--loops", run.num_loops,
                  "How often each loop goes on before it is left (default 0)")
      ->type_name("N");
  command
      .add_option("--hold", run.hold_seconds,
                  "The motion's button is held so long, and loops go on, instead of --loops")
      ->check(is_time)
      ->type_name("SECONDS");
  command
      .add_option("--tick-us", run.tick_us,
                  "A tick in microseconds; else the project's clock, or 1/60 s")
      ->check(CLI::Range(1.0, 1e9))
      ->type_name("N");
  auto* seconds = command
                      .add_option("--max-seconds", run.max_seconds,
                                  "Stop after so long (default: after 216000 ticks, an hour)")
                      ->check(is_time)
                      ->type_name("SECONDS");
  command.add_option("--max-ticks", run.max_ticks, "Stop after so many ticks")
      ->check(CLI::Range(0.0, kMostTicks))
      ->excludes(seconds)
      ->type_name("N");
}

void add_choices(CLI::App& command, Run& run) {
  command.add_option("--set", run.variables, "A variable at the start: 64=3; may be given again")
      ->check(check_variable_value)
      ->allow_extra_args(false)
      ->type_name("VAR=VALUE");
  command
      .add_option("--inputs", run.inputs,
                  "A CSV of what happens: columns tick, held (0 or 1) and variables v64, ...; an "
                  "empty cell changes nothing")
      ->type_name("FILE");
  command
      .add_option("--disabled", run.disabled,
                  "What disabled words (0X) do: the base pose, keep where it is, or the file's")
      ->check(CLI::IsMember({"base", "keep", "file"}))
      ->default_str("base")
      ->type_name("WHAT");
  command
      .add_option("--mif-true", run.mif_true, "The way that branch blocks take where they are true")
      ->check(CLI::IsMember({"branch", "normal"}))
      ->default_str("branch")
      ->type_name("WAY");
  command.add_flag("--skip-division-by-zero", run.skips_division_by_zero,
                   "Leave a variable that would be divided by zero, with a warning");
}

}  // namespace

void add_run(CLI::App& app, Globals& globals) {
  auto run = std::make_shared<Run>();
  CLI::App* command =
      app.add_subcommand("run", "Run a flow of servo poses tick by tick, as its robot would");
  command->add_option("FLOW", run->file, "File to read; - is standard input")->required();
  command->add_option("-o,--out", run->out, "CSV to write; else standard output")->type_name("OUT");
  command->add_flag("--force", run->may_replace, "Replace an existing file");
  command->add_flag("--trace", run->is_trace, "Print the way that the flow took instead");
  command->add_flag("--degrees", run->in_degrees,
                    "Sliders in degrees under their names, where the project has them");
  command->add_flag("--relative", run->is_relative, "Degrees from the base pose on");
  add_time_options(*command, *run);
  add_choices(*command, *run);
  add_reading_options(*command, run->reading);
  command->callback(
      [run, &globals] { globals.run = [run, &globals] { return run_command(*run, globals); }; });
}

}  // namespace kinefile::cli
