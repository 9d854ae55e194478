// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/array.hpp"
#include "kinefile/format.hpp"
#include "kinefile/function_ref.hpp"
#include "kinefile/robot_project.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// The bytes of a file, valid as long as this object lives. They are read, never memory-mapped, so
/// that a file which is truncated meanwhile is an error and not a crash.
class FileBytes {
 public:
  /// Reads a file, or standard input for "-".
  /// \errors IO001 if it cannot be read, or changes meanwhile
  static Result<FileBytes> open(const std::string& path);

  std::string_view view() const {
    return bytes_ == nullptr ? std::string_view()
                             : std::string_view(bytes_->data(), bytes_->size());
  }
  /// The owner that keeps the bytes alive.
  std::shared_ptr<const void> owner() const { return bytes_; }

 private:
  std::shared_ptr<const Array<char>> bytes_;
};

/// The bytes of a regular file, which stays open as long as there are copies; reading them fails as
/// soon as the file has changed. Empty if it cannot be opened, or is no regular file.
std::optional<ByteSource> open_pieces(const std::string& path);

/// Finds files in the folder of a file and below it. Names that lead elsewhere find nothing: a file
/// cannot make its reader open other files.
/// \param root  a folder in which and below which files may be, too, wherever links lead; empty:
///              none
/// \param refusals  receives a warning (IO005) for each file that is a link out of these folders,
///                  and is then not opened; null: says nothing. Outlives the resolver.
Resolver files_beside(const std::string& path, const std::string& root = {},
                      Diagnostics* refusals = nullptr);

/// Reads a document from bytes.
/// \param name    its name in diagnostics; its extension gives the format if the content does not
/// \param format  null: found from the content, then from the name
/// \errors FMT001 or FMT008 (InvalidInput) if its format is not known or known not to be read,
/// those of the reader
Result<Document> read_bytes(std::string_view bytes, const std::string& name, const Format* format,
                            ReadOptions options, Diagnostics& diagnostics);

/// Reads a document from a file.
/// \param name    a path; the stem of a set of files if `format` is one; "-" is standard input,
///                which diagnostics call <stdin>
/// \param format  null: found from the content, then from the extension
/// \errors IO001 if the file cannot be read, IO004 (Usage) if `options.model_root` is no folder,
/// FMT001 or FMT008 as `read_bytes`, those of the reader
Result<Document> read_file(const std::string& name, const Format* format, ReadOptions options,
                           Diagnostics& diagnostics);

/// Opens the motion of a file that is too large to be kept in memory, with the same frames and
/// diagnostics as `read_file`. It stays open as long as the frames.
/// \returns  empty if the file needs to be read whole: it is smaller than that, no regular file, of
///           a format without `open_frames`, or not plain, or reading it whole gives an error
std::optional<LongMotion> open_long_motion(const std::string& path, const Format* format,
                                           double most_bytes_in_memory, ReadOptions options,
                                           Diagnostics& diagnostics);

/// Reads a robot's project and the files that it names, which are in its folder or below.
/// \param options  encoding, leniency and who records files; the source name and the companions are
///                 set here
/// \errors IO001 if the file cannot be read, those of `read_project`
Result<RobotProject> read_project_file(const std::string& path, ReadOptions options,
                                       Diagnostics& diagnostics);

/// How a caller that handles signals stops output, and leaves no temporary file behind. All members
/// may be used in a signal handler.
struct Cancellation {
  /// Set by the caller: what is written fails from now on (ECANCELED), and is removed.
  std::atomic<bool> is_requested{false};
  /// How many temporary files have a name now. While this is 0, the process may end at once.
  std::atomic<int> num_temporary_files{0};
};

/// How files are written.
struct OutputOptions {
  bool may_replace = false;              ///< whether an existing file may be replaced
  Cancellation* cancellation = nullptr;  ///< null: nothing stops the output; outlives it otherwise
};

