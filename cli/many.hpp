// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "command.hpp"
#include "long_motions.hpp"
#include "writing.hpp"

// Commands that take one file take many with --out-dir.

namespace kinefile::cli {

/// Options of every command that takes many files.
struct Many {
  std::vector<std::string> inputs;  ///< files and folders
  std::string out_dir;
  std::size_t num_jobs = 0;  ///< the number of threads; 0: one a core
  bool is_recursive = false;
  bool is_resuming = false;
  bool is_json = false;
};

/// Adds --jobs to a command.
CLI::Option* add_jobs_option(CLI::App& command, std::size_t& num_jobs);

/// Adds the options of `Many` to a command, except for the inputs.
/// \param others  options that it has only for one file
void add_many_options(CLI::App& command, Many& many, const std::vector<CLI::Option*>& others);

/// Adds the positional argument of a command that was called with --out-dir.
void add_inputs(CLI::App& command, Many& many);

/// One of many files.
struct ManyFile {
  std::string path;
  std::string name;                ///< of the output, in the output folder
  std::string target;              ///< the output's path
  const Format* format = nullptr;  ///< null: not known, reading it says why
  const Format* to = nullptr;      ///< null: the format cannot be written
};

/// What a command does with many files.
struct ManyWork {
  const Reading* reading = nullptr;
  bool may_replace = false;
  const Format* to = nullptr;           ///< the format of all outputs; null: each has its input's
  bool writes_poses = false;            ///< outputs are tables of poses, which have no companions
  std::vector<std::string> words = {};  ///< positional arguments that change the outputs
  std::vector<std::string> files = {};  ///< further files that are read, and not to be replaced
  /// Makes the output of a file: reads it as `reading` says, which is its own copy, and writes to
  /// `files`, which it commits. Returns the names of the files written. Called for several files at
  /// once; prints nothing.
  std::function<Result<std::vector<std::string>>(const ManyFile& file, const Reading& reading,
                                                 const OutputFiles& files,
                                                 Diagnostics& diagnostics)>
      make;
};

/// Runs a command on many files: finds them, refuses what would overwrite something, makes the
/// outputs on several threads, and reports each file in order, then all of them.
/// \returns the exit code
int run_many(const Many& many, const ManyWork& work, const Globals& globals);

/// Changes a document before it is written.
using ManyChange = std::function<Result<void>(const ManyFile& file, Document& document,
                                              const Reading& reading, Diagnostics& diagnostics)>;

/// Runs a command that makes a document of each document.
/// \param change            null: none
/// \param change_in_blocks  the same for a motion that is too large for memory; null: as none
/// \param words             positional arguments that are for `change`
int run_many_documents(const Many& many, const Reading& reading, const Writing& writing,
                       const ManyChange& change, const ChangeLong& change_in_blocks,
                       const std::vector<std::string>& words, const Globals& globals);

}  // namespace kinefile::cli
