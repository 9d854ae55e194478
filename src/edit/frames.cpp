// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "edit/travel.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/evidence.hpp"
#include "kinematics/joint_columns.hpp"

namespace kinefile::edit {
namespace {

bool is_length(DofKind kind) {
  return kind == DofKind::Translation || kind == DofKind::TailTranslation;
}

/// The columns that hold only lengths.
std::vector<bool> length_columns(const Skeleton& skeleton) {
  std::vector<bool> is_length_column(skeleton.coordinates.size(), true);
  const std::vector<std::size_t> readers = num_readers_of_columns(skeleton);
  for (std::size_t c = 0; c < readers.size(); ++c) is_length_column[c] = readers[c] > 0;
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      const std::size_t num_lengths = dof.kind == DofKind::Free ? 3 : (is_length(dof.kind) ? 1 : 0);
      for (std::size_t k = num_lengths; k < num_coordinates(dof); ++k) {
        is_length_column[dof.coordinate + k] = false;
      }
    }
  }
  return is_length_column;
}

/// Scales a length: in its column if that is scaled, otherwise by gain and shift.
void scale_length(double factor, bool is_column_scaled, DegreeOfFreedom& dof) {
  for (double* value : {&dof.lower, &dof.upper, &dof.max_speed, &dof.shift}) *value *= factor;
  (is_column_scaled ? dof.rest : dof.gain) *= factor;
}

/// A rotation by 90 degrees that takes one axis to another.
struct QuarterTurn {
  Eigen::Index from = 1;
  Eigen::Index to = 2;

  Vec3 operator()(const Vec3& v) const {
    Vec3 turned = v;
    turned[to] = v[from];
    turned[from] = -v[to];
    return turned;
  }

  Quat rotation() const { return Quat::FromTwoVectors(Vec3::Unit(from), Vec3::Unit(to)); }
};

/// The opposite vector, without negative zeros.
Vec3 opposite(const Vec3& axis) { return Vec3::Zero() - axis; }

void negate_column(Clip& clip, std::size_t column) {
  const Rows rows = clip.mutate();
  for (std::size_t f = 0; f < clip.num_frames; ++f) rows[f][column] = -rows[f][column];
}

void turn_vector(const QuarterTurn& turn, double* numbers) {
  const Vec3 turned = turn(Vec3(numbers));
  std::copy(turned.begin(), turned.end(), numbers);
}

/// Rotates the vectors in the numbers of a kind that reads several columns: x y z qw qx qy qz of a
/// free joint, qw qx qy qz of a ball, a rotation vector.
void turn_numbers(const QuarterTurn& turn, DofKind kind, double* numbers) {
  if (kind == DofKind::Free) turn_vector(turn, numbers);
  if (kind == DofKind::Free) turn_vector(turn, numbers + 4);
  if (kind == DofKind::Ball) turn_vector(turn, numbers + 1);
  if (kind == DofKind::RotationVector) turn_vector(turn, numbers);
}

void turn_columns(const QuarterTurn& turn, const DegreeOfFreedom& dof, Clip& clip) {
  const Rows rows = clip.mutate();
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    turn_numbers(turn, dof.kind, &rows[f][dof.coordinate]);
  }
}

/// Rotates an axis. If the result is -x, -y or -z, axis and values are negated, so that formats
/// with coordinate axes only can still store it.
void turn_axis(const QuarterTurn& turn, bool has_own_column, DegreeOfFreedom& dof, Motion& motion) {
  dof.axis = opposite(opposite(turn(dof.axis)));
  const bool is_turned_around = coordinate_axis(-dof.axis).has_value();
  // A scale along -y is a scale along y; a length along the bone stays the same.
  if (is_turned_around && dof.kind == DofKind::TailScale) dof.axis = opposite(dof.axis);
  if (is_turned_around && has_own_column &&
      (dof.kind == DofKind::Rotation || dof.kind == DofKind::Translation)) {
    dof.axis = opposite(dof.axis);
    dof.rest = -dof.rest;
    dof.shift = 0 - dof.shift;
    dof.lower = -std::exchange(dof.upper, -dof.lower);
    negate_column(motion.clip, dof.coordinate);
  }
}

