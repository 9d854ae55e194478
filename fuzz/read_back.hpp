// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <compare>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "checks.hpp"
#include "folder.hpp"

namespace kinefile::fuzz {

/// Ends the process with a message if something does not hold.
/// \param detail  what it is about: an error's message, a file's bytes
inline void require(bool condition, const char* what, const std::string& detail) {
  if (condition) return;
  std::fprintf(stderr, "journey: %s: %s\n", what, detail.c_str());
  std::abort();
}

inline Sink appending_to(std::string& text) {
  return [&text](std::string_view piece) {
    text += piece;
    return true;
  };
}

inline bool is_json(const std::string& text) { return nlohmann::json::accept(text); }

/// How many numbers a document has, which conversions copy.
inline std::size_t num_values_of(const Document& document) {
  if (const auto* flow = std::get_if<PoseFlow>(&document.content)) {
    return flow->blocks.size() * flow->num_sliders;
  }
  const auto* body = std::get_if<BodyMotion>(&document.content);
  if (body == nullptr) {
    const Motion motion = still_or_moving(document);
    return motion.clip.values.size() + motion.skeleton.joints.size();
  }
  std::size_t count = 0;
  for (const Component& component : body->components) count += component.values.size();
  return count;
}

/// The files that a document is written as; nothing if it is refused, which has a reason.
inline std::optional<Folder> files_of(const Document& document, const Format& format,
                                      const WriteOptions& options) {
  const auto files = std::make_shared<Folder>();
  const OutputFiles memory = files_in_memory(files);
  Diagnostics diagnostics;
  const std::string name =
      format.write_set != nullptr ? "out" : "out" + std::string(format.extensions.front());
  const auto written = write(name, document, format, options, memory, diagnostics);
  if (!written) {
    require(written.error().kind != ErrorKind::Io && !written.error().message.empty(),
            "memory has no faults", written.error().message);
    return std::nullopt;
  }
  require(memory.commit().has_value(), "not committed", name);
  return *files;
}

/// The file of a set or a pair by which it is read.
inline const MemoryFile& main_file(const Folder& files, const Format& format) {
  if (format.write_set != nullptr) return files.front();
  return files.back();  // behind its companion
}

/// Rows of a table that cannot be read, since its columns need their skeleton: as many numbers as
/// the motion has, and the same ones.
inline void require_rows(const std::string& csv, const Motion& motion) {
  std::vector<double> values;
  const std::size_t num_rows = motion.clip.num_frames;
  // Names may hold line ends, so that rows are counted from the end.
  std::size_t at = csv.size();
  for (std::size_t i = 0; i < num_rows; ++i) at = csv.rfind('\n', at - 2);
  const char* next = csv.c_str() + at;
  for (std::size_t i = 0; i < num_rows * (motion.clip.num_coordinates + 1); ++i) {
    char* end = nullptr;
    const double value = std::strtod(next + 1, &end);
    require(end != next + 1, "no number in a table", std::string(next));
    next = end;
    if (i % (motion.clip.num_coordinates + 1) != 0) values.push_back(value);
  }
  require(same_values(values, motion.clip.values), "a table has other values", csv);
}

/// Whether rates are the same, but for the rounding of a frame time that is written as a rate.
inline bool is_near(double a, double b) { return a == b || std::abs(a - b) <= a * 1e-14; }

/// The values of each frame by size: a file has columns in the order of its hierarchy.
inline std::vector<double> sorted_rows(const Clip& clip) {
  std::vector<double> values(clip.values.begin(), clip.values.end());
  for (double& value : values) {
    if (std::isnan(value)) value = std::numeric_limits<double>::quiet_NaN();  // of either sign
  }
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const auto row = values.begin() + static_cast<std::ptrdiff_t>(f * clip.num_coordinates);
    std::sort(row, row + static_cast<std::ptrdiff_t>(clip.num_coordinates),
              [](double x, double y) { return std::strong_order(x, y) < 0; });
  }
  return values;
}

