// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/kinefile.hpp"

// What was written into an output folder, and from what: so that a batch can go on where it ended.

namespace kinefile::cli {

/// The name of the status file in an output folder.
inline constexpr std::string_view kStatusName = ".kinefile-status";

/// A file that was read, as it was then.
struct InputState {
  std::string path;
  std::uint64_t num_bytes = 0;
  std::int64_t time = 0;   ///< of its last change, in nanoseconds
  std::uint64_t hash = 0;  ///< see `content_hash`
};

/// A file that was written.
struct OutputState {
  std::string name;  ///< relative to the output folder
  std::uint64_t num_bytes = 0;
};

/// What is known of one output.
struct OutputRecord {
  bool is_begun = false;           ///< it may have been written since, by a run that was killed
  bool is_done = false;            ///< the rest is known
  std::string version;             ///< of the program
  std::uint64_t options = 0;       ///< a hash of the command and its options
  std::vector<InputState> inputs;  ///< the input, then other files that were read with it
  std::vector<OutputState> outputs;
};

/// The state of a file that was opened. One that has changed since is never up to date.
InputState state_of(const CompanionFile& file);

/// Whether a done record holds: the files that were read and written are as they were.
/// \param path  the input as it is named now
bool is_up_to_date(const OutputRecord& record, const std::string& path, std::uint64_t options,
                   const std::string& out_dir);

/// Whether what lies at an output is what was written there, or nothing, so that it may be
/// replaced.
bool is_own(const OutputRecord& record, const std::string& out_dir);

/// The status file of an output folder. Lines are appended to it while files are written, which a
/// process that is killed leaves whole; at the end it is written anew, in order.
class StatusFile {
 public:
  /// Reads the records and opens the file to add to them.
  /// \errors IO001 if it cannot be read, IO003 if it cannot be written
  static Result<StatusFile> open(const std::string& out_dir);

  StatusFile(StatusFile&&) noexcept;
  StatusFile& operator=(StatusFile&&) noexcept;
  ~StatusFile();

  /// The record of an output as it was when the file was opened; null: there is none.
  const OutputRecord* find(const std::string& name) const;

  /// Notes that an output is going to be written, that it was, or that it could not be. May be
  /// called from several threads at once.
  void begin(const std::string& name);
  void finish(const std::string& name, const OutputRecord& record);
  void give_up(const std::string& name);

  /// Writes the file anew, with a line for each output, in the order of their names, unless another
  /// process is writing into the folder.
  /// \errors IO003
  Result<void> close();

 private:
  struct State;
  explicit StatusFile(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace kinefile::cli