/// Gives columns the names of the axes that they are about or along now; if several degrees of
/// freedom read one, the first counts.
void rename_channels(const Skeleton& old, Skeleton& skeleton) {
  std::vector<bool> is_named(skeleton.coordinates.size(), false);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    for (std::size_t d = 0; d < skeleton.joints[j].dofs.size(); ++d) {
      const DegreeOfFreedom& dof = skeleton.joints[j].dofs[d];
      const auto old_axis = coordinate_axis(old.joints[j].dofs[d].axis);
      const auto new_axis = coordinate_axis(dof.axis);
      if (num_coordinates(dof) > 1 || is_named[dof.coordinate]) continue;
      is_named[dof.coordinate] = true;
      std::string& channel = skeleton.coordinates[dof.coordinate].channel;
      if (old_axis && new_axis && channel == channel_name(dof.kind, *old_axis)) {
        channel = channel_name(dof.kind, *new_axis);
      }
    }
  }
}

/// Whether all degrees of freedom of a joint are about or along x, y and z, up to sign. Only then
/// may some be negated: three oblique axes would become their mirror image.
bool turns_about_plain_axes(const Joint& joint) {
  return std::all_of(joint.dofs.begin(), joint.dofs.end(), [](const DegreeOfFreedom& dof) {
    return num_coordinates(dof) > 1 || dof.kind == DofKind::TailTranslation ||
           coordinate_axis(dof.axis) || coordinate_axis(-dof.axis);
  });
}

/// \param is_turned  columns that are rotated already, because several joints may read one
void turn_joint(const QuarterTurn& turn, const std::vector<std::size_t>& readers, Joint& joint,
                std::vector<bool>& is_turned, Motion& motion) {
  joint.offset = turn(joint.offset);
  turn_numbers(turn, DofKind::Free, joint.free_rest.data());
  for (Tip& tip : joint.tips) tip.offset = turn(tip.offset);
  for (VisualShape& shape : joint.visuals) {
    shape.position = turn(shape.position);
    shape.rotation = (turn.rotation() * shape.rotation).normalized();
  }
  joint.rest_rotation.vec() = turn(joint.rest_rotation.vec());
  const bool is_plain = turns_about_plain_axes(joint);
  for (DegreeOfFreedom& dof : joint.dofs) {
    if (num_coordinates(dof) > 1) {
      if (!is_turned[dof.coordinate]) turn_columns(turn, dof, motion.clip);
      is_turned[dof.coordinate] = true;
    } else {
      const bool may_flip = is_plain && dof.kind != DofKind::TailTranslation;
      turn_axis(turn, may_flip && readers[dof.coordinate] == 1, dof, motion);
    }
  }
}

/// Sets a column to its first finite number in all frames.
void hold_column(Clip& clip, std::size_t column) {
  const Rows rows = clip.mutate();
  std::size_t first = 0;
  while (first < clip.num_frames && !std::isfinite(rows[first][column])) ++first;
  for (std::size_t f = first; f < clip.num_frames; ++f) {
    if (std::isfinite(rows[f][column])) rows[f][column] = rows[first][column];
  }
}

/// Moves a joint with oblique translation axes back above its first position in every frame.
void hold_over_ground(const Traveller& traveller, Eigen::Index up, Clip& clip) {
  const Rows rows = clip.mutate();
  std::optional<Vec3> start;
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    Vec3 place = position_of(traveller, rows[f]);
    if (!place.allFinite()) continue;
    if (!start) start = place;
    const double height = place[up];
    place = *start;
    place[up] = height;
    move_to(traveller, place, rows[f]);
  }
}

