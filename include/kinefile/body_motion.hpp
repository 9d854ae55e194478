// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/array.hpp"
#include "kinefile/kept.hpp"
#include "kinefile/timeline.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// What the frames of a component hold.
enum class ComponentKind {
  Values,   ///< numbers, one a part: joints' angles in radians, displacements in metres
  Poses,    ///< positions in metres and rotations, one a part
  Vectors,  ///< one vector in three dimensions
  Other,    ///< unknown to kinefile; its format keeps it as text
};

/// How a pose says its rotation.
enum class PoseForm {
  Quaternion,    ///< x y z qw qx qy qz, not necessarily of unit length
  RollPitchYaw,  ///< x y z roll pitch yaw, in radians: R = Rz(yaw) Ry(pitch) Rx(roll)
};

/// What components of known use are called.
inline constexpr std::string_view kJointDisplacement = "JointDisplacement";
inline constexpr std::string_view kLinkPosition = "LinkPosition";
inline constexpr std::string_view kZmp = "ZMP";

/// What follows the content in the names of columns of vectors that are relative to the root link:
/// ZMP.root.x.
inline constexpr std::string_view kRootRelativeSuffix = ".root";

/// One kind of data over time, with a rate and a length of its own.
struct Component {
  ComponentKind kind = ComponentKind::Values;
  std::string content;  ///< what it is: `kJointDisplacement` in order of joint ids, `kLinkPosition`
                        ///< in order of links, `kZmp`, or any other word
  std::size_t num_parts = 1;            ///< 1 for vectors
  std::vector<std::string> part_names;  ///< of joints or links, where the source names them (CSV, a
                                        ///< servo map); empty otherwise
  PoseForm pose_form = PoseForm::Quaternion;
  bool is_root_relative = false;  ///< of vectors: in the frame of the root link, not the world's
  std::size_t num_frames = 0;
  Array<double> values;  ///< [frame][part][width], exactly as read
  Timeline timeline;
  Kept kept;  ///< what its format keeps of it beyond the model

  /// The numbers of one part: 1, 7 or 6 for a pose, 3.
  std::size_t width() const {
    if (kind == ComponentKind::Vectors) return 3;
    if (kind != ComponentKind::Poses) return 1;
    return pose_form == PoseForm::Quaternion ? 7 : 6;
  }
  std::size_t row_size() const { return num_parts * width(); }
  std::span<const double> row(std::size_t frame) const {
    return {values.data() + frame * row_size(), row_size()};
  }
  /// The rows, to be written (see `Array::mutate`).
  Rows mutate() { return {values.mutate(), row_size()}; }
};

/// A robot's motion without the robot: named components. It has no skeleton.
struct BodyMotion {
  std::vector<Component> components;
};

/// The last component of this kind and content, as the format has it; null if there is none.
const Component* find_component(const BodyMotion& motion, ComponentKind kind,
                                std::string_view content);

/// The component whose length and rate are the motion's: link poses, else joint displacements, else
/// the first that kinefile knows; null if there is none.
const Component* main_component(const BodyMotion& motion);

/// The rotation of a pose as a quaternion w x y z, as it is.
/// \param pose  of `component.width()` numbers
std::array<double, 4> quaternion_of_pose(PoseForm form, std::span<const double> pose);

/// The values of poses with quaternions as x y z roll pitch yaw, [frame][part][6], each angle
/// nearest to the one of the frame before.
Array<double> poses_as_roll_pitch_yaw(const Component& component);

}  // namespace kinefile

#pragma GCC visibility pop
