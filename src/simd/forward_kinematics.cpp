// SPDX-License-Identifier: MIT
// The general kernel, for joints of every kind; quaternion_kinematics.cpp is the fast one for most.
// It works on blocks of frames: every number of a pose is an array of kBlock lanes, one per
// frame, so that each line of arithmetic is a short loop that the compiler can vectorise. A
// rotation about a coordinate axis changes only two columns of the rotation matrix.
// Highway compiles this file once for every instruction set and selects one at run time.

#include "simd/forward_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#ifdef __EMSCRIPTEN__
#define HWY_COMPILE_ONLY_EMU128  // WebAssembly has no vectors of doubles in Highway 1.0
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/forward_kinematics.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/quaternion_kinematics.hpp"
#include "simd/sincos-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {

/// One number of a pose in every frame of a block.
struct alignas(64) Lanes {
  double v[kBlock];
};

using VectorLanes = std::array<Lanes, 3>;
using MatrixLanes = std::array<VectorLanes, 3>;  ///< [column][row]

struct Pose {
  MatrixLanes rotation;
  VectorLanes position;
};

/// The rows of a block. Lanes beyond the last row repeat it.
struct Block {
  const Rows& rows;
  std::size_t first;
  std::size_t count;

  HWY_INLINE void load(std::size_t coordinate, Lanes& lanes) const {
    const double* from = rows.values + first * rows.stride + coordinate;
    for (std::size_t i = 0; i < count; ++i) lanes.v[i] = from[i * rows.stride];
    for (std::size_t i = count; i < kBlock; ++i) lanes.v[i] = lanes.v[count - 1];
  }

  HWY_INLINE void load(const Input& input, Lanes& lanes) const {
    load(input.coordinate, lanes);
    if (input.gain == 1 && input.shift == 0) return;
    for (std::size_t i = 0; i < kBlock; ++i) lanes.v[i] = input.gain * lanes.v[i] + input.shift;
  }
};

HWY_INLINE void fill(Lanes& lanes, double value) {
  for (std::size_t i = 0; i < kBlock; ++i) lanes.v[i] = value;
}

HWY_INLINE void fill(VectorLanes& lanes, const Vector& vector) {
  for (std::size_t k = 0; k < 3; ++k) fill(lanes[k], vector[k]);
}

HWY_INLINE void fill(MatrixLanes& lanes, const Matrix& matrix) {
  for (std::size_t c = 0; c < 3; ++c) fill(lanes[c], matrix[c]);
}

/// sum + rotation * point
HWY_INLINE void add_rotated(const MatrixLanes& rotation, const VectorLanes& point,
                            VectorLanes& sum) {
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t i = 0; i < kBlock; ++i) {
      sum[r].v[i] += rotation[0][r].v[i] * point[0].v[i] + rotation[1][r].v[i] * point[1].v[i] +
                     rotation[2][r].v[i] * point[2].v[i];
    }
  }
}

/// rotation = rotation * factor
HWY_INLINE void multiply(MatrixLanes& rotation, const MatrixLanes& factor) {
  MatrixLanes product;
  fill(product, Matrix{});
  for (std::size_t c = 0; c < 3; ++c) add_rotated(rotation, factor[c], product[c]);
  rotation = product;
}

/// Rotates two columns: the product with a rotation about the third axis.
HWY_INLINE void turn_columns(VectorLanes& first, VectorLanes& second, const Lanes& sine,
                             const Lanes& cosine) {
  for (std::size_t r = 0; r < 3; ++r) {
    double* HWY_RESTRICT a = first[r].v;
    double* HWY_RESTRICT b = second[r].v;
    for (std::size_t i = 0; i < kBlock; ++i) {
      const double turned = cosine.v[i] * a[i] + sine.v[i] * b[i];
      b[i] = cosine.v[i] * b[i] - sine.v[i] * a[i];
      a[i] = turned;
    }
  }
}

