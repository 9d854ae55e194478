// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "kinefile/document.hpp"
#include "kinefile/option.hpp"
#include "kinefile/retime.hpp"

#pragma GCC visibility push(default)

/// Retiming of documents: motions, and body motions, whose components are retimed one by one, each
/// as a motion of separate parts (see `robot::motion_of_component`).
namespace kinefile::retime {

/// Whether a document can be retimed: a motion, or a body motion with a component that kinefile
/// knows.
bool has_frames(const Document& document);

/// How a document is warped.
struct DocumentWarp {
  WarpOptions options = {};
  bool keys_in_seconds = false;   ///< keys are in seconds, not frames
  bool follows_contacts = false;  ///< time stretches where a foot is on the ground:
                                  ///< `contact_weights` replace the weights of `options`
};

/// The options of a warp: key, tail, curve, ease, contacts, allow-hold, allow-reverse, seconds. Of
/// `WarpOptions::weights` there is none.
std::span<const Option<DocumentWarp>> warp_options();

/// The options of showing a motion at other times: rotation, antialias. `RetimeOptions::lenient` is
/// not among them: it goes with the leniency of reading.
std::span<const Option<RetimeOptions>> retime_options();

/// The options of aligning two motions: by.
std::span<const Option<AlignOptions>> align_options();

/// A warp as the words of the command line that ask for it, without what is the default:
/// {"--key", "150:160", "--tail", "extend"}. `warp_options` reads them as the same warp, except for
/// `WarpOptions::weights`, which no option sets. Numbers are in their shortest exact form.
/// \param warp  with keys and an ease that are finite
std::vector<std::string> words_of(const DocumentWarp& warp);

/// The same for how a motion is shown at other times, for `retime_options`.
std::vector<std::string> words_of(const RetimeOptions& options);

/// Finds the map through keys (see `warp_map`). Keys count frames of the motion, or of a body
/// motion's main component. If frames have their own times, a new frame gets the time of the old
/// frame with the same number.
/// \errors those of `warp_map` and `contact_weights`; DOC001 (Usage) if `has_frames` is false;
///         CLI002 (Usage) for contacts of a document without a skeleton
Result<TimeMap> warp_map(const Document& document, const DocumentWarp& warp,
                         Diagnostics& diagnostics);

/// Finds the map that aligns a motion with another (see `align_map` of motions).
/// \errors those of that function; DOC001 (Usage) if one of the documents is not a motion
Result<TimeMap> align_map(const Document& document, const Document& reference,
                          const AlignOptions& options, Diagnostics& diagnostics);

/// Applies a time map to a document's motion (see `apply` of a motion). The components of a body
/// motion must have one length and rate.
/// \errors those of that function; DOC001 (Usage) if `has_frames` is false; CLI002 (Usage) if the
///         components do not agree
Result<void> apply(Document& document, const TimeMap& map, const RetimeOptions& options,
                   Diagnostics& diagnostics);

/// Resamples a document's motion to another frame rate, with the same duration (see
/// `resample_map`); each component of a body motion from its own rate. Components that end before
/// the others hold their last values, with a diagnostic (RTM010).
/// \errors those of `resample_map` and of `apply`; DOC001 (Usage) if `has_frames` is false
Result<void> resample(Document& document, double frame_rate, const RetimeOptions& options,
                      Diagnostics& diagnostics);

}  // namespace kinefile::retime

#pragma GCC visibility pop
