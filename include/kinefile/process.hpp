// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/convert.hpp"
#include "kinefile/io.hpp"
#include "kinefile/operation.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// Provides a document on demand: a skeleton, a robot. Null: there is none.
using DocumentSource =
    std::function<Result<std::shared_ptr<const Document>>(Diagnostics& diagnostics)>;

/// How a document is converted to a form that a format can write.
struct AdaptOptions {
  shape::ChannelOptions channels = {};  ///< the channels that a motion shall have
  KindOptions kinds = {};               ///< except for the model, which `robot` or `skeleton` gives
  /// The skeleton that the output shall have (ASF), or the robot of the motion.
  DocumentSource skeleton = {};
  std::string skeleton_name = {};  ///< the name of that file; empty: there is none
  DocumentSource robot = {};       ///< the robot to which a motion is transferred; null: `skeleton`
                                   ///< is used
};

/// An option of `adapt`, for flags and keywords. The caller reads options that are files.
struct AdaptOption {
  Option<AdaptOptions> option;
  bool (*is_for)(const Format& output) = nullptr;  ///< whether it can affect this output format
};

/// All options of `adapt`, in the order in which they are listed.
std::span<const AdaptOption> adapt_options();

/// Converts a document to the kind and the form that a format can write: see `in_kind_of`,
/// `on_skeleton_of`, `adapted_to`. Notes report each change.
/// \param options  in: for the format's writer; out: also whether a companion is written
/// \errors those of these three functions, and of the sources
Result<Document> adapt(Document document, const Format& format, const AdaptOptions& adapting,
                       WriteOptions& options, Diagnostics& diagnostics);

/// The same for a motion whose frames are read when they are asked for, with the same result and
/// diagnostics; so are the new frames. A number that becomes too large (CNV011) is an error of
/// these.
/// \returns empty if that needs all frames at once, and `diagnostics` says nothing: for a skeleton,
///          a robot or a form that is asked for, a body motion, and as `adapted_in_blocks`
std::optional<Result<LongMotion>> adapt_in_blocks(const LongMotion& motion, const Format& format,
                                                  const AdaptOptions& adapting,
                                                  Diagnostics& diagnostics);

/// One job: read a document, change it by operations, write it.
struct Job {
  std::string source;  ///< a path, or the name of `bytes` in diagnostics
  std::optional<std::string_view> bytes = std::nullopt;  ///< read instead of a file
  const Format* from = nullptr;                          ///< null: detected from content and name
  ReadOptions reading = {};
  bool strict = false;  ///< warnings are errors
  /// Changes the document before the operations do; null: only they change it.
  std::function<Result<void>(Document& document, Diagnostics& diagnostics)> change = {};
  /// Changes a motion whose frames are read when they are asked for as `change` changes all of
  /// them; null: none if `change` is null, otherwise `change` needs all frames.
  std::function<Result<LongMotion>(LongMotion motion, Diagnostics& diagnostics)> change_in_blocks =
      {};
  std::vector<Operation> operations = {};
  OperationContext context = {};
  std::string target;          ///< the output's name; its companions are named after it
  const Format* to = nullptr;  ///< null: see `format_of_output`
  AdaptOptions adapting = {};
  WriteOptions writing = {};
  /// A file whose motion needs more memory is read, changed and written block by block, if its
  /// format and all steps allow that (see `open_long_motion`, `adapt_in_blocks`). Absent: never.
  std::optional<double> most_bytes_in_memory = std::nullopt;
};

/// The result of a job.
struct Report {
  Diagnostics diagnostics;         ///< all diagnostics, including errors
  std::optional<Error> error;      ///< the error that ended the job; absent: it succeeded
  std::vector<std::string> files;  ///< the names of the files written
  std::string_view kind;           ///< of the document read: "motion", ...; empty: none was read
  std::size_t num_frames = 0;      ///< of the document written, if it is a motion
};

/// Runs a job. Prints nothing; nothing is written if any step fails.
/// \param files  where the output goes: the disk (`files_on_disk`), or memory
/// May be called from several threads at once, with different `files`.
Report process(const Job& job, const OutputFiles& files);

}  // namespace kinefile

#pragma GCC visibility pop
