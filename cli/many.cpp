// SPDX-License-Identifier: MIT
#include "many.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "content_hash.hpp"
#include "folders.hpp"
#include "many_plan.hpp"
#include "many_summary.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "signals.hpp"
#include "status_file.hpp"

namespace kinefile::cli {
namespace {

namespace fs = std::filesystem;

/// What came of one file.
struct Outcome {
  Diagnostics diagnostics;
  std::optional<Error> error;  ///< absent: its output was written, or is up to date
  bool is_up_to_date = false;
  std::vector<std::string> outputs;
  /// What reading it used, see `Reading`.
  std::vector<const Format*> formats;
  bool is_skeleton_used = false;
};

/// What all files share.
struct ManyRun {
  const Many& many;
  const ManyWork& work;
  std::vector<ManyFile> files;
  Reading reading;  ///< as it is before the first file
  std::uint64_t options = 0;
  StatusFile status;
};

/// The files that were read for an output.
struct Inputs {
  std::shared_ptr<std::vector<CompanionFile>> opened =
      std::make_shared<std::vector<CompanionFile>>();
  std::vector<InputState> states;

  /// Takes the states of those that were opened, whose bytes are then let go.
  void settle() {
    for (const CompanionFile& file : *opened) states.push_back(state_of(file));
    opened->clear();
  }
};

/// The output's files, for which folders are made, and before which the input is let go.
/// \param inputs  must outlive them
OutputFiles output_files(Inputs& inputs, bool may_replace) {
  OutputFiles made = files_on_disk(output_options(may_replace));
  made.open = [&inputs, open = std::move(made.open)](const std::string& name) {
    inputs.settle();
    std::error_code fault;
    fs::create_directories(fs::path(name).parent_path(), fault);  // opening it says what is wrong
    return open(name);
  };
  return made;
}

/// The record of an output that was written, and of what was read for it.
OutputRecord record_of(const ManyRun& run, Inputs&& inputs, const Outcome& outcome) {
  OutputRecord record;
  record.is_done = true;
  record.version = kVersion;
  record.options = run.options;
  inputs.settle();
  record.inputs = std::move(inputs.states);
  for (const std::string& name : outcome.outputs) {
    record.outputs.push_back(
        {fs::path(name).lexically_relative(run.many.out_dir).string(), size_of_file(name)});
  }
  return record;
}

/// The error of an output that is there and may not be replaced.
std::optional<Error> hindrance(const std::string& target, bool may_replace) {
  std::error_code ignored;
  if (may_replace || !fs::exists(target, ignored)) return {};
  const auto refused = OutputFile::create(target, output_options(false));
  if (refused) return {};  // it went away meanwhile
  return refused.error();
}

/// Makes the output of a file. An exception is an error of this file alone.
Result<std::vector<std::string>> made(const ManyRun& run, const ManyFile& file,
                                      const Reading& reading, const OutputFiles& files,
                                      Diagnostics& diagnostics) {
  try {
    return run.work.make(file, reading, files, diagnostics);
  } catch (const std::bad_alloc&) {
    return fail(make_error(ErrorKind::Io, "MEM001", "out of memory", file.path));
  } catch (const std::exception& error) {
    return fail(make_error(ErrorKind::Io, "INT001", error.what(), file.path));
  }
}

/// Works on a file, unless its output is up to date. Called on several threads at once.
Outcome work_on(ManyRun& run, const ManyFile& file) {
  Outcome outcome;
  const OutputRecord* known = run.many.is_resuming ? run.status.find(file.name) : nullptr;
  if (known && is_up_to_date(*known, file.path, run.options, run.many.out_dir)) {
    outcome.is_up_to_date = true;
    for (const OutputState& output : known->outputs) {
      outcome.outputs.push_back((fs::path(run.many.out_dir) / output.name).string());
    }
    return outcome;
  }
  const bool may_replace = run.work.may_replace || (known && is_own(*known, run.many.out_dir));
  outcome.error = hindrance(file.target, may_replace);
  if (outcome.error) return outcome;
  run.status.begin(file.name);
  Reading reading = run.reading;
  Inputs inputs;
  reading.options.opened = inputs.opened;
  reading.options.holds_opened = false;
  outcome.diagnostics.warnings_are_errors = reading.is_strict;
  auto outputs = made(run, file, reading, output_files(inputs, may_replace), outcome.diagnostics);
  if (outputs) {
    outcome.outputs = std::move(*outputs);
    run.status.finish(file.name, record_of(run, std::move(inputs), outcome));
  } else {
    outcome.error = std::move(outputs.error());
    run.status.give_up(file.name);
  }
  outcome.formats = std::move(reading.formats);
  outcome.is_skeleton_used = reading.is_skeleton_used;
  return outcome;
}

/// Prints what came of a file, and adds it to the summary.
void tell(const ManyFile& file, Outcome&& outcome, const ManyRun& run, const Globals& globals,
          Summary& summary) {
  const bool is_strict = run.reading.is_strict;
  print_diagnostics(STDERR_FILENO, named(outcome.diagnostics, file.path, is_strict), globals);
  SummaryLine line{file.path, {}, std::move(outcome.outputs), {}, {}};
  line.result = outcome.is_up_to_date ? FileResult::UpToDate : FileResult::Written;
  if (outcome.error) {
    line.result = FileResult::Failed;
    line.code = outcome.error->code;
    line.message = outcome.error->message;
    summary.worst = worse(summary.worst, print_failure(std::move(*outcome.error),
                                                       outcome.diagnostics, file.path, globals));
  }
  summary.lines.push_back(std::move(line));
  for (const Format* format : outcome.formats) note_format(format, *run.work.reading);
  run.work.reading->is_skeleton_used |= outcome.is_skeleton_used;
}

/// A number for everything but the input that the output depends on: the command, its options, and
/// the content of files that they name.
std::uint64_t hash_of_options(const ManyWork& work) {
  constexpr std::string_view kOthers[] = {"--out-dir", "--jobs", "--recursive",
                                          "--resume",  "--json", "--force"};
  std::string text = work.reading->command->get_name();
  const auto add = [&text](const std::string& word) {
    text += '\0' + word;
    std::error_code ignored;
    if (!fs::is_regular_file(word, ignored)) return;
    if (const auto bytes = open_pieces(word)) {
      text += fmt::format("{}", content_hash(*bytes).value_or(0));
    }
  };
  for (const CLI::Option* option : work.reading->command->get_options()) {
    const std::string name = option->get_name();
    const bool is_other =
        option->get_positional() ||
        std::find(std::begin(kOthers), std::end(kOthers), name) != std::end(kOthers);
    if (option->count() == 0 || is_other) continue;
    add(name);
    for (const std::string& word : option->results()) add(word);
  }
  for (const std::string& word : work.words) add(word);
  return content_hash(text);
}

/// The formats of all outputs, each once.
std::vector<const Format*> output_formats(const std::vector<ManyFile>& files) {
  std::vector<const Format*> formats;
  for (const ManyFile& file : files) {
    if (file.to == nullptr) continue;
    if (std::find(formats.begin(), formats.end(), file.to) == formats.end()) {
      formats.push_back(file.to);
    }
  }
  return formats;
}

/// Refuses options that have no effect on any of the files, before the first is read.
Result<void> expect_effects(const ManyWork& work, const std::vector<ManyFile>& files) {
  if (auto project = expect_project(*work.reading); !project) return project;
  for (const ManyFile& file : files) note_format(file.format, *work.reading);
  if (!work.writes_poses) return expect_options_of(*work.reading, output_formats(files));
  if (auto read = expect_options_of(*work.reading, {}); !read) return read;
  return expect_pose_options_of(*work.reading, output_formats(files));
}

/// Works on all files.
/// \returns  the exit code
int work_on_all(ManyRun& run, const Globals& globals) {
  Summary summary;
  Progress progress(run.files.size(), globals);
  const Batch batch{run.files.size(), [&run](std::size_t i) {
                      return size_of_file(run.files[i].path) >= kLargeInputBytes;
                    }};
  const bool is_whole = for_each_input<Outcome>(
      batch, [&run](std::size_t i) { return work_on(run, run.files[i]); },
      [&](std::size_t i, Outcome&& outcome) {
        if (noted_signal() != 0) return false;
        tell(run.files[i], std::move(outcome), run, globals, summary);
        progress.show(i + 1);
        return noted_signal() == 0;
      });
  progress.clear();
  if (!is_whole) return kIo;  // a signal ends the program
  if (run.many.is_json) {
    print_json_summary(summary);
  } else if (!globals.is_quiet) {
    print_summary(summary);
  }
  int exit_code = exit_code_of(summary);
  if (const auto closed = run.status.close(); !closed) {
    print_error(closed.error(), globals);
    exit_code = worse(exit_code, kIo);
  }
  return exit_code;
}

int report(const Error& error, const Globals& globals) {
  print_error(error, globals);
  return exit_code_of(error);
}

/// Reads the project that all files share.
/// \param hash  out: a number for the content of its files
/// \returns the exit code
int load_shared(const Reading& reading, const Globals& globals, std::uint64_t& hash) {
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = reading.is_strict;
  Reading recorded = reading;
  recorded.options.opened = std::make_shared<std::vector<CompanionFile>>();
  const auto project = load_project(recorded, diagnostics);
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  if (!project) return print_failure(project.error(), diagnostics, reading.project, globals);
  reading.loaded_project = *project;
  for (const CompanionFile& file : *recorded.options.opened) {
    hash = hash * 31 + content_hash(file.bytes);
  }
  return kDone;
}

}  // namespace

CLI::Option* add_jobs_option(CLI::App& command, std::size_t& num_jobs) {
  constexpr int kMost = 1024;
  return command
      .add_option("--jobs", num_jobs, "Work on so many files at a time; else on one a core")
      ->check(CLI::Range(1, kMost))
      ->type_name("N");
}

void add_inputs(CLI::App& command, Many& many) {
  command.add_option("FILE", many.inputs, "Files to read, or folders of such")->required();
}

void add_many_options(CLI::App& command, Many& many, const std::vector<CLI::Option*>& others) {
  CLI::Option* folder =
      command
          .add_option("--out-dir", many.out_dir,
                      "Take many files and folders, and write an output for each in this folder")
          ->type_name("DIR");
  for (CLI::Option* other : others) other->excludes(folder);
  CLI::Option* const options[] = {
      add_jobs_option(command, many.num_jobs),
      command.add_flag("--recursive", many.is_recursive, "Read the folders in folders, too"),
      command.add_flag("--resume", many.is_resuming,
                       "Leave outputs that are up to date, and replace those that are not"),
      command.add_flag("--json", many.is_json, "Print what came of each file")};
  for (CLI::Option* option : options) option->needs(folder);
}

int run_many(const Many& many, const ManyWork& work, const Globals& globals) {
  if (many.out_dir.empty()) return usage_error(globals, "--out-dir needs the name of a folder");
  set_max_threads(many.num_jobs);
  auto plan = plan_of(many, work);
  if (!plan) return report(plan.error(), globals);
  print_diagnostics(STDERR_FILENO, plan->notes, globals);
  if (const auto effective = expect_effects(work, plan->files); !effective) {
    return report(effective.error(), globals);
  }
  std::uint64_t hash = 0;
  if (const int loaded = load_shared(*work.reading, globals, hash); loaded != kDone) return loaded;
  std::error_code fault;
  fs::create_directories(many.out_dir, fault);
  auto status = StatusFile::open(many.out_dir);
  if (!status) return report(status.error(), globals);
  ManyRun run{many,
              work,
              std::move(plan->files),
              *work.reading,
              hash ^ hash_of_options(work),
              std::move(*status)};
  const int exit_code = work_on_all(run, globals);
  if (noted_signal() != 0) return exit_code;
  const auto used = expect_skeleton_used(*work.reading);
  return used ? exit_code : worse(exit_code, report(used.error(), globals));
}

}  // namespace kinefile::cli
