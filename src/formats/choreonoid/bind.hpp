// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/choreonoid/syntax.hpp"
#include "formats/files.hpp"
#include "kinefile/document.hpp"
#include "kinefile/format.hpp"

namespace kinefile::choreonoid {

/// The data that a document keeps from a .seq file.
struct KeptFile {
  TextLayout text;
  std::string version;  ///< as spelled in the file; empty if it is missing
  bool is_snake_case = false;
  bool is_json = false;
  bool has_comments = false;
  std::string unknown_keys;  ///< as YAML lines
  /// How frames with times became frames of a steady rate; absent: they have no times, or keep
  /// them.
  std::optional<TimedRounding> rounding = std::nullopt;
};

/// The data that a component keeps from a .seq file.
struct KeptComponent {
  std::string type;                                    ///< as spelled in the file
  std::string content;                                 ///< as spelled in the file
  PoseOrder pose_order = PoseOrder::QuaternionWFirst;  ///< of poses
  std::string unknown_keys;                            ///< as YAML lines
  std::string text;  ///< the whole text of a component of unknown type
};

/// The data kept from a .seq file; its components keep their own data.
KeptFile kept_of(const SeqFile& file, const TextLayout& text);

/// The body motion of a .seq file.
/// \param fps  replaces the rates in the file
BodyMotion bind(SeqFile&& file, std::optional<double> fps);

/// The name of its content in kinefile, whatever its name in the format version.
std::string_view usual_content(const SeqComponent& component);

/// The word for an order of a pose's numbers, "XYZRPY".
std::string_view word_of(PoseOrder order);

}  // namespace kinefile::choreonoid
