// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "folders.hpp"
#include "json_output.hpp"
#include "many.hpp"
#include "options.hpp"
#include "report.hpp"
#include "skeleton_source.hpp"

namespace kinefile::cli {
namespace {

struct Check {
  std::vector<std::string> files;
  bool is_json = false;
  bool is_recursive = false;
  std::size_t num_jobs = 0;
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

/// What came of one file, and what reading it used.
struct Checked {
  Diagnostics diagnostics;
  int exit_code = kDone;
  std::vector<const Format*> formats;
  bool is_skeleton_used = false;
};

/// Checks a file. Called for several files at once.
Checked check_file(const InputFile& file, const Reading& shared) {
  Checked result;
  Diagnostics& diagnostics = result.diagnostics;
  if (!file.is_known) {
    diagnostics.add(unknown_format(file.path));
    return result;
  }
  const Reading reading = shared;
  const DocumentSource source =
      [&](Diagnostics& noticed) -> Result<std::shared_ptr<const Document>> {
    auto document = load_quietly(file.path, reading, noticed);
    if (!document) return fail(std::move(document.error()));
    return std::make_shared<const Document>(std::move(*document));
  };
  const auto checked =
      check(source, {source_name(file.path), source_of_skeleton(reading), reading.is_lenient},
            diagnostics);
  if (!checked) result.exit_code = exit_code_of(checked.error());
  if (diagnostics.has_errors()) result.exit_code = worse(result.exit_code, kInvalid);
  result.formats = reading.formats;
  result.is_skeleton_used = reading.is_skeleton_used;
  return result;
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

/// Reports what is to be said of a path after its files.
/// \returns the exit code
int report_path(const std::string& path, const Result<FolderFiles>& found, const Check& check,
                const Globals& globals, Json& all) {
  Diagnostics diagnostics;
  if (!found) {
    diagnostics.add(found.error());
    report({path, false}, diagnostics, check, globals, all);
    return exit_code_of(found.error());
  }
  if (found->num_folders > 0) {
    diagnostics.add(folders_passed_over(path, found->num_folders));
    report({path, false}, diagnostics, check, globals, all);
  }
  return is_without_files(path, *found) ? usage_error(globals, no_files_in(path)) : kDone;
}

/// Checks all files.
/// \returns the exit code
int check_all(const Check& check, const Globals& globals, Json& all) {
  const GivenFiles given = files_at_all(check.files, {check.is_recursive});
  const Reading shared = check.reading;
  int exit_code = kDone;
  std::size_t num_paths = 0;  // that are reported
  const auto report_paths_before = [&](std::size_t end) {
    for (; num_paths < end; ++num_paths) {
      exit_code = worse(exit_code, report_path(check.files[num_paths], given.paths[num_paths],
                                               check, globals, all));
    }
  };
  for_each_input<Checked>(
      batch_of(given), [&](std::size_t i) { return check_file(given.file(i), shared); },
      [&](std::size_t i, Checked&& checked) {
        report_paths_before(given.files[i].first);
        report(given.file(i), checked.diagnostics, check, globals, all);
        exit_code = worse(exit_code, checked.exit_code);
        for (const Format* format : checked.formats) note_format(format, check.reading);
        check.reading.is_skeleton_used |= checked.is_skeleton_used;
        return true;
      });
  report_paths_before(given.paths.size());
  return exit_code;
}

int run(const Check& check, const Globals& globals) {
  set_max_threads(check.num_jobs);
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
  if (exit_code == kDone) exit_code = check_all(check, globals, all);
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
  add_jobs_option(*command, check->num_jobs);
  add_reading_options(*command, check->reading);
  check->reading.options.keeps_times_without_rate = true;
  command->callback(
      [check, &globals] { globals.run = [check, &globals] { return run(*check, globals); }; });
}

}  // namespace kinefile::cli
