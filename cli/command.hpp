// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinefile/kinefile.hpp"

namespace kinefile::cli {

/// The exit codes of the program; see docs/guide/command-line.md.
enum ExitCode : int {
  kDone = 0,
  kInvalid = 1,
  kUsage = 2,
  kIo = 3,
  kDataLoss = 4,
  kPartOfBatch = 5,
};

/// Options of every command.
struct Globals {
  bool is_quiet = false;
  std::string color = "auto";
  bool takes_many = false;   ///< --out-dir is among the words: every positional is an input
  std::function<int()> run;  ///< runs the selected command
};

/// Options of every command that reads files.
struct Reading {
  std::string from;
  std::string skeleton;
  std::string project;  ///< the project of the robot that flows are for
  /// The project that `project` names, after it was read; see `load_project`.
  mutable std::shared_ptr<const RobotProject> loaded_project;
  ReadOptions options;  ///< set through the formats' tables of options
  bool is_lenient = false;
  bool is_strict = false;
  const CLI::App* command = nullptr;  ///< the command that has these options
  /// The formats of the files that were read so far, each once, and whether `skeleton` was read.
  mutable std::vector<const Format*> formats;
  mutable bool is_skeleton_used = false;
};

/// Why a text is not a valid frame rate; empty if it is.
std::string check_rate(const std::string& text);

/// Adds the options of `Reading` to a command.
void add_reading_options(CLI::App& command, Reading& reading);

/// Reads a file; null after a fault, which is then reported on stderr and counted in `exit_code`.
std::optional<Document> load(const std::string& path, const Reading& reading,
                             const Globals& globals, int& exit_code);

/// How a file is read; the project of `--project` was loaded before.
ReadOptions read_options(const Reading& reading);

/// Refuses --degrees without --project.
/// \errors CLI001 (Usage)
Result<void> expect_project(const Reading& reading);

/// Notes that a file of this format is read; null: of an unknown one.
void note_format(const Format* format, const Reading& reading);

/// As `load`, but prints nothing: all messages are in `diagnostics`.
Result<Document> load_quietly(const std::string& path, const Reading& reading,
                              Diagnostics& diagnostics);

/// Reads the document that `--skeleton` names; null if it names none.
Result<std::optional<Document>> load_skeleton(const Reading& reading, Diagnostics& diagnostics);

/// Reads the project that `--project` names, once; null if it names none.
Result<std::shared_ptr<const RobotProject>> load_project(const Reading& reading,
                                                         Diagnostics& diagnostics);

/// The flow of a file, as `load`.
std::optional<PoseFlow> load_flow(const std::string& path, const Reading& reading,
                                  const Globals& globals, int& exit_code);

/// Reports a usage error.
/// \returns kUsage
int usage_error(const Globals& globals, const std::string& message);

void add_info(CLI::App& app, Globals& globals);
void add_check(CLI::App& app, Globals& globals);
void add_fk(CLI::App& app, Globals& globals);
void add_convert(CLI::App& app, Globals& globals);
void add_diff(CLI::App& app, Globals& globals);
void add_edit(CLI::App& app, Globals& globals);
void add_warp(CLI::App& app, Globals& globals);
void add_align(CLI::App& app, Globals& globals);
void add_resample(CLI::App& app, Globals& globals);
void add_run(CLI::App& app, Globals& globals);
void add_graph(CLI::App& app, Globals& globals);
void add_keyframe(CLI::App& app, Globals& globals);
void add_servo_map(CLI::App& app, Globals& globals);
void add_view(CLI::App& app, Globals& globals);
void add_formats(CLI::App& app, Globals& globals);

/// Writes the man page, or the completions for a shell: "man", "bash", "zsh" or "fish".
std::string manual(const CLI::App& app, const std::string& kind);

}  // namespace kinefile::cli
