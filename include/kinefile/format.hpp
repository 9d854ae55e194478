// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/byte_source.hpp"
#include "kinefile/document.hpp"
#include "kinefile/frame_source.hpp"
#include "kinefile/function_ref.hpp"
#include "kinefile/option.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

struct RobotProject;
struct PoseTable;
struct PoseArrays;

/// Which frame of a steady rate a frame with its own time becomes (.seq with hasFrameTime).
enum class TimedRounding {
  Ceil,   ///< the first one at or after its time, as in the format's document
  Floor,  ///< the last one at or before its time, as in Choreonoid
  Slerp,  ///< no rounding: values are interpolated
};

/// A file that another file needs, or that was opened.
struct CompanionFile {
  std::string name;        ///< its name in diagnostics
  std::string_view bytes;  ///< valid as long as `owner` lives
  std::shared_ptr<const void> owner;
  /// Of a file whose bytes were not held: `bytes` is empty.
  std::optional<ByteSource> pieces = std::nullopt;
};

/// Finds the files that a format needs in addition to the one that is read: on the disk, or in
/// memory. A function that is absent finds nothing.
struct Resolver {
  /// Opens a file by its name, relative to the one that is read, case-insensitively; never one
  /// outside of its folder and of the folder that the caller allows (`ReadOptions::model_root`).
  std::function<std::optional<CompanionFile>(const std::string& name)> open = {};
  /// The names of the files with this extension in the folder of the one that is read, sorted.
  std::function<std::vector<std::string>(std::string_view extension)> list = {};
};

/// How to read a file.
struct ReadOptions {
  std::string source_name = "<memory>";  ///< the name of the input in diagnostics
  bool lenient = false;                  ///< repair what docs/errors.md names, with a warning each
  /// "utf-8", "utf-16le", "utf-16be", "latin-1", "cp932"; empty: detect.
  std::string encoding = {};
  /// Overrides the file's frame rate, or gives a missing one.
  std::optional<double> fps = std::nullopt;
  /// Metres per unit of length, where the format does not define the unit: BVH's unit; for ASF the
  /// unit of lengths after division by the file's own factor.
  std::optional<double> metres_per_unit = std::nullopt;
  /// The axis that points up, 0 x, 1 y, 2 z, where the format does not define it.
  std::optional<std::size_t> up = std::nullopt;
  TimedRounding timed_rounding = TimedRounding::Ceil;
  bool keeps_times = false;  ///< frames keep their own times
  /// They also keep them where the file gives no rate to import them at, which is otherwise an
  /// error: for callers that only look at a file.
  bool keeps_times_without_rate = false;
  /// For motions that need one; if null, `read_file` reads it from `skeleton_name`.
  std::shared_ptr<const Document> skeleton = nullptr;
  std::string skeleton_name = {};  ///< a path, and its name in diagnostics
  Resolver companions = {};
  /// A folder above that of a robot's model, in which and below which files that the model names
  /// may be; empty: in its own folder and below. `read_file` makes `companions` by it.
  std::string model_root = {};
  /// `read_file` and `read_project_file` add every file that they open here: the file itself first,
  /// then its companions and the skeleton, each as often as it is opened. Null: nobody asks.
  std::shared_ptr<std::vector<CompanionFile>> opened = nullptr;
  /// Whether the bytes of these files are held; else a large one may have `CompanionFile::pieces`.
  bool holds_opened = true;
  /// For a flow: the robot's project, to convert degrees and to check words and sounds.
  std::shared_ptr<const RobotProject> project = nullptr;
  FormatOptions of_formats = {};  ///< options of single formats: `bvh::ReadOptions`, ...
};

/// How to write a file.
struct WriteOptions {
  /// Digits after the point; absent: the shortest exact form.
  std::optional<int> decimals = std::nullopt;
  bool writes_companion = true;  ///< whether `write_file` also writes the companion
  std::string companion = {};    ///< its name, to be written into the file
  /// For a flow's table: the robot's project, to convert words to degrees.
  std::shared_ptr<const RobotProject> project = nullptr;
  FormatOptions of_formats = {};  ///< options of single formats: `choreonoid::WriteOptions`, ...
};

