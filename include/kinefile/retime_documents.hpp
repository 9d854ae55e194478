// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/document.hpp"
#include "kinefile/retime.hpp"

#pragma GCC visibility push(default)

/// What `retime` does to documents: motions, and body motions, whose components are retimed one by
/// one, each as a motion of loose parts (see `robot::motion_of_component`).
namespace kinefile::retime {

/// Whether a document has frames that can be shown at other times: a motion, or a body motion with
/// a component that kinefile knows.
bool has_frames(const Document& document);

/// How a document is warped.
struct DocumentWarp {
  WarpOptions options = {};
  bool keys_in_seconds = false;   ///< keys are in seconds, not frames
  bool follows_contacts = false;  ///< time stretches where a foot is on the ground; the weights of
                                  ///< `options` are these then (see `contact_weights`)
};

/// Finds the map through keys (see `warp_map`). Keys count frames of the motion, or of a body
/// motion's main component. A new frame of a document whose frames have times of their own happens
/// when the old frame of its number did.
/// \errors those of `warp_map` and `contact_weights`; DOC001 (Usage) if `has_frames` is false;
///         CLI002 (Usage) for contacts of a document without a skeleton
Result<TimeMap> warp_map(const Document& document, const DocumentWarp& warp,
                         Diagnostics& diagnostics);

/// Finds the map that brings a motion onto another (see `align_map` of motions).
/// \errors those of that function; DOC001 (Usage) if one of the documents is no motion
Result<TimeMap> align_map(const Document& document, const Document& reference,
                          const AlignOptions& options);

/// Shows a document's motion by a time map (see `apply` of a motion). The components of a body
/// motion must have one length and rate.
/// \errors those of that function; DOC001 (Usage) if `has_frames` is false; CLI002 (Usage) if the
///         components do not agree
Result<void> apply(Document& document, const TimeMap& map, const RetimeOptions& options,
                   Diagnostics& diagnostics);

/// Gives a document's motion another frame rate and the same duration (see `resample_map`); each
/// component of a body motion from its own rate.
/// \errors those of `resample_map` and of `apply`; DOC001 (Usage) if `has_frames` is false
Result<void> resample(Document& document, double frame_rate, const RetimeOptions& options,
                      Diagnostics& diagnostics);

}  // namespace kinefile::retime

#pragma GCC visibility pop
