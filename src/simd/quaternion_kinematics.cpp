// SPDX-License-Identifier: MIT
// Places a few frames at a time, one in each lane of a vector, by quaternions throughout.
// 1. Rows of numbers become columns with a frame in each lane (transpose-inl.hpp).
// 2. Sines and cosines of half angles, of all turns at once (half_angles-inl.hpp): in degrees the
//    angle is reduced without an error. The sign of both together does not matter, so none is lost
//    on it.
// 3. Joint by joint: the parent's quaternion turns the offset, v + 2 w (u x v) + 2 u x (u x v), and
// is
//    multiplied by those of the joint's axes, which have two numbers each.
// 4. Columns of results become rows in memory that stays in the cache; large results go past it.
// Errors: sine and cosine have 2e-16 each, so quaternions have some 1e-15 after a dozen joints. A
// quaternion's length is mended when it is written, by a step of Newton's method.
// Source: Diebel, "Representing Attitude", 2006, for the formulas.
// Highway compiles this file once for every instruction set and selects one at run time.

#include "simd/quaternion_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/quaternion_kinematics.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Each needs what is above it.
#include "simd/frame_lanes-inl.hpp"
//
#include "simd/half_angles-inl.hpp"
//
#include "simd/joint_lanes-inl.hpp"
#include "simd/transpose-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {
namespace {

/// Which joints' rotations are needed.
template <class T>
std::vector<bool> needed_rotations(const Plan& plan, const PoseOutput<T>& out) {
  const bool are_all = out.rotations != nullptr || out.directions != nullptr;
  std::vector<bool> is_needed(plan.joints.size(), are_all);
  for (std::size_t j = 0; j < plan.joints.size(); ++j) {
    const PlannedJoint& joint = plan.joints[j];
    if (joint.parent != kNoJoint) is_needed[joint.parent] = true;
    if (out.tips != nullptr && !joint.tips.empty()) is_needed[j] = true;
  }
  return is_needed;
}

/// A turn, and where its sine and cosine are in a pass.
struct NeededTurn {
  Input input;
  std::size_t row;
};

std::vector<NeededTurn> needed_turns(const Plan& plan, const std::vector<bool>& needs_rotation) {
  std::vector<NeededTurn> turns;
  std::size_t row = 0;
  for (std::size_t j = 0; j < plan.joints.size(); ++j) {
    for (const Turn& turn : plan.joints[j].turns) {
      Input input = turn.input;
      if (turn.axis < 3 && turn.sign < 0) {  // about -x is the other way about x
        input.gain = -input.gain;
        input.shift = -input.shift;
      }
      if (needs_rotation[j]) turns.push_back({input, row});
      row += 2;
    }
  }
  return turns;
}

std::size_t num_turns(const Plan& plan) {
  std::size_t count = 0;
  for (const PlannedJoint& joint : plan.joints) count += joint.turns.size();
  return count;
}

/// The numbers of a pass, [number][frame]: the columns of its rows, the rotations of slots, and
/// results, none of those that are not wanted.
template <class T>
struct Pass {
  Pass(const Plan& plan, const PoseOutput<T>& out)
      : columns(plan.num_columns),
        turns(num_turns(plan) * 2),
        slots(plan.num_slots * 4),
        positions(plan.joints.size() * 3),
        rotations(out.rotations != nullptr ? plan.joints.size() * 4 : 0),
        directions(out.directions != nullptr ? plan.joints.size() * 3 : 0),
        tips(out.tips != nullptr ? out.num_tips * 3 : 0) {}

