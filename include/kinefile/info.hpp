// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/document.hpp"
#include "kinefile/format.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/robot_project.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// An order in which joints turn: "ZXY", outermost first; ? is an axis that is none of x, y and z.
struct RotationOrderInfo {
  std::string order;
  std::size_t num_joints = 0;
};

/// What a skeleton is.
struct SkeletonInfo {
  std::size_t num_joints = 0;
  std::size_t num_roots = 0;
  std::size_t num_tips = 0;
  std::size_t num_dofs = 0;
  std::size_t num_columns = 0;
  std::vector<RotationOrderInfo> rotation_orders;  ///< of joints that turn, in alphabetical order
  std::size_t num_joints_with_translations = 0;
  AngleUnit angle_unit = AngleUnit::Degrees;
  double metres_per_unit = 0;  ///< 0 where the file does not say
  Box rest_extent;             ///< of the rest pose, in the skeleton's unit of length
};

/// When frames happen. Times are in seconds.
struct TimeInfo {
  std::size_t num_frames = 0;
  std::int64_t first_frame_number = 0;  ///< what the file calls the first frame
  double frame_time = 0;
  double frame_rate = 0;
  double nominal_frame_rate = 0;  ///< see `kinefile::nominal_frame_rate`
  double duration = 0;            ///< from the first frame to the last
  bool has_own_times = false;     ///< the frames have times of their own
};

/// How a skeleton moves.
struct MotionInfo {
  TimeInfo time;
  Box extent;  ///< over all frames, in the skeleton's unit of length
};

/// What a component of a body motion is.
struct ComponentInfo {
  ComponentKind kind = ComponentKind::Values;
  std::string content;
  std::string type;  ///< in the words of its file (see `component_type`); may be empty
  std::size_t num_parts = 0;
  bool is_root_relative = false;
  TimeInfo time;
};

/// What a body motion is: angles in radians, lengths in metres.
struct BodyInfo {
  std::vector<ComponentInfo> components;  ///< in the order of the file
  std::optional<TimeInfo> time;           ///< of the main component (see `main_component`)
};

/// How many blocks of a flow are of one kind.
struct BlockCount {
  std::string_view kind;  ///< see `body_name`
  std::size_t num_blocks = 0;
};

/// What a pose of a flow says of a slider.
struct SliderInfo {
  std::size_t slider = 0;
  std::string name;  ///< the project's; "s3" where there is none
  std::int16_t word = 0;
  std::optional<double> degrees;  ///< where the project shows the slider in degrees
};

/// A pose of a flow, with the sliders that it enables.
struct PoseInfo {
  std::size_t block = 0;
  std::string name;
  int ticks = 0;
  std::string sound;
  std::vector<SliderInfo> sliders;
};

/// What a flow of poses is.
struct FlowInfo {
  FlowFormat format = FlowFormat::V1R4;
  std::size_t num_sliders = 0;
  std::size_t num_blocks = 0;
  std::vector<BlockCount> blocks;  ///< of the kinds that there are, in the order of the model
  std::vector<PoseInfo> poses;     ///< where they were asked for
};

/// What a document holds. Of the optional members those are there that its kind has: of a motion
/// `skeleton` and `motion`.
struct Info {
  std::string format;       ///< the name of the format that it was read from
  std::string_view kind;    ///< see `kind_name`
  std::vector<Fact> facts;  ///< of the file that it was read from (see `facts_of`)
  std::optional<SkeletonInfo> skeleton;
  std::optional<MotionInfo> motion;
  std::optional<BodyInfo> body;
  std::optional<FlowInfo> flow;
};

/// What to tell of a document.
struct InfoOptions {
  bool poses = false;                     ///< of a flow: its poses, too
  const RobotProject* project = nullptr;  ///< names sliders and says what degrees are; may be null
};

/// Tells what a document holds. Precondition: the document is valid (see `validate`).
Info info(const Document& document, const InfoOptions& options = {});

}  // namespace kinefile

#pragma GCC visibility pop
