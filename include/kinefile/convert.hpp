// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "kinefile/document.hpp"
#include "kinefile/flow.hpp"
#include "kinefile/format.hpp"
#include "kinefile/frame_source.hpp"
#include "kinefile/joint_map.hpp"
#include "kinefile/robot.hpp"
#include "kinefile/shape.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// Changes a document into a form that a format can write, if it does not have one already.
/// Positions and rotations in the world stay the same. Notes report each change; a loss of data is
/// an error. For a format that writes any form, the document stays unchanged.
/// \param channels  channels that the motion shall have; with its `lenient`, data that the format
///                  cannot store is dropped, with a warning each
/// \errors those of shape.hpp; DOC001 (Usage) if a document without a skeleton shall get other
///         channels or be written in a format of skeletons
Result<Document> adapted_to(const Format& format, Document document,
                            const shape::ChannelOptions& channels, Diagnostics& diagnostics);

/// The same for a motion whose frames are read when they are asked for; so are the new ones. All
/// frames are read before, once or twice, where that decides how.
/// \returns empty if the conversion needs all frames at once: to BVH from another format, from a
///          format of bones to one without, and of frames with times of their own
std::optional<Result<LongMotion>> adapted_in_blocks(const Format& format, const LongMotion& motion,
                                                    const shape::ChannelOptions& channels,
                                                    Diagnostics& diagnostics);

/// How to convert a motion to a body motion, or vice versa.
struct KindOptions {
  /// Absent: unchanged; for a motion the joints if it is a robot's, otherwise the links.
  std::optional<robot::BodyForm> form = std::nullopt;
  const Document* model = nullptr;               ///< the robot of the body motion; null: none
  JointMap joint_map = {};                       ///< for a motion that is transferred to the robot
  std::optional<std::size_t> up = std::nullopt;  ///< the axis that shall point up, 1 y or 2 z;
                                                 ///< absent: z for body motions, y for BVH and ASF
  bool keeps_up = false;                         ///< keeps the axes unchanged
  bool lenient = false;
  std::optional<FlowFormat> flow_format = std::nullopt;  ///< for a flow; absent: unchanged
};

/// Converts a document to a kind that a format can write: a motion for BVH, ASF, AMC and CSV, a
/// body motion for .seq. A flow is converted to the requested flow format. Notes report the
/// assumptions made.
/// \errors those of robot.hpp and of `flow::in_format`; CNV002 and CNV006 (Usage) if there is no
///         conversion; CNV007 (Usage) if the map, or a line of it, or the axis has no effect;
///         DOC001 (Usage) if the model is not a skeleton
Result<Document> in_kind_of(const Format& format, Document document, const KindOptions& options,
                            Diagnostics& diagnostics);

/// Interpolates frames that have their own times to a steady rate (see `retime::rate_for`) if a
/// format cannot store such times. A note reports the rate (CNV009); a warning if no common rate
/// matches the times. Components of a body motion get one rate and start at the same time.
/// `in_kind_of` and `adapted_to` call this first.
/// \errors those of `retime::with_steady_rate`; RTM002 (Usage) if no rate can be found
Result<Document> at_steady_rate(const Format& format, Document document, bool lenient,
                                Diagnostics& diagnostics);

/// Removes helper bones (see `shape::without_helper_bones`) if a document of a format of bones is
/// converted to a format without bones; a note reports it. `in_kind_of` and `adapted_to` call this
/// first.
/// \param document  valid
Document without_helper_bones(const Format& format, Document document, Diagnostics& diagnostics);

/// Whether `in_kind_of` can use a model of the robot.
bool uses_model(const Format& format, const Document& document, const KindOptions& options);

/// Reads the motion of a file: see `read_file`. A body motion becomes the motion of its links.
/// \errors those of `read_file`; DOC001 (Usage) for a skeleton alone and a flow, BRG010 (Usage) for
///         a body motion without link poses
Result<Motion> read_motion(const std::string& path, Diagnostics& diagnostics,
                           const ReadOptions& options = {});

/// Whether a format writes two documents the same except for line ends. Tells, for example, whether
/// a motion still fits the skeleton that it was read with.
bool are_written_alike(const Format& format, const Document& a, const Document& b);

/// Transfers a document's motion to another skeleton (see `shape::onto_skeleton`), with what the
/// format of that skeleton keeps.
/// \errors those of `shape::onto_skeleton`; CNV001 (Usage) for a document without a motion
Result<Document> on_skeleton_of(const Document& skeleton, Document document,
                                Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
