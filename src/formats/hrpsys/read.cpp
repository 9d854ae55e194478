// SPDX-License-Identifier: MIT
#include "formats/hrpsys/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/words.hpp"
#include "formats/files.hpp"
#include "formats/hrpsys/codes.hpp"
#include "formats/hrpsys/table.hpp"
#include "kinefile/math.hpp"

namespace kinefile::hrpsys {
namespace {

constexpr std::size_t kPositionAlone = 3;
constexpr std::size_t kPositionAndAngles = 6;
constexpr std::size_t kPositionAndMatrix = 12;
/// A matrix and six more numbers: what Choreonoid wrote until 2019.
constexpr std::size_t kPositionMatrixAndSpeeds = 18;
/// How far the product of a rotation matrix and its transpose may be from the identity: the
/// rounding error of six digits in such files.
constexpr double kRotationTolerance = 1e-3;

/// A file of the set, decoded.
struct Part {
  CompanionFile file;  ///< keeps the bytes
  text::DecodedText decoded;
  std::optional<text::Source> source;
  Table table;
};

class SetReader {
 public:
  SetReader(const ReadOptions& options, Diagnostics& diagnostics)
      : options_(options), diagnostics_(diagnostics) {}

  /// Reads one file of the set. False after an error.
  bool add(const std::string& extension, CompanionFile file) {
    Part& part = parts_[extension];  // its final place, because the table points into the text
    part.file = std::move(file);
    auto decoded = text::decode(part.file.bytes, options_.encoding, part.file.name, diagnostics_);
    if (!decoded) {
      diagnostics_.add(decoded.error());
      return false;
    }
    part.decoded = std::move(*decoded);
    part.source.emplace(part.file.name, part.decoded.view());
    auto table = parse_table(*part.source, options_.fps, diagnostics_);
    if (table) part.table = std::move(*table);
    return table.has_value();
  }

  /// The components of all files. Not valid if errors were reported.
  BodyMotion motion() {
    BodyMotion motion;
    if (const Part* joints = part(".pos")) {
      Component& component = start(motion, ComponentKind::Values, kJointDisplacement, *joints);
      component.num_parts = joints->table.num_values();
      copy_all(component, joints->table);
    }
    if (part(".waist") != nullptr || part(".hip") != nullptr) add_root(motion);
    if (const Part* zmp = part(".zmp")) {
      if (!has_columns(*zmp, {3}, "3 (x y z)")) return motion;
      Component& component = start(motion, ComponentKind::Vectors, kZmp, *zmp);
      component.is_root_relative = true;
      copy_all(component, zmp->table);
    }
    return motion;
  }

  /// The layout of the file that was named.
  TextLayout layout(const std::string& extension) const {
    return layout_of(parts_.at(extension).decoded);
  }

 private:
  const Part* part(const char* extension) const {
    const auto found = parts_.find(extension);
    return found == parts_.end() ? nullptr : &found->second;
  }

  void report(const Part& part, Severity severity, const char* code, std::string message,
              std::size_t frame = 0) {
    text::report(*part.source, diagnostics_, severity, code, std::move(message),
                 part.table.rows.starts[frame]);
  }

  bool has_columns(const Part& part, std::initializer_list<std::size_t> counts, const char* words) {
    const std::size_t found = part.table.num_values();
    if (std::find(counts.begin(), counts.end(), found) != counts.end()) return true;
    report(part, Severity::Error, code::kOtherColumns,
           fmt::format("expected a time and {} numbers, found {}", words, found));
    return false;
  }

  static Component& start(BodyMotion& motion, ComponentKind kind, std::string_view content,
                          const Part& part) {
    Component& component = motion.components.emplace_back();
    component.kind = kind;
    component.content = content;
    component.timeline = part.table.timeline;
    component.num_frames = part.table.num_frames();
    return component;
  }

  static void copy_all(Component& component, const Table& table) {
    component.values = table.values();
  }

  /// Adds the root's pose from .waist, from .hip, or from both.
  void add_root(BodyMotion& motion) {
    const Part* waist = part(".waist");
    const Part* hip = part(".hip");
    if (hip != nullptr && !has_columns(*hip, {3}, "3 (roll, pitch, yaw)")) return;
    if (waist == nullptr && hip == nullptr) return;  // there is no root without either
    if (waist == nullptr) {
      report(*hip, Severity::Warning, code::kNoOrientation,
             "expected a .waist file beside it, found none; the root stays at the origin");
      add_angles(start(motion, ComponentKind::Poses, kLinkPosition, *hip), nullptr, hip);
      return;
    }
    constexpr auto kWords =
        "3 (x y z), 6 (and roll, pitch, yaw), 12 (and a matrix) or 18 (and speeds)";
    const auto counts = {kPositionAlone, kPositionAndAngles, kPositionAndMatrix,
                         kPositionMatrixAndSpeeds};
    if (!has_columns(*waist, counts, kWords)) return;
    Component& component = start(motion, ComponentKind::Poses, kLinkPosition, *waist);
    switch (waist->table.num_values()) {
      case kPositionMatrixAndSpeeds:
        report(*waist, Severity::Note, code::kSpeedsLeftOut,
               "the six numbers after the matrix, the root's speeds, are left out");
        [[fallthrough]];
      case kPositionAndMatrix:
        add_matrices(component, *waist);
        break;
      case kPositionAndAngles:
        component.pose_form = PoseForm::RollPitchYaw;
        copy_all(component, waist->table);
        if (hip != nullptr) compare_with_hip(component, *waist, *hip);
        break;
      default:
        if (hip == nullptr) {
          report(*waist, Severity::Warning, code::kNoOrientation,
                 "expected a .hip file beside it, found none; the root does not turn");
        }
        if (hip != nullptr && !have_same_times(waist->table, hip->table)) {
          report_times(*hip, Severity::Error);
          return;
        }
        add_angles(component, waist, hip);
    }
  }

