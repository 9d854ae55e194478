// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/document.hpp"
#include "kinefile/evidence.hpp"
#include "kinefile/format.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/robot_project.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// An order of rotations: "ZXY", outermost first; ? is an axis other than x, y and z.
struct RotationOrderInfo {
  std::string order;
  std::size_t num_joints = 0;
};

/// Properties of a skeleton.
struct SkeletonInfo {
  std::size_t num_joints = 0;
  std::size_t num_roots = 0;
  std::size_t num_tips = 0;
  std::size_t num_dofs = 0;
  std::size_t num_columns = 0;
  std::vector<RotationOrderInfo> rotation_orders;  ///< of joints with rotations, in alphabetical
                                                   ///< order
  std::size_t num_joints_with_translations = 0;
  AngleUnit angle_unit = AngleUnit::Degrees;
  double metres_per_unit = 0;  ///< 0 if the file does not specify it
  Box rest_extent;             ///< of the rest pose, in the skeleton's unit of length
};

/// The times of frames, in seconds.
struct TimeInfo {
  std::size_t num_frames = 0;
  std::int64_t first_frame_number = 0;  ///< the file's number of the first frame
  double frame_time = 0;
  double frame_rate = 0;
  double nominal_frame_rate = 0;  ///< see `kinefile::nominal_frame_rate`
  double duration = 0;            ///< from the first frame to the last
  bool has_own_times = false;     ///< the frames have their own times
};

/// Properties of a skeleton's motion.
struct MotionInfo {
  TimeInfo time;
  Box extent;  ///< over all frames, in the skeleton's unit of length
};

/// What the file does not say and the skeleton and its motion show; or what is known.
struct EvidenceInfo {
  UpAxis up;
  Facing facing;    ///< in frame 0; in the rest pose if there are no frames
  LengthUnit unit;  ///< of length
};

/// Properties of a component of a body motion.
struct ComponentInfo {
  ComponentKind kind = ComponentKind::Values;
  std::string content;
  std::string type;  ///< as named in its file (see `component_type`); may be empty
  std::size_t num_parts = 0;
  bool is_root_relative = false;
  TimeInfo time;
};

/// Properties of a body motion: angles in radians, lengths in metres.
struct BodyInfo {
  std::vector<ComponentInfo> components;  ///< in the order of the file
  std::optional<TimeInfo> time;           ///< of the main component (see `main_component`)
};

/// The number of blocks of one kind in a flow.
struct BlockCount {
  std::string_view kind;  ///< see `body_name`
  std::size_t num_blocks = 0;
};

/// A slider in a pose of a flow.
struct SliderInfo {
  std::size_t slider = 0;
  std::string name;  ///< from the project; without one "s3"
  std::int16_t word = 0;
  std::optional<double> degrees;  ///< if the project shows the slider in degrees
};

/// A pose of a flow, with the sliders that it enables.
struct PoseInfo {
  std::size_t block = 0;
  std::string name;
  int ticks = 0;
  std::string sound;
  std::vector<SliderInfo> sliders;
};

/// Properties of a flow of poses.
struct FlowInfo {
  FlowFormat format = FlowFormat::V1R4;
  std::size_t num_sliders = 0;
  std::size_t num_blocks = 0;
  std::vector<BlockCount> blocks;  ///< of the kinds that occur, in the order of the model
  std::vector<PoseInfo> poses;     ///< only if requested
};

/// What a document holds. The optional members that belong to its kind are present: for a motion
/// `skeleton` and `motion`.
struct Info {
  std::string format;       ///< the name of the format that it was read from
  std::string_view kind;    ///< see `kind_name`
  std::vector<Fact> facts;  ///< facts about the file that it was read from (see `facts_of`)
  std::optional<SkeletonInfo> skeleton;
  std::optional<EvidenceInfo> evidence;  ///< with `skeleton`
  std::optional<MotionInfo> motion;
  std::optional<BodyInfo> body;
  std::optional<FlowInfo> flow;
};

/// What to include in the info of a document.
struct InfoOptions {
  bool poses = false;                     ///< for a flow: its poses, too
  const RobotProject* project = nullptr;  ///< gives names and degrees of sliders; may be null
};

/// Describes what a document holds. Precondition: the document is valid (see `validate`).
Info info(const Document& document, const InfoOptions& options = {});

}  // namespace kinefile

#pragma GCC visibility pop