/// Joints are where they were, but for rounding. Motions beyond all measure are not compared.
inline void require_same_places(const Motion& a, const Motion& b, const std::string& text) {
  const WorldPoses before = forward_kinematics(a.skeleton, a.clip, {});
  double size = 1;
  for (const double number : before.positions) {
    if (!(std::abs(number) < 1e9)) return;
    size = std::max(size, std::abs(number));
  }
  Motion in_units = b;  // what a unit is comes from an option, not from the file
  in_units.skeleton.metres_per_unit = 0;
  const MotionComparison comparison = compare_motions(a, in_units);
  require(comparison.only_in_first.empty(), "joints are gone", text);
  require(comparison.distance.value <= 1e-6 * size, "joints are elsewhere", text);
}

inline void require_same(const Motion& a, const Motion& b, const std::string& text) {
  require(a.clip.num_frames == b.clip.num_frames, "another number of frames", text);
  require(a.skeleton.joints.size() == b.skeleton.joints.size(), "another number of joints", text);
  require(same_values(sorted_rows(a.clip), sorted_rows(b.clip)), "other values", text);
  require_same_places(a, b, text);
  require(
      a.clip.num_frames == 0 || is_near(frame_time(a.clip.timeline), frame_time(b.clip.timeline)),
      "another frame time", text);
}

inline void require_same(const BodyMotion& a, const BodyMotion& b, const std::string& text) {
  require(a.components.size() == b.components.size(), "other components", text);
  for (std::size_t i = 0; i < a.components.size(); ++i) {
    const Component& one = a.components[i];
    const Component& other = b.components[i];
    require(one.kind == other.kind, "another component", text);
    if (one.kind == ComponentKind::Other) continue;  // a text, which is written again as it stands
    require(one.content == other.content, "another content", text);
    require(one.num_frames == other.num_frames && one.num_parts == other.num_parts,
            "another size of a component", text);
    require(same_values(one.values, other.values), "other values of a component", text);
    require(same_values(own_times(one.timeline), own_times(other.timeline)), "other times", text);
    const double rate = nominal_frame_rate(one.timeline);  // as which a cut frame time is written
    require(is_near(rate, frame_rate(other.timeline)), "another rate", text);
  }
}

/// What a format that keeps every bit gives back is what was written.
inline void require_same(const Document& a, const Document& b, const std::string& text) {
  if (const auto* flow = std::get_if<PoseFlow>(&a.content)) {
    require(*flow == std::get<PoseFlow>(b.content), "another flow", text);
  }
  if (a.content.index() != b.content.index()) return;
  if (const auto* motion = std::get_if<Motion>(&a.content)) {
    require_same(*motion, std::get<Motion>(b.content), text);
  }
  if (b.format != "choreonoid") return;  // others have no place for some components
  require_same(std::get<BodyMotion>(a.content), std::get<BodyMotion>(b.content), text);
}

/// Reads written files, which must succeed, compares them with the document that was written, and
/// writes them again, which must give the same bytes.
/// \param was_body  whether a table holds a body motion, which can be read
/// \param options   for the reader: what the document was read with
inline void read_back(const Folder& files, const Document& written, const Format& format,
                      bool was_body, ReadOptions options) {
  const MemoryFile& file = main_file(files, format);
  if (format.name == "json") return require(is_json(file.bytes), "no JSON", file.bytes);
  const Motion* const motion = std::get_if<Motion>(&written.content);
  if (format.name == "csv" && motion != nullptr && !was_body)
    return require_rows(file.bytes, *motion);
  // Leniently, a table is written although its names do not read (CNV012).
  if (format.name == "csv" && was_body && options.lenient) return;
  options.companions = resolver_of(files);
  Diagnostics diagnostics;
  const auto again = read_bytes(file.bytes, file.name, &format, options, diagnostics);
  if (!again) {
    require(false, to_string(again.error()).c_str(), file.name + "\n" + file.bytes);
  }
  check_reading(again, diagnostics);
  require_same(written, *again, file.bytes);
  WriteOptions writing;
  const auto adapted = adapt(*again, format, {}, writing, diagnostics);
  require(adapted.has_value(), "read back, and not adapted again", file.bytes);
  const auto second = files_of(*adapted, format, writing);
  require(second.has_value(), "read back, and not written again", file.bytes);
  require(second->size() == files.size(), "other files are written again", file.bytes);
  for (std::size_t i = 0; i < files.size(); ++i) {
    require((*second)[i].bytes == files[i].bytes, "written again otherwise",
            files[i].bytes + "\n-- again --\n" + (*second)[i].bytes);
  }
}

}  // namespace kinefile::fuzz