  std::vector<Row<double, T>> columns;
  std::vector<Row<T>> turns;  ///< sine and cosine of each
  std::vector<Row<T>> slots;
  std::vector<Row<T>> positions;
  std::vector<Row<T>> rotations;
  std::vector<Row<T>> directions;
  std::vector<Row<T>> tips;
};

template <class T>
struct PoseLanes {
  QuaternionLanes<T> rotation;
  VectorLanes<T> position;
};

/// The pose that a joint's own rotation turns.
template <class T>
HWY_INLINE PoseLanes<T> pose_before_turns(const Plan& plan, Frame frame, const PlannedJoint& joint,
                                          std::size_t lane, const Pass<T>& pass) {
  const ColumnLanes<T> columns{pass.columns.data(), lane};
  VectorLanes<T> origin = local_position<T>(joint, columns);
  if (joint.parent != kNoJoint) {
    apply_tail<T>(plan.joints[joint.parent], columns, origin);
    if (frame == Frame::World) {
      const auto rotation =
          load_quaternion<T>(pass.slots.data() + plan.joints[joint.parent].slot * 4, lane);
      return {rotation,
              load_vector<T>(pass.positions.data() + joint.parent * 3, lane) + rotation * origin};
    }
  }
  return {{fill<T>(1), fill<T>(0), fill<T>(0), fill<T>(0)}, origin};
}

/// \param first  of the joint's tips among all tips
template <class T>
HWY_INLINE void place_tips(const PlannedJoint& joint, std::size_t first, const PoseLanes<T>& pose,
                           std::size_t lane, Pass<T>& pass) {
  Row<T>* out = pass.tips.data() + first * 3;
  for (const Vector& tip : joint.tips) {
    VectorLanes<T> point = fill<T>(tip);
    apply_tail<T>(joint, {pass.columns.data(), lane}, point);
    store_vector<T>(pose.position + pose.rotation * point, lane, out);
    out += 3;
  }
}

/// Sines and cosines of all turns that are needed. Each step waits long for the one before it;
/// here they are many of one kind, which need not wait for each other.
template <class T>
HWY_INLINE void find_turns(const std::vector<NeededTurn>& turns, bool is_in_degrees,
                           Pass<T>& pass) {
  for (const NeededTurn& turn : turns) {
    Row<T>* out = pass.turns.data() + turn.row;
    for (std::size_t lane = 0; lane < kPass<T>; lane += kLanes<T> * kTogether) {
      Together<T> angles, sines, cosines;
      for (std::size_t i = 0; i < kTogether; ++i) {
        const ColumnLanes<T> columns{pass.columns.data(), lane + i * kLanes<T>};
        angles.v[i] = angles_of(turn.input, columns, is_in_degrees);
      }
      half_sincos(angles, is_in_degrees, sines, cosines);
      for (std::size_t i = 0; i < kTogether; ++i) {
        store<T>(sines.v[i], lane + i * kLanes<T>, out[0]);
        store<T>(cosines.v[i], lane + i * kLanes<T>, out[1]);
      }
    }
  }
}

/// Where the parts of a joint begin among those of all.
struct First {
  std::size_t turn = 0;
  std::size_t tip = 0;
};

/// Places joint `j` in the frames from a lane on; its parent has been placed.
template <class T>
HWY_INLINE void place_joint(const Plan& plan, Frame frame, std::size_t j, bool needs_rotation,
                            const First& first, std::size_t lane, Pass<T>& pass) {
  const PlannedJoint& joint = plan.joints[j];
  PoseLanes<T> pose = pose_before_turns<T>(plan, frame, joint, lane, pass);
  store_vector<T>(pose.position, lane, pass.positions.data() + j * 3);
  if (!needs_rotation) return;
  if (joint.has_rest_rotation) {
    const std::array<double, 4>& rest = joint.rest_quaternion;
    pose.rotation = pose.rotation * QuaternionLanes<T>{fill<T>(rest[0]), fill<T>(rest[1]),
                                                       fill<T>(rest[2]), fill<T>(rest[3])};
  }
  const Row<T>* by = pass.turns.data() + first.turn * 2;
  for (const Turn& turn : joint.turns) {
    apply_turn<T>(turn, load<T>(by[0], lane), load<T>(by[1], lane), pose.rotation);
    by += 2;
  }
  store_quaternion<T>(pose.rotation, lane, pass.slots.data() + joint.slot * 4);
  if (!pass.rotations.empty()) {
    store_quaternion<T>(canonical<T>(pose.rotation), lane, pass.rotations.data() + j * 4);
  }
  if (!pass.directions.empty()) {
    store_vector<T>(pose.rotation * fill<T>(joint.direction), lane, pass.directions.data() + j * 3);
  }
  if (!pass.tips.empty()) place_tips<T>(joint, first.tip, pose, lane, pass);
}

template <class T>
void place_all(const Plan& plan, Frame frame, const Rows& rows, const PoseOutput<T>& out) {
  const std::vector<bool> needs_rotation = needed_rotations(plan, out);
  const std::vector<NeededTurn> turns = needed_turns(plan, needs_rotation);
  Pass<T> pass(plan, out);
  RowWriter<T> positions(out.positions, pass.positions.size(), rows.num_frames);
  RowWriter<T> rotations(out.rotations, pass.rotations.size(), rows.num_frames);
  RowWriter<T> directions(out.directions, pass.directions.size(), rows.num_frames);
  RowWriter<T> tips(out.tips, pass.tips.size(), rows.num_frames);
  for (std::size_t first = 0; first < rows.num_frames; first += kPass<T>) {
    const std::size_t count = std::min(kPass<T>, rows.num_frames - first);
    const double* frames[kPass<T>];  // the last one's again behind it
    for (std::size_t f = 0; f < kPass<T>; ++f) {
      frames[f] = rows.values + (first + std::min(f, count - 1)) * rows.stride;
    }
    load_columns<T>(frames, plan.num_columns, pass.columns.data());
    find_turns<T>(turns, plan.is_in_degrees, pass);
    First part;
    for (std::size_t j = 0; j < plan.joints.size(); ++j) {
      for (std::size_t lane = 0; lane < kPass<T>; lane += kLanes<T>) {
        place_joint<T>(plan, frame, j, needs_rotation[j], part, lane, pass);
      }
      part.turn += plan.joints[j].turns.size();
      part.tip += plan.joints[j].tips.size();
    }
    positions.write(pass.positions, count);
    rotations.write(pass.rotations, count);
    directions.write(pass.directions, count);
    tips.write(pass.tips, count);
  }
  hwy::FlushStream();
}

void place_doubles(const Plan& plan, Frame frame, const Rows& rows, const PoseOutput<double>& out) {
  place_all<double>(plan, frame, rows, out);
}

void place_floats(const Plan& plan, Frame frame, const Rows& rows, const PoseOutput<float>& out) {
  place_all<float>(plan, frame, rows, out);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinefile::simd {
namespace {
HWY_EXPORT(place_doubles);
HWY_EXPORT(place_floats);
}  // namespace

void place_by_quaternions(const Plan& plan, Frame frame, const Rows& rows,
                          const PoseOutput<double>& out) {
  HWY_DYNAMIC_DISPATCH(place_doubles)(plan, frame, rows, out);
}

void place_by_quaternions(const Plan& plan, Frame frame, const Rows& rows,
                          const PoseOutput<float>& out) {
  HWY_DYNAMIC_DISPATCH(place_floats)(plan, frame, rows, out);
}

}  // namespace kinefile::simd
#endif  // HWY_ONCE
