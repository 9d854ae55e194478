// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/array.hpp"
#include "kinefile/format.hpp"
#include "kinefile/robot_project.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// The bytes of a file, alive as long as this is. They are read, never mapped, so that a file which
/// somebody cuts short meanwhile is an error and no crash.
class FileBytes {
 public:
  /// Reads a file, or standard input for "-".
  /// \errors IO001 if it cannot be read, or becomes shorter meanwhile
  static Result<FileBytes> open(const std::string& path);

  std::string_view view() const {
    return bytes_ == nullptr ? std::string_view()
                             : std::string_view(bytes_->data(), bytes_->size());
  }
  /// What keeps the bytes alive.
  std::shared_ptr<const void> owner() const { return bytes_; }

 private:
  std::shared_ptr<const Array<char>> bytes_;
};

/// Finds files in the folder of a file and below it. Names that lead elsewhere find nothing: a file
/// cannot make its reader open others.
Resolver files_beside(const std::string& path);

/// Reads a document from bytes.
/// \param name    how diagnostics call it; its extension tells the format where content does not
/// \param format  null: found from the content, then from the name
/// \errors FMT001 (InvalidInput) if its format is not known, else the reader's
Result<Document> read_bytes(std::string_view bytes, const std::string& name, const Format* format,
                            ReadOptions options, Diagnostics& diagnostics);

/// Reads a document from a file.
/// \param name    the stem of a set of files, too, where `format` is one; "-" is standard input;
/// diagnostics then call it <stdin> \param format  null: found from the content, then from the
/// extension \errors IO001 if the file cannot be read, FMT001 if its format is not known, else the
/// reader's
Result<Document> read_file(const std::string& name, const Format* format, ReadOptions options,
                           Diagnostics& diagnostics);

/// Reads a robot's project and the files that it names, which lie beside it or below.
/// \param options  how to take encodings and faults; the source and its companions are set here
/// \errors IO001 if the file cannot be read, else those of `read_project`
Result<RobotProject> read_project_file(const std::string& path, ReadOptions options,
                                       Diagnostics& diagnostics);

/// A file that appears whole or not at all: written to a temporary name beside it, synced, and
/// renamed by `commit`. Destroyed before that, it leaves nothing behind.
class OutputFile {
 public:
  /// \param path     "-" is standard output, which is written at once
  /// \param replace  whether an existing file may be replaced
  /// \errors IO002 if it exists and may not be replaced, IO003 if it cannot be written
  static Result<OutputFile> create(const std::string& path, bool replace);

  OutputFile(OutputFile&&) noexcept;
  OutputFile& operator=(OutputFile&&) noexcept;
  ~OutputFile();

  /// Appends bytes; false after a fault, which `commit` reports.
  bool write(std::string_view bytes);

  /// The first fault, if `write` returned false. \errors IO003
  Result<void> fault() const;

  /// Brings the file to its name. \errors IO003
  Result<void> commit();

 private:
  struct State;
  explicit OutputFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Where output goes: files by name, which appear all together or not at all. The disk is one such
/// place, memory another.
struct OutputFiles {
  /// Starts a file; its bytes go to the sink.
  std::function<Result<Sink>(const std::string& name)> open;
  /// What went wrong while a file's bytes were taken, once a sink has returned false.
  std::function<Result<void>()> fault;
  /// Whether a file of this name is there that was not started here.
  std::function<bool(const std::string& name)> exists;
  /// Brings all files to their names. Where one of them cannot be, none that is new stays.
  std::function<Result<void>()> commit;
};

/// Files on the disk (see `OutputFile`); "-" is standard output.
/// \param replace  whether existing files may be replaced
OutputFiles files_on_disk(bool replace);

/// A file that was written to memory.
struct MemoryFile {
  std::string name;
  std::string bytes;
};

/// Files in memory.
/// \param files  takes them when they are committed
OutputFiles files_in_memory(std::shared_ptr<std::vector<MemoryFile>> files);

/// Writes a document: its file, and those that belong to it (the skeleton of an AMC file, the
/// files of a set), but for standard output, which takes one file. Nothing is committed.
/// \errors those of `files` and of the format's writer; FMT002 if the format cannot be written
Result<void> write(const std::string& name, const Document& document, const Format& format,
                   const WriteOptions& options, const OutputFiles& files, Diagnostics& diagnostics);

/// Writes a document to a file, whole or not at all; and its companion of the same name beside it,
/// if its format has one (the skeleton of an AMC file), but not for standard output.
/// \errors those of OutputFile and of the format's writer; FMT002 if the format cannot be written
Result<void> write_file(const std::string& path, const Document& document, const Format& format,
                        const WriteOptions& options, bool replace, Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
