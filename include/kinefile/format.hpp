// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/document.hpp"
#include "kinefile/option.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

struct RobotProject;

/// Which frame of a steady rate the frame of a timed motion goes to (.seq with hasFrameTime).
enum class TimedRounding {
  Ceil,   ///< the first one at or after its time, as the format's document says
  Floor,  ///< the last one at or before it, as Choreonoid does
  Slerp,  ///< none: values are interpolated
};

/// A file that another one needs.
struct CompanionFile {
  std::string name;        ///< how diagnostics call it
  std::string_view bytes;  ///< alive as long as `owner`
  std::shared_ptr<const void> owner;
};

/// Finds the files that a format needs beside the one that is read: on the disk, or among those
/// that a page was given. Either function may be absent, which finds nothing.
struct Resolver {
  /// Opens a file by its name, relative to the one that is read, whatever the case of letters;
  /// never one above its folder.
  std::function<std::optional<CompanionFile>(const std::string& name)> open = {};
  /// The names of the files beside the one that is read that have an extension, in order.
  std::function<std::vector<std::string>(std::string_view extension)> list = {};
};

/// How to read a file.
struct ReadOptions {
  std::string source_name = "<memory>";  ///< how diagnostics call the input
  bool lenient = false;                  ///< repair what docs/errors.md names, with a warning each
  std::string encoding =
      {};  ///< "utf-8", "utf-16le", "utf-16be", "latin-1", "cp932"; empty: detect
  std::optional<double> fps =
      std::nullopt;  ///< overrides the file's frame rate, or says what it does not
  /// Metres in the unit of length that the format leaves open: BVH's unit; what an ASF file's
  /// lengths are in once they are divided by its own factor.
  std::optional<double> metres_per_unit = std::nullopt;
  TimedRounding timed_rounding = TimedRounding::Ceil;
  bool keeps_times = false;  ///< leaves timed frames at their times
  /// For motions that need one; `read_file` reads it from `skeleton_name` where it is null.
  std::shared_ptr<const Document> skeleton = nullptr;
  std::string skeleton_name = {};  ///< a path, and how diagnostics call it
  Resolver companions = {};
  /// Of a flow: the robot's project, for degrees and for checks of words and sounds.
  std::shared_ptr<const RobotProject> project = nullptr;
  FormatOptions of_formats = {};  ///< what single formats can be told: `bvh::ReadOptions`, ...
};

/// How to write a file.
struct WriteOptions {
  std::optional<int> decimals =
      std::nullopt;              ///< digits after the point; absent: the shortest exact form
  bool writes_companion = true;  ///< whether `write_file` writes the companion, too
  std::string companion = {};    ///< its name, for the file to tell it
  /// Of a flow's table: the robot's project, with which words are degrees.
  std::shared_ptr<const RobotProject> project = nullptr;
  FormatOptions of_formats =
      {};  ///< what single formats can be told: `choreonoid::WriteOptions`, ...
};

using ReadOption = Option<ReadOptions>;
using WriteOption = Option<WriteOptions>;

/// What the rest must know of a format's files to bring a document into it.
struct Conventions {
  Kinds writes = {};   ///< the kinds that `Format::write` takes
  std::size_t up = 1;  ///< the axis that is to point up in what is written, 1 y or 2 z
  std::optional<AngleUnit> angle_unit = std::nullopt;  ///< absent: either
  bool turns_at_rest = true;                           ///< whether joints may have rest rotations
  /// Whether a joint is a bone with one end, where all of its children are.
  bool has_one_end = false;
  /// Whether a body motion becomes a motion by its components, a column a value, not by its links.
  bool has_columns_of_components = false;
  /// Whether a body motion is the root's pose, the joints and a ZMP relative to the root.
  bool is_root_and_joints = false;
  std::optional<FlowFormat> flow_format = std::nullopt;  ///< the one that flows have; absent: any
  /// Whether it has a place for times of single frames, or no frames; a motion that goes into
  /// another format is interpolated to a steady rate first.
  bool keeps_times = false;
};

/// Takes the next piece of the output; returns false to stop.
using Sink = std::function<bool(std::string_view)>;

/// Starts a file of a set, by what its name has behind the stem of the set: ".waist".
using OpenPart = std::function<Result<Sink>(std::string_view extension)>;

/// Something that a file says, or how it is written, which the model does not hold.
struct Fact {
  std::string key;    ///< "line_end"
  std::string value;  ///< "lf"
  std::string words;  ///< for people: "line ends lf"; empty where the value is none for a line
};

/// A file format: what it is called and how it is read and written.
struct Format {
  std::string_view name;
  std::string_view description;
  std::span<const std::string_view> extensions;  ///< with the dot, lower case, the usual one first
  std::string_view companion =
      {};  ///< the format of a file that is written beside: "asf" for "amc"

  /// Tells whether a file that starts with these bytes is surely of this format; null: never.
  bool (*probe)(std::string_view head) = nullptr;

  /// Reads a document; null where the format is only written. On failure every error is in
  /// `diagnostics`, and the first of them is returned.
  Result<Document> (*read)(std::string_view bytes, const ReadOptions&, Diagnostics&) = nullptr;

  /// Writes a document; null where the format is only read, and where it is a set of files.
  Result<void> (*write)(const Document&, const WriteOptions&, const Sink&, Diagnostics&) = nullptr;

  /// Of a format that is a set of files of one stem, one an extension: writes those for which a
  /// document has something, each once it is started; null for all other formats.
  Result<void> (*write_set)(const Document&, const WriteOptions&, const OpenPart&,
                            Diagnostics&) = nullptr;

  bool takes_skeleton = false;  ///< whether reading asks for `ReadOptions::skeleton`

  /// Tells what is kept of the file that a document was read from, the most telling first; null:
  /// nothing.
  std::vector<Fact> (*facts)(const Document&) = nullptr;

  /// The type of a component in the words of the file that it was read from; empty where nothing is
  /// kept of that. Null where files do not say types.
  std::string (*component_type)(const Component&) = nullptr;

  /// Whether the file was read with position channels that are added to offsets, also where its
  /// skeleton does not show it; null: they never are.
  bool (*adds_positions)(const Document&) = nullptr;

  /// The options that mean something for reading and for writing this format: what is in neither
  /// table of the formats at hand has no effect. What every format takes (lenient) is in none.
  std::span<const ReadOption> read_options = {};
  std::span<const WriteOption> write_options = {};
  Conventions conventions = {};
};

/// Every format, in the order in which they are probed and listed.
std::span<const Format> formats();

/// Whether documents can be written in a format.
inline bool is_written(const Format& format) {
  return format.write != nullptr || format.write_set != nullptr;
}

/// What is known of the file that a document was read from (see `Format::facts`).
std::vector<Fact> facts_of(const Document& document);

/// The type of a component in the words of the document's file; empty if nothing is known of it
/// (see `Format::component_type`).
std::string component_type(const Document& document, const Component& component);

/// The format of this name, or null.
const Format* find_format(std::string_view name);

/// The format that a file's first bytes show, else the one that its name's extension does, else
/// null.
const Format* detect_format(std::string_view head, std::string_view file_name);

/// The format that a file's name shows by its extension, or null.
const Format* format_of_name(std::string_view file_name);

}  // namespace kinefile

#pragma GCC visibility pop
