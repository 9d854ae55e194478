// SPDX-License-Identifier: MIT
#pragma once

// Acclaim skeletons (ASF) and motions (AMC). The sources are
// - Schafer, "ASF: Acclaim Skeleton File Format", version 1.10,
// - the Acclaim notes of Vicon BodyBuilder, and Lander, "ASF-AMC", University of Wisconsin, 1999,
// - a survey of 562 AMC and 43 ASF files, in docs/formats/acclaim.md.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/acclaim/like_frames.hpp"
#include "kinefile/array.hpp"
#include "kinefile/skeleton.hpp"

namespace kinefile::acclaim {

/// A word of a `dof` or `order` line.
enum class DofWord { Tx, Ty, Tz, Rx, Ry, Rz, Length };

inline constexpr std::array<std::string_view, 7> kDofWords = {"tx", "ty", "tz", "rx",
                                                              "ry", "rz", "l"};

inline std::string_view spelling(DofWord word) { return kDofWords[static_cast<std::size_t>(word)]; }

constexpr bool is_rotation(DofWord word) { return word >= DofWord::Rx && word <= DofWord::Rz; }
constexpr bool is_translation(DofWord word) { return word <= DofWord::Tz; }

/// The coordinate axis of a rotation or a translation: 0 x, 1 y, 2 z.
constexpr std::size_t axis_of(DofWord word) { return static_cast<std::size_t>(word) % 3; }

/// The order in which three rotations about fixed axes are applied, first to last: "XYZ" is {0, 1,
/// 2} and gives Rz Ry Rx.
using AxisOrder = std::array<std::size_t, 3>;

/// "XYZ" for {0, 1, 2}.
inline std::string spelling(const AxisOrder& order) {
  return {"XYZ"[order[0]], "XYZ"[order[1]], "XYZ"[order[2]]};
}

/// The assumed unit of lengths after division by the unit of length.
inline constexpr double kMetresPerInch = 0.0254;

/// Three angles about x, y and z (in this order, whatever `order` is), in the file's unit.
struct Orientation {
  std::array<double, 3> angles{};
  AxisOrder order = {0, 1, 2};
};

struct Limit {
  double low = 0;  ///< may be infinite
  double high = 0;
};

/// `begin ... end` of :bonedata.
struct Bone {
  std::string id;
  std::string name;
  std::array<double, 3> direction{};  ///< in world coordinates, in the rest pose; not normalised
  double length = 0;
  Orientation axis;
  std::vector<DofWord> dofs;  ///< in the order of values and of application
  std::vector<Limit> limits;
  std::string body_mass;  ///< empty if the file does not specify it
  std::string cof_mass;
  std::vector<std::string> other_lines;  ///< lines that start with unknown words
  std::size_t parent = kNoParent;        ///< index of a bone, or kNoParent for the root
  const char* at = nullptr;              ///< its place in the text that was parsed
};

/// `:root`
struct Root {
  std::vector<DofWord> order;
  Orientation orientation;
  std::array<double, 3> position{};
};

/// The content of an ASF file.
struct AsfFile {
  std::string comments;  ///< the lines before the first section, without the last line end
  std::string version;
  std::string name;
  std::optional<double> mass;
  std::optional<double> length;
  std::optional<AngleUnit> angle;
  std::string documentation;  ///< its lines, unchanged
  Root root;
  std::vector<Bone> bones;     ///< in the order of :bonedata
  std::string skin;            ///< its lines, unchanged
  std::string other_sections;  ///< with their keywords, unchanged
};

/// The content of the lines before the first frame of an AMC file.
struct AmcHeader {
  std::string skeleton_hint;  ///< of `#!OML:ASF` or `:asf-file`
  std::string skeleton_path;  ///< of `:asf-path`
  const char* hint_at = nullptr;
  std::optional<AngleUnit> angle;
  bool forces_3dof = false;
  std::optional<double> samples_per_second;
  std::string other_lines;  ///< unknown keywords, and comments
};

/// A line in the body of an AMC file: the columns of the clip that hold a bone's values.
struct BoneColumns {
  std::string name;
  std::size_t first_column = 0;
  std::size_t num_columns = 0;
};

/// The frames of an AMC file.
struct AmcBody {
  Array<double> values;  ///< [frame][column]
  std::size_t num_frames = 0;
  std::int64_t first_frame_number = 1;
  std::int64_t last_frame_number = 1;
  std::vector<std::size_t> bone_order;  ///< of the first frame, as indices of BoneColumns
  std::optional<LikeFrames> like;       ///< how frames like the first one are read
};

/// Within these limits, frames a second and the times of frames are finite numbers.
inline constexpr double kLeastRate = 1e-9, kMostRate = 1e9;

/// A file may have this many bones.
inline constexpr std::size_t kMaxBones = 100'000;

}  // namespace kinefile::acclaim
