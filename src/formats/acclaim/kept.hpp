// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/acclaim/syntax.hpp"
#include "formats/files.hpp"

namespace kinefile::acclaim {

/// The source of the frame rate of a motion.
enum class RateSource { Asked, File, Assumed };

/// The data that is kept from an AMC file.
struct KeptMotion {
  std::string skeleton_name;  ///< of its ASF file
  std::string other_lines;    ///< before the first frame
  bool forces_3dof = false;
  RateSource rate = RateSource::Assumed;
  std::vector<std::string>
      bone_order;  ///< the bones that have values, in the order of the first frame
};

/// The data that a document keeps from an ASF file, or from an AMC file and its ASF file. Joints
/// keep the `Root` and the `Bone` that they were made from.
struct KeptFile {
  TextLayout text;  ///< of the file that was read; for AMC, not of its skeleton
  AsfFile asf;      ///< without the root and the bones
  std::optional<KeptMotion> motion;
};

/// The part of a skeleton's file that is kept.
inline AsfFile kept_of(AsfFile file) {
  file.root = {};
  file.bones.clear();
  if (!file.angle) file.angle = AngleUnit::Degrees;
  return file;
}

/// The data that a document keeps from an ASF or AMC file; empty for other documents.
inline KeptFile kept_file_of(const Document& document) {
  const KeptFile* const kept = document.kept.get<KeptFile>();
  return kept != nullptr ? *kept : KeptFile{};
}

/// The facts of a document of either format.
std::vector<Fact> facts(const Document& document);

}  // namespace kinefile::acclaim
