// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "command.hpp"
#include "options.hpp"
#include "report.hpp"

namespace kinefile::cli {
namespace {

std::vector<std::string> readable_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (format.read != nullptr) names.emplace_back(format.name);
  }
  return names;
}

}  // namespace

std::string check_rate(const std::string& text) {
  double rate = 0;
  const bool is_number = CLI::detail::lexical_cast(text, rate);
  // Within these limits, frame times and times are finite numbers, too.
  const bool is_good = is_number && rate >= 1e-9 && rate <= 1e9;
  return is_good ? "" : fmt::format("expected frames a second above 0, found '{}'", text);
}

void add_reading_options(CLI::App& command, Reading& reading) {
  reading.command = &command;
  command.add_option("--from", reading.from, "Format of the input; else its content and name tell")
      ->check(CLI::IsMember(readable_formats()))
      ->type_name("FORMAT");
  command
      .add_option("--skeleton", reading.skeleton,
                  "The skeleton of a motion that needs one; else it is looked for beside the file")
      ->type_name("FILE");
  command
      .add_option("--project", reading.project,
                  "The RobovieMaker project (.rpj) of the robot that a flow is for")
      ->type_name("FILE");
  std::vector<TableFlag> flags;
  for (const Format& format : formats()) add_table(flags, format.read_options, reading.options);
  for (const TableFlag& flag : flags) add_flag(command, flag);
  command.add_flag("--lenient", reading.is_lenient,
                   "Repair the faults that docs/errors.md names, with a warning each");
  command.add_flag("--strict", reading.is_strict, "Take warnings for errors");
}

namespace {

void add_format(const Reading& reading, const Format* format) {
  if (format == nullptr) return;
  auto& known = reading.formats;
  if (std::find(known.begin(), known.end(), format) == known.end()) known.push_back(format);
}

}  // namespace

void note_format(const Format* format, const Reading& reading) {
  add_format(reading, format);
  if (format == nullptr || !format->takes_skeleton || reading.skeleton.empty()) return;
  reading.is_skeleton_used = true;
  add_format(reading, format_of_name(reading.skeleton));
}

namespace {

/// Records the format of a file; if the file could not be read, the expected format.
void note_format(const std::string& path, const Reading& reading, const Format* asked,
                 const Result<Document>& document) {
  const Format* format = document ? find_format(document->format) : asked;
  if (format == nullptr) format = format_of_name(path);
  note_format(format, reading);
}

bool asks_for_degrees(const Reading& reading) {
  const CLI::Option* option = reading.command->get_option_no_throw("--degrees");
  return option != nullptr && option->count() > 0;
}

}  // namespace

Result<void> expect_project(const Reading& reading) {
  if (!asks_for_degrees(reading) || !reading.project.empty()) return {};
  return fail(ErrorKind::Usage, "CLI001", "--degrees needs --project, which says what words mean");
}

ReadOptions read_options(const Reading& reading) {
  ReadOptions options = reading.options;
  options.lenient = reading.is_lenient;
  options.skeleton_name = reading.skeleton;
  options.project = reading.loaded_project;
  return options;
}

Result<Document> load_quietly(const std::string& path, const Reading& reading,
                              Diagnostics& diagnostics) {
  diagnostics.warnings_are_errors = reading.is_strict;
  if (auto named = expect_project(reading); !named) return fail(std::move(named.error()));
  auto project = load_project(reading, diagnostics);
  if (!project) return fail(std::move(project.error()));
  const ReadOptions options = read_options(reading);
  const Format* format = reading.from.empty() ? nullptr : find_format(reading.from);
  auto document = read_file(path, format, options, diagnostics);
  note_format(path, reading, format, document);
  return document;
}

std::optional<Document> load(const std::string& path, const Reading& reading,
                             const Globals& globals, int& exit_code) {
  Diagnostics diagnostics;
  auto document = load_quietly(path, reading, diagnostics);
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  if (document) return std::move(*document);
  if (!diagnostics.has_errors()) print_error(document.error(), globals);
  exit_code = worse(exit_code, exit_code_of(document.error()));
  return std::nullopt;
}

Result<std::optional<Document>> load_skeleton(const Reading& reading, Diagnostics& diagnostics) {
  if (reading.skeleton.empty()) return std::optional<Document>();
  Reading skeleton_reading = reading;
  skeleton_reading.from.clear();
  skeleton_reading.options.encoding.clear();
  skeleton_reading.skeleton.clear();
  auto skeleton = load_quietly(reading.skeleton, skeleton_reading, diagnostics);
  reading.is_skeleton_used = true;
  for (const Format* format : skeleton_reading.formats) add_format(reading, format);
  if (!skeleton) return fail(std::move(skeleton.error()));
  if (!has_skeleton(*skeleton)) {
    return fail(make_error(ErrorKind::Usage, "CLI001",
                           fmt::format("'{}' holds no skeleton", reading.skeleton)));
  }
  return std::optional<Document>(std::move(*skeleton));
}

Result<std::shared_ptr<const RobotProject>> load_project(const Reading& reading,
                                                         Diagnostics& diagnostics) {
  if (reading.project.empty() || reading.loaded_project) return reading.loaded_project;
  ReadOptions options;
  options.lenient = reading.is_lenient;
  options.opened = reading.options.opened;
  auto project = read_project_file(reading.project, options, diagnostics);
  if (!project) return fail(std::move(project.error()));
  reading.loaded_project = std::make_shared<const RobotProject>(std::move(*project));
  return reading.loaded_project;
}

std::optional<PoseFlow> load_flow(const std::string& path, const Reading& reading,
                                  const Globals& globals, int& exit_code) {
  auto document = load(path, reading, globals, exit_code);
  if (!document) return std::nullopt;
  if (auto* flow = std::get_if<PoseFlow>(&document->content)) return std::move(*flow);
  exit_code = usage_error(globals, fmt::format("'{}' holds no flow of poses", path));
  return std::nullopt;
}

int usage_error(const Globals& globals, const std::string& message) {
  print_error(make_error(ErrorKind::Usage, "CLI001", message), globals);
  return kUsage;
}

}  // namespace kinefile::cli
