// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/choreonoid/syntax.hpp"
#include "formats/files.hpp"
#include "kinefile/document.hpp"
#include "kinefile/format.hpp"

namespace kinefile::choreonoid {

/// What a document keeps of a .seq file.
struct KeptFile {
  TextLayout text;
  std::string version;  ///< as it is spelt; empty where it is not said
  bool is_snake_case = false;
  bool is_json = false;
  bool has_comments = false;
  std::string unknown_keys;  ///< as YAML lines
};

/// What a component keeps of one.
struct KeptComponent {
  std::string type;                                    ///< as it is spelt
  std::string content;                                 ///< as it is spelt
  PoseOrder pose_order = PoseOrder::QuaternionWFirst;  ///< of poses
  std::string unknown_keys;                            ///< as YAML lines
  std::string text;  ///< of a component of unknown type, all of it
};

/// What is kept of a .seq file; what its components keep comes with them.
KeptFile kept_of(const SeqFile& file, const TextLayout& text);

/// What a .seq file means. \param fps  instead of the rates that it says
BodyMotion bind(SeqFile&& file, std::optional<double> fps);

/// What its content is called here, whatever the format version calls it.
std::string_view usual_content(const SeqComponent& component);

/// The word for an order of a pose's numbers, "XYZRPY".
std::string_view word_of(PoseOrder order);

}  // namespace kinefile::choreonoid
