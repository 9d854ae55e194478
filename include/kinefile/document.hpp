// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <variant>

#include "kinefile/body_motion.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/pose_flow.hpp"

namespace kinefile {

/// What a format keeps beyond the model and needs to write the same file again, without the
/// numbers: words for that format alone, by key. Another format leaves them out.
struct Extras {
  std::map<std::string, std::string> file;                           ///< key to value
  std::map<std::string, std::map<std::string, std::string>> joints;  ///< joint name, key to value
};

/// The content of a file: one of the kinds of the model.
struct Document {
  std::variant<Motion, Skeleton, BodyMotion, PoseFlow> content;
  std::string format;  ///< the name of the format that it was read from, "bvh"
  Extras extras;
};

/// The word for what a document holds: "motion", "skeleton", "body_motion" or "pose_flow".
std::string_view kind_name(const Document& document);

/// The skeleton of a motion, or the skeleton itself. A body motion and a flow have
/// none: a precondition.
const Skeleton& skeleton_of(const Document& document);

/// The motion of a document, or its skeleton as a motion without frames. Precondition:
/// `has_skeleton`.
Motion still_or_moving(const Document& document);

/// Whether a document has a skeleton: a motion or a skeleton alone.
bool has_skeleton(const Document& document);

}  // namespace kinefile
