// SPDX-License-Identifier: MIT
// What follows from a format's conventions, and how a changed motion goes back into its document.
#pragma once

#include <utility>

#include "kinefile/format.hpp"

namespace kinefile {

/// Whether a format accepts body motions, and no motions or skeletons.
inline bool takes_bodies_alone(const Conventions& conventions) {
  return conventions.writes.body_motions && !conventions.writes.motions;
}

/// Whether a motion can become a body motion, or columns of its components, for a format.
inline bool takes_components(const Conventions& conventions) {
  return takes_bodies_alone(conventions) || conventions.has_columns_of_components;
}

/// Expects that the known components of a body motion have one length and rate.
/// \errors CLI002 (Usage) if they do not
Result<void> expect_agreement(const BodyMotion& body);

/// Puts a motion into a document with a skeleton: its skeleton alone if the document has no frames.
inline void put_motion(Motion motion, Document& document) {
  if (std::holds_alternative<Skeleton>(document.content)) {
    document.content = std::move(motion.skeleton);
  } else {
    document.content = std::move(motion);
  }
}

}  // namespace kinefile