  /// Whether two files have the same times, within the rounding of a few digits.
  static bool have_same_times(const Table& a, const Table& b) {
    if (a.num_frames() != b.num_frames()) return false;
    const std::size_t last = a.num_frames() - 1;
    const double period = last > 0 ? (a.time(last) - a.time(0)) / static_cast<double>(last) : 1;
    for (std::size_t f = 0; f <= last; ++f) {
      if (!(std::abs(a.time(f) - b.time(f)) <= 1e-3 * period)) return false;
    }
    return true;
  }

  void report_times(const Part& hip, Severity severity) {
    report(hip, severity, code::kOtherTimes,
           "expected the times of the .waist file, row by row, found others");
  }

  /// Adds positions from one file and angles from another; missing values are 0.
  static void add_angles(Component& component, const Part* positions, const Part* angles) {
    component.pose_form = PoseForm::RollPitchYaw;
    component.values.assign(component.num_frames * kPositionAndAngles, 0.0);
    for (std::size_t f = 0; f < component.num_frames; ++f) {
      double* const out = component.mutate()[f].data();
      for (const Part* from : {positions, angles}) {
        if (from == nullptr) continue;
        std::copy_n(from->table.row(f), 3, out + (from == angles ? 3 : 0));
      }
    }
  }

  void add_matrices(Component& component, const Part& waist) {
    for (std::size_t f = 0; f < component.num_frames; ++f) {
      const double* row = waist.table.row(f);
      const Mat3 matrix = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row + 3);
      const double fault = (matrix * matrix.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff();
      if (!(fault <= kRotationTolerance) || !(matrix.determinant() > 0)) {
        report(waist, Severity::Error, code::kNoRotation,
               "expected x y z and a rotation matrix, row by row, found no rotation", f);
        return;
      }
      const Quat q = Quat(matrix).normalized();
      for (const double value : {row[0], row[1], row[2], q.w(), q.x(), q.y(), q.z()}) {
        component.values.push_back(value);
      }
    }
  }

  void compare_with_hip(const Component& component, const Part& waist, const Part& hip) {
    constexpr double kSame = 1e-5;  // both have six digits
    if (!have_same_times(waist.table, hip.table)) return report_times(hip, Severity::Warning);
    for (std::size_t f = 0; f < component.num_frames; ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double own = component.row(f)[3 + k], other = hip.table.row(f)[k];
        if (std::abs(own - other) <= kSame * std::max(1.0, std::abs(own))) continue;
        report(hip, Severity::Warning, code::kHipDiffers,
               fmt::format("expected the angles of the .waist file, found others, first in frame "
                           "{}; those of .waist count",
                           f),
               f);
        return;
      }
    }
  }

  const ReadOptions& options_;
  Diagnostics& diagnostics_;
  std::map<std::string, Part> parts_;
};

/// The stem of a file's name, without its folder, and its extension; empty without a known one.
std::pair<std::string, std::string> split_name(const std::string& path) {
  const std::string name = path.substr(path.find_last_of("/\\") + 1);
  for (const std::string_view extension : kParts) {
    if (lowered(name).ends_with(extension)) {
      return {name.substr(0, name.size() - extension.size()), std::string(extension)};
    }
  }
  return {};
}

Result<Document> read_alone(std::string_view bytes, const ReadOptions& options,
                            Diagnostics& diagnostics) {
  const auto [stem, own_part] = split_name(options.source_name);
  if (own_part.empty()) {
    return fail(make_error(ErrorKind::InvalidInput, code::kUnknownPart,
                           "expected a name that ends in .pos, .waist, .hip or .zmp",
                           options.source_name));
  }
  SetReader reader(options, diagnostics);
  for (const std::string_view extension : kParts) {
    std::optional<CompanionFile> file;
    if (extension == own_part) {
      file = CompanionFile{options.source_name, bytes, nullptr};
    } else if (options.companions.open) {
      file = options.companions.open(stem + std::string(extension));
    }
    if (file && !reader.add(std::string(extension), std::move(*file))) {
      return fail(diagnostics.first_error());
    }
  }
  Document document;
  document.format = "hrpsys";
  document.content = reader.motion();
  document.kept = Kept(reader.layout(own_part));
  return document;
}

}  // namespace

Result<Document> read(std::string_view bytes, const ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

}  // namespace kinefile::hrpsys
