// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinefile/format.hpp"
#include "kinefile/operation.hpp"
#include "kinefile/place.hpp"
#include "kinefile/pose_table.hpp"
#include "kinefile/robot.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// What to tell of where joints are, beside their positions.
struct FkOptions {
  bool rest = false;                     ///< the rest pose, as the only frame
  std::string frames = {};               ///< A:B or A:B:STEP (see `parse_range`); empty: all
  std::vector<std::string> joints = {};  ///< by name; empty: all
  bool tips = false;
  bool rotations = false;
  bool directions = false;  ///< of the bones
  bool local = false;       ///< in the frame of each joint's parent
  bool metres = false;      ///< lengths in metres, not in the file's unit
  std::string name = {};    ///< what errors call the document
};

/// Where joints are, frame by frame. Poses are computed when they are asked for, so that a long
/// motion needs little memory.
struct FkTable {
  Placed placed;  ///< of the rest pose: a clip of one frame
  FkOptions options;
  FrameRange frames;
  std::vector<std::size_t> joints;  ///< which ones, in skeleton order
  double length_scale = 1;          ///< lengths are multiplied by this

  /// What the writers of tables want to know. \returns a view of this, which must outlive it
  PoseTable view() const;
};

/// Prepares a table of where joints are (forward kinematics).
/// \errors CLI001 (Usage) for a skeleton alone without `rest`, frames that the motion does not
///         have, a name that is no joint's, and metres where the file does not say its unit
Result<FkTable> fk(Placed placed, const FkOptions& options);

/// The poses of all joints over some frames of a table's clip: in the world, or in the frames of
/// the joints' parents (`FkOptions::local`). Lengths are in the file's unit.
PoseArrays poses_of(const FkTable& table, const FrameRange& frames);

/// Writes a table as CSV, a block of frames at a time (see `write_pose_csv`). Returns false if the
/// sink did.
bool write_csv(const FkTable& table, const Sink& sink);

/// Writes a table as a JSON object (see `write_pose_json`). Returns false if the sink did.
bool write_json(const FkTable& table, const Sink& sink);

/// Tells how far kinematics and the recorded poses of links differ, one entry a link.
/// \errors DOC001 (Usage) if the document is no body motion; CNV002 (Usage) if there is no robot;
///         those of `robot` and of `robot::compare_recorded_links`
Result<std::vector<robot::LinkDeviation>> compare_links(const Document& document,
                                                        const DocumentSource& robot, bool lenient,
                                                        Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