/// The matrix of a rotation about a unit axis (Rodrigues).
void rotation_about(const Vector& u, const Lanes& sine, const Lanes& cosine, MatrixLanes& out) {
  const Matrix cross = {{{0, u[2], -u[1]}, {-u[2], 0, u[0]}, {u[1], -u[0], 0}}};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t r = 0; r < 3; ++r) {
      const double outer = u[r] * u[c];
      const double rest = (r == c ? 1 : 0) - outer;
      for (std::size_t i = 0; i < kBlock; ++i) {
        out[c][r].v[i] = outer + rest * cosine.v[i] + cross[c][r] * sine.v[i];
      }
    }
  }
}

void apply_turn(MatrixLanes& rotation, const Turn& turn, const Block& block, bool is_in_degrees) {
  Lanes angles;
  Lanes sine;
  Lanes cosine;
  block.load(turn.input, angles);
  (is_in_degrees ? sincos_degrees : sincos_radians)(angles.v, sine.v, cosine.v);
  if (turn.axis == 3) {
    MatrixLanes factor;
    rotation_about(turn.direction, sine, cosine, factor);
    multiply(rotation, factor);
    return;
  }
  for (std::size_t i = 0; i < kBlock; ++i) sine.v[i] *= turn.sign;
  turn_columns(rotation[(turn.axis + 1) % 3], rotation[(turn.axis + 2) % 3], sine, cosine);
}

/// The largest deviation of the squared length of a quaternion from 1 by rounding to nine digits,
/// as Choreonoid writes them. Such a quaternion is used unchanged, as Choreonoid does with every
/// quaternion.
constexpr double kRoundedSquare = 1e-8;

/// Whether the squared length of a quaternion lost no digits for being too large or too small.
inline bool is_ordinary_square(double square) { return square >= 1e-200 && square <= 1e200; }

/// Scales the quaternions whose squared length a double does not hold to numbers of up to 1. One of
/// length 0 becomes the identity: Choreonoid, too, makes the identity's matrix of it.
void rescale_extremes(std::array<Lanes, 4>& q, const Lanes& square) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    if (is_ordinary_square(square.v[i])) continue;
    double largest = 0;
    for (std::size_t k = 0; k < 4; ++k) largest = std::max(largest, std::abs(q[k].v[i]));
    if (largest == 0 && square.v[i] == 0) q[0].v[i] = largest = 1;
    for (std::size_t k = 0; k < 4; ++k) q[k].v[i] /= largest;
  }
}

void squared_lengths(const std::array<Lanes, 4>& q, Lanes& square) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    square.v[i] = q[0].v[i] * q[0].v[i] + q[1].v[i] * q[1].v[i] + q[2].v[i] * q[2].v[i] +
                  q[3].v[i] * q[3].v[i];
  }
}

/// A rotation from a quaternion, which is normalised only here.
void apply_quaternion(MatrixLanes& rotation, std::size_t coordinate, const Block& block) {
  std::array<Lanes, 4> q;
  for (std::size_t k = 0; k < 4; ++k) block.load(coordinate + k, q[k]);
  Lanes square;
  squared_lengths(q, square);
  bool are_ordinary = true;
  for (std::size_t i = 0; i < kBlock; ++i) are_ordinary &= is_ordinary_square(square.v[i]);
  if (!are_ordinary) {
    rescale_extremes(q, square);
    squared_lengths(q, square);
  }
  MatrixLanes factor;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double length = std::abs(square.v[i] - 1) <= kRoundedSquare ? 1 : std::sqrt(square.v[i]);
    const double w = q[0].v[i] / length;
    const double x = q[1].v[i] / length;
    const double y = q[2].v[i] / length;
    const double z = q[3].v[i] / length;
    factor[0][0].v[i] = 1 - 2 * (y * y + z * z);
    factor[0][1].v[i] = 2 * (x * y + w * z);
    factor[0][2].v[i] = 2 * (x * z - w * y);
    factor[1][0].v[i] = 2 * (x * y - w * z);
    factor[1][1].v[i] = 1 - 2 * (x * x + z * z);
    factor[1][2].v[i] = 2 * (y * z + w * x);
    factor[2][0].v[i] = 2 * (x * z + w * y);
    factor[2][1].v[i] = 2 * (y * z - w * x);
    factor[2][2].v[i] = 1 - 2 * (x * x + y * y);
  }
  multiply(rotation, factor);
}

