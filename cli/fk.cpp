// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "long_motions.hpp"
#include "many.hpp"
#include "options.hpp"
#include "report.hpp"
#include "signals.hpp"
#include "skeleton_source.hpp"
#include "writing.hpp"

namespace kinefile::cli {
namespace {

struct Fk {
  std::string file;
  std::string out = "-";
  std::string to;
  std::string frames;
  std::string joints;
  std::string unit = "file";
  bool is_rest = false;
  bool has_tips = false;
  bool has_rotations = false;
  bool has_directions = false;
  bool is_local = false;
  bool may_replace = false;
  bool is_comparing = false;
  Many many;
  Reading reading;
  WriteOptions format;  ///< set through the formats' tables of options for poses
};

FkOptions options_of(const Fk& fk) {
  FkOptions options;
  options.rest = fk.is_rest;
  options.frames = fk.frames;
  if (!fk.joints.empty()) options.joints = CLI::detail::split(fk.joints, ',');
  options.tips = fk.has_tips;
  options.rotations = fk.has_rotations;
  options.directions = fk.has_directions;
  options.local = fk.is_local;
  options.metres = fk.unit == "m";
  options.name = fk.file;
  return options;
}

Result<void> write_file(const std::string& name, const FkTable& table, const Format& format,
                        const Fk& fk, const OutputFiles& files) {
  auto written = write_content(
      name, files, [&](const Sink& sink) { return write_table(table, format, fk.format, sink); });
  return written ? files.commit() : written;
}

/// Writes the table of one file, if there is one.
/// \returns the exit code
int finish(const Result<FkTable>& table, const Format& format, const Fk& fk,
           const Globals& globals) {
  const auto written =
      table ? write_file(fk.out, *table, format, fk, files_on_disk(output_options(fk.may_replace)))
            : Result<void>(fail(table.error()));
  if (written) return kDone;
  print_error(written.error(), globals);
  return exit_code_of(written.error());
}

bool takes_poses(const Format& format) { return format.write_poses != nullptr; }

/// The format of the output; null if poses are not written in it.
const Format* output_format(const Fk& fk) {
  if (!fk.to.empty()) return find_format(fk.to);
  const Format* format = fk.out == "-" ? first_format(takes_poses) : format_of_name(fk.out);
  return format != nullptr && takes_poses(*format) ? format : nullptr;
}

/// The names of the formats that poses are written in.
std::vector<std::string> pose_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (takes_poses(format)) names.emplace_back(format.name);
  }
  return names;
}

/// The extensions of these formats, for a sentence: ".csv or .json".
std::string pose_extensions() {
  std::vector<std::string_view> extensions;
  for (const Format& format : formats()) {
    if (takes_poses(format)) extensions.push_back(format.extensions.front());
  }
  const std::string_view last = extensions.back();
  extensions.pop_back();
  return fmt::format("{} or {}", fmt::join(extensions, ", "), last);
}

/// Prints how far kinematics and the recorded poses of links differ, one row per link.
int compare(const Fk& fk, const Document& document, const Globals& globals) {
  if (fk.reading.skeleton.empty() || !std::holds_alternative<BodyMotion>(document.content)) {
    return usage_error(globals, "--compare needs a body motion and the model of --skeleton");
  }
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = fk.reading.is_strict;
  const auto deviations =
      compare_links(document, source_of_skeleton(fk.reading), fk.reading.is_lenient, diagnostics);
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  if (!deviations) return print_failure(deviations.error(), diagnostics, fk.file, globals);
  if (finish_reading(fk.reading, globals, kDone) != kDone) return kUsage;
  std::string text = "link,distance,distance_frame,degrees,degrees_frame\n";
  for (const robot::LinkDeviation& deviation : *deviations) {
    text += fmt::format("{},{},{},{},{}\n", deviation.link, deviation.distance,
                        deviation.distance_frame, deviation.degrees, deviation.degrees_frame);
  }
  print_data(text);
  return diagnostics.has_errors() ? kInvalid : kDone;
}

/// Opens the motion of a file that is too large for memory; empty if it has to be read whole.
std::optional<LongMotion> open_long_for(const Fk& fk, const std::string& path,
                                        const Reading& reading, Diagnostics& diagnostics) {
  if (fk.is_comparing || fk.is_rest) return std::nullopt;
  return open_long(path, reading, false, diagnostics);
}

/// The table of one of many files.
Result<FkTable> table_of(const Fk& fk, const std::string& path, const Reading& reading,
                         Diagnostics& diagnostics) {
  FkOptions options = options_of(fk);
  options.name = path;
  if (const auto motion = open_long_for(fk, path, reading, diagnostics)) {
    return kinefile::fk(*motion, options);
  }
  auto document = load_quietly(path, reading, diagnostics);
  if (!document) return fail(std::move(document.error()));
  auto placed = place(*document, source_of_skeleton(reading), reading.is_lenient, diagnostics);
  if (!placed) return fail(std::move(placed.error()));
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  return kinefile::fk(std::move(*placed), options);
}