/// Holds a traveller above its first position. Columns along the axis that points up keep their
/// bits if the others are level.
void hold(const Traveller& traveller, Eigen::Index up, Clip& clip) {
  constexpr double kStraight = 1e-12;
  const auto rise = [&](const Translation& s) { return std::abs(to_world(traveller, s.axis)[up]); };
  const auto is_level = [&](const Translation& s) { return rise(s) < kStraight; };
  const auto is_straight = [&](const Translation& s) {
    return is_level(s) || std::abs(rise(s) - 1) < kStraight;
  };
  const auto& translations = traveller.translations;
  if (!std::all_of(translations.begin(), translations.end(), is_straight)) {
    hold_over_ground(traveller, up, clip);
    return;
  }
  for (const Translation& translation : translations) {
    if (is_level(translation)) hold_column(clip, translation.dof.coordinate);
  }
}

}  // namespace

Motion scale(Motion motion, double factor) {
  const std::vector<bool> is_scaled = length_columns(motion.skeleton);
  for (Joint& joint : motion.skeleton.joints) {
    joint.offset *= factor;
    for (Tip& tip : joint.tips) tip.offset *= factor;
    for (VisualShape& shape : joint.visuals) {
      shape.position *= factor;
      shape.size *= factor;
    }
    for (std::size_t k = 0; k < 3; ++k) joint.free_rest[k] *= factor;
    for (DegreeOfFreedom& dof : joint.dofs) {
      if (is_length(dof.kind)) scale_length(factor, is_scaled[dof.coordinate], dof);
    }
  }
  const Rows rows = motion.clip.mutate();
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    const auto row = rows[f];
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (is_scaled[c]) row[c] *= factor;
    }
  }
  return motion;
}

Motion up(Motion motion, std::size_t axis, Diagnostics& diagnostics) {
  const std::size_t before_axis = settle_up_axis(motion, diagnostics).axis;
  motion.skeleton.up = axis;
  if (before_axis == axis) {
    diagnostics.add(Severity::Note, "EDT009",
                    axis == 2 ? "z points up already" : "y points up already");
    return motion;
  }
  const QuarterTurn turn{static_cast<Eigen::Index>(before_axis), static_cast<Eigen::Index>(axis)};
  const auto readers = num_readers_of_columns(motion.skeleton);
  const Skeleton before = motion.skeleton;
  std::vector<bool> is_turned(readers.size(), false);
  for (Joint& joint : motion.skeleton.joints) {
    turn_joint(turn, readers, joint, is_turned, motion);
  }
  rename_channels(before, motion.skeleton);
  return motion;
}

LongMotion up(const LongMotion& motion, std::size_t axis) {
  LongMotion result = motion;
  const Motion& old = std::get<Motion>(motion.document.content);
  Diagnostics ignored;  // the axis is known
  result.document.content = up(old, axis, ignored);
  // Each frame is turned by itself.
  const auto block = std::make_shared<Motion>();
  result.frames.rows = [block, skeleton = old.skeleton, frames = motion.frames, axis](
                           std::size_t first,
                           std::size_t count) -> Result<std::span<const double>> {
    const auto rows = frames.rows(first, count);
    if (!rows) return fail(rows.error());
    const Clip clip{count, frames.num_coordinates, Array<double>::adopt(*rows, nullptr), {}};
    Diagnostics told_before;
    *block = up({skeleton, clip}, axis, told_before);
    return std::span<const double>(block->clip.values);
  };
  return result;
}

Motion in_place(Motion motion, Diagnostics& diagnostics) {
  if (motion.skeleton.joints.empty()) return motion;
  motion.skeleton.up = settle_up_axis(motion, diagnostics).axis;
  const auto up = static_cast<Eigen::Index>(*motion.skeleton.up);
  for (const Traveller& traveller : travellers_of(motion, find_travellers(motion))) {
    hold(traveller, up, motion.clip);
  }
  return motion;
}

}  // namespace kinefile::edit