/// A rotation from a rotation vector.
void apply_vector(MatrixLanes& rotation, std::size_t coordinate, const Block& block,
                  bool is_in_degrees) {
  std::array<Lanes, 3> u;
  Lanes angle;
  Lanes sine;
  Lanes cosine;
  for (std::size_t k = 0; k < 3; ++k) block.load(coordinate + k, u[k]);
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double square = u[0].v[i] * u[0].v[i] + u[1].v[i] * u[1].v[i] + u[2].v[i] * u[2].v[i];
    angle.v[i] = std::sqrt(square);
    const double length = angle.v[i] == 0 ? 1 : angle.v[i];  // an angle of 0 has no axis
    for (std::size_t k = 0; k < 3; ++k) u[k].v[i] /= length;
  }
  (is_in_degrees ? sincos_degrees : sincos_radians)(angle.v, sine.v, cosine.v);
  MatrixLanes factor;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t next = (c + 1) % 3;
    const std::size_t last = (c + 2) % 3;
    for (std::size_t i = 0; i < kBlock; ++i) {
      const double along = (1 - cosine.v[i]) * u[c].v[i];
      factor[c][c].v[i] = cosine.v[i] + along * u[c].v[i];
      factor[c][next].v[i] = along * u[next].v[i] + sine.v[i] * u[last].v[i];
      factor[c][last].v[i] = along * u[last].v[i] - sine.v[i] * u[next].v[i];
    }
  }
  multiply(rotation, factor);
}

/// The position of a joint's origin in its parent's frame.
HWY_INLINE void local_position(const PlannedJoint& joint, const Block& block,
                               VectorLanes& position) {
  fill(position, joint.offset);
  for (const Shift& shift : joint.shifts) {
    Lanes values;
    block.load(shift.input, values);
    for (std::size_t k = 0; k < 3; ++k) {
      if (shift.direction[k] == 0) continue;
      for (std::size_t i = 0; i < kBlock; ++i) {
        position[k].v[i] += shift.direction[k] * values.v[i];
      }
    }
  }
}

/// Applies a joint's tail moves, which act on its children and tips.
void apply_tail(const PlannedJoint& joint, VectorLanes& point, const Block& block) {
  for (std::size_t m = joint.tail_moves.size(); m-- > 0;) {
    const TailMove& move = joint.tail_moves[m];
    const Vector& u = move.direction;
    Lanes values;
    block.load(move.input, values);
    if (move.is_scale && move.axis < 3) {  // a single product loses no digits
      for (std::size_t i = 0; i < kBlock; ++i) point[move.axis].v[i] *= values.v[i];
      continue;
    }
    for (std::size_t i = 0; i < kBlock; ++i) {
      const double along = point[0].v[i] * u[0] + point[1].v[i] * u[1] + point[2].v[i] * u[2];
      const double step = move.is_scale ? (values.v[i] - 1) * along : values.v[i];
      for (std::size_t k = 0; k < 3; ++k) point[k].v[i] += step * u[k];
    }
  }
}

/// Places joint `j`; its parent has been placed.
void place_joint(const Plan& plan, Frame frame, std::size_t j, const Block& block,
                 std::vector<Pose>& pose_of_slot) {
  constexpr Matrix kIdentity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const PlannedJoint& joint = plan.joints[j];
  Pose& pose = pose_of_slot[joint.slot];
  const bool is_root = joint.parent == kNoJoint;
  VectorLanes origin;
  local_position(joint, block, origin);
  if (!is_root) apply_tail(plan.joints[joint.parent], origin, block);
  if (is_root || frame == Frame::Parent) {
    fill(pose.rotation, kIdentity);
    pose.position = origin;
  } else {
    const Pose& parent = pose_of_slot[plan.joints[joint.parent].slot];
    pose = parent;
    add_rotated(parent.rotation, origin, pose.position);
  }
  if (joint.has_rest_rotation) {
    MatrixLanes rest;
    fill(rest, joint.rest_rotation);
    multiply(pose.rotation, rest);
  }
  if (joint.whole == WholeRotation::Quaternion) {
    apply_quaternion(pose.rotation, joint.whole_coordinate, block);
  } else if (joint.whole == WholeRotation::AxisAngle) {
    apply_vector(pose.rotation, joint.whole_coordinate, block, plan.is_in_degrees);
  }
  for (const Turn& turn : joint.turns) apply_turn(pose.rotation, turn, block, plan.is_in_degrees);
}

