// SPDX-License-Identifier: MIT
#include "edit/unwrap.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "kinefile/edit.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinematics/joint_columns.hpp"
#include "math/turns.hpp"

namespace kinefile::edit {
namespace {

/// Removes jumps by whole turns from a column.
void unwrap_column(Clip& clip, std::size_t begin, std::size_t column, double turn) {
  const Rows rows = clip.mutate();
  std::optional<double> before;
  for (std::size_t f = begin; f < clip.num_frames; ++f) {
    double& angle = rows[f][column];
    if (!std::isfinite(angle)) continue;
    if (before) angle = nearest_turn(angle, *before, turn);
    before = angle;
  }
}

/// Three rotations of a joint for which a second triple of angles gives the same rotation.
struct Triple {
  std::array<DegreeOfFreedom, 3> rotations;
  bool is_proper;  ///< the outer axes are the same: z x z

  Vec3 in_row(std::span<const double> row) const {
    return {value_in_row(rotations[0], row), value_in_row(rotations[1], row),
            value_in_row(rotations[2], row)};
  }
};

void unwrap_triple(Clip& clip, std::size_t begin, const Triple& triple, double turn) {
  const Rows rows = clip.mutate();
  std::optional<Vec3> before;
  for (std::size_t f = begin; f < clip.num_frames; ++f) {
    const Vec3 angles = triple.in_row(rows[f]);
    if (!angles.allFinite()) continue;
    Vec3 best = angles;
    if (before) {
      best = nearest_turns(angles, *before, turn);
      const double half = turn / 2;
      const Vec3 other(angles[0] + half, (triple.is_proper ? 0 : half) - angles[1],
                       angles[2] + half);
      const Vec3 twin = nearest_turns(other, *before, turn);
      // A flip appears as half a turn in two angles; smaller steps are real motion.
      const double step = (best - *before).cwiseAbs().maxCoeff();
      if (step > turn / 4 && (twin - *before).cwiseAbs().maxCoeff() < step) best = twin;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const DegreeOfFreedom& dof = triple.rotations[k];
      const double angle = best[static_cast<Eigen::Index>(k)];
      if (angle != angles[static_cast<Eigen::Index>(k)]) {
        rows[f][dof.coordinate] = column_of(dof, angle);
      }
    }
    before = best;
  }
}

/// The joint's three rotations, if another triple of angles gives the same rotation and no other
/// degree of freedom reads their columns.
std::optional<Triple> triple_of(const std::vector<DegreeOfFreedom>& rotations,
                                const std::vector<std::size_t>& readers) {
  const auto axes = euler_axes_of(rotations);
  if (!axes) return std::nullopt;
  Triple triple{};
  for (std::size_t k = 0; k < 3; ++k) {
    triple.rotations[k] = rotations[k];
    if (readers[rotations[k].coordinate] != 1 || rotations[k].gain == 0) return std::nullopt;
  }
  triple.is_proper = std::abs((*axes)[2].dot((*axes)[0])) > 0.5;
  return triple;
}

/// Gives a joint's quaternions the signs by which they change least.
void unwrap_quaternions(Clip& clip, std::size_t begin, std::size_t first) {
  const Rows rows = clip.mutate();
  std::optional<Eigen::Vector4d> before;
  for (std::size_t f = begin; f < clip.num_frames; ++f) {
    Eigen::Map<Eigen::Vector4d> quaternion(&rows[f][first]);
    if (!quaternion.allFinite()) continue;
    if (before && quaternion.dot(*before) < 0) quaternion = -quaternion;
    before = quaternion;
  }
}

/// Adds whole turns to rotation vectors so that each is nearest to the previous one.
void unwrap_vectors(Clip& clip, std::size_t begin, std::size_t first, double turn) {
  const Rows rows = clip.mutate();
  std::optional<Vec3> before;
  for (std::size_t f = begin; f < clip.num_frames; ++f) {
    Eigen::Map<Vec3> vector(&rows[f][first]);
    if (!vector.allFinite()) continue;
    const double length = vector.norm();
    if (before && length > 0) {
      const double near = before->dot(vector) / length;
      const double angle = nearest_turn(length, near, turn);
      if (angle != length) vector *= angle / length;
    }
    before = vector;
  }
}

}  // namespace

void unwrap_from(Motion& motion, std::size_t first_frame) {
  const std::size_t begin = first_frame > 0 ? first_frame - 1 : 0;
  const double turn = whole_turn(motion.skeleton.angle_unit);
  const auto readers = num_readers_of_columns(motion.skeleton);
  std::vector<double> turns = turns_of_columns(motion.skeleton);
  for (const Joint& joint : motion.skeleton.joints) {
    const auto rotations = rotations_of(joint);
    if (const auto triple = triple_of(rotations, readers)) {
      unwrap_triple(motion.clip, begin, *triple, turn);
      for (const DegreeOfFreedom& dof : triple->rotations) turns[dof.coordinate] = 0;
    } else if (is_whole_rotation(rotations) && rotations[0].kind == DofKind::Ball) {
      unwrap_quaternions(motion.clip, begin, rotations[0].coordinate);
    } else if (is_whole_rotation(rotations)) {
      unwrap_vectors(motion.clip, begin, rotations[0].coordinate, turn);
    }
  }
  for (std::size_t c = 0; c < turns.size(); ++c) {
    if (turns[c] > 0) unwrap_column(motion.clip, begin, c, turns[c]);
  }
}

Motion unwrap(Motion motion) {
  unwrap_from(motion, 0);
  return motion;
}

}  // namespace kinefile::edit
