// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "kinefile/document.hpp"
#include "kinefile/flow.hpp"
#include "kinefile/format.hpp"
#include "kinefile/joint_map.hpp"
#include "kinefile/robot.hpp"
#include "kinefile/shape.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// Brings a document into a form that a format can write, where it is not in one already; the
/// world stays as it is. What had to be done is told in notes, what would be lost is an error.
/// Formats that write anything leave the document as it is.
/// \param channels  other channels that the motion is to have; its `lenient` leaves out what cannot
///                  be said, with a warning each
/// \errors those of shape.hpp; DOC001 (Usage) if a document without a skeleton is to have other
///         channels, or a format of skeletons is to take it
Result<Document> adapted_to(const Format& format, Document document,
                            const shape::ChannelOptions& channels, Diagnostics& diagnostics);

/// How a motion becomes a body motion, or the other way around.
struct KindOptions {
  std::optional<robot::BodyForm> form =
      std::nullopt;                 ///< absent: as it is; joints of a robot, else links
  const Document* model = nullptr;  ///< the robot of the body motion; null: none
  JointMap joint_map = {};          ///< for a motion that goes onto it
  std::optional<std::size_t> up = std::nullopt;  ///< the axis that is to point up, 1 y or 2 z;
                                                 ///< absent: z for body motions, y for BVH and ASF
  bool keeps_up = false;                         ///< leaves the axes as they are
  bool lenient = false;
  std::optional<FlowFormat> flow_format = std::nullopt;  ///< of a flow; absent: as it is
};

/// Brings a document into a kind that a format can write: a motion for BVH, ASF, AMC and CSV, a
/// body motion for .seq; a flow goes into the format that is asked for. What had to be taken for
/// granted is told in notes.
/// \errors those of robot.hpp and of `flow::in_format`; CNV002 and CNV006 (Usage) if there is no
/// way;
///         CNV007 (Usage) if the map, or a line of it, or the axis has no effect; DOC001 (Usage)
///         for a model that is none
Result<Document> in_kind_of(const Format& format, Document document, const KindOptions& options,
                            Diagnostics& diagnostics);

/// Interpolates frames that have times of their own to a steady rate (see `retime::rate_for`) where
/// a format has no place for such times, and tells the rate (CNV009); a warning where no usual rate
/// holds them. Components of a body motion get one rate and begin together. `in_kind_of` and
/// `adapted_to` do so first.
/// \errors those of `retime::with_steady_rate`; RTM002 (Usage) where no rate can be found
Result<Document> at_steady_rate(const Format& format, Document document, bool lenient,
                                Diagnostics& diagnostics);

/// Takes helper bones out (see `shape::without_helper_bones`) where a document of a format of bones
/// goes into another kind of format; a note tells it. `in_kind_of` and `adapted_to` do so first.
/// \param document  valid
Document without_helper_bones(const Format& format, Document document, Diagnostics& diagnostics);

/// Whether `in_kind_of` has a use for a model of the robot.
bool uses_model(const Format& format, const Document& document, const KindOptions& options);

/// Reads the motion of a file: see `read_file`. A body motion becomes the motion of its links.
/// \errors those of `read_file`; DOC001 (Usage) for a skeleton alone and a flow, BRG010 (Usage) for
/// a
///         body motion without poses of links
Result<Motion> read_motion(const std::string& path, Diagnostics& diagnostics,
                           const ReadOptions& options = {});

/// Whether two documents are written alike in a format but for line ends: whether a motion still
/// fits the skeleton that it was read with, say.
bool are_written_alike(const Format& format, const Document& a, const Document& b);

/// Puts a document's motion on another skeleton (see `shape::onto_skeleton`), with what that one's
/// format keeps of it. \errors those of `shape::onto_skeleton`; CNV001 (Usage) for a document
/// without a motion
Result<Document> on_skeleton_of(const Document& skeleton, Document document,
                                Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
