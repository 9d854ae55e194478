// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "command.hpp"
#include "folders.hpp"
#include "json_output.hpp"
#include "options.hpp"
#include "report.hpp"
#include "skeleton_source.hpp"

namespace kinefile::cli {
namespace {

struct Check {
  std::vector<std::string> files;
  bool is_json = false;
  bool is_recursive = false;
  Reading reading;
};

Json json_of_diagnostic(const Diagnostic& item) {
  return {{"file", item.place.source},   {"line", item.place.line},
          {"column", item.place.column}, {"severity", severity_name(item.severity)},
          {"code", item.code},           {"message", item.message}};
}

std::string source_name(const std::string& path) { return path == "-" ? "<stdin>" : path; }

void print_summary(const std::string& path, const Diagnostics& diagnostics,
                   const Globals& globals) {
  if (globals.is_quiet) return;
  const auto count = [&diagnostics](Severity severity, std::string_view word) {
    const std::size_t number = diagnostics.count(severity);
    return fmt::format("{} {}{}", number, word, number == 1 ? "" : "s");
  };
  print_message(fmt::format("{}: {}, {}, {}\n", source_name(path), count(Severity::Error, "error"),
                            count(Severity::Warning, "warning"), count(Severity::Note, "note")));
}

/// The note about a file in a folder whose format is unknown.
Diagnostic unknown_format(const std::string& path) {
  Diagnostic note;
  note.severity = Severity::Note;
  note.code = "FMT005";
  note.message = "neither the content nor the name shows a format; passed over";
  note.place.source = path;
  return note;
}

/// The note about folders in a folder.
Diagnostic passed_over(const std::string& path, std::size_t num_folders) {
  Diagnostic note;
  note.severity = Severity::Note;
  note.code = "FMT009";
  note.message =
      num_folders == 1
          ? "a folder in it is passed over; --recursive reads it"
          : fmt::format("{} folders in it are passed over; --recursive reads them", num_folders);
  note.place.source = path;
  return note;
}

/// The diagnostics of one file.
Diagnostics check_file(const InputFile& file, const Reading& reading, int& exit_code) {
  Diagnostics diagnostics;
  if (!file.is_known) {
    diagnostics.add(unknown_format(file.path));
    return diagnostics;
  }
  const DocumentSource source =
      [&](Diagnostics& noticed) -> Result<std::shared_ptr<const Document>> {
    auto document = load_quietly(file.path, reading, noticed);
    if (!document) return fail(std::move(document.error()));
    return std::make_shared<const Document>(std::move(*document));
  };
  const auto checked =
      check(source, {source_name(file.path), source_of_skeleton(reading), reading.is_lenient},
            diagnostics);
  if (!checked) exit_code = worse(exit_code, exit_code_of(checked.error()));
  if (diagnostics.has_errors()) exit_code = worse(exit_code, kInvalid);
  return diagnostics;
}

/// Prints the diagnostics of a file, or adds them to the array for JSON.
void report(const InputFile& file, const Diagnostics& diagnostics, const Check& check,
            const Globals& globals, Json& all) {
  if (check.is_json) {
    for (const Diagnostic* item : diagnostics.by_place()) all.push_back(json_of_diagnostic(*item));
  } else {
    print_diagnostics(STDOUT_FILENO, diagnostics, globals);
    if (file.is_known) print_summary(file.path, diagnostics, globals);
  }
}

/// Checks a file, or the files of a folder.
/// \returns the worse of the given exit code and that of the check
int check_path(const std::string& path, const Check& check, const Globals& globals, Json& all,
               int exit_code) {
  const auto found = files_at(path, check.is_recursive);
  if (!found) {
    Diagnostics diagnostics;
    diagnostics.add(found.error());
    report({path, false}, diagnostics, check, globals, all);
    return worse(exit_code, exit_code_of(found.error()));
  }
  const std::vector<InputFile>& files = found->files;
  for (const InputFile& file : files) {
    const Diagnostics diagnostics = check_file(file, check.reading, exit_code);
    report(file, diagnostics, check, globals, all);
  }
  if (found->num_folders > 0) {
    Diagnostics diagnostics;
    diagnostics.add(passed_over(path, found->num_folders));
    report({path, false}, diagnostics, check, globals, all);
  }
  const bool is_any_known =
      std::any_of(files.begin(), files.end(), [](const InputFile& file) { return file.is_known; });
  if (is_any_known) return exit_code;
  return worse(
      exit_code,
      usage_error(globals,
                  fmt::format("the folder '{}' holds no file of a format that can be read", path)));
}

int run(const Check& check, const Globals& globals) {
  int exit_code = kDone;
  Json all = Json::array();
  if (!check.reading.project.empty()) {  // once, before all files
    Diagnostics diagnostics;
    diagnostics.warnings_are_errors = check.reading.is_strict;
    const auto project = load_project(check.reading, diagnostics);
    if (!project) exit_code = worse(exit_code, exit_code_of(project.error()));
    if (!project && !diagnostics.has_errors()) diagnostics.add(project.error());
    report({check.reading.project}, diagnostics, check, globals, all);
  }
  if (exit_code == kDone) {
    for (const std::string& path : check.files)
      exit_code = check_path(path, check, globals, all, exit_code);
  }
  if (check.is_json) print_json(all);
  return finish_reading(check.reading, globals, exit_code);
}

}  // namespace

void add_check(CLI::App& app, Globals& globals) {
  auto check = std::make_shared<Check>();
  CLI::App* command =
      app.add_subcommand("check", "Report every fault of files, each with its place");
  command
      ->add_option("FILE", check->files, "Files to read, or folders of such; - is standard input")
      ->required();
  command->add_flag("--json", check->is_json, "Print an array with an object a fault");
  command->add_flag("--recursive", check->is_recursive, "Read the folders in folders, too");
  add_reading_options(*command, check->reading);
  check->reading.options.keeps_times_without_rate = true;
  command->callback(
      [check, &globals] { globals.run = [check, &globals] { return run(*check, globals); }; });
}

}  // namespace kinefile::cli
