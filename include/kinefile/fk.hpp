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

/// What a table of joints shows in addition to positions.
struct FkOptions {
  bool rest = false;                     ///< the rest pose, as the only frame
  std::string frames = {};               ///< A:B or A:B:STEP (see `parse_range`); empty: all
  std::vector<std::string> joints = {};  ///< by name; empty: all
  bool tips = false;
  bool rotations = false;
  bool directions = false;  ///< directions of the bones
  bool local = false;       ///< in the frame of each joint's parent
  bool metres = false;      ///< lengths in metres, not in the file's unit
  std::string name = {};    ///< the name of the document in errors
};

/// Positions of joints, frame by frame. Poses are computed on request, so that a long motion needs
/// little memory.
struct FkTable {
  Placed placed;  ///< for the rest pose: a clip of one frame
  FkOptions options;
  FrameRange frames;
  std::vector<std::size_t> joints;  ///< the joints shown, in skeleton order
  double length_scale = 1;          ///< lengths are multiplied by this
  /// Gives the frames if the clip has none, since they are read when they are asked for.
  std::optional<FrameSource> source = std::nullopt;

  /// The input of the table writers: a view of this table, which must outlive it.
  PoseTable view() const;
};

/// Prepares a table of joint positions (forward kinematics).
/// \errors CLI001 (Usage) for a skeleton alone without `rest`, frames that the motion does not
///         have, a name that no joint has, and metres if the file does not specify its unit
Result<FkTable> fk(Placed placed, const FkOptions& options);

/// As above, for a motion whose frames are read when they are asked for.
Result<FkTable> fk(const LongMotion& motion, const FkOptions& options);

/// The poses of all joints over some frames of a table's clip: in the world, or in the frame of
/// each joint's parent (`FkOptions::local`). Lengths are in the file's unit. Precondition: the clip
/// has the frames.
PoseArrays poses_of(const FkTable& table, const FrameRange& frames);

/// Writes a table. Poses are computed a block of frames at a time. Precondition: the format has
/// `write_poses`.
/// \errors IO003 if the sink returned false; those of `FrameSource::rows`
Result<void> write_table(const FkTable& table, const Format& format, const WriteOptions& options,
                         const Sink& sink);

/// Computes how far kinematics and the recorded poses of links differ, one entry per link.
/// \errors DOC001 (Usage) if the document is not a body motion; CNV002 (Usage) if there is no
///         robot; those of `robot` and of `robot::compare_recorded_links`
Result<std::vector<robot::LinkDeviation>> compare_links(const Document& document,
                                                        const DocumentSource& robot, bool lenient,
                                                        Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
