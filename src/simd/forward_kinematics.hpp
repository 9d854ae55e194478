// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "simd/block.hpp"

namespace kinefile::simd {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;  ///< [column][row]

inline constexpr std::size_t kNoJoint = static_cast<std::size_t>(-1);

/// A column, and how a value is computed from its number: gain * number + shift.
struct Input {
  std::size_t coordinate = 0;
  double gain = 1;
  double shift = 0;

  double value(const double* row) const {
    const double number = row[coordinate];
    return gain == 1 && shift == 0 ? number : gain * number + shift;
  }
};

/// A rotation about x, y or z (`axis` 0, 1, 2; `sign` -1 for the opposite axis), or about any
/// other unit vector (`axis` 3, `sign` unused).
struct Turn {
  Input input;
  std::size_t axis;
  double sign;
  Vector direction;
};

/// A translation of a joint's origin along a direction in its parent's frame.
struct Shift {
  Input input;
  Vector direction;
};

/// A translation or scale of the positions of a joint's children and tips, along an axis of the
/// joint's frame: x, y or z (`axis` 0, 1, 2), or any other unit vector (`axis` 3).
struct TailMove {
  Input input;
  bool is_scale;
  std::size_t axis;
  Vector direction;
};

/// A whole rotation from several columns.
enum class WholeRotation {
  None,
  Quaternion,  ///< qw, qx, qy, qz
  AxisAngle,   ///< an axis times its angle, three numbers
};

/// A joint in the form that the kernel needs. parent_from_joint is a translation by `offset` and
/// all shifts, the rest rotation, the whole rotation, then the turns, the first of them outermost.
struct PlannedJoint {
  std::size_t parent = kNoJoint;  ///< an index below that of this joint
  Vector offset{};
  bool has_rest_rotation = false;
  Matrix rest_rotation{};
  std::array<double, 4> rest_quaternion{};  ///< the same, w x y z
  std::vector<Shift> shifts;
  WholeRotation whole = WholeRotation::None;
  std::size_t whole_coordinate = 0;  ///< its first column
  std::vector<Turn> turns;
  std::vector<TailMove> tail_moves;  ///< the first of them is outermost
  Vector direction{};                ///< unit vector along the bone, in the joint's frame
  std::vector<Vector> tips;
  std::size_t slot = 0;  ///< where its pose is kept, until its last child has been placed
};

struct Plan {
  std::vector<PlannedJoint> joints;
  /// Whether unit quaternions can stand for all rotations: joints have no whole ones, whose
  /// quaternions are not always normalised, and unit axes.
  bool has_quaternions = false;
  std::size_t num_slots = 0;
  std::size_t num_columns = 0;  ///< of a row
  bool is_in_degrees = true;
};

/// Rows of values, [frame][coordinate], consecutive rows start `stride` numbers apart.
struct Rows {
  const double* values;
  std::size_t num_frames;
  std::size_t stride;
};

/// What poses are relative to: world_from_joint or parent_from_joint.
enum class Frame { World, Parent };

/// The destination of poses, laid out as in `PoseArrays`; null if not requested.
template <class T>
struct PoseOutput {
  T* positions;
  T* rotations;
  T* directions;
  T* tips;
  std::size_t num_tips;
};

/// Computes the poses of all joints for all rows, in the output's precision. Every instruction set
/// gives the same bits.
void place_frames(const Plan& plan, Frame frame, const Rows& rows, const PoseOutput<double>& out);
void place_frames(const Plan& plan, Frame frame, const Rows& rows, const PoseOutput<float>& out);

/// Sines and cosines as the kernel computes them, for `count` angles.
void sincos(const double* angles, std::size_t count, bool is_in_degrees, double* sines,
            double* cosines);

}  // namespace kinefile::simd
