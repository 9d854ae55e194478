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

/// Rows of values to place: `num_frames` rows of a skeleton's coordinates. Consecutive rows start
/// `stride` numbers apart.
struct ValueRows {
  std::span<const double> values;
  std::size_t num_frames = 0;
  std::size_t stride = 0;
};

/// The destination of poses: memory of the caller, laid out as in `PoseArrays`. Empty spans are not
/// computed, except positions, which always are.
template <class T>
struct BasicPoseSpans {
  std::span<T> positions = {};   ///< [frame][joint][3]
  std::span<T> rotations = {};   ///< [frame][joint][4] or empty
  std::span<T> directions = {};  ///< [frame][joint][3] or empty
  std::span<T> tips = {};        ///< [frame][tip][3] or empty
};

using PoseSpans = BasicPoseSpans<double>;

/// Poses in single precision: half the memory, and computed in half the time. An error is a few
/// millionths of the largest coordinate.
using FloatPoseSpans = BasicPoseSpans<float>;

/// A joint's frame in the world: world_from_joint = T(position) rotation.
struct JointFrame {
  Mat3 rotation = Mat3::Identity();
  Vec3 position = Vec3::Zero();
};

/// A point that is fixed to a joint.
struct JointPoint {
  std::size_t joint = 0;
  Vec3 offset = Vec3::Zero();  ///< in the joint's frame
  bool is_on_tail = false;     ///< moves with the joint's tail, as its children and tips do
};

/// Forward kinematics of a skeleton. The constructor makes a plan; after that, rows are placed and
/// derivatives computed any number of times. Copies share the plan. All const functions may be
/// called from several threads at once.
/// Values that are not finite give poses that are not finite. A quaternion (of a free joint, of a
/// ball) is normalised unless the square of its length is within 1e-8 of 1, as rounding to nine
/// digits leaves it.
class Kinematics {
 public:
  /// \param skeleton  valid (see `validate`); not used after construction
  explicit Kinematics(const Skeleton& skeleton);

  std::size_t num_joints() const;
  std::size_t num_tips() const;
  std::size_t num_coordinates() const;

  /// Places every joint in the world, for every row: world_from_joint.
  void place(const ValueRows& rows, const PoseSpans& out) const;
  void place(const ValueRows& rows, const FloatPoseSpans& out) const;

  /// Places every joint in its parent's frame, for every row: parent_from_joint; tips are in the
  /// frame of their joint's parent, too.
  void place_locally(const ValueRows& rows, const PoseSpans& out) const;
  void place_locally(const ValueRows& rows, const FloatPoseSpans& out) const;

  /// Places every joint in the world for one row. Allocates nothing.
  /// \param row     shape (coordinates)
  /// \param frames  out; shape (joints)
  void place_row(std::span<const double> row, std::span<JointFrame> frames) const;

  /// The position of a point in the world. Allocates nothing.
  /// \param frames  the result of `place_row` for the row
  Vec3 position_of(const JointPoint& point, std::span<const double> row,
                   std::span<const JointFrame> frames) const;

  /// The Jacobian of a point's position in the world: its derivative by every coordinate, in the
  /// coordinates' own units (per degree if angles are in degrees). If several degrees of freedom
  /// read a column, their derivatives are added; a column that does not move the point has 0. A
  /// free joint has seven columns: its position, and the four numbers of its quaternion, like a
  /// ball. Quaternion derivatives are those of the normalised quaternion: the derivative along the
  /// quaternion itself is 0. Allocates nothing.
  /// \param frames    the result of `place_row` for the row
  /// \param jacobian  out; [coordinate][3], which is a 3 x coordinates matrix in column order
  void jacobian(const JointPoint& point, std::span<const double> row,
                std::span<const JointFrame> frames, std::span<double> jacobian) const;

 private:
  struct Plan;
  std::shared_ptr<const Plan> plan_;
};

/// Which frames to place, and which results to compute in addition to positions.
struct KinematicsOptions {
  std::size_t first_frame = 0;
  std::size_t num_frames = std::numeric_limits<std::size_t>::max();  ///< at most this many
  std::size_t frame_step = 1;                                        ///< step between frames
  bool rotations = false;
  bool directions = false;
  bool tips = false;
};

/// Places every joint in the world, for every requested frame.
/// \param skeleton  valid (see `validate`)
/// \param clip      values in the skeleton's units; as many columns as it has coordinates
/// \returns         world_from_joint; row 0 is `options.first_frame`
/// Column vectors, right-handed: world_from_joint = world_from_parent * parent_from_joint.
/// Values that are not finite give poses that are not finite. A quaternion (of a free joint, of a
/// ball) is normalised unless the square of its length is within 1e-8 of 1, as rounding to nine
/// digits leaves it.
/// Source: the format document's worked example; Meredith and Maddock, "Motion Capture File Formats
/// Explained", section 3.
WorldPoses forward_kinematics(const Skeleton& skeleton, const Clip& clip,
                              const KinematicsOptions& options = {});

/// Places every joint in its parent's frame. As `forward_kinematics`, but parent_from_joint; tips
/// are in the frame of their joint's parent, too.
LocalPoses local_poses(const Skeleton& skeleton, const Clip& clip,
                       const KinematicsOptions& options = {});

/// How many frames to place at a time when all of them would need too much memory: a few megabytes,
/// independent of the number of joints.
std::size_t frames_per_block(const Skeleton& skeleton);

/// A clip of one frame, in which every coordinate has its rest value.
Clip rest_clip(const Skeleton& skeleton);

/// The unit vectors along the bones in the joints' own frames; shape (joints). With one child: its
/// rest offset; with several: the mean of their rest offsets; with none: the mean of the tips'
/// offsets; (0, 1, 0) if that has zero length.
/// Source: bvhio's `Joint.getTip`, as printed in the format document (UpWorld).
std::vector<Vec3> bone_directions(const Skeleton& skeleton);

/// An axis-aligned box; empty while `min` is above `max`.
struct Box {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());
};

/// The box around all joints and tips over all frames, in the skeleton's unit of length. Positions
/// that are not finite are ignored.
Box world_extent(const Skeleton& skeleton, const Clip& clip);

/// The diagonal of the box around the rest pose. Tolerances of lengths are relative to it. 0 if it
/// is not finite.
double rest_size(const Skeleton& skeleton);

}  // namespace kinefile

#pragma GCC visibility pop
