// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <utility>

#include "command.hpp"
#include "numbers.hpp"
#include "options.hpp"
#include "report.hpp"
#include "signals.hpp"
#include "skeleton_source.hpp"
#include "writing.hpp"

namespace kinefile::cli {
namespace {

struct Run {
  std::string file;
  std::string inputs;
  std::string servo_map;
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
  Writing writing;
  Reading reading;
};

using VariableValue = std::pair<std::size_t, std::int16_t>;

/// Reads "64=3" or "v64=3"; empty if it is not a variable and a value.
std::optional<VariableValue> parse_variable_value(std::string_view text) {
  if (text.starts_with('v')) text.remove_prefix(1);
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  const auto variable = parse_number<std::size_t>(text.substr(0, equals));
  const auto value = parse_number<std::int16_t>(text.substr(equals + 1));
  if (!variable || *variable >= kNumVariables || !value) return std::nullopt;
  return VariableValue{*variable, *value};
}

Result<std::vector<flow::Input>> load_inputs(const std::string& path) {
  if (path.empty()) return std::vector<flow::Input>();
  const auto bytes = FileBytes::open(path);
  if (!bytes) return fail(bytes.error());
  return parse_inputs(bytes->view(), path);
}

/// The settings for running the flow.
Result<RunSettings> settings_of(const Run& run, Diagnostics& diagnostics) {
  RunSettings settings;
  auto project = load_project(run.reading, diagnostics);
  if (!project) return fail(std::move(project.error()));
  settings.project = std::move(*project);
  if (!run.servo_map.empty()) {
    auto map = read_servo_map(run.servo_map, diagnostics);
    if (!map) return fail(std::move(map.error()));
    settings.servo_map = std::move(*map);
  }
  flow::RunOptions& options = settings.options;
  options.num_loops = run.num_loops;
  for (const std::string& word : run.variables) {
    options.variables.push_back(*parse_variable_value(word));
  }
  auto inputs = load_inputs(run.inputs);
  if (!inputs) return fail(std::move(inputs.error()));
  options.inputs = std::move(*inputs);
  if (run.disabled == "keep") options.disabled = flow::DisabledWords::Keep;
  if (run.disabled == "file") options.disabled = flow::DisabledWords::File;
  options.true_takes_branch = run.mif_true == "branch";
  options.skips_division_by_zero = run.skips_division_by_zero;
  if (run.max_ticks) options.max_ticks = *run.max_ticks;
  settings.tick_us = run.tick_us;
  settings.hold_seconds = run.hold_seconds;
  settings.max_seconds = run.max_seconds;
  return settings;
}

/// Whether a format is a table with a column a value.
bool is_table(const Format& format) { return format.conventions.has_columns_of_components; }

/// The format of the output: CSV on standard output, otherwise by the file's name.
const Format* format_of(const Run& run) {
  const bool is_plain = run.writing.out == "-" && run.writing.to.empty();
  return is_plain ? first_format(is_table) : output_format(run.writing);
}

/// Why the options do not fit together; empty if they do.
std::string misuse(const Run& run) {
  if (run.in_degrees && run.reading.project.empty()) {
    return "--degrees needs --project, which says what words mean";
  }
  if (run.is_relative && !run.in_degrees) return "--relative needs --degrees";
  const bool has_sliders = run.is_trace || run.servo_map.empty();
  if (run.in_degrees && (run.is_trace || !has_sliders)) {
    return "--degrees has no effect: it is for sliders, without --servo-map and --trace";
  }
  if (has_sliders && !run.reading.skeleton.empty()) {
    return "--skeleton has no effect without a motion of joints, by --servo-map";
  }
  if (has_sliders && run.writing.format.decimals) {
    return "--decimals has no effect without a motion of joints, by --servo-map";
  }
  if (run.is_trace) return {};
  const Format* format = format_of(run);
  if (format == nullptr) {
    return fmt::format("'{}' shows no format by its name; --to names it", run.writing.out);
  }
  const Conventions& conventions = format->conventions;
  const bool takes_components =
      conventions.writes.body_motions || conventions.has_columns_of_components;
  if (!takes_components && run.reading.skeleton.empty()) {
    return fmt::format("{} needs --skeleton, the robot or figure whose joints the servos turn",
                       format->name);
  }
  if (!is_table(*format) && run.servo_map.empty()) {
    return fmt::format(
        "{} needs --servo-map, which says what words mean to joints; without it a "
        "run is written as CSV",
        format->name);
  }
  return {};
}

/// Writes the values of the sliders, or the path of the flow.
Result<void> write_sliders(const Run& run, const PoseFlow& flow, const TimedRun& done) {
  auto file = OutputFile::create(run.writing.out, output_options(run.writing.may_replace));
  if (!file) return fail(file.error());
  const Sink sink = [&file](std::string_view piece) { return file->write(piece); };
  if (run.is_trace) {
    sink(trace_of(flow, done));
  } else {
    const RobotProject* const project = run.reading.loaded_project.get();
    write_run_csv({done, run.in_degrees ? project : nullptr, run.is_relative}, sink);
  }
  return file->commit();
}

/// Reports the diagnostics, and the error that ended the command, if any.
/// \returns the exit code
int report_run(const Run& run, const Diagnostics& noticed, Result<void> done,
               const Globals& globals) {
  const Diagnostics diagnostics = named(noticed, run.file, run.reading.is_strict);
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  if (done) return diagnostics.has_errors() ? kInvalid : kDone;
  return print_failure(std::move(done.error()), diagnostics, run.file, globals);
}

int run_command(const Run& run, const Globals& globals) {
  if (const std::string fault = misuse(run); !fault.empty()) return usage_error(globals, fault);
  int exit_code = kDone;
  const auto flow = load_flow(run.file, run.reading, globals, exit_code);
  if (!flow) return exit_code;
  const Format* const output = run.is_trace ? nullptr : format_of(run);
  const std::span<const Format* const> outputs(&output, output != nullptr ? 1 : 0);
  if (const auto effect = expect_options_of(run.reading, outputs); !effect) {
    print_error(effect.error(), globals);
    return kUsage;
  }
  Diagnostics noticed;
  const auto settings = settings_of(run, noticed);
  if (!settings) return report_run(run, noticed, fail(settings.error()), globals);
  const auto done = kinefile::run(*flow, *settings, noticed);
  if (!done) return report_run(run, noticed, fail(done.error()), globals);
  if (run.is_trace || !settings->servo_map) {
    return report_run(run, noticed, write_sliders(run, *flow, *done), globals);
  }
  auto document =
      document_of_run(*done, *settings->servo_map, source_of_skeleton(run.reading), noticed);
  if (!document) return report_run(run, noticed, fail(document.error()), globals);
  const Format& format = *format_of(run);
  Diagnostics diagnostics = named(noticed, run.file, run.reading.is_strict);
  return write_document({}, std::move(*document), format, run.writing, run.file, run.reading,
                        diagnostics, globals);
}

std::string check_variable_value(const std::string& text) {
  return parse_variable_value(text) ? ""
                                    : "expected VAR=VALUE, a variable from 0 to 255 and a value "
                                      "from -32768 to 32767, found '" +
                                          text + "'";
}

void add_time_options(CLI::App& command, Run& run) {
  const auto is_time = [](const std::string& text) { return check_number(text, 0, 1e12); };
  command
      .add_option("--loops", run.num_loops,
                  "How often each loop goes on before it is left (default 0)")
      ->check([](const std::string& text) { return check_count(text, 0, 1'000'000'000); })
      ->type_name("N");
  command
      .add_option("--hold", run.hold_seconds,
                  "The motion's button is held so long, and loops go on, instead of --loops")
      ->check(is_time)
      ->type_name("SECONDS");
  command
      .add_option("--tick-us", run.tick_us,
                  "A tick in microseconds; else the project's clock, or 1/60 s")
      ->check([](const std::string& text) { return check_number(text, 1, 1e9); })
      ->type_name("N");
  auto* seconds = command
                      .add_option("--max-seconds", run.max_seconds,
                                  "Stop after so long (default: after 216000 ticks, an hour)")
                      ->check(is_time)
                      ->type_name("SECONDS");
  command.add_option("--max-ticks", run.max_ticks, "Stop after so many ticks")
      ->check([](const std::string& text) { return check_count(text, 0, kMostRunTicks); })
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
  run->writing.out = "-";
  command->add_option("-o,--out", run->writing.out, "File to write; else standard output, as CSV")
      ->type_name("OUT");
  command
      ->add_option("--servo-map", run->servo_map,
                   "A YAML file that says what words mean to joints; then what the joints did is "
                   "written (.seq, .csv; with --skeleton .bvh, too)")
      ->type_name("FILE");
  add_writing_options(*command, run->writing);
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