using ReadOption = Option<ReadOptions>;
using WriteOption = Option<WriteOptions>;

/// What the conversion of a document to a format must know of the format's files.
struct Conventions {
  Kinds writes = {};  ///< the kinds that `Format::write` accepts
  /// The axis that points up in written files, 1 y or 2 z. Absent: either; a body motion that
  /// becomes a motion then gets y, which most programs have.
  std::optional<std::size_t> up = std::nullopt;
  std::optional<AngleUnit> angle_unit = std::nullopt;  ///< absent: either
  bool turns_at_rest = true;                           ///< whether joints may have rest rotations
  /// Whether a joint is a bone with one end, at which all of its children are.
  bool has_one_end = false;
  /// Whether its readers expect no rotations or three about different axes of a joint, and six
  /// channels of a root. A motion of another format gets these.
  bool has_whole_channels = false;
  /// Whether a body motion becomes a motion by its components (one column per value), not by its
  /// links.
  bool has_columns_of_components = false;
  /// Whether a body motion holds the root's pose, the joints and a ZMP relative to the root.
  bool is_root_and_joints = false;
  std::optional<FlowFormat> flow_format = std::nullopt;  ///< the only one for flows; absent: any
  /// Whether it can store times of single frames, or stores no frames. For other formats, a motion
  /// is interpolated to a steady rate first.
  bool keeps_times = false;
};

/// Consumes the next piece of the output; returns false to stop.
using Sink = std::function<bool(std::string_view)>;

/// Uses the poses of some frames; returns false to stop.
using UsePoses = FunctionRef<bool(const PoseArrays&)>;

/// Computes the poses of a table's frames (see `PoseTable`): calls `use` with one block of frames
/// after the other, on the calling thread, until all were used or `use` returned false. Returns
/// whether all were used. May be called several times.
using PoseBlocks = FunctionRef<bool(UsePoses use)>;

/// Starts a file of a set, by the part of its name after the stem of the set: ".waist".
using OpenPart = std::function<Result<Sink>(std::string_view extension)>;

/// A property of a file's content or notation that the model does not hold.
struct Fact {
  std::string key;    ///< "line_end"
  std::string value;  ///< "lf"
  std::string words;  ///< for people: "line ends lf"; empty if the value does not fit on a line
};

/// A format that is not read, but whose files are often given where another is expected.
struct ForeignFormat {
  std::string_view extension;  ///< with the dot, lower case
  /// Whether a file that starts with these bytes is certainly of this format; null: never.
  bool (*probe)(std::string_view head) = nullptr;
  std::string_view advice;  ///< what it is and what to do with it, in one sentence
};

/// A file format: its name and how it is read and written.
struct Format {
  std::string_view name;
  std::string_view description;
  std::span<const std::string_view> extensions;  ///< with the dot, lower case, the usual one first
  /// The format of the file that is written with it: "asf" for "amc".
  std::string_view companion = {};

  /// Whether a file that starts with these bytes is certainly of this format; null: never.
  bool (*probe)(std::string_view head) = nullptr;

  /// Formats whose files are taken for those of this one.
  std::span<const ForeignFormat> foreign = {};

  /// Reads a document; null if the format is write-only. On failure every error is in
  /// `diagnostics`, and the first of them is returned.
  Result<Document> (*read)(std::string_view bytes, const ReadOptions&, Diagnostics&) = nullptr;

  /// Reads a document without holding all bytes of its file, if the file is as plain as nearly all
  /// are; empty for any other, which `read` reads. Null: the format always needs all bytes.
  std::optional<Result<Document>> (*read_pieces)(const ByteSource&, const ReadOptions&,
                                                 Diagnostics&) = nullptr;

