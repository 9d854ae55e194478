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

/// Gets a document when it is needed: a skeleton, a robot. Null: there is none.
using DocumentSource =
    std::function<Result<std::shared_ptr<const Document>>(Diagnostics& diagnostics)>;

/// How a document is brought into a form that a format can take.
struct AdaptOptions {
  shape::ChannelOptions channels = {};  ///< that a motion is to have
  KindOptions kinds = {};               ///< but for the model, which `robot` or `skeleton` gives
  /// The skeleton that the output is to have (ASF), or the robot that the motion is of.
  DocumentSource skeleton = {};
  std::string skeleton_name = {};  ///< what that file is called; empty: there is none
  DocumentSource robot = {};       ///< a robot that a motion goes onto; else `skeleton` is it
};

/// An option of `adapt`, for flags and keywords. Those that are files are read by the caller.
struct AdaptOption {
  Option<AdaptOptions> option;
  bool (*is_for)(const Format& output) =
      nullptr;  ///< whether it can have an effect on the way there
};

/// Every option of `adapt`, in the order in which they are listed.
std::span<const AdaptOption> adapt_options();

/// Brings a document into the kind and the form that a format can take: see `in_kind_of`,
/// `on_skeleton_of`, `adapted_to`. What had to be done is told in notes.
/// \param options  what the format's writer is told; out: whether a companion is to be written
/// \errors those of these three, and of the sources
Result<Document> adapt(Document document, const Format& format, const AdaptOptions& adapting,
                       WriteOptions& options, Diagnostics& diagnostics);

/// One job: read a document, change it by operations, write it.
struct Job {
  std::string source;  ///< a path, or what diagnostics call `bytes`
  std::optional<std::string_view> bytes = std::nullopt;  ///< read instead of a file
  const Format* from = nullptr;                          ///< null: content and name tell
  ReadOptions reading = {};
  std::vector<Operation> operations = {};
  OperationContext context = {};
  std::string target;          ///< the output's name; its companions are named after it
  const Format* to = nullptr;  ///< null: the target's name tells
  AdaptOptions adapting = {};
  WriteOptions writing = {};
};

/// What came of a job.
struct Report {
  Diagnostics diagnostics;         ///< what was noticed on the way, errors among it
  std::optional<Error> error;      ///< what ended it; absent: it was done
  std::vector<std::string> files;  ///< the names that were written
  std::string_view kind;           ///< of what was read: "motion", ...; empty: nothing was
  std::size_t num_frames = 0;      ///< of what was written, if it is a motion
};

/// Runs a job. Prints nothing; nothing is written if any step fails.
/// \param files  where the output goes: the disk (`files_on_disk`), or memory
/// May be called from several threads at once, with different `files`.
Report process(const Job& job, const OutputFiles& files);

}  // namespace kinefile

#pragma GCC visibility pop
