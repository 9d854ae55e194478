// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "command.hpp"
#include "folders.hpp"
#include "json_output.hpp"
#include "options.hpp"
#include "report.hpp"

namespace kinefile::cli {
namespace {

struct Check {
  std::vector<std::string> files;
  bool is_json = false;
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
  std::fflush(stdout);
  fmt::print(stderr, "{}: {}, {}, {}\n", source_name(path), count(Severity::Error, "error"),
             count(Severity::Warning, "warning"), count(Severity::Note, "note"));
}

/// A breach of a limit in words.
std::string text_of(const LimitBreach& breach, const Skeleton& skeleton) {
  const std::string& joint = skeleton.joints[breach.joint].name;
  if (breach.kind == LimitBreach::Kind::TooFast) {
    return fmt::format(
        "joint '{}' moves at up to {:.6g} a second (to frame {}), its limit is "
        "{:.6g}; too fast in {} frames, first in {}",
        joint, breach.worst, breach.worst_frame, breach.limit, breach.num_frames,
        breach.first_frame);
  }
  const bool is_below = breach.kind == LimitBreach::Kind::Below;
  return fmt::format(
      "joint '{}' goes {} to {:.6g} (frame {}), its limit is {:.6g}; beyond it in "
      "{} frames, first in {}",
      joint, is_below ? "down" : "up", breach.worst, breach.worst_frame, breach.limit,
      breach.num_frames, breach.first_frame);
}

/// A note about a file as a whole.
Diagnostic note_of(const std::string& path, std::string code, std::string message) {
  Diagnostic note;
  note.severity = Severity::Note;
  note.code = std::move(code);
  note.message = std::move(message);
  note.place.source = source_name(path);
  return note;
}

/// Notes joints that turn suddenly, which no format forbids.
void note_sudden_turns(const std::string& path, const Document& document,
                       Diagnostics& diagnostics) {
  const Motion* motion = std::get_if<Motion>(&document.content);
  if (motion == nullptr) return;
  for (const SuddenTurn& turn : find_sudden_turns(*motion)) {
    const bool is_spike = turn.return_frame != 0;
    std::string message = fmt::format("joint '{}' turns by {:.0f} degrees from frame {} to {}",
                                      motion->skeleton.joints[turn.joint].name, turn.degrees,
                                      turn.frame - 1, turn.frame);
    if (is_spike) message += fmt::format(" and is back in frame {}", turn.return_frame);
    diagnostics.add(note_of(path, is_spike ? "MOT001" : "MOT002", std::move(message)));
  }
}

/// Puts a body motion on the robot that `--skeleton` names: counts that do not fit, joints that
/// leave their limits.
void check_on_robot(const std::string& path, Document& document, const Reading& reading,
                    Diagnostics& diagnostics) {
  if (reading.skeleton.empty() || has_skeleton(document)) return;
  Diagnostics own;
  own.warnings_are_errors = reading.is_strict;
  const auto motion = motion_in_world(document, reading, own);
  if (!motion && !own.has_errors()) own.add(motion.error());
  if (motion) {
    for (const LimitBreach& breach : find_limit_breaches(*motion)) {
      own.add(Severity::Warning, breach.kind == LimitBreach::Kind::TooFast ? "MOT004" : "MOT003",
              text_of(breach, motion->skeleton));
    }
  }
  for (Diagnostic item : own.items()) {
    if (item.place.source.empty()) item.place.source = source_name(path);
    // Warnings are raised already where they are to be errors.
    diagnostics.add(std::move(item));
  }
}

/// What is wrong with one file.
Diagnostics check_file(const InputFile& file, const Reading& reading, int& exit_code) {
  Diagnostics diagnostics;
  if (!file.is_known) {
    diagnostics.add(note_of(file.path, "FMT005",
                            "neither the content nor the name shows a format; passed over"));
    return diagnostics;
  }
  auto document = load_quietly(file.path, reading, diagnostics);
  if (!document) {
    exit_code = worse(exit_code, exit_code_of(document.error()));
    // A fault of the file itself, not of its content, is not among the diagnostics yet.
    if (!diagnostics.has_errors()) diagnostics.add(document.error());
    return diagnostics;
  }
  note_sudden_turns(file.path, *document, diagnostics);
  check_on_robot(file.path, *document, reading, diagnostics);
  if (diagnostics.has_errors()) exit_code = worse(exit_code, kInvalid);
  return diagnostics;
}

/// Prints what is wrong with a file, or adds it to the array for JSON.
void report(const InputFile& file, const Diagnostics& diagnostics, const Check& check,
            const Globals& globals, Json& all) {
  if (check.is_json) {
    for (const Diagnostic* item : diagnostics.by_place()) all.push_back(json_of_diagnostic(*item));
  } else {
    print_diagnostics(stdout, diagnostics, globals);
    if (file.is_known) print_summary(file.path, diagnostics, globals);
  }
}

/// Checks a file, or those of a folder. Returns the exit code, no better than the one given.
int check_path(const std::string& path, const Check& check, const Globals& globals, Json& all,
               int exit_code) {
  const std::vector<InputFile> files = with_files_of_folders({path});
  for (const InputFile& file : files) {
    const Diagnostics diagnostics = check_file(file, check.reading, exit_code);
    report(file, diagnostics, check, globals, all);
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
  add_reading_options(*command, check->reading);
  command->callback(
      [check, &globals] { globals.run = [check, &globals] { return run(*check, globals); }; });
}

}  // namespace kinefile::cli