HWY_INLINE void store_point(const VectorLanes& point, const Block& block, std::size_t stride,
                            double* HWY_RESTRICT out) {
  for (std::size_t i = 0; i < block.count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) out[i * stride + k] = point[k].v[i];
  }
}

/// The unit quaternion w x y z of one lane's rotation (Shepperd, "Quaternion from Rotation
/// Matrix", 1978: the largest of the four is found first). The sign is such that w >= 0, and if w =
/// 0 the first other nonzero number is positive: equal rotations have equal numbers.
void store_quaternion(const MatrixLanes& m, std::size_t lane, double* out) {
  const auto at = [&m, lane](std::size_t row, std::size_t column) {
    return m[column][row].v[lane];
  };
  const double trace = at(0, 0) + at(1, 1) + at(2, 2);
  double q[4];
  if (trace > 0) {
    q[0] = 1 + trace;
    q[1] = at(2, 1) - at(1, 2);
    q[2] = at(0, 2) - at(2, 0);
    q[3] = at(1, 0) - at(0, 1);
  } else {
    std::size_t a = at(1, 1) > at(0, 0) ? 1 : 0;
    if (at(2, 2) > at(a, a)) a = 2;
    const std::size_t b = (a + 1) % 3;
    const std::size_t c = (a + 2) % 3;
    q[0] = at(c, b) - at(b, c);
    q[1 + a] = 1 + at(a, a) - at(b, b) - at(c, c);
    q[1 + b] = at(b, a) + at(a, b);
    q[1 + c] = at(c, a) + at(a, c);
  }
  double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double* first = std::find_if(q, q + 3, [](double number) { return number != 0; });
  if (*first < 0) length = -length;
  for (std::size_t k = 0; k < 4; ++k) {
    const double number = q[k] / length;
    out[k] = number == 0 ? 0 : number;  // never -0
  }
}

/// Copies the poses of joint `j` in a block to the output.
void store_joint(const Plan& plan, std::size_t j, const Block& block, const Pose& pose,
                 const PoseOutput<double>& out) {
  const std::size_t num_joints = plan.joints.size();
  const std::size_t index = block.first * num_joints + j;
  store_point(pose.position, block, num_joints * 3, out.positions + index * 3);
  if (out.rotations != nullptr) {
    for (std::size_t i = 0; i < block.count; ++i) {
      store_quaternion(pose.rotation, i, out.rotations + (index + i * num_joints) * 4);
    }
  }
  if (out.directions != nullptr) {
    VectorLanes bone;
    VectorLanes direction;
    fill(bone, plan.joints[j].direction);
    fill(direction, Vector{});
    add_rotated(pose.rotation, bone, direction);
    store_point(direction, block, num_joints * 3, out.directions + index * 3);
  }
}

/// \param first  of the joint's tips among all tips
void store_tips(const PlannedJoint& joint, std::size_t first, const Block& block, const Pose& pose,
                const PoseOutput<double>& out) {
  for (std::size_t t = 0; t < joint.tips.size(); ++t) {
    VectorLanes point;
    fill(point, joint.tips[t]);
    apply_tail(joint, point, block);
    VectorLanes place = pose.position;
    add_rotated(pose.rotation, point, place);
    store_point(place, block, out.num_tips * 3,
                out.tips + (block.first * out.num_tips + first + t) * 3);
  }
}