/// Writes the table of one of many files.
Result<std::vector<std::string>> make_table(const Fk& fk, const ManyFile& file,
                                            const Reading& reading, const OutputFiles& files,
                                            Diagnostics& diagnostics) {
  const auto table = table_of(fk, file.path, reading, diagnostics);
  if (!table) return fail(table.error());
  auto written = write_file(file.target, *table, *file.to, fk, files);
  if (!written) return fail(std::move(written.error()));
  return std::vector<std::string>{file.target};
}

int run_on_many(const Fk& fk, const Globals& globals) {
  ManyWork work;
  work.reading = &fk.reading;
  work.may_replace = fk.may_replace;
  work.to = output_format(fk);
  work.writes_poses = true;
  work.make = [&fk](const ManyFile& file, const Reading& reading, const OutputFiles& files,
                    Diagnostics& diagnostics) {
    return make_table(fk, file, reading, files, diagnostics);
  };
  return run_many(fk.many, work, globals);
}

/// Refuses options that have no effect.
int expect_effects(const Fk& fk, const Format& format, const Globals& globals) {
  const int exit_code = finish_reading(fk.reading, globals, kDone);
  const Format* const output = &format;
  const auto effective = expect_pose_options_of(fk.reading, {&output, 1});
  if (exit_code != kDone || effective) return exit_code;
  print_error(effective.error(), globals);
  return kUsage;
}

/// Places a motion that is too large for memory; empty if it is not.
std::optional<int> run_on_long(const Fk& fk, const Format& format, const Globals& globals) {
  Diagnostics diagnostics;
  const auto motion = open_long_for(fk, fk.file, fk.reading, diagnostics);
  if (!motion) return std::nullopt;
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  if (expect_effects(fk, format, globals) != kDone) return kUsage;
  return finish(kinefile::fk(*motion, options_of(fk)), format, fk, globals);
}

int run(const Fk& fk, const Globals& globals) {
  if (globals.takes_many) return run_on_many(fk, globals);
  const Format* format = output_format(fk);
  if (format == nullptr) {
    return usage_error(globals, fmt::format("'{}' shows no format that poses are written in; "
                                            "name it {}, or say --to",
                                            fk.out, pose_extensions()));
  }
  if (const auto done = run_on_long(fk, *format, globals)) return *done;
  int exit_code = kDone;
  const auto document = load(fk.file, fk.reading, globals, exit_code);
  if (!document) return exit_code;
  if (fk.is_comparing) return compare(fk, *document, globals);
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = fk.reading.is_strict;
  auto placed =
      place(*document, source_of_skeleton(fk.reading), fk.reading.is_lenient, diagnostics);
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  if (!placed) return print_failure(placed.error(), diagnostics, fk.file, globals);
  if (diagnostics.has_errors()) return kInvalid;
  if (expect_effects(fk, *format, globals) != kDone) return kUsage;
  return finish(kinefile::fk(std::move(*placed), options_of(fk)), *format, fk, globals);
}

}  // namespace

void add_fk(CLI::App& app, Globals& globals) {
  auto fk = std::make_shared<Fk>();
  CLI::App* command =
      app.add_subcommand("fk", "Place every joint in the world (forward kinematics)");
  if (globals.takes_many) {
    add_inputs(*command, fk->many);
  } else {
    command->add_option("FILE", fk->file, "File to read; - is standard input")->required();
  }
  CLI::Option* out =
      command
          ->add_option("-o,--out", fk->out,
                       fmt::format("File to write, {}; else standard output", pose_extensions()))
          ->type_name("OUT");
  command->add_option("--to", fk->to, "Format of the output")
      ->check(CLI::IsMember(pose_formats()))
      ->type_name("FORMAT");
  CLI::Option* rest = command->add_flag("--rest", fk->is_rest, "The rest pose, as frame 0");
  command
      ->add_option("--frames", fk->frames, "Frames A to B, B not included; either may be left out")
      ->type_name("A:B[:STEP]")
      ->excludes(rest);
  command->add_option("--joints", fk->joints, "These joints alone")->type_name("A,B,...");
  command->add_flag("--tips", fk->has_tips, "A row NAME.tip after each joint that has a tip");
  command->add_flag("--rotations", fk->has_rotations, "Add the rotation, qw qx qy qz");
  command->add_flag("--direction", fk->has_directions, "Add the direction of the bone, ux uy uz");
  command->add_flag("--local", fk->is_local, "In the frame of each joint's parent");
  command->add_option("--unit", fk->unit, "Unit of lengths: the file's own, or metres")
      ->check(CLI::IsMember({"file", "m"}))
      ->default_str("file")
      ->type_name("UNIT");
  for (const Format& format : formats()) add_flags(*command, format.pose_options, fk->format);
  command->get_option("--float32")->excludes(command->get_option("--float64"));
  CLI::Option* compare =
      command->add_flag("--compare", fk->is_comparing,
                        "How far kinematics and the recorded poses of links differ at most, and in "
                        "which frame (.seq with --skeleton)");
  add_many_options(*command, fk->many, {out, compare});
  command->add_flag("--force", fk->may_replace, "Replace an existing file");
  add_reading_options(*command, fk->reading);
  command->callback([fk, &globals] { globals.run = [fk, &globals] { return run(*fk, globals); }; });
}

}  // namespace kinefile::cli
