// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "kinefile/motion.hpp"
#include "kinefile/world_poses.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// Rows of values to place: `num_frames` rows of a skeleton's coordinates, each `stride` numbers
/// behind the one before.
struct ValueRows {
  std::span<const double> values;
  std::size_t num_frames = 0;
  std::size_t stride = 0;
};

/// Where poses go: memory of the caller's, laid out as in `PoseArrays`. What is empty is not
/// computed, but positions are always.
struct PoseSpans {
  std::span<double> positions = {};   ///< [frame][joint][3]
  std::span<double> rotations = {};   ///< [frame][joint][4] or empty
  std::span<double> directions = {};  ///< [frame][joint][3] or empty
  std::span<double> tips = {};        ///< [frame][tip][3] or empty
};

/// How a joint stands in the world: world_from_joint = T(position) rotation.
struct JointFrame {
  Mat3 rotation = Mat3::Identity();
  Vec3 position = Vec3::Zero();
};

/// A point that goes with a joint.
struct JointPoint {
  std::size_t joint = 0;
  Vec3 offset = Vec3::Zero();  ///< in the joint's frame
  bool is_on_tail = false;     ///< moves with the joint's tail, as its children and tips do
};

/// Places a skeleton: plans once, then places rows and tells derivatives as often as is wanted.
/// Copies share the plan. All const functions may be called from several threads at once.
/// Values that are not finite give poses that are not; a quaternion (of a free joint, of a ball) is
/// normalised unless the square of its length is within 1e-8 of 1, as rounding to nine digits
/// leaves it.
class Kinematics {
 public:
  /// \param skeleton  valid (see `validate`); not looked at afterwards
  explicit Kinematics(const Skeleton& skeleton);

  std::size_t num_joints() const;
  std::size_t num_tips() const;
  std::size_t num_coordinates() const;

  /// Places every joint in the world, for every row: world_from_joint.
  void place(const ValueRows& rows, const PoseSpans& out) const;

  /// Places every joint in its parent's frame, for every row: parent_from_joint; tips are in the
  /// parent's frame of their joint, too.
  void place_locally(const ValueRows& rows, const PoseSpans& out) const;

  /// Places every joint in the world for one row. Allocates nothing.
  /// \param row     shape (coordinates)
  /// \param frames  out; shape (joints)
  void place_row(std::span<const double> row, std::span<JointFrame> frames) const;

  /// Where a point is in the world. Allocates nothing.
  /// \param frames  what `place_row` makes of the row
  Vec3 position_of(const JointPoint& point, std::span<const double> row,
                   std::span<const JointFrame> frames) const;

  /// The Jacobian of a point's position in the world: its derivative by every coordinate, in the
  /// coordinates' own units (a degree where angles are in degrees). Where several degrees of
  /// freedom read a column, their derivatives add up; a column that moves the point in no way has
  /// 0. A free joint has seven columns: its position, and the four numbers of its quaternion, as a
  /// ball has, whose derivatives are those of the normalised quaternion: along the quaternion
  /// itself there is none. Allocates nothing. \param frames    what `place_row` makes of the row
  /// \param jacobian  out; [coordinate][3], which is a 3 x coordinates matrix in column order
  void jacobian(const JointPoint& point, std::span<const double> row,
                std::span<const JointFrame> frames, std::span<double> jacobian) const;

 private:
  struct Plan;
  std::shared_ptr<const Plan> plan_;
};

/// Which frames to place and what to tell of them, beside the positions.
struct KinematicsOptions {
  std::size_t first_frame = 0;
  std::size_t num_frames = std::numeric_limits<std::size_t>::max();  ///< at most so many
  std::size_t frame_step = 1;                                        ///< every so many frames
  bool rotations = false;
  bool directions = false;
  bool tips = false;
};

/// Places every joint in the world, for every frame asked for.
/// \param skeleton  valid (see `validate`)
/// \param clip      values in the skeleton's units; as many columns as it has coordinates
/// \returns         world_from_joint; row 0 is `options.first_frame`
/// Column vectors, right-handed: world_from_joint = world_from_parent * parent_from_joint.
/// Values that are not finite give poses that are not; a quaternion (of a free joint, of a ball) is
/// normalised unless the square of its length is within 1e-8 of 1, as rounding to nine digits
/// leaves it. Source: the format document's worked example; Meredith and Maddock, "Motion Capture
/// File Formats Explained", section 3.
WorldPoses forward_kinematics(const Skeleton& skeleton, const Clip& clip,
                              const KinematicsOptions& options = {});

/// Places every joint in its parent's frame. As `forward_kinematics`, but parent_from_joint;
/// tips are in the parent's frame of their joint, too.
LocalPoses local_poses(const Skeleton& skeleton, const Clip& clip,
                       const KinematicsOptions& options = {});

/// How many frames to place at a time where all of them together would need too much memory: some
/// megabytes' worth, whatever the number of joints.
std::size_t frames_per_block(const Skeleton& skeleton);

/// A clip of one frame, in which every coordinate has its rest value.
Clip rest_clip(const Skeleton& skeleton);

/// The unit vectors along the bones in the joints' own frames; shape (joints). One child: its
/// rest offset; several: the mean of theirs; none: the mean of the tips' offsets; (0, 1, 0) where
/// that has no length.
/// Source: bvhio's `Joint.getTip`, as the format document prints it (UpWorld).
std::vector<Vec3> bone_directions(const Skeleton& skeleton);

/// An axis-aligned box; empty while `min` is above `max`.
struct Box {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());
};

/// The box around all joints and tips over all frames, in the skeleton's unit of length. Positions
/// that are not finite are left out.
Box world_extent(const Skeleton& skeleton, const Clip& clip);

/// The diagonal of the box around the rest pose: what tolerances of lengths are relative to. 0
/// where that is not finite.
double rest_size(const Skeleton& skeleton);

/// The axis that points up: 1 for y, 2 for z. The one along which the joints lie high over the
/// lowest of them while that stays at one level, as feet on the ground do; told from 64 frames of
/// the motion, or from the rest pose without frames. In doubt y.
std::size_t guess_up_axis(const Motion& motion);

}  // namespace kinefile

#pragma GCC visibility pop
