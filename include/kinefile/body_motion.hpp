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
  Values,   ///< numbers, one per part: joint angles in radians, displacements in metres
  Poses,    ///< positions in metres and rotations, one pose per part
  Vectors,  ///< one vector in three dimensions
  Other,    ///< unknown to kinefile; its format keeps it as text
};

/// How a pose stores its rotation.
enum class PoseForm {
  Quaternion,    ///< x y z qw qx qy qz, not necessarily of unit length
  RollPitchYaw,  ///< x y z roll pitch yaw, in radians: R = Rz(yaw) Ry(pitch) Rx(roll)
};

/// Names (`Component::content`) of the components that kinefile knows.
inline constexpr std::string_view kJointDisplacement = "JointDisplacement";
inline constexpr std::string_view kLinkPosition = "LinkPosition";
inline constexpr std::string_view kZmp = "ZMP";

/// The suffix of the content in the column names of vectors that are relative to the root link:
/// ZMP.root.x.
inline constexpr std::string_view kRootRelativeSuffix = ".root";

/// One kind of data over time, with its own rate and length.
struct Component {
  ComponentKind kind = ComponentKind::Values;
  std::string content;  ///< what it is: `kJointDisplacement` (parts in order of joint ids),
                        ///< `kLinkPosition` (parts in order of links), `kZmp`, or any other word
  std::size_t num_parts = 1;            ///< 1 for vectors
  std::vector<std::string> part_names;  ///< names of joints or links, if the source gives them
                                        ///< (CSV, a servo map); otherwise empty
  PoseForm pose_form = PoseForm::Quaternion;
  bool is_root_relative = false;  ///< for vectors: in the frame of the root link, not the world
                                  ///< frame
  std::size_t num_frames = 0;
  Array<double> values;  ///< [frame][part][width], exactly as read
  Timeline timeline;
  Kept kept;  ///< what its format keeps beyond the model

  /// How many numbers a part has: a value 1, a pose 7 or 6, a vector 3.
  std::size_t width() const {
    if (kind == ComponentKind::Vectors) return 3;
    if (kind != ComponentKind::Poses) return 1;
    return pose_form == PoseForm::Quaternion ? 7 : 6;
  }
  std::size_t row_size() const { return num_parts * width(); }
  std::span<const double> row(std::size_t frame) const {
    return {values.data() + frame * row_size(), row_size()};
  }
  /// The rows, for writing (see `Array::mutate`).
  Rows mutate() { return {values.mutate(), row_size()}; }
};

/// A robot's motion without the robot's model: named components. It has no skeleton.
struct BodyMotion {
  std::vector<Component> components;
};

/// The last component of this kind and content: where a file repeats one, its last one counts; null
/// if there is none.
const Component* find_component(const BodyMotion& motion, ComponentKind kind,
                                std::string_view content);

/// The component that gives the motion its length and rate: link poses, otherwise joint
/// displacements, otherwise the first component that kinefile knows; null if there is none.
const Component* main_component(const BodyMotion& motion);

/// The rotation of a pose as a quaternion w x y z, not normalised.
/// \param pose  of `component.width()` numbers
std::array<double, 4> quaternion_of_pose(PoseForm form, std::span<const double> pose);

/// The values of poses with quaternions as x y z roll pitch yaw, [frame][part][6]. Each angle is
/// the one nearest to that of the previous frame.
Array<double> poses_as_roll_pitch_yaw(const Component& component);

}  // namespace kinefile

#pragma GCC visibility pop
