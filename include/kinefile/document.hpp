// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <variant>

#include "kinefile/body_motion.hpp"
#include "kinefile/kept.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/pose_flow.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// The content of a file: one of the kinds of the model.
struct Document {
  std::variant<Motion, Skeleton, BodyMotion, PoseFlow> content;
  std::string format;  ///< the name of the format that it was read from, "bvh"
  Kept kept;           ///< what its format keeps of the file; see also `Joint::kept`
};

/// The name of a document's kind: "motion", "skeleton", "body_motion" or "pose_flow".
std::string_view kind_name(const Document& document);

/// A set of kinds of documents.
struct Kinds {
  bool motions = false;
  bool skeletons = false;
  bool body_motions = false;
  bool flows = false;
};

/// Whether a document is of one of these kinds.
bool contains(const Kinds& kinds, const Document& document);

/// The error for a document of an unsupported kind: DOC001 (Usage).
/// \param wanted  what was expected: "a motion to write as AMC"
Error wrong_kind(const Document& document, std::string_view wanted);

/// Checks what every function of documents relies on: see `validate` of a skeleton and of a motion;
/// the components of a body motion have as many values as their sizes require.
/// \errors MDL001 or MDL002 (InvalidInput)
Result<void> validate(const Document& document);

/// The skeleton of a motion, or the skeleton itself; an empty skeleton for a body motion and a
/// flow, which have none.
const Skeleton& skeleton_of(const Document& document);

/// The motion of a document, or its skeleton as a motion without frames. Precondition:
/// `has_skeleton`.
Motion still_or_moving(const Document& document);

/// Whether a document has a skeleton: a motion or a skeleton alone.
bool has_skeleton(const Document& document);

}  // namespace kinefile

#pragma GCC visibility pop