void place_all(const Plan& plan, Frame frame, const Rows& rows, const PoseOutput<double>& out) {
  std::vector<Pose> pose_of_slot(plan.num_slots);
  for (std::size_t first = 0; first < rows.num_frames; first += kBlock) {
    const Block block{rows, first, std::min(kBlock, rows.num_frames - first)};
    std::size_t num_tips = 0;
    for (std::size_t j = 0; j < plan.joints.size(); ++j) {
      const PlannedJoint& joint = plan.joints[j];
      place_joint(plan, frame, j, block, pose_of_slot);
      store_joint(plan, j, block, pose_of_slot[joint.slot], out);
      if (out.tips != nullptr) {
        store_tips(joint, num_tips, block, pose_of_slot[joint.slot], out);
      }
      num_tips += joint.tips.size();
    }
  }
}

void sincos_all(const double* angles, std::size_t count, bool is_in_degrees, double* sines,
                double* cosines) {
  for (std::size_t first = 0; first < count; first += kBlock) {
    const std::size_t size = std::min(kBlock, count - first);
    Lanes block{};
    Lanes sine;
    Lanes cosine;
    std::copy_n(angles + first, size, block.v);
    (is_in_degrees ? sincos_degrees : sincos_radians)(block.v, sine.v, cosine.v);
    std::copy_n(sine.v, size, sines + first);
    std::copy_n(cosine.v, size, cosines + first);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinefile::simd {
namespace {
HWY_EXPORT(place_all);
HWY_EXPORT(sincos_all);

/// Room for the results of some frames, or none for what is not wanted.
std::vector<double> buffer_for(const float* wanted, std::size_t size) {
  return std::vector<double>(wanted != nullptr ? size : 0);
}

/// Rounds a buffer's numbers, and goes on behind them.
void round_into(const std::vector<double>& numbers, std::size_t count, float*& out) {
  if (numbers.empty()) return;
  out = std::transform(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count), out,
                       [](double number) { return static_cast<float>(number); });
}

/// Places a few hundred frames at a time in double precision, and rounds the results.
void place_rounded(const Plan& plan, Frame frame, const Rows& rows, PoseOutput<float> out) {
  constexpr std::size_t kFrames = 256;
  const std::size_t num_joints = plan.joints.size();
  std::vector<double> positions = buffer_for(out.positions, kFrames * num_joints * 3);
  std::vector<double> rotations = buffer_for(out.rotations, kFrames * num_joints * 4);
  std::vector<double> directions = buffer_for(out.directions, kFrames * num_joints * 3);
  std::vector<double> tips = buffer_for(out.tips, kFrames * out.num_tips * 3);
  const auto wanted = [](std::vector<double>& v) { return v.empty() ? nullptr : v.data(); };
  const PoseOutput<double> doubles{wanted(positions), wanted(rotations), wanted(directions),
                                   wanted(tips), out.num_tips};
  for (std::size_t first = 0; first < rows.num_frames; first += kFrames) {
    const std::size_t count = std::min(kFrames, rows.num_frames - first);
    place_frames(plan, frame, {rows.values + first * rows.stride, count, rows.stride}, doubles);
    round_into(positions, count * num_joints * 3, out.positions);
    round_into(rotations, count * num_joints * 4, out.rotations);
    round_into(directions, count * num_joints * 3, out.directions);
    round_into(tips, count * out.num_tips * 3, out.tips);
  }
}

}  // namespace

void place_frames(const Plan& plan, Frame frame, const Rows& rows, const PoseOutput<double>& out) {
#ifndef __EMSCRIPTEN__  // where bytes are dear, one kernel is enough
  if (plan.has_quaternions) return place_by_quaternions(plan, frame, rows, out);
#endif
  HWY_DYNAMIC_DISPATCH(place_all)(plan, frame, rows, out);
}

void place_frames(const Plan& plan, Frame frame, const Rows& rows, const PoseOutput<float>& out) {
#ifndef __EMSCRIPTEN__  // where bytes are dear, one kernel is enough
  if (plan.has_quaternions) return place_by_quaternions(plan, frame, rows, out);
#endif
  place_rounded(plan, frame, rows, out);
}

void sincos(const double* angles, std::size_t count, bool is_in_degrees, double* sines,
            double* cosines) {
  HWY_DYNAMIC_DISPATCH(sincos_all)(angles, count, is_in_degrees, sines, cosines);
}

}  // namespace kinefile::simd
#endif  // HWY_ONCE