/// A file that is written completely or not at all: it is a temporary file in the same folder,
/// which is synced, and gets its name by `commit`. If it is destroyed before that, nothing stays. A
/// link that is replaced stays a link: where it leads, the file is replaced. Other names of a
/// replaced file (hard links) keep the old content. The new file has the owner and rights of the
/// old one, where the process may give them.
class OutputFile {
 public:
  /// \param path  "-" is standard output, which is written at once, as devices and pipes are
  /// \errors IO002 if it exists and may not be replaced, IO003 if it cannot be written
  static Result<OutputFile> create(const std::string& path, const OutputOptions& options = {});

  /// An open stream, which is written at once and stays open if it is a standard one.
  /// \param name  in messages
  static OutputFile of_stream(int descriptor, const std::string& name);

  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile(OutputFile&&) noexcept;
  OutputFile& operator=(OutputFile&&) noexcept;
  ~OutputFile();

  /// Appends bytes; returns false after an error, which `commit` reports. Waits for a stream that
  /// does not block.
  bool write(std::string_view bytes);

  /// The first error, if `write` returned false.
  /// \errors IO003
  Result<void> fault() const;

  /// Gives the file its final name.
  /// \errors IO002, IO003
  Result<void> commit();

  /// Gives several files their final names. If one of them fails, those that were replaced before
  /// it are put back.
  /// \errors as `commit`; the message says what stands if that fails, too
  static Result<void> commit_all(std::span<OutputFile* const> files);

 private:
  struct State;
  explicit OutputFile(std::unique_ptr<State> state);
  Result<void> prepare();
  Result<void> place(bool keeps_old);
  bool put_back();
  static Result<void> undone(std::span<OutputFile* const> files, Error&& error);

  std::unique_ptr<State> state_;
};

/// A destination of output: named files, which are committed all together or not at all. The disk
/// is one such destination, memory another.
struct OutputFiles {
  /// Starts a file; the sink takes its bytes.
  std::function<Result<Sink>(const std::string& name)> open;
  /// The error of a file, after its sink has returned false.
  std::function<Result<void>()> fault;
  /// Whether a file of this name exists that was not started here.
  std::function<bool(const std::string& name)> exists;
  /// Gives all files their final names. If one of them fails, all are as before.
  std::function<Result<void>()> commit;
};

/// Files on the disk (see `OutputFile`); "-" is standard output.
OutputFiles files_on_disk(const OutputOptions& options = {});

/// Writes a file. Nothing is committed.
/// \param print  writes its content to a sink; an error of its own is one of the file if that has
///               one
/// \errors those of `files` and of `print`
Result<void> write_content(const std::string& name, const OutputFiles& files,
                           FunctionRef<Result<void>(const Sink& sink)> print);

/// A file that was written to memory.
struct MemoryFile {
  std::string name;
  std::string bytes;
};

/// Files in memory.
/// \param files  receives them when they are committed
OutputFiles files_in_memory(const std::shared_ptr<std::vector<MemoryFile>>& files);

/// Writes a document: its file, and the files that belong to it (the skeleton of an AMC file, the
/// files of a set). Standard output takes one file only. Nothing is committed.
/// \errors those of `files` and of the format's writer; FMT002 if the format cannot be written
Result<void> write(const std::string& name, const Document& document, const Format& format,
                   const WriteOptions& options, const OutputFiles& files, Diagnostics& diagnostics);

/// The same for a motion, which is written block by block. Precondition: the format has
/// `write_frames`. \errors also those of the motion's frames
Result<void> write_in_blocks(const std::string& name, const LongMotion& motion,
                             const Format& format, const WriteOptions& options,
                             const OutputFiles& files, Diagnostics& diagnostics);

/// Writes a document to a file, completely or not at all. Also writes the companion with the same
/// stem if its format has one (the skeleton of an AMC file), but not for standard output.
/// \errors those of OutputFile and of the format's writer; FMT002 if the format cannot be written
Result<void> write_file(const std::string& path, const Document& document, const Format& format,
                        const WriteOptions& options, const OutputOptions& output,
                        Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
