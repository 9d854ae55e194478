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

/// Takes the jumps by whole turns out of a column.
void unwrap_column(Clip& clip, std::size_t begin, std::size_t column, double turn) {
  std::optional<double> before;
  for (std::size_t f = begin; f < clip.num_frames; ++f) {
    double& angle = clip.mutate()[f][column];
    if (!std::isfinite(angle)) continue;
    if (before) angle = nearest_turn(angle, *before, turn);
    before = angle;
  }
}

/// Three columns that together are a rotation which another triple gives, too.
struct Triple {
  std::array<std::size_t, 3> columns;
  bool is_proper;  ///< the outer axes are the same: z x z

  Vec3 in_row(std::span<const double> row) const {
    return {row[columns[0]], row[columns[1]], row[columns[2]]};
  }
};

void unwrap_triple(Clip& clip, std::size_t begin, const Triple& triple, double turn) {
  std::optional<Vec3> before;
  for (std::size_t f = begin; f < clip.num_frames; ++f) {
    const Vec3 angles = triple.in_row(clip.row(f));
    if (!angles.allFinite()) continue;
    Vec3 best = angles;
    if (before) {
      best = nearest_turns(angles, *before, turn);
      const double half = turn / 2;
      const Vec3 other(angles[0] + half, (triple.is_proper ? 0 : half) - angles[1],
                       angles[2] + half);
      const Vec3 twin = nearest_turns(other, *before, turn);
      // A flip shows as half a turn in two angles; smaller steps are the motion's own.
      const double step = (best - *before).cwiseAbs().maxCoeff();
      if (step > turn / 4 && (twin - *before).cwiseAbs().maxCoeff() < step) best = twin;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      clip.mutate()[f][triple.columns[k]] = best[static_cast<Eigen::Index>(k)];
    }
    before = best;
  }
}

/// The joint's three rotations, if another triple of angles gives the same and nothing else reads
/// their columns.
std::optional<Triple> triple_of(const std::vector<DegreeOfFreedom>& rotations,
                                const std::vector<std::size_t>& readers) {
  const auto axes = euler_axes_of(rotations);
  if (!axes) return std::nullopt;
  Triple triple{};
  for (std::size_t k = 0; k < 3; ++k) {
    triple.columns[k] = rotations[k].coordinate;
    if (readers[triple.columns[k]] != 1) return std::nullopt;
  }
  triple.is_proper = std::abs((*axes)[2].dot((*axes)[0])) > 0.5;
  return triple;
}

/// Columns that are angles and nothing else.
std::vector<bool> angle_columns(const Skeleton& skeleton) {
  std::vector<bool> is_angle(skeleton.coordinates.size(), true);
  const auto readers = num_readers_of_columns(skeleton);
  for (std::size_t c = 0; c < readers.size(); ++c) is_angle[c] = readers[c] > 0;
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      const std::size_t count = dof.kind == DofKind::Free ? 7 : 1;
      if (dof.kind == DofKind::Rotation) continue;
      for (std::size_t k = 0; k < count; ++k) is_angle[dof.coordinate + k] = false;
    }
  }
  return is_angle;
}

/// Gives a joint's quaternions the signs by which they change least.
void unwrap_free(Clip& clip, std::size_t begin, std::size_t first) {
  std::optional<Eigen::Vector4d> before;
  for (std::size_t f = begin; f < clip.num_frames; ++f) {
    Eigen::Map<Eigen::Vector4d> quaternion(&clip.mutate()[f][first + 3]);
    if (!quaternion.allFinite()) continue;
    if (before && quaternion.dot(*before) < 0) quaternion = -quaternion;
    before = quaternion;
  }
}

}  // namespace

void unwrap_from(Motion& motion, std::size_t first_frame) {
  const std::size_t begin = first_frame > 0 ? first_frame - 1 : 0;
  const double turn = whole_turn(motion.skeleton.angle_unit);
  const auto readers = num_readers_of_columns(motion.skeleton);
  std::vector<bool> is_waiting = angle_columns(motion.skeleton);
  for (const Joint& joint : motion.skeleton.joints) {
    if (const auto column = free_column(joint)) unwrap_free(motion.clip, begin, *column);
    if (const auto triple = triple_of(rotations_of(joint), readers)) {
      unwrap_triple(motion.clip, begin, *triple, turn);
      for (const std::size_t column : triple->columns) is_waiting[column] = false;
    }
  }
  for (std::size_t c = 0; c < is_waiting.size(); ++c) {
    if (is_waiting[c]) unwrap_column(motion.clip, begin, c, turn);
  }
}

Motion unwrap(const Motion& motion) {
  Motion result = motion;
  unwrap_from(result, 0);
  return result;
}

}  // namespace kinefile::edit