  /// Opens a motion whose frames are read when they are asked for, with the same values and
  /// diagnostics as `read`, if the file is as plain as for `read_pieces`. Reads the whole file
  /// once. Empty for any other file, and for one whose values probably need no more memory than
  /// `most_bytes_in_memory`. Null: the format needs all frames at once.
  /// \param bytes  copies are kept as long as the frames
  std::optional<LongMotion> (*open_frames)(const ByteSource& bytes, double most_bytes_in_memory,
                                           const ReadOptions&, Diagnostics&) = nullptr;

  /// Writes a document; null if the format is read-only or a set of files.
  Result<void> (*write)(const Document&, const WriteOptions&, const Sink&, Diagnostics&) = nullptr;

  /// Writes a motion block by block, as `write` writes it whole. Null: the format needs all frames
  /// at once.
  Result<void> (*write_frames)(const LongMotion&, const WriteOptions&, const Sink&,
                               Diagnostics&) = nullptr;

  /// For a format that is a set of files with one stem and different extensions: writes those for
  /// which a document has content, one after the other; null for all other formats.
  Result<void> (*write_set)(const Document&, const WriteOptions&, const OpenPart&,
                            Diagnostics&) = nullptr;

  /// Writes a table of poses (see `PoseTable`), without holding all of them where its order allows
  /// that; null if the format has no form for one. Returns false if the sink returned false.
  bool (*write_poses)(const PoseTable&, PoseBlocks, const WriteOptions&, const Sink&) = nullptr;

  bool takes_skeleton = false;  ///< whether reading uses `ReadOptions::skeleton`

  /// Lists what is kept of the file that a document was read from, the most important first; null:
  /// nothing.
  std::vector<Fact> (*facts)(const Document&) = nullptr;

  /// The type of a component as named in the file that it was read from; empty if it is not kept.
  /// Null if files of the format do not have types.
  std::string (*component_type)(const Component&) = nullptr;

  /// Whether the file was read with position channels that are added to offsets, even if its
  /// skeleton does not show it; null: never.
  bool (*adds_positions)(const Document&) = nullptr;

  /// The options that have an effect on reading and on writing this format. Options that every
  /// format takes (lenient) are in no table.
  std::span<const ReadOption> read_options = {};
  std::span<const WriteOption> write_options = {};
  std::span<const WriteOption> pose_options = {};  ///< on `write_poses`
  Conventions conventions = {};
};

/// All formats, in the order in which they are probed and listed.
std::span<const Format> formats();

/// Whether a format can be written.
inline bool is_written(const Format& format) {
  return format.write != nullptr || format.write_set != nullptr;
}

/// Facts about the file that a document was read from (see `Format::facts`).
std::vector<Fact> facts_of(const Document& document);

/// The type of a component as named in the document's file; empty if it is unknown (see
/// `Format::component_type`).
std::string component_type(const Document& document, const Component& component);

/// The format of this name, or null.
const Format* find_format(std::string_view name);

/// The format that a file's first bytes show; otherwise the one of its name's extension; otherwise
/// null.
const Format* detect_format(std::string_view head, std::string_view file_name);

/// The foreign format that a file's first bytes show, or, if `detected` is null, its name; null if
/// the content shows the detected format, or there is none.
/// \param detected  of `detect_format`
const ForeignFormat* find_foreign(std::string_view head, std::string_view file_name,
                                  const Format* detected);

/// The format in which a document is written under a name: that of the file that it was read from,
/// if both names have the same extension and the format is written; otherwise the one of the name's
/// extension, or null. So a BVH file that is called .txt stays one.
/// \param input  the format of the file with the name `input_name`; null: not known
const Format* format_of_output(std::string_view file_name, std::string_view input_name,
                               const Format* input);

/// The format of a file name's extension, or null.
const Format* format_of_name(std::string_view file_name);

}  // namespace kinefile

#pragma GCC visibility pop
